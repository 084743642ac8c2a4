// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// self_test: RTL against twin on every clock, and directed tests of its course. In closed loop:
// start_test.cpp. Documentation: docs/blocks/supervisor.md
#include <Vself_test.h>

#include <array>
#include <functional>
#include <vector>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/self_test.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate {

/// Clocked twin; D gives the width of a torque.
template <class D>
class SelfTest {
 public:
  struct In {
    bool armed = false;
    bool direct = false;
    std::uint16_t travel = 0;
    std::uint32_t tick_count = 0;
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    bool waits = false;
  };
  struct Out {
    bool busy = false;
    std::int64_t early_term = 0;
    std::uint8_t result = 0;
    bool trip = false;
  };

  void reset() { *this = SelfTest{}; }

  void clock(const In& in) {
    last_ = in;
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    const TestPulse pulse = at(T::scene_rounded) ? law_.pulse(in.armed) : TestPulse::none;
    constexpr std::int64_t most = (std::int64_t{1} << (D::f.scene_torque.width() - 1)) - 1;
    early_ = pulse == TestPulse::up ? most : pulse == TestPulse::down ? -most - 1 : 0;
    if (at(T::sample)) law_.sample(in.travel);
    if (at(T::self_test_quiet)) words_.quiet = in.param;
    if (at(T::self_test_over)) words_.pulse = in.param;
    if (at(T::self_test_turn)) {
      words_.arms = in.param;
      fails_ = law_.turn(in.armed, in.direct, in.tick_count, words_, in.waits);
    }
  }

  /// With the inputs of the last clock, and with others.
  Out out() const { return peek(last_); }
  Out peek(const In& in) const {
    const bool now = ((in.wave >> Map::T::self_test) & 1u) != 0;
    return {law_.busy(in.armed), early_, static_cast<std::uint8_t>(law_.result()), now && fails_};
  }

 private:
  In last_;
  SelfTestLaw law_;
  SelfTestLaw::Words words_;
  std::int64_t early_ = 0;
  bool fails_ = false;
};

}  // namespace feltgate

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Design = FELTGATE_DESIGN;
using Twin = SelfTest<Design>;

struct Adapter {
  static void drive(Vself_test& rtl, const Twin::In& in) {
    rtl.armed_i = in.armed;
    rtl.direct_i = in.direct;
    rtl.waits_i = in.waits;
    rtl.travel_i = static_cast<std::uint8_t>(in.travel & 3);
    rtl.tick_count_i = in.tick_count;
    FELTGATE_STROBES(rtl, in.wave, at, T, sample, scene_rounded, self_test_quiet, self_test_over,
                     self_test_turn, self_test);
    rtl.param_i = in.param;
  }
  template <class Check>
  static void compare(Check& check, const Vself_test& rtl, const Twin::Out& out) {
    check("busy", rtl.busy_o, out.busy);
    check("early_term", sign_extend<Design::f.scene_torque.width()>(rtl.early_term_o),
          out.early_term);
    check("result", rtl.result_o, out.result);
    check("trip", rtl.trip_o, out.trip);
  }
};
using Bench = LockStep<Vself_test, Twin, Adapter>;

/// The inputs of one wave.
struct Wave {
  bool armed = true, direct = false;
  int step = 0;                       ///< counts since the wave before
  std::uint32_t ticks = 1;            ///< by which the counter has moved
  SelfTestLaw::Words words{2, 3, 3};  ///< quiet, pulse, arms
  bool waits = false;                 ///< another axis is before
};

/// The outputs of a wave.
struct Seen {
  bool busy = false, trip = false;
  int pulse = 0;
  unsigned result = 0;
};

using Next = std::function<Wave(std::int64_t k, const Seen& before)>;

/// The clocks of waves of next(wave number), with any words in the clocks between.
struct Waves {
  Next next;
  Random random;
  std::vector<Seen>* seen;
  Twin::In in;
  Wave wave;
  Seen now;
  std::int64_t k = 0;
  int clock = 0;

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    note(out);
    if (clock == 0) {
      if (k > 0 && seen != nullptr) seen->push_back(now);
      wave = next(k++, now);
      now = {};
      in.armed = wave.armed;
      in.direct = wave.direct;
      in.waits = wave.waits;
      in.travel = static_cast<std::uint16_t>(in.travel + wave.step);
      in.tick_count += wave.ticks;
    }
    in.wave = std::uint64_t{1} << clock;
    in.param = static_cast<std::uint32_t>(random.bits());
    if (clock == Map::W::self_test_quiet) in.param = wave.words.quiet;
    if (clock == Map::W::self_test_pulse) in.param = wave.words.pulse;
    if (clock == Map::W::self_test_arms) in.param = wave.words.arms;
    clock = clock == Map::wave_length - 1 ? 0 : clock + 1;
    return in;
  }
  /// Of the clock before.
  void note(const Twin::Out& out) {
    now.busy = out.busy;
    now.result = out.result;
    now.trip = now.trip || out.trip;
    if (out.early_term != 0) now.pulse = out.early_term > 0 ? 1 : -1;
  }
};

