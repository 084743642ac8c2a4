// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// uart_rx: RTL against twin on every clock on rough lines; which bytes arrive at which baud rates;
// the twin from event to event. Documentation: docs/link.md
#include "feltgate/uart_rx.hpp"

#include <Vuart_rx.h>

#include <cmath>
#include <cstdint>
#include <deque>

#include "catch.hpp"
#include "lock_step.hpp"
#include "random.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// A UART line as a host of another clock drives it: its own baud rate, any phase, gaps, pulses of
/// one clock, stop bits that are low, breaks.
struct RoughLine {
  struct Faults {
    bool pulses = false;   ///< of one clock, at least six clocks apart
    bool framing = false;  ///< stop bits that are low, breaks, half bytes
  };
  /// `bit_clocks`: of this host.
  RoughLine(std::uint64_t seed, double bit_clocks, Faults f)
      : random(seed), bit(bit_clocks), faults(f) {}

  /// The level in the next clock.
  bool next() {
    now += 1.0;
    while (now >= edge) begin_bit();
    bool now_level = level;
    if (faults.pulses && since_pulse > 6 && random.one_in(25)) {
      since_pulse = 0;
      now_level = !now_level;
    }
    ++since_pulse;
    return now_level;
  }

  void begin_bit() {
    if (left == 0) begin();
    level = (bits & 1U) != 0;
    bits >>= 1;
    --left;
    edge += bit * (left == 0 ? last : 1.0);
  }

  /// A byte, a gap, or what is wrong.
  void begin() {
    last = 1.0;
    if (random.one_in(3)) {  // idle for any time
      bits = 1;
      left = 1;
      last = random.one_in(20) ? 30.0 : 0.001 * static_cast<double>(1 + random.below(2000));
      return;
    }
    if (faults.framing && random.one_in(20)) {  // low for long: one error
      bits = 0x1000U;
      left = 13;
      last = 2.0;
      wrong += 1;
      return;
    }
    const auto byte = static_cast<std::uint8_t>(random.below(256));
    const bool low_stop = faults.framing && random.one_in(20);
    bits = (low_stop ? 0x400U : 0x200U) | static_cast<unsigned>(byte) << 1;
    left = low_stop ? 11 : 10;
    if (low_stop) {
      ++wrong;
    } else {
      sent.push_back(byte);
    }
  }

  Random random;
  double bit, now = 0, edge = 0, last = 1;
  Faults faults;
  bool level = true;
  unsigned bits = 1;
  int left = 0, since_pulse = 0;
  std::deque<std::uint8_t> sent;  ///< whose stop bits were high
  std::int64_t wrong = 0;         ///< the others
};

constexpr double kBitClocks = static_cast<double>(CLOCK_HZ) / BAUD;

struct Twin : UartRx {
  Twin() : UartRx(uart_step(CLOCK_HZ, BAUD)) {}
};

struct Adapter {
  static void drive(Vuart_rx& rtl, const Twin::In& in) { rtl.rx_i = in.rx; }
  template <class Check>
  static void compare(Check& check, const Vuart_rx& rtl, const Twin::Out& out) {
    check("byte", rtl.byte_o, out.byte);
    check("valid", rtl.valid_o, out.valid);
    check("error", rtl.error_o, out.error);
  }
};
using Bench = LockStep<Vuart_rx, Twin, Adapter>;

/// Bytes that arrive wrong or not at all of those that a host sends whose clock is off by `error`.
int wrong_bytes(double error, RoughLine::Faults faults, std::int64_t clocks, std::uint64_t seed) {
  RoughLine line(seed, kBitClocks / (1.0 + error), faults);
  Twin twin;
  int wrong = 0;
  std::int64_t arrived = 0, errors = 0;
  for (std::int64_t k = 0; k < clocks; ++k) {
    twin.clock({line.next()});
    errors += twin.out().error;
    if (!twin.out().valid) continue;
    ++arrived;
    if (line.sent.empty()) {
      ++wrong;
      continue;
    }
    wrong += twin.out().byte != line.sent.front();
    line.sent.pop_front();
  }
  CHECK(arrived > clocks / static_cast<std::int64_t>(40 * kBitClocks));
  const auto rest = static_cast<int>(line.sent.size());
  const auto unseen = static_cast<int>(std::abs(line.wrong - errors));
  return wrong + (rest > 2 ? rest : 0) + (unseen > 1 ? unseen : 0);
}

}  // namespace

