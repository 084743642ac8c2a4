// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked: signals between its blocks that random requests hardly change; each test makes
// one visible at an output or to the host. Documentation: docs/link.md
#include <array>
#include <functional>
#include <vector>

#include "catch.hpp"
#include "feltgate_linked_twin.hpp"

using namespace feltgate;
using namespace feltgate::test;
using A = LinkMap::A;
using C = D::C;
using H = EngineMap::H;

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
    REQUIRE(armed());
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
  for (const int number : {0x155, 0x066, 0x078, 0x180}) {
    Life s;
    s.clocks(5000);
    s.write_engine(law::load_into_zeros(numbered(number)));
    s.arm();
    REQUIRE(s.out().armed);
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
  CHECK_FALSE(s.out().armed);
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
         for (int k = 0; k < 20'000 && s.out().gates_enable; ++k) s.step(k % 2 == 0);
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
    CHECK(s.out().faults == fault_bit(way.cause));
    CHECK(s.out().first_fault == static_cast<unsigned>(way.cause));
    CHECK_FALSE(s.out().gates_enable);
    s.control(false);
    s.write(D::A::i2t_budget, 0xffffffff);  // otherwise the heat remains a fault
    s.write(D::A::overspeed, 0x7fffffff);   // and so does the remaining velocity
    s.write(C::command, 1U << C::command_clear_faults);
    s.ticks(3);
    CHECK(s.out().faults == 0);
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
      seen |= s.out().limits;
    }
    for (int k = 0; k < 5'000; ++k) {
      s.ticks(1);
      seen |= s.out().limits;
    }
    INFO("limit " << way.limit << ", seen " << seen);
    CHECK((seen >> way.limit & 1U) == 1);
    s.control(false);
    s.ticks(3);
    CHECK(s.out().limits == limit::gates_closed);
    s.play();
  }
  Armed s;
  unsigned seen = 0;
  for (int k = 0; k < 40; ++k) {
    s.step(k % 2 == 0);
    seen |= s.out().limits;
  }
  CHECK((seen & limit::chatter) != 0);
  s.play();

  // Thousands of rad/s until the motion ends.
  Armed fast({{D::A::overspeed, 0x7fffffff}});
  seen = 0;
  for (int k = 0; k < 4'000; ++k) {
    fast.turn(true);
    fast.clocks(2);
    seen |= fast.out().limits;
  }
  CHECK((seen & limit::velocity) != 0);
  fast.ticks(2000);
  CHECK((fast.out().limits & limit::velocity) == 0);
  fast.play();
}

// A host loads a law over the UART, arms, changes parameters while it runs, and reads its events.
// RTL and twin in lock-step.

namespace {

/// Returns the torque for a position, as a word of the torque format.
int torque(double stiffness, int counts) {
  const double nm = -stiffness * counts * design_info<D>().count_rad;
  return static_cast<int>(std::lround(std::ldexp(nm, D::f.torque.fraction)));
}

}  // namespace

TEST_CASE("feltgate_linked: a law is loaded, verified, felt, changed, and tells events") {
  law::LoadedParameters parameters(image());
  Life s;
  s.clocks(5000);
  s.write_engine(law::load_into_zeros(image()));

  // Read back: program, ranges, constants.
  const auto low = s.engine(H::program, 32), high = s.engine(H::program_high, 32);
  const auto data = s.engine(H::data + EngineMap::D::lower, 64);
  for (std::size_t k = 0; k < 32; ++k) {
    CHECK((std::uint64_t{high[k]} << 32 | low[k]) == image().program[k]);
  }
  for (std::size_t k = 0; k < 64; ++k) {
    CHECK(static_cast<std::int32_t>(data[k]) == image().data[EngineMap::D::lower + k]);
  }

  s.arm();
  REQUIRE(s.out().armed);
  CHECK((s.engine(H::status)[0] >> EngineMap::S::status_crc_good & 1U) == 1);
  for (int k = 0; k < 10; ++k) s.step(true);
  s.ticks(40);
  CHECK(s.out().position == 10);
  CHECK(std::abs(s.out().tau_ref - torque(parameters.value("stiffness"), 10)) <= 1);

  // A parameter takes effect only with the commit.
  const double before = parameters.value("stiffness");
  auto writes = parameters.set("stiffness", 0.5);
  const law::HostWord commit = writes.back();
  writes.pop_back();
  s.write_engine(writes);
  s.ticks(20);
  CHECK(std::abs(s.out().tau_ref - torque(before, 10)) <= 1);
  s.write_engine({commit});
  s.ticks(40);
  CHECK(std::abs(s.out().tau_ref - torque(parameters.value("stiffness"), 10)) <= 1);

  // A parameter out of its range is refused, and its number is reported.
  writes.front().data = 0x7fffffff;
  s.write_engine(writes);
  s.write_engine({commit});
  s.ticks(40);
  CHECK(std::abs(s.out().tau_ref - torque(parameters.value("stiffness"), 10)) <= 1);
  const auto status = s.engine(H::status, 2);
  CHECK((status[0] >> EngineMap::S::status_refused & 1U) == 1);
  CHECK(status[1] == static_cast<std::uint32_t>(image().words[0].word));

  // The event: a read keeps it, a write removes it, a repeated write does not remove a second one.
  for (int k = 0; k < 9; ++k) s.step(false);
  for (int k = 0; k < 9; ++k) s.step(true);
  auto event = s.engine(H::event_count, 5);
  REQUIRE(event[0] == 2);
  CHECK(s.engine(H::event_count, 5) == event);
  CHECK(event[1] == static_cast<std::uint32_t>(image().events[0].number));
  const double at = static_cast<std::int32_t>(event[2]) * image().events[0].scale;
  CHECK(at > 0.01);
  CHECK(at < 0.013);
  const Bytes take = request(2, 201, EngineMap::port_first + H::event_tick, 0);
  for (int twice = 0; twice < 2; ++twice) {
    s.send(take);
    REQUIRE(s.frame(0x82, 201).size() == 1);
  }
  const auto next = s.engine(H::event_count, 5);
  CHECK(next[0] == 1);
  CHECK(next[3] > event[3]);
  CHECK(next[4] == 0);

  // Locked while armed.
  s.write(static_cast<std::uint32_t>(EngineMap::port_first + H::program), 0);
  CHECK(s.engine(H::program)[0] == low[0]);
  s.play();
}

