// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// quad_decoder: RTL against twin on every clock, and both against the motion of an encoder.
// Documentation: docs/blocks/encoder.md
#include <algorithm>
#include <limits>

#include "adapter.hpp"
#include "catch.hpp"

using feltgate::QuadDecoder;
using namespace feltgate::test;

namespace {

constexpr std::int32_t kStart = RESET_POSITION;  // near the wrap

/// Returns the counts since the start, modulo 2^32.
std::int32_t moved(const QuadDecoder& decoder) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(decoder.out().position) -
                                   static_cast<std::uint32_t>(kStart));
}

QuadDecoder play(const Script& script, std::uint64_t seed = 1) {
  QuadDecoderBench bench("quad_decoder", seed, QuadDecoder(kStart, INDEX_COUNTS));
  return bench.run_list(script.list);
}

}  // namespace

TEST_CASE("quad_decoder: every transition between two states") {
  for (int from = 0; from < 4; ++from) {
    for (int turn = 0; turn < 4; ++turn) {
      for (const bool polarity : {false, true}) {
        Script script(at_phase(from));
        script.now.polarity = polarity;
        const QuadDecoder end = play(script.hold(10).phase(from + turn, 10));
        const int up = turn == 1 ? 1 : (turn == 3 ? -1 : 0);
        REQUIRE(moved(end) == (polarity ? -up : up));
        REQUIRE(end.out().error == (turn == 2));
        REQUIRE(end.out().error_count == (turn == 2 ? 1 : 0));
      }
    }
  }
}

TEST_CASE("quad_decoder: an edge at the pin is in travel after 3 clocks, in position after 4") {
  for (int filter = 0; filter < 16; ++filter) {
    Script script(at_phase(0));
    script.now.filter = static_cast<std::uint8_t>(filter);
    script.hold(30).phase(1, filter + 2);
    REQUIRE(play(script).out().step == 0);
    REQUIRE(play(script.hold(1)).out().step == 1);
    REQUIRE(moved(play(script)) == 0);
    REQUIRE(moved(play(script.hold(1))) == 1);
  }
}

TEST_CASE("quad_decoder: the filter rejects pulses up to its length and counts them") {
  for (int filter = 0; filter < 16; ++filter) {
    for (int length = 1; length <= 18; ++length) {
      for (int channel = 0; channel < 3; ++channel) {
        for (const bool rest : {false, true}) {
          Script script(at_phase(0));
          bool QuadDecoder::In::*const pin = channel == 0   ? &QuadDecoder::In::a
                                             : channel == 1 ? &QuadDecoder::In::b
                                                            : &QuadDecoder::In::z;
          script.now.filter = static_cast<std::uint8_t>(filter);
          script.now.*pin = rest;
          script.hold(25);
          script.now.*pin = !rest;
          script.hold(length);
          script.now.*pin = rest;
          const auto passed = length > filter;
          QuadDecoderBench bench("quad_decoder", 5, QuadDecoder(kStart, INDEX_COUNTS));
          const QuadDecoder end = bench.run_list(script.hold(25).list);
          REQUIRE(end.out().rejected_count == (passed ? 0 : 1));
          REQUIRE(end.out().index_seen == (passed && channel == 2));
          REQUIRE(moved(end) == 0);
          if (channel == 2) continue;
          int steps = 0;
          QuadDecoder twin(kStart);
          for (const QuadDecoder::In& in : script.list) {
            twin.clock(in);
            steps += twin.out().step * twin.out().step;
          }
          REQUIRE(steps == (passed ? 2 : 0));
        }
      }
    }
  }
}

TEST_CASE("quad_decoder: set-zero loses no edge, whichever clock it meets") {
  for (std::size_t clock = 6; clock < 26; ++clock) {
    for (const int direction : {1, -1}) {
      Script script(at_phase(0));
      script.hold(12).phase(direction, 20);
      script.list[clock].set_zero = true;
      const QuadDecoder end = play(script);
      // The pin change of clock 12 is in the travel from clock 15 on: from then the set-zero
      // includes the step.
      REQUIRE(end.out().position == (clock >= 15 ? 0 : direction));
      REQUIRE(end.out().travel == ((kStart + direction) & 0xffff));
    }
  }
}