std::vector<Seen> play(const Next& next, std::int64_t waves) {
  std::vector<Seen> seen;
  Bench bench("self_test", 3);
  const std::int64_t clocks = Bench::kFirstReset + Map::wave_length * (waves + 1);
  bench.run(Waves{next, Random(1), nullptr, {}, {}, {}}, clocks);
  Twin twin;  // the RTL does the same
  twin.reset();
  Waves live{next, Random(1), &seen, {}, {}, {}};
  for (std::int64_t c = 0; c < clocks; ++c) twin.clock(live(c, twin.out()));
  REQUIRE(static_cast<std::int64_t>(seen.size()) >= waves);
  return seen;
}

constexpr int kUnit = 1 << Map::self_test_unit_bits;

std::int64_t waves_with(const std::vector<Seen>& seen, int pulse) {
  std::int64_t n = 0;
  for (const Seen& s : seen) n += s.pulse == pulse ? 1 : 0;
  return n;
}
std::int64_t trips(const std::vector<Seen>& seen) {
  std::int64_t n = 0;
  for (const Seen& s : seen) n += s.trip ? 1 : 0;
  return n;
}

/// Disarmed for two waves, then armed; `step` is what the lever does beside.
Next start(const std::function<int(std::int64_t, const Seen&)>& step, SelfTestLaw::Words words) {
  return [step, words](std::int64_t k, const Seen& before) {
    Wave w;
    w.armed = k >= 2;
    w.words = words;
    w.step = step(k, before);
    return w;
  };
}
int still(std::int64_t, const Seen&) { return 0; }

/// A word of any size, most of them within the counter.
std::uint32_t any(Random& random) {
  const auto word = static_cast<std::uint32_t>(random.bits());
  return random.one_in(4) ? word : word & 0xffU;
}

/// So many counts towards `sign` in the first pulse, one every 50 waves, none while pulse is 0.
std::function<int(std::int64_t, const Seen&)> answers(int counts, int in_pulse = 1) {
  int left = counts, wait = 50;
  return [left, wait, in_pulse](std::int64_t k, const Seen& before) mutable {
    if (k == 0) return 0;
    if (before.pulse != in_pulse || left == 0 || --wait > 0) return 0;
    wait = 50;
    const int step = left > 0 ? 1 : -1;
    left -= step;
    return step;
  };
}

}  // namespace

TEST_CASE("self_test: random levers, words, times and resets") {
  std::array<std::int64_t, 4> results{};
  std::int64_t tripped = 0;
  for (const std::uint32_t distance : {0U, 20000U}) {
    struct Life {
      Random random{9};
      Wave w{};
      int mood = 0;
      Wave operator()(std::int64_t, const Seen& before) {
        if (random.one_in(w.armed ? 60 : 4)) w.armed = !w.armed;
        if (before.trip) w.armed = false;
        w.direct = random.one_in(w.direct ? 5 : 200);
        if (random.one_in(w.waits ? 8 : 80)) w.waits = !w.waits;
        w.ticks = random.one_in(10) ? 3 * kUnit : random.below(2 * kUnit);
        if (random.one_in(30)) w.ticks = 1 << Map::self_test_patience_bits;
        if (random.one_in(400)) w.ticks = static_cast<std::uint32_t>(random.bits());
        if (random.one_in(15)) mood = static_cast<int>(random.below(6));
        w.step = 0;
        if (mood == 1) w.step = random.one_in(4) ? 1 : 0;
        if (mood == 2) w.step = random.one_in(4) ? -1 : 0;
        if (mood == 3) w.step = static_cast<int>(random.below(4)) - 1;
        if (mood == 4 && before.pulse != 0) w.step = random.one_in(3) ? before.pulse : 0;
        if (mood == 5 && before.pulse != 0) w.step = random.one_in(3) ? -before.pulse : 0;
        if (random.one_in(40)) {
          w.words.quiet = random.below(4);
          w.words.pulse = random.below(6);
          w.words.arms = random.below(4);
          if (random.one_in(5)) w.words.quiet = any(random);
          if (random.one_in(5)) w.words.pulse = any(random);
        }
        return w;
      }
    };
    struct Watch {
      std::array<std::int64_t, 4>* results;
      std::int64_t* tripped;
      unsigned before = 0;
      const char* operator()(const Twin::In& in, const Vself_test& rtl, const Twin&,
                             bool in_reset) {
        if (in_reset) return rtl.busy_o != 0 || rtl.trip_o != 0 ? "rest in a reset" : nullptr;
        if (rtl.result_o != before) ++(*results)[rtl.result_o];
        before = rtl.result_o;
        *tripped += rtl.trip_o;
        if (rtl.busy_o != 0 && !in.armed) return "busy while disarmed";
        return nullptr;
      }
    };
    Bench bench("self_test", 5);
    bench.run(Waves{Life{}, Random(2), nullptr, {}, {}, {}}, scaled_clocks(2000000), {distance},
              Watch{&results, &tripped});
  }
  CAPTURE(results, tripped);
  for (const std::int64_t n : results) CHECK(n >= 20);
  CHECK(tripped >= 50);
}

