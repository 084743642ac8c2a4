// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// uart_tx: RTL against twin on every clock; every edge in its place; the receiver takes what it
// sends; the twin from event to event. Documentation: docs/link.md
#include "feltgate/uart_tx.hpp"

#include <Vuart_tx.h>

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "feltgate/uart_line.hpp"
#include "lock_step.hpp"
#include "random.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr double kBitClocks = static_cast<double>(CLOCK_HZ) / BAUD;

struct Twin : UartTx {
  Twin() : UartTx(uart_step(CLOCK_HZ, BAUD)) {}
};

struct Adapter {
  static void drive(Vuart_tx& rtl, const Twin::In& in) {
    rtl.byte_i = in.byte;
    rtl.valid_i = in.valid;
  }
  template <class Check>
  static void compare(Check& check, const Vuart_tx& rtl, const Twin::Out& out) {
    check("ready", rtl.ready_o, out.ready);
    check("tx", rtl.tx_o, out.tx);
  }
};
using Bench = LockStep<Vuart_tx, Twin, Adapter>;

/// Bytes with and without gaps, held until they are taken.
struct Bytes {
  Random random;
  bool gaps = true;
  Twin::In in{};
  int gap = 0;
  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    if (in.valid && out_ready) in.valid = false;
    if (!in.valid && gap-- <= 0) {
      in = {static_cast<std::uint8_t>(random.below(256)), true};
      gap = !gaps || !random.one_in(30) ? 0 : static_cast<int>(random.below(1500));
    }
    out_ready = out.ready;
    return in;
  }
  bool out_ready = false;
};

}  // namespace

TEST_CASE("uart_tx: bytes at random, RTL against twin; resets") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Bench bench("uart_tx", seed);
    bench.run(Bytes{Random(seed)}, scaled_clocks(static_cast<std::int64_t>(4000 * kBitClocks)),
              {30'000});
  }
}

TEST_CASE("uart_tx: bytes without an end: the phase comes by every value before a bit's end") {
  Bench bench("uart_tx", 9);
  bench.run(Bytes{Random(9), false}, scaled_clocks(static_cast<std::int64_t>(5000 * kBitClocks)),
            {});
}

TEST_CASE("uart_tx: edges less than a clock late, bytes without a gap") {
  Twin twin;
  const std::vector<std::uint8_t> bytes{0x55, 0x00, 0xff, 0xc0, 0xdb, 0xaa};
  std::vector<bool> levels;
  std::size_t taken = 0;
  while (taken < bytes.size() || twin.busy()) {
    const bool valid = taken < bytes.size();
    const bool takes = valid && twin.out().ready;
    twin.clock({valid ? bytes[taken] : std::uint8_t{0}, valid});
    if (takes) ++taken;
    levels.push_back(twin.out().tx);
  }
  const double bit = 65536.0 / uart_step(CLOCK_HZ, BAUD);
  CHECK(std::abs(bit / kBitClocks - 1) < 1.001 * kBitClocks / 131072);  // half a step in STEP
  for (std::size_t n = 0; n < 10 * bytes.size(); ++n) {
    const std::size_t k = n % 10;
    const bool wanted = k == 0 ? false : k == 9 || ((bytes[n / 10] >> (k - 1)) & 1U) != 0;
    const auto from = static_cast<std::size_t>(std::ceil(static_cast<double>(n) * bit));
    const auto to = static_cast<std::size_t>(std::floor(static_cast<double>(n + 1) * bit));
    for (std::size_t clock = from; clock < to; ++clock) {
      INFO("bit " << n << ", clock " << clock);
      REQUIRE(levels[clock] == wanted);
    }
  }
}

TEST_CASE("uart_tx: a receiver takes what it sends; both from event to event") {
  UartLine slow(CLOCK_HZ, BAUD), fast(CLOCK_HZ, BAUD);
  Random random(3);
  std::vector<std::uint8_t> sent;
  for (int k = 0; k < 300; ++k) {
    sent.push_back(static_cast<std::uint8_t>(random.below(256)));
    slow.send(sent.back());
    fast.send(sent.back());
  }
  const auto clocks = static_cast<std::int64_t>(310 * 10 * kBitClocks);
  for (std::int64_t k = 0; k < clocks; ++k) slow.clock(slow.level());  // what it sends comes back
  std::int64_t calls = 0;
  for (std::int64_t k = 0; k < clocks;) {
    const std::int64_t n = std::min(fast.quiet(fast.level()), clocks - k);
    if (n > 0) {
      fast.skip(n);
      k += n;
    } else {
      fast.clock(fast.level());
      ++k;
    }
    ++calls;
  }
  CHECK(calls < clocks / 2);
  CHECK(slow.take_received() == sent);
  CHECK(fast.take_received() == sent);
  CHECK(slow.unsent() + fast.unsent() == 0);
}

// uart_tx: clocks that the twin skips are those in which nothing changes.

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
