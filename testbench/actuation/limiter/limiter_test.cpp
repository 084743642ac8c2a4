// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// limiter: RTL against twin on every clock, and both against a plain integer program.
// Documentation: docs/blocks/torque_control.md
#include <Vlimiter.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "../../estimators/lowpass/exact.hpp"
#include "catch.hpp"
#include "limiter_twin.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "unreset.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr int kWide = Design::f.limiter_input.width();
constexpr int kWidth = Design::f.limiter.width();
constexpr int kSum = Design::f.with_addend.width();
constexpr std::int64_t kMaxX = (std::int64_t{1} << (kWide - 1)) - 1;
constexpr std::int64_t kMaxLimit = (std::int64_t{1} << (kWidth - 1)) - 1;

using Twin = Filled<Limiter<Design>, 2>;
using Rtl = Unreset<Vlimiter>;

struct Adapter {
  static void drive(Rtl& rtl, const Twin::In& in) {
    FELTGATE_DRIVE(rtl, in, valid, torque, voltage, duty);
    // The width of the port is the design's: 32 or 64 bits of a word.
    using Port = std::remove_reference_t<decltype(rtl.early_term_i)>;
    rtl.early_term_i = port_bits<kWide, Port>(in.early_term);
    rtl.late_term_i = port_bits<kWide, Port>(in.late_term);
    FELTGATE_DRIVE(rtl, in, early_up, late_not, late_up);
    rtl.addend_i = port_bits<kSum>(in.addend);
    rtl.param_i = in.param;
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    if (!out.known) return;
    check("limited", sign_extend<kSum>(rtl.limited_o), out.limited);
    check("over_limit", rtl.over_limit_o, out.over_limit);
  }
};

using Bench = LockStep<Rtl, Twin, Adapter>;

/// One x and its limit.
struct Case {
  bool valid = true, early_term = false;  ///< x comes a clock ahead
  bool up = false;                        ///< x is rounded up
  int signal = 0;                         ///< 1 torque, 2 voltage, 3 duty
  std::int64_t x = 0;                     ///< before it is rounded up
  std::uint32_t param = 0;
  std::int64_t addend = 0;
  bool complement = false;  ///< x comes as its complement, if it is late
};

/// Cases from next(), one per clock.
template <class Next>
struct Pipeline {
  Next next;
  Case now{}, after{};

  Twin::In operator()(std::int64_t) {
    now = after;
    after = next();
    return {after.valid,
            after.early_term ? after.x : 0,
            now.early_term   ? 0
            : now.complement ? ~now.x
                             : now.x,
            now.param,
            after.signal == 1,
            after.signal == 2,
            after.signal == 3,
            after.early_term && after.up,
            !now.early_term && now.up,
            now.addend,
            !now.early_term && now.complement};
  }
};

/// x of every size, and around its limit; limits of every size, 0, negative, and any 32 bits.
struct RandomCases {
  Random random;

  Case operator()() {
    Case c;
    c.valid = !random.one_in(4);
    c.early_term = random.coin();
    if (c.valid) c.signal = static_cast<int>(random.below(4));
    std::int64_t limit = kMaxLimit >> random.below(static_cast<std::uint64_t>(kWidth));
    if (random.one_in(4))
      limit = std::int64_t{1} << random.below(
                  static_cast<std::uint64_t>(kWidth - 1));  // one misfit bit
    if (random.one_in(8)) limit = -1 - limit;
    c.param = static_cast<std::uint32_t>(limit);
    // The bits above the limit's width have no effect.
    if (random.one_in(4)) c.param ^= static_cast<std::uint32_t>(random.bits()) << (kWidth % 32);
    c.x = static_cast<std::int64_t>(random.bits()) >>
          (64 - kWide + static_cast<int>(random.below(static_cast<std::uint64_t>(kWide))));
    if (random.one_in(3)) {
      c.x = (random.coin() ? limit : -limit) + random.between(-2, 2);
    } else if (random.one_in(16)) {
      c.x = random.coin() ? kMaxX : -kMaxX - 1;
    }
    c.up = random.one_in(3);
    c.addend = random.between(-kMaxLimit - 1, kMaxLimit);
    c.complement = random.coin();
    return c;
  }
};