TEST_CASE("self_test: a time beyond the counter is the longest") {
  using Words = SelfTestLaw::Words;
  const auto next = [](Words words) {
    return [inner = start(still, words)](std::int64_t k, const Seen& before) {
      Wave w = inner(k, before);
      w.ticks = kUnit;
      return w;
    };
  };
  constexpr std::uint32_t most = 255;
  for (const std::uint32_t word : {256U, 0x8000'0000U, 0xffff'ffffU}) {
    const auto pulses = play(next({2, word, 3}), 2 * most + 40);
    CHECK(waves_with(pulses, 1) == most + 1);
    CHECK(waves_with(pulses, -1) == most + 1);
    const auto quiet = play(next({word, 3, 3}), most + 40);
    CHECK(waves_with(quiet, 1) == 4);
    CHECK(quiet[most].pulse == 0);
  }
}

TEST_CASE("self_test: the times are counted to the end of their words") {
  // A unit passes in every wave; each word has high bits, and 0 among its low ones.
  using Words = SelfTestLaw::Words;
  for (const Words words : {Words{200, 130, 0}, Words{66, 249, 0}, Words{127, 96, 0}}) {
    const auto next = [inner = start(still, words)](std::int64_t k, const Seen& before) {
      Wave w = inner(k, before);
      w.ticks = kUnit;
      return w;
    };
    const auto seen = play(next, words.quiet + 2 * words.pulse + 20);
    CHECK(waves_with(seen, 1) == words.pulse + 1);  // with the wave that finds it over
    CHECK(waves_with(seen, -1) == words.pulse + 1);
  }
}

TEST_CASE("self_test: quiet, a pulse, its opposite of the same length, a tick of rest") {
  const auto seen = play(start(answers(3), {2, 3, 0}), 9 * kUnit);
  CHECK(waves_with(seen, 1) == 3 * kUnit);
  CHECK(waves_with(seen, -1) == 3 * kUnit);
  CHECK(trips(seen) == 0);
  std::size_t k = 0;
  while (!seen[k].busy) ++k;
  CHECK(k == 2);
  const std::size_t begin = k;
  while (seen[k].pulse == 0) ++k;
  CHECK(k - begin > kUnit);
  CHECK(k - begin <= 2 * kUnit + 2);
  while (seen[k].pulse > 0) ++k;
  while (seen[k].pulse < 0) ++k;
  CHECK(seen[k].pulse == 0);
  CHECK_FALSE(seen[k].busy);  // from the end of this wave on
  CHECK(seen[k].result == static_cast<unsigned>(SelfTestResult::right));
  CHECK(seen.back().result == static_cast<unsigned>(SelfTestResult::right));
  CHECK_FALSE(seen.back().busy);
}

TEST_CASE("self_test: two counts against the pulse trip at once, one is no answer") {
  for (const unsigned arms : {0U, 3U}) {
    const auto seen = play(start(answers(-2), {1, 3, arms}), 9 * kUnit);
    REQUIRE(trips(seen) >= 1);
    CHECK(waves_with(seen, 1) >= 100);
    std::size_t k = 0;
    while (!seen[k].trip) ++k;
    CHECK(waves_with({seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(k) + 1}, 1) == 101);
  }
  for (const int counts : {1, -1}) {
    const auto seen = play(start(answers(counts), {1, 3, 1}), 9 * kUnit);
    CHECK(trips(seen) == 0);
    CHECK(seen.back().result == static_cast<unsigned>(SelfTestResult::held));
  }
}

