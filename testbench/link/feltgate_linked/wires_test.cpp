// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked: signals between its blocks that random requests hardly change; each test makes
// one visible at an output or to the host. Documentation: docs/link.md
#include <array>
#include <functional>

#include "linked_life.hpp"

using namespace feltgate;
using namespace feltgate::test;
using A = LinkMap::A;
using C = D::C;

namespace {

/// The spring, with this number for its event.
law::Image numbered(int number) {
  law::Image made = image();
  int events = 0;
  for (std::uint64_t& word : made.program) {
    EngineInstruction i = engine_decode(word);
    if (i.dst != static_cast<int>(EngineTarget::event)) continue;
    i.d = number;
    word = engine_encode(i);
    ++events;
  }
  REQUIRE(events == 1);
  return made;
}

/// An armed lever with a spring; the given words are written before arming.
struct Armed : Life {
  explicit Armed(const std::vector<std::array<std::uint32_t, 2>>& words = {}) {
    clocks(5000);
    write_engine(law::load_into_zeros(image()));
    for (const auto& [address, word] : words) write(address, word);
    arm();
    REQUIRE(out().core.armed);
  }
};

}  // namespace

TEST_CASE("link: all bits of a word come to the link's registers and back") {
  Life s;
  s.clocks(5000);
  for (const std::uint32_t word :
       {0x55555555U, 0xaaaaaaaaU, 0x33333333U, 0xccccccccU, 0x0ff00ff0U, 0xf00ff00fU}) {
    s.write(A::trigger_level, word);
    CHECK(s.read(A::trigger_level, 1)[0] == word);
    s.write(A::stream_period, word & 0xffffff);
    CHECK(s.read(A::stream_period, 1)[0] == (word & 0xffffff));
    s.write(A::stream_period, 0);
  }
  s.play();
}

TEST_CASE("link: an address of the engine's half is none of the link's") {
  Life s;
  s.clocks(5000);
  s.write(A::stream_words, 0x0a5);
  s.write(A::stream_words | 0x4000, 0x15a);
  CHECK(s.read(A::stream_words, 1)[0] == 0x0a5);
  CHECK(s.read(A::stream_words | 0x4000, 1)[0] == 0);
  s.play();
}

TEST_CASE("link: a capture is triggered by the event whose number has all its bits") {
  for (const int number : {0x155, 0x0aa, 0x1c3, 0x03c, 0x012, 0x100}) {
    Life s;
    s.clocks(5000);
    s.write_engine(law::load_into_zeros(numbered(number)));
    s.arm();
    REQUIRE(s.out().core.armed);
    s.write(A::trigger_mode, LinkMap::trigger_event);
    s.write(A::trigger_level, static_cast<std::uint32_t>(number));
    s.write(A::capture_words, 1U << LinkMap::N::tick);
    s.write(A::capture_control, 1U << LinkMap::B::capture_control_start);
    CHECK(s.read(A::capture_state, 1)[0] == 2);
    for (int k = 0; k < 9; ++k) s.step(true);
    s.ticks(1 << LinkMap::rows_log2);
    CHECK(s.read(A::capture_state, 1)[0] == 4);
    CHECK(s.engine(H::event_number)[0] == static_cast<std::uint32_t>(number));
    // One row per tick: each address of the memory holds its own row.
    const std::uint32_t first = s.read(A::capture_first, 1)[0], rows = 1U << LinkMap::rows_log2;
    const auto at = [&](std::uint32_t row) {
      return s.read(LinkMap::memory + 8 * ((first + row) % rows), 1)[0];
    };
    const std::uint32_t begin = at(0);
    for (std::uint32_t row = 1; row < rows; row <<= 1) CHECK(at(row) == begin + row);
    s.play();
  }
}