/// The plain program.
struct Plain {
  Twin::In before[2] = {};
  int filled = 0;

  const char* operator()(const Twin::In& in, const Rtl& rtl, const Twin&, bool in_reset) {
    // One of each is 0.
    const std::int64_t late = in.late_not ? -1 - in.late_term : in.late_term;
    const std::int64_t x = before[0].early_term + late + (before[0].early_up || in.late_up);
    const bool valid = before[0].valid;
    const int width = before[0].torque    ? Design::f.torque.width()
                      : before[0].voltage ? Design::f.voltage.width()
                      : before[0].duty    ? Design::f.duty.width()
                                          : kWidth;
    before[0] = in;
    filled = in_reset ? 0 : filled + 1;
    if (filled < 2) return nullptr;
    const std::int64_t limit = sign_extend<kWidth>(in.param);
    const std::int64_t size = x < 0 ? -x : x;
    const bool misfit = limit >= std::int64_t{1} << (width - 1);
    const bool over_limit = misfit || size > limit;
    const std::int64_t most = misfit ? 0 : std::max<std::int64_t>(limit, 0);
    const std::int64_t limited = !valid ? 0 : std::clamp(x, -most, most);
    if (sign_extend<kSum>(rtl.limited_o) != limited + in.addend)
      return "limited of the plain program";
    if ((rtl.over_limit_o != 0) != over_limit) return "beyond of the plain program";
    return nullptr;
  }
};

}  // namespace

TEST_CASE("limiter: random x and limits, both ways in, with and without valid") {
  Bench bench("limiter", 1);
  bench.run(Pipeline<RandomCases>{{Random(2)}}, scaled_clocks(1000000), {1000}, Plain{});
}

TEST_CASE("limiter: every pair of corners, each way in, back to back") {
  std::vector<std::int64_t> corners{0, 1, -1};
  for (int k = 1; k < kWide; ++k) {
    const std::int64_t power = std::int64_t{1} << k;
    for (const std::int64_t x : {power - 1, power, power + 1}) {
      if (x > kMaxX) continue;
      corners.push_back(x);
      corners.push_back(-x);
    }
  }
  corners.push_back(-kMaxX - 1);
  std::vector<Case> cases;
  for (const std::int64_t x : corners) {
    for (const std::int64_t limit : corners) {
      if (limit > kMaxLimit || limit < -kMaxLimit - 1) continue;
      for (const bool early_term : {false, true}) {
        for (const bool up : {false, true}) {
          cases.push_back({true, early_term, up, 0, x, static_cast<std::uint32_t>(limit), 7, up});
        }
      }
    }
  }
  struct Listed {
    const std::vector<Case>* cases;
    std::size_t k = 0;
    Case operator()() { return (*cases)[k++ % cases->size()]; }
  };
  Bench bench("limiter", 3);
  bench.run(Pipeline<Listed>{{&cases}}, static_cast<std::int64_t>(cases.size()) + 10, {}, Plain{});
}

TEST_CASE("limiter: the law takes the largest limit of a format, and the next one for none") {
  using D = FELTGATE_DESIGN;
  using Law = LimiterLaw<D, Fixed>;
  constexpr int key = Law::key<D::f.torque.fraction>;
  using Torque = fixed_of<D::f.torque.key()>;
  for (const std::int64_t more : {-1, 0, 1, 2}) {
    bool hit = false;
    const auto limit = Fixed::from_raw<key>(Torque::max_raw() + more);
    const auto got = Law::limited<Torque, D::f.torque.key()>(Torque::from_raw(9), limit, &hit);
    REQUIRE(hit == (more > 0));
    REQUIRE(got.raw() == (more > 0 ? 0 : 9));
  }
}
