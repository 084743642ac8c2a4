// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// uart_rx: clocks that the twin skips are those in which nothing changes. Documentation:
// docs/link.md
#include "catch.hpp"
#include "feltgate/uart_rx.hpp"
#include "random.hpp"

using feltgate::UartRx;
using feltgate::test::Random;

namespace {

bool same(const UartRx& a, const UartRx& b, bool rx) {
  return a.out().valid == b.out().valid && a.out().error == b.out().error &&
         a.out().byte == b.out().byte && a.quiet(rx) == b.quiet(rx);
}

}  // namespace

TEST_CASE("uart_rx: as many clocks as are quiet are one skip, and no clock more") {
  // Bits of 50 clocks, of 8 1/3, and of 16; the line changes at any time.
  for (const std::uint32_t step : {1311U, 7864U, 4096U}) {
    CAPTURE(step);
    const std::int64_t bit = 65536 / step;
    UartRx skipped(step), clocked(step);
    Random random(step);
    std::int64_t busy_skips = 0, idle_skips = 0, bytes = 0, errors = 0;
    for (int k = 0; k < 20'000; ++k) {
      const bool rx = random.one_in(2);
      // Long levels too: a byte that ends, and a line at rest.
      std::int64_t left =
          random.one_in(3) ? 30 * bit : 1 + random.below(3 * static_cast<std::uint32_t>(bit));
      while (left > 0) {
        const std::int64_t quiet = skipped.quiet(rx);
        const std::int64_t clocks = std::max<std::int64_t>(1, std::min(quiet, left));
        if (quiet > 0) {
          (quiet == UartRx::kForever ? idle_skips : busy_skips) += 1;
          skipped.skip(clocks);
        } else {
          skipped.clock({rx});
        }
        for (std::int64_t n = 0; n < clocks; ++n) clocked.clock({rx});
        left -= clocks;
        bytes += clocked.out().valid ? 1 : 0;
        errors += clocked.out().error ? 1 : 0;
        REQUIRE(same(skipped, clocked, rx));
        REQUIRE(same(skipped, clocked, !rx));
      }
    }
    CHECK(busy_skips > 1'000);
    CHECK(idle_skips > 100);
    CHECK(bytes > 100);
    CHECK(errors > 100);
  }
}

TEST_CASE("uart_rx: a line at rest stays so for ever, whatever is under way does not") {
  constexpr std::uint32_t step = 4096;  // 16 clocks a bit
  UartRx twin(step);
  const auto clocks = [&twin](bool rx, int n) {
    for (int k = 0; k < n; ++k) twin.clock({rx});
  };
  clocks(true, 3);
  CHECK(twin.quiet(true) == UartRx::kForever);
  CHECK(twin.quiet(false) == 0);
  clocks(false, 4);
  CHECK(twin.quiet(true) == 0);
  clocks(false, 4);  // in the start bit, of which half is under way
  const std::int64_t half = twin.quiet(false);
  CHECK(half > 0);
  CHECK(half < 8);
  twin.skip(half);
  CHECK(twin.quiet(false) == 0);
  clocks(false, 1);
  CHECK(twin.quiet(false) == 15);
  clocks(false, 9 * 16);  // the stop bit was low
  CHECK(twin.out().error);
  CHECK(twin.quiet(false) == 0);
  clocks(false, 2);  // it waits for a line at rest
  CHECK(twin.quiet(false) == UartRx::kForever);
  clocks(true, 2);
  CHECK(twin.quiet(true) == 0);
  clocks(true, 6);
  CHECK(twin.quiet(true) == UartRx::kForever);
}

TEST_CASE("uart_rx: the step of a rate is the nearest") {
  CHECK(feltgate::uart_step(50'000'000, 1'000'000) == 1311);  // 1310.72
  CHECK(feltgate::uart_step(27'000'000, 500'000) == 1214);    // 1213.63
  CHECK(feltgate::uart_step(50'000'000, 2'000'000) == 2621);  // 2621.44
}
