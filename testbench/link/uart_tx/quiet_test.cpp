// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// uart_tx: clocks that the twin skips are those in which nothing changes. Documentation:
// docs/link.md
#include "catch.hpp"
#include "feltgate/uart_tx.hpp"
#include "random.hpp"

using feltgate::UartRx;
using feltgate::UartTx;
using feltgate::test::Random;

namespace {

bool same(const UartTx& a, const UartTx& b) {
  return a.out().ready == b.out().ready && a.out().tx == b.out().tx && a.busy() == b.busy() &&
         a.quiet() == b.quiet();
}

}  // namespace

TEST_CASE("uart_tx: as many clocks as are quiet are one skip, and no clock more") {
  // Bits of 50 clocks, of 8 1/3, and of 16.
  for (const std::uint32_t step : {1311U, 7864U, 4096U}) {
    CAPTURE(step);
    UartTx skipped(step), clocked(step);
    REQUIRE(skipped.quiet() == UartRx::kForever);
    Random random(step);
    std::int64_t busy_skips = 0, idle_skips = 0;
    for (int k = 0; k < 20'000; ++k) {
      const bool sends = skipped.out().ready && random.one_in(4);
      const std::int64_t quiet = sends ? 0 : skipped.quiet();
      if (quiet > 0) {
        const std::int64_t clocks = std::min<std::int64_t>(quiet, 1 + random.below(200));
        (skipped.busy() ? busy_skips : idle_skips) += 1;
        skipped.skip(clocks);
        for (std::int64_t n = 0; n < clocks; ++n) {
          clocked.clock({});
          REQUIRE(clocked.out().tx == skipped.out().tx);
        }
      } else {
        const UartTx::In in{static_cast<std::uint8_t>(random.below(256)), sends};
        skipped.clock(in);
        clocked.clock(in);
      }
      REQUIRE(same(skipped, clocked));
    }
    CHECK(busy_skips > 1'000);
    CHECK(idle_skips > 100);
  }
}

TEST_CASE("uart_tx: a line at rest stays so for ever, one in a bit until its end") {
  constexpr std::uint32_t step = 4096;  // 16 clocks a bit
  UartTx twin(step);
  twin.clock({});
  CHECK(twin.quiet() == UartRx::kForever);
  twin.clock({0x55, true});
  for (int bit = 0; bit < 10; ++bit) {
    CAPTURE(bit);
    REQUIRE(twin.busy());
    REQUIRE(twin.quiet() == 15);
    twin.skip(15);
    REQUIRE(twin.quiet() == 0);
    REQUIRE(twin.out().ready == (bit == 9));
    twin.clock({});
  }
  CHECK_FALSE(twin.busy());
  CHECK(twin.quiet() == UartRx::kForever);
}

TEST_CASE("uart_tx: behind a byte whose bits are no whole clocks the phase begins anew first") {
  UartTx twin(1311);
  twin.clock({0x55, true});
  while (twin.busy()) twin.clock({});
  CHECK(twin.quiet() == 0);
  twin.clock({});
  CHECK(twin.quiet() == UartRx::kForever);
}