TEST_CASE("self_test: an answer stays what it is, however far the lever runs on") {
  for (const int way : {1, -1}) {
    const auto runs = [way](std::int64_t, const Seen& before) { return way * before.pulse; };
    const auto seen = play(start(runs, {1, 3, 1}), 9 * kUnit);
    CHECK((trips(seen) == 0) == (way > 0));
    // Against, it trips in every wave of both pulses from the second count on.
    if (way < 0) CHECK(trips(seen) > 2 * kUnit);
    if (way > 0) CHECK(seen.back().result == static_cast<unsigned>(SelfTestResult::right));
  }
}

TEST_CASE("self_test: what moves with the second pulse only is no answer") {
  const auto seen = play(start(answers(-3, -1), {1, 3, 1}), 9 * kUnit);
  CHECK(trips(seen) == 0);
  CHECK(waves_with(seen, -1) == 3 * kUnit);
  CHECK(seen.back().result == static_cast<unsigned>(SelfTestResult::held));
}

TEST_CASE("self_test: a lever that is held begins its scene or trips, as the word says") {
  for (const unsigned arms : {0U, 1U, 2U, 3U}) {
    const auto seen = play(start(still, {1, 2, arms}), 7 * kUnit);
    CHECK(trips(seen) == ((arms & 1U) != 0 ? 0 : 1));
    CHECK(seen.back().result == static_cast<unsigned>(SelfTestResult::held));
    CHECK_FALSE(seen.back().busy);
  }
}

TEST_CASE("self_test: a lever that never rests gets no pulse, and patience ends") {
  for (const unsigned arms : {0U, 1U, 2U, 3U}) {
    const auto seen = play(
        [arms](std::int64_t k, const Seen&) {
          Wave w;
          w.armed = k >= 2;
          w.words = {2, 3, arms};
          w.ticks = kUnit / 2;
          w.step = k % 3 == 0 ? 1 : 0;
          return w;
        },
        3LL << (Map::self_test_patience_bits - Map::self_test_unit_bits + 1));
    CHECK(waves_with(seen, 1) == 0);
    CHECK(trips(seen) == ((arms & 2U) != 0 ? 0 : 1));
    CHECK(seen.back().result == static_cast<unsigned>(SelfTestResult::moving));
    std::int64_t busy = 0;
    for (const Seen& s : seen) busy += s.busy ? 1 : 0;
    const std::int64_t turn = 1LL << (Map::self_test_patience_bits - Map::self_test_unit_bits + 1);
    CHECK(busy > turn);
    CHECK(busy <= 2 * turn);
  }
}

TEST_CASE("self_test: no pulse and no patience while another axis is before, and quiet after it") {
  constexpr std::int64_t kWait = 3LL << (Map::self_test_patience_bits - Map::self_test_unit_bits);
  const auto seen = play(
      [](std::int64_t k, const Seen&) {
        Wave w;
        w.armed = k >= 2;
        w.words = {2, 3, 1};
        w.ticks = kUnit;
        w.waits = k < kWait;
        return w;
      },
      kWait + 40);
  CHECK(trips(seen) == 0);
  std::int64_t k = 2;
  while (seen[static_cast<std::size_t>(k)].busy && seen[static_cast<std::size_t>(k)].pulse == 0)
    ++k;
  CHECK(k >= kWait + 2);
  CHECK(k <= kWait + 6);
  CHECK(seen.back().result == static_cast<unsigned>(SelfTestResult::held));
}

TEST_CASE("self_test: no pulse, no test; in voltage mode neither") {
  for (const bool direct : {false, true}) {
    const auto seen = play(
        [direct](std::int64_t k, const Seen&) {
          Wave w;
          w.armed = k >= 2;
          w.direct = direct;
          w.words = {0, direct ? 3U : 0U, 0};
          return w;
        },
        5 * kUnit);
    for (const Seen& s : seen) {
      if (s.busy || s.trip || s.pulse != 0 || s.result != 0) FAIL("a test");
    }
  }
}

TEST_CASE("self_test: a failure is told once") {
  feltgate::SelfTestLaw law;
  const feltgate::SelfTestLaw::Words words{1, 1, 0};  // a lever that does not answer is not armed
  int failures = 0;
  for (std::uint32_t tick = 0; tick < 2000; ++tick) {
    law.sample(0);
    const bool failed = law.turn(tick > 3, false, tick, words);
    REQUIRE(law.failed() == failed);
    REQUIRE_FALSE(law.failed());
    failures += failed;
  }
  REQUIRE(failures == 1);
}