TEST_CASE("quad_decoder: the counters saturate, clear, and lose no event to a clear") {
  Script errors(at_phase(0));
  errors.hold(6);
  for (int k = 0; k < 65540; ++k) errors.phase(2 * k, 1);
  QuadDecoder end = play(errors.hold(6));
  REQUIRE(end.out().error_count == 65535);
  REQUIRE(moved(end) == 0);

  Script glitches(at_phase(0));
  glitches.now.filter = 3;
  glitches.hold(6);
  for (int k = 0; k < 65540; ++k) {
    glitches.now.a = true;
    glitches.hold(1);
    glitches.now.a = false;
    glitches.hold(1);
  }
  end = play(glitches.hold(6));
  REQUIRE(end.out().rejected_count == 65535);
  REQUIRE(end.out().error_count == 0);
  glitches.now.clear_error = true;
  REQUIRE(play(glitches.hold(1)).out().rejected_count == 0);

  for (int clear = 0; clear < 8; ++clear) {  // an error that meets the clear is counted after it
    Script meet(at_phase(0));
    meet.hold(6).phase(2, 12);
    meet.list[static_cast<std::size_t>(6 + clear)].clear_error = true;
    end = play(meet);
    REQUIRE(end.out().error == (clear <= 2));
    REQUIRE(end.out().error_count == (clear <= 3 ? 1 : 0));
  }
}

