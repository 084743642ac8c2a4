// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked of a design with two axes or three: RTL against twin on every clock, with a host
// at the wire that loads a law, arms, chooses words of all axes, and stops at any of them.
// Documentation: docs/link.md
#include "catch.hpp"
#include "feltgate_linked_twin.hpp"

using namespace feltgate;
using namespace feltgate::test;
using A = LinkMap::A;
using N = LinkMap::N;
using H = EngineMap::H;

namespace {

void choose(Life& s, int k, int axis, int word) {
  s.write(static_cast<std::uint32_t>(LinkViewMap::first + k), LinkViewMap::choice(axis, word));
}
bool none_on(const Life& s) {
  bool any = false;
  for (int n = 0; n < AXES; ++n) any |= s.out(n).gates_enable;
  return !any;
}

}  // namespace

TEST_CASE("feltgate_linked of axes: a law is felt at each axis, and one frame shows them all") {
  Life s;
  s.clocks(5000);
  CHECK(s.read(LinkViewMap::axes)[0] == AXES);
  s.write_engine(law::load_into_zeros(image()));
  s.arm();
  REQUIRE(s.armed());
  for (int n = 0; n < AXES; ++n) {
    for (int k = 0; k < 5 + 3 * n; ++k) s.step(n != 1, n);
  }
  s.ticks(40);
  const int last = AXES - 1;
  choose(s, 0, last, N::tau_ref);
  choose(s, 1, 1, N::position);
  choose(s, 3, 0, N::position);
  choose(s, 11, last, N::position);
  s.write(A::stream_words, 0x80b);
  s.send(request(2, 0, A::stream_period, 20'000));  // the first frame comes before the reply
  const auto frame = s.frame(LinkMap::kind_stream, -1);
  s.write(A::stream_period, 0);
  REQUIRE(frame.size() == 5);
  CHECK(static_cast<std::int32_t>(frame[0]) == s.out(last).tau_ref);
  CHECK(s.out(last).tau_ref != 0);
  CHECK(static_cast<std::int32_t>(frame[1]) == -8);
  CHECK(frame[3] == 5);
  CHECK(static_cast<std::int32_t>(frame[4]) == (AXES == 2 ? -8 : 11));
  // The words of each axis at its own address.
  for (std::uint32_t n = 0; n < AXES; ++n) {
    CHECK(static_cast<std::int32_t>(s.read(kStride * n + D::C::read_status + 1)[0]) ==
          s.out(static_cast<int>(n)).position);
  }
  CHECK(s.read(kStride * AXES + D::C::read_status)[0] == 0);
  s.play();
}

TEST_CASE("feltgate_linked of axes: the reply to a write has the status of its axis") {
  Life s;
  s.clocks(5000);
  s.arm(D::S::free);
  REQUIRE(s.armed());
  for (std::uint32_t n = 0; n < AXES; ++n) {
    // Refused while armed, by this axis alone.
    const auto at = kStride * n + static_cast<std::uint32_t>(D::A::inverse_resistance);
    CHECK((s.write(at, 1) >> D::C::status_refused & 1U) == 1);
    const std::uint32_t other = kStride * ((n + 1) % AXES);
    CHECK((s.write(other + static_cast<std::uint32_t>(D::A::overspeed), 0x7fffffff) >>
               D::C::status_refused &
           1U) == 0);
  }
  s.play();
}

TEST_CASE("feltgate_linked of axes: a disarm, a stop or a lost host at any axis stops all") {
  for (int n = 0; n < AXES; ++n) {
    const auto at = kStride * static_cast<std::uint32_t>(n);
    Life s;
    s.clocks(5000);
    s.arm(D::S::free);
    REQUIRE(s.armed());
    s.write(at + D::C::control, control_word(false, D::S::free));
    CHECK(none_on(s));
    s.arm(D::S::free);
    REQUIRE(s.armed());
    s.write(at + D::C::command, 1U << D::C::command_stop);
    CHECK(none_on(s));
    // The panel clears the faults of all axes.
    s.control(false, D::S::free);
    s.in.clear_faults = true;
    s.clocks(1);
    s.in.clear_faults = false;
    s.ticks(6);
    for (int k = 0; k < AXES; ++k) CHECK(s.out(k).faults == 0);
    // A host that has kicked this axis and is then silent.
    s.arm(D::S::free);
    REQUIRE(s.armed());
    s.write(at + static_cast<std::uint32_t>(D::A::watchdog_ticks), 3000);
    s.write(at + D::C::command, 1U << D::C::command_kick);
    s.ticks(1500);
    CHECK(s.armed());
    s.ticks(2000);
    CHECK(none_on(s));
    for (int k = 0; k < AXES; ++k) CHECK(s.out(k).faults != 0);
    s.play();
  }
}

TEST_CASE("feltgate_linked of axes: an event triggers the capture of words of all axes") {
  const int last = AXES - 1;
  Life s;
  s.clocks(5000);
  s.write_engine(law::load_into_zeros(image()));
  s.arm();
  REQUIRE(s.armed());
  choose(s, 0, last, N::position);
  choose(s, 1, 0, N::position);
  s.write(A::capture_words, 7);
  s.write(A::capture_pre, 3);
  s.write(A::trigger_mode, LinkMap::trigger_event);
  s.write(A::trigger_level, LinkMap::any_event);
  s.write(A::capture_control, 1U << LinkMap::B::capture_control_start);
  for (int k = 0; k < 60; ++k) s.step(true, last);
  s.ticks(1 << LinkMap::rows_log2);
  REQUIRE(s.read(A::capture_state)[0] == 4);
  const auto event = s.engine(H::event_count, 4);
  REQUIRE(event[0] >= 1);
  const std::uint32_t first = s.read(A::capture_first)[0];
  const std::uint32_t row = (first + 3) % (1U << LinkMap::rows_log2);
  const auto words = s.read(LinkMap::memory + 8 * row, 3);
  CHECK(words[2] == event[3]);
  CHECK(words[0] * design_info<D>().count_rad > 0.01);
  CHECK(words[1] == 0);
  s.play();
}