TEST_CASE("uart_rx: rough lines, RTL against twin") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    const double error = 0.001 * static_cast<double>(random.between(-80, 80));
    RoughLine line(seed, kBitClocks / (1 + error), {seed % 2 == 0, seed % 3 != 0});
    Bench bench("uart_rx", seed);
    bench.run([line](std::int64_t) mutable { return Twin::In{line.next()}; },
              scaled_clocks(static_cast<std::int64_t>(2500 * kBitClocks)), {20'000});
  }
}

TEST_CASE("uart_rx: levels at random") {
  Random random(5);
  int left = 0;
  bool level = true;
  Bench bench("uart_rx", 77);
  bench.run(
      [=](std::int64_t) mutable {
        if (left-- == 0) {
          level = !level;
          left = static_cast<int>(
              random.below(random.one_in(3) ? 3 : 4 * static_cast<unsigned>(kBitClocks)));
        }
        return Twin::In{level};
      },
      scaled_clocks(200'000));
}

TEST_CASE("uart_rx: every byte arrives from a host that is off by 2 %, beside pulses of a clock") {
  const auto clocks = static_cast<std::int64_t>(30'000 * kBitClocks);
  for (const double error : {-0.02, -0.01, 0.0, 0.01, 0.02}) {
    INFO("off by " << error);
    CHECK(wrong_bytes(error, {false, false}, clocks, 1) == 0);
    CHECK(wrong_bytes(error, {true, false}, clocks, 2) == 0);
    CHECK(wrong_bytes(error, {false, true}, clocks, 3) == 0);
  }
}

TEST_CASE("uart_rx: the bound of the sampling point") {
  // At most a clock and what the step is rounded by, so that in the middle of the stop bit the two
  // baud rates may differ by (1/2 - 1 / bit) / 9.5; half of a clock goes to the filter.
  const double step = static_cast<double>(uart_step(CLOCK_HZ, BAUD)) / 65536.0 * kBitClocks;
  const double bearable = (0.5 - 2.0 / kBitClocks) / 9.5 - std::abs(step - 1.0);
  const auto clocks = static_cast<std::int64_t>(60'000 * kBitClocks);
  CHECK(bearable > 0.025);
  CHECK(wrong_bytes(bearable * 0.99, {false, false}, clocks, 4) == 0);
  CHECK(wrong_bytes(-bearable * 0.99, {false, false}, clocks, 5) == 0);
  CHECK(wrong_bytes(0.07, {false, false}, clocks, 6) > 0);
  CHECK(wrong_bytes(-0.07, {false, false}, clocks, 7) > 0);
}

TEST_CASE(
    "uart_rx: a low start of less than half a bit is none; a line that is held low is one error") {
  Twin twin;
  int errors = 0, bytes = 0;
  const auto hold = [&](bool level, double bits) {
    for (int k = 0; k < static_cast<int>(bits * kBitClocks); ++k) {
      twin.clock({level});
      errors += twin.out().error;
      bytes += twin.out().valid;
    }
  };
  hold(true, 3);
  for (int k = 0; k < 5; ++k) {
    hold(false, 0.35);
    hold(true, 12);
  }
  CHECK(errors + bytes == 0);
  hold(false, 100);
  CHECK(errors == 1);
  hold(true, 0.5);
  CHECK(bytes == 0);
}

// uart_rx: clocks that the twin skips are those in which nothing changes.

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