TEST_CASE("link: an event is taken once, however long the engine is busy") {
  Armed s;
  for (int k = 0; k < 9; ++k) s.step(true);
  for (int turn = 0; turn < 4; ++turn) {
    for (int k = 0; k < 9; ++k) s.step(false);
    for (int k = 0; k < 9; ++k) s.step(true);
  }
  REQUIRE(s.engine(H::event_count)[0] == 5);
  for (int k = 0; k < 9; ++k) s.step(false);  // otherwise arming would report one more event
  s.control(false);
  s.ticks(3);
  // Arms again: the write waits at the port until the CRC is computed.
  s.control(true);
  const Bytes take = request(2, 201, EngineMap::port_first + H::event_tick, 0);
  s.send(take);
  s.clocks(10'000);
  CHECK_FALSE(s.out().core.armed);
  s.clocks(80'000);
  CHECK(s.engine(H::event_count)[0] == 4);
  s.play();
}

TEST_CASE("linked: each cause of fault is its own at the pins") {
  struct Way {
    Fault cause;
    std::vector<std::array<std::uint32_t, 2>> words;
    std::function<void(Life&)> what;
  };
  const auto push = [](Life& s) {
    for (int k = 0; k < 60; ++k) s.step(true);
    s.ticks(2000);
  };
  const Way ways[] = {
      {Fault::encoder,
       {},
       [](Life& s) {
         for (int k = 0; k < 200; ++k) {
           s.in.encoder.a = !s.in.encoder.a;
           s.in.encoder.b = !s.in.encoder.b;
           s.clocks(7);
         }
       }},
      {Fault::speed, {{D::A::overspeed, 1}}, push},
      {Fault::i2t,
       {{D::A::nominal_current_squared, 0x7fffffff},
        {D::A::nominal_current_squared, 0},
        {D::A::i2t_budget, 20}},
       push},
      {Fault::watchdog,
       {{D::A::watchdog_ticks, 40}},
       [](Life& s) {
         s.write(C::command, 1U << C::command_kick);
         s.ticks(100);
       }},
      {Fault::stop, {}, [](Life& s) { s.write(C::command, 1U << C::command_stop); }},
      {Fault::index,
       {},
       [](Life& s) {
         for (int turn = 0; turn < 3; ++turn) {
           for (int k = 0; k < 7; ++k) s.step(true);
           s.in.encoder.z = true;
           s.ticks(2);
           s.in.encoder.z = false;
         }
       }},
      {Fault::polarity,
       {{D::A::overspeed, 0x7fffffff},
        {D::A::polarity_ticks, 20},
        {D::A::polarity_speed, 1},
        {D::A::polarity_current, 0}},
       [](Life& s) {
         for (int gap = 40; gap > 0; gap -= 1 + gap / 20) {
           s.ticks(gap);
           s.step(true);
         }
       }},
      {Fault::channel,
       {},
       [](Life& s) {
         for (int k = 0; k < 20'000 && s.out().core.gates_enable; ++k) s.step(k % 2 == 0);
       }},
      {Fault::engine,
       {{EngineMap::port_first + H::divider0, 4000}, {EngineMap::port_first + H::max_age, 3000}},
       [](Life& s) { s.ticks(9000); }},
  };
  for (const Way& way : ways) {
    Armed s(way.words);
    way.what(s);
    s.ticks(3);
    INFO("fault " << static_cast<int>(way.cause));
    CHECK(s.out().core.faults == fault_bit(way.cause));
    CHECK(s.out().core.first_fault == static_cast<unsigned>(way.cause));
    CHECK_FALSE(s.out().core.gates_enable);
    s.control(false);
    s.write(D::A::i2t_budget, 0xffffffff);  // otherwise the heat remains a fault
    s.write(D::A::overspeed, 0x7fffffff);   // and so does the remaining velocity
    s.write(C::command, 1U << C::command_clear_faults);
    s.ticks(3);
    CHECK(s.out().core.faults == 0);
    s.play();
  }
}

TEST_CASE("linked: each limit is its own at the pins") {
  struct Way {
    int limit;
    std::vector<std::array<std::uint32_t, 2>> words;
  };
  const Way ways[] = {
      {Map::L::torque, {{D::A::torque_limit, 100}}},
      {Map::L::current, {{D::A::current_limit, 10}}},
      {Map::L::voltage, {{D::A::voltage_window, 10}}},
      {Map::L::duty, {{D::A::duty_limit, 1}}},
      {
          Map::L::hold,
          {{D::A::hold_time, 2}, {D::A::hold_torque, 10}, {D::A::hold_limit, 5}},
      },
  };
  for (const Way& way : ways) {
    Armed s(way.words);
    s.write(A::stream_words, (1U << LinkMap::snapshot_words) - 1);
    s.write(A::stream_period, 500);  // streams all words in every case
    unsigned seen = 0;
    for (int k = 0; k < 120; ++k) {
      s.step(true);
      seen |= s.out().core.limits;
    }
    for (int k = 0; k < 5'000; ++k) {
      s.ticks(1);
      seen |= s.out().core.limits;
    }
    INFO("limit " << way.limit << ", seen " << seen);
    CHECK((seen >> way.limit & 1U) == 1);
    s.control(false);
    s.ticks(3);
    CHECK(s.out().core.limits == limit::gates_closed);
    s.play();
  }
  Armed s;
  unsigned seen = 0;
  for (int k = 0; k < 40; ++k) {
    s.step(k % 2 == 0);
    seen |= s.out().core.limits;
  }
  CHECK((seen & limit::chatter) != 0);
  s.play();

  // Thousands of rad/s until the motion ends.
  Armed fast({{D::A::overspeed, 0x7fffffff}});
  seen = 0;
  for (int k = 0; k < 4'000; ++k) {
    fast.turn(true);
    fast.clocks(2);
    seen |= fast.out().core.limits;
  }
  CHECK((seen & limit::velocity) != 0);
  fast.ticks(2000);
  CHECK((fast.out().core.limits & limit::velocity) == 0);
  fast.play();
}