TEST_CASE("feltgate_linked: an event of the law triggers the capture in its tick") {
  using A = LinkMap::A;
  Life s;
  s.clocks(5000);
  s.write_engine(law::load_into_zeros(image()));
  s.arm();
  constexpr std::uint32_t before = 3;
  for (int k = 0; k < 9; ++k) s.step(true);
  const auto number = static_cast<std::uint32_t>(image().events[0].number);
  for (const std::uint32_t level : {511U, number, std::uint32_t{LinkMap::any_event}}) {
    // Moves the lever below the position of the event and removes the old events.
    for (int k = 0; k < 9; ++k) s.step(false);
    while (s.engine(H::event_count)[0] > 0) {
      s.write(static_cast<std::uint32_t>(EngineMap::port_first + H::event_tick), 0);
    }
    s.write(A::capture_words, 1U << LinkMap::N::tick);
    s.write(A::capture_pre, before);
    s.write(A::trigger_mode, LinkMap::trigger_event);
    s.write(A::trigger_level, level);
    s.write(A::capture_control, 1U << LinkMap::B::capture_control_start);
    s.ticks(10);
    for (int k = 0; k < 9; ++k) s.step(true);
    const auto event = s.engine(H::event_count, 4);
    REQUIRE(event[0] == 1);
    s.ticks(1 << LinkMap::rows_log2);
    const auto state = s.read(A::capture_state, 1)[0];
    if (level == 511U) {  // the number of another event
      CHECK(state == 2);
      continue;
    }
    REQUIRE(state == 4);
    const std::uint32_t first = s.read(A::capture_first, 1)[0];
    const std::uint32_t row = (first + before) % (1U << LinkMap::rows_log2);
    CHECK(s.read(LinkMap::memory + 8 * row, 1)[0] == event[3]);
  }
  s.play();
}

TEST_CASE("feltgate_linked: a law of which the last part is missing is not armed") {
  const auto all = law::load_into_zeros(image());
  for (const std::size_t part : {std::size_t{2}, all.size() / 2, all.size() - 6}) {
    Life s;
    s.clocks(5000);
    s.write_engine({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(part)});
    s.arm();
    CHECK_FALSE(s.out().gates_enable);
    CHECK(s.out().tau_ref == 0);
    CHECK((s.engine(H::status)[0] >> EngineMap::S::status_crc_good & 1U) == 0);
    if (part == 2) s.play();
  }
}

TEST_CASE("feltgate_linked: a read of the engine waits while it is busy, a disarm does not") {
  Life s;
  s.clocks(5000);
  s.write_engine(law::load_into_zeros(image()));
  s.control(true);  // the engine now computes the CRC, 1.1 ms
  s.send(request(1, 200, static_cast<std::uint32_t>(EngineMap::port_first + H::status), 1));
  s.clocks(20'000);
  CHECK((s.engine(H::status)[0] >> EngineMap::S::status_crc_good & 1U) == 1);
  s.arm();
  REQUIRE(s.out().armed);
  s.control(true);
  s.send(request(1, 210, EngineMap::port_first, 64));
  s.clocks(10'000);
  s.control(false);
  s.ticks(2);
  CHECK_FALSE(s.out().gates_enable);
  // The panel clears a fault while the engine processes a commit of the host.
  s.arm();
  s.in.stop = true;
  s.clocks(1);
  s.in.stop = false;
  s.ticks(3);
  CHECK(s.out().faults != 0);
  s.control(false);
  s.send(request(2, 220, static_cast<std::uint32_t>(EngineMap::port_first + H::commit), 1));
  s.in.clear_faults = true;
  s.clocks(1);
  s.in.clear_faults = false;
  s.clocks(5000);
  CHECK(s.out().faults == 0);
  s.play();
}