TEST_CASE("quad_decoder: random shafts against twin and oracle") {
  Mix plain;
  Mix fast;
  fast.dwell = 1;
  Mix jumps;
  jumps.jump = 30;
  Mix back;
  back.polarity = true;
  std::vector<Mix> mixes{plain, fast, jumps, back};
  for (std::uint8_t filter = 1; filter < 16; ++filter) {
    Mix noisy;
    noisy.filter = filter;
    noisy.dwell = 40;
    noisy.glitch = 30;
    noisy.jump = 500;
    mixes.push_back(noisy);
  }
  std::uint64_t seed = 10;
  for (const Mix& mix : mixes) {
    QuadDecoderBench bench("quad_decoder", ++seed, QuadDecoder(kStart, INDEX_COUNTS));
    const auto watch = [oracle = Oracle(kStart)](const auto& in, const auto&,
                                                 const QuadDecoder& twin, bool in_reset) mutable {
      return oracle(in, twin.out(), in_reset);
    };
    bench.run(Wander(seed, mix), scaled_clocks(500'000), ResetPlan{5000}, watch);
  }
}

TEST_CASE("quad_decoder: everything at random") {
  Mix mix;
  mix.dwell = 2;
  mix.glitch = 100;
  mix.jump = 50;
  mix.registers = 300;
  QuadDecoderBench bench("quad_decoder", 77, QuadDecoder(kStart, INDEX_COUNTS));
  bench.run(Wander(77, mix), scaled_clocks(5'000'000), ResetPlan{3000});
}

namespace {

/// A shaft with an index of `width` counts in a revolution of INDEX_COUNTS.
class Shaft {
 public:
  explicit Shaft(int width, int start) : script_(at_phase(start)), at_(start), width_(width) {
    now();
    script_.hold(9);
  }
  Shaft& turn(int counts) {
    for (; counts != 0; counts += counts > 0 ? -1 : 1) {
      at_ += counts > 0 ? 1 : -1;
      now();
      script_.phase(at_ - slipped_, 4);
    }
    return *this;
  }
  /// Moves the shaft without a change of the channels.
  Shaft& slip(int counts) {
    at_ += counts;
    slipped_ += counts;
    now();
    script_.hold(4);
    return *this;
  }
  Shaft& zero() {
    script_.now.set_zero = true;
    script_.hold(1).now.set_zero = false;
    return *this;
  }
  Shaft& clear() {
    script_.now.clear_error = true;
    script_.hold(1).now.clear_error = false;
    return *this;
  }
  bool wrong() const { return play(script_).out().index_wrong; }

 private:
  void now() { script_.now.z = ((at_ % INDEX_COUNTS) + INDEX_COUNTS) % INDEX_COUNTS < width_; }
  Script script_;
  int at_, width_, slipped_ = 0;
};

}  // namespace

TEST_CASE("quad_decoder: an index fits whole revolutions, by its width both ways") {
  for (const int width : {1, 2, 4, 7}) {
    for (const int way : {1, -1}) {
      Shaft shaft(width, way > 0 ? -20 : 40);
      shaft.turn(way * 150).zero().turn(-way * 170).turn(way * 3 * INDEX_COUNTS);
      REQUIRE_FALSE(shaft.wrong());
      for (int k = 0; k < 5; ++k) shaft.turn(-way * 70).turn(way * 70);  // both directions
      REQUIRE_FALSE(shaft.wrong());
    }
  }
}

TEST_CASE("quad_decoder: a count that has slipped does not fit its index, until it is cleared") {
  for (const int slip : {-20, -12, -8, 9, 12, 20}) {
    Shaft shaft(1, -10);
    shaft.turn(45).slip(slip).turn(5);
    REQUIRE_FALSE(shaft.wrong());  // no index seen yet
    shaft.turn(INDEX_COUNTS);
    REQUIRE(shaft.wrong());
    shaft.turn(-2 * INDEX_COUNTS).zero();
    REQUIRE(shaft.wrong());
    shaft.clear();
    REQUIRE_FALSE(shaft.wrong());
    shaft.turn(4 * INDEX_COUNTS);  // the next index is the first
    REQUIRE_FALSE(shaft.wrong());
  }
  for (const int slip : {-7, -4, 4, 8}) {
    Shaft near(1, -10);
    REQUIRE_FALSE(near.turn(40).slip(slip).turn(2 * INDEX_COUNTS).wrong());
  }
}

// quad_decoder: the twin alone, which can skip the clocks between two changes of a pin.

namespace {

/// Changes one field after another: the comparison must find each single difference, and all of
/// them together.
template <class T, class... Change>
void each_field_counts(Change... changes) {
  const T plain;
  CHECK(plain == T());
  T all;
  int n = 0;
  const auto one = [&](auto change) {
    T other;
    change(other);
    change(all);
    CAPTURE(n++);
    CHECK_FALSE(plain == other);
    CHECK_FALSE(other == plain);
    T same;
    change(same);
    CHECK(other == same);
    CHECK_FALSE(plain == all);
  };
  (one(changes), ...);
}

}  // namespace

TEST_CASE("quad_decoder: inputs and outputs differ where a field does") {
  using In = QuadDecoder::In;
  each_field_counts<In>([](In& i) { i.a = true; }, [](In& i) { i.b = true; },
                        [](In& i) { i.z = true; }, [](In& i) { i.filter = 1; },
                        [](In& i) { i.polarity = true; }, [](In& i) { i.set_zero = true; },
                        [](In& i) { i.clear_error = true; });
  using Out = QuadDecoder::Out;
  each_field_counts<Out>([](Out& o) { o.position = 1; }, [](Out& o) { o.travel = 1; },
                         [](Out& o) { o.step = 1; }, [](Out& o) { o.error = true; },
                         [](Out& o) { o.illegal = true; }, [](Out& o) { o.error_count = 1; },
                         [](Out& o) { o.rejected_count = 1; }, [](Out& o) { o.index_position = 1; },
                         [](Out& o) { o.index_seen = true; }, [](Out& o) { o.index_wrong = true; },
                         [](Out& o) { o.levels = 1; }, [](Out& o) { o.count = 1; },
                         [](Out& o) { o.zero = 1; });
}

TEST_CASE("quad_decoder: the twin is reset when it is made") {
  QuadDecoder made(70'000);
  CHECK(made.out().position == 70'000);
  CHECK(made.out().count == 70'000);
  CHECK(made.out().travel == 70'000 - 65'536);
  QuadDecoder again = made;
  again.reset();
  for (int k = 0; k < 10; ++k) {
    made.clock(at_phase(2));
    again.clock(at_phase(2));
    REQUIRE(made.out() == again.out());
  }
}

TEST_CASE("quad_decoder: without a revolution no index is wrong") {
  QuadDecoder twin(0, 0);
  QuadDecoder::In in = at_phase(0);
  for (int k = 1; k < 400; ++k) {
    const QuadDecoder::In pins = at_phase(k);
    in.a = pins.a;
    in.b = pins.b;
    in.z = k % 37 == 0;
    for (int held = 0; held < 3; ++held) twin.clock(in);
    REQUIRE_FALSE(twin.out().index_wrong);
  }
  CHECK(twin.out().index_seen);
}

TEST_CASE("quad_decoder: a settled twin may be skipped") {
  std::int64_t skipped = 0;
  for (const bool brief : {false, true}) {  // also pulses on their way through the synchronisers
    QuadDecoder every(RESET_POSITION, INDEX_COUNTS);  // near the wrap
    QuadDecoder skipping = every;
    Mix mix;
    mix.filter = brief ? 0 : 4;
    mix.glitch = 10;
    mix.jump = 40;
    Wander wander(3, mix);
    Random random(4);
    for (int k = 0; k < 50'000; ++k) {
      QuadDecoder::In in = wander(k);
      const int clocks = brief ? 1 + static_cast<int>(random.below(9)) : 30;
      for (int held = 0; held < clocks; ++held) {
        every.clock(in);
        if (skipping.settled(in)) {
          ++skipped;
        } else {
          skipping.clock(in);
        }
        in.set_zero = in.clear_error = false;
        REQUIRE(every.out() == skipping.out());
      }
    }
  }
  REQUIRE(skipped > 500'000);
}

TEST_CASE("quad_decoder: two events in one clock are both counted before it is settled") {
  QuadDecoder every;
  QuadDecoder skipping;
  QuadDecoder::In in = at_phase(0);
  in.filter = 3;
  const auto clock = [&](int clocks) {
    for (; clocks > 0; --clocks) {
      every.clock(in);
      if (!skipping.settled(in)) skipping.clock(in);
      REQUIRE(every.out() == skipping.out());
    }
  };
  clock(20);
  // Delay from a pulse on Z that is too short to the change of both channels.
  for (int lead = -6; lead <= 6; ++lead) {
    const int before = every.out().error_count + every.out().rejected_count;
    for (int k = 0; k < 40; ++k) {
      in.a = in.b = (k >= 10) == (lead % 2 == 0);
      in.z = k == 10 + lead;
      clock(1);
    }
    REQUIRE(every.out().error_count + every.out().rejected_count == before + 2);
  }
}

TEST_CASE("quad_decoder: an index rests when no level, old or new, is high") {
  for (const std::uint8_t filter : {std::uint8_t{0}, std::uint8_t{3}, std::uint8_t{9}}) {
    for (const int high : {1, 4, 30}) {
      QuadDecoder twin;
      QuadDecoder::In in = at_phase(1);
      in.filter = filter;
      for (int k = 0; k < 30; ++k) twin.clock(in);
      REQUIRE(twin.index_rests(in));
      const bool passes = high > filter;
      in.z = true;
      for (int k = 0; k < high; ++k) {
        REQUIRE_FALSE(twin.index_rests(in));
        twin.clock(in);
      }
      in.z = false;
      // Clocks for the pin, two synchronisers, the earlier level and, if the pulse passes, the
      // filter.
      const int rests = passes ? 3 + filter : 3;
      for (int k = 0; k < 40; ++k) {
        CAPTURE(filter, high, k);
        CHECK(twin.index_rests(in) == (k >= rests));
        twin.clock(in);
      }
    }
  }
}
