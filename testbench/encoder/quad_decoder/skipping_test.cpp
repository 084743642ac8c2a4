// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// quad_decoder: the twin alone, which can skip the clocks between two changes of a pin.
// Documentation: docs/blocks/encoder.md
#include "adapter.hpp"
#include "catch.hpp"

using feltgate::QuadDecoder;
using namespace feltgate::test;

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
