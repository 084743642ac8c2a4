// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A host loads a law over the UART, arms, changes parameters while it runs, and reads its events.
// RTL and twin in lock-step. Documentation: docs/link.md
#include "linked_life.hpp"

using namespace feltgate;
using namespace feltgate::test;

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
  REQUIRE(s.out().core.armed);
  CHECK((s.engine(H::status)[0] >> EngineMap::S::status_crc_good & 1U) == 1);
  for (int k = 0; k < 10; ++k) s.step(true);
  s.ticks(40);
  CHECK(s.out().core.position == 10);
  CHECK(std::abs(s.out().core.tau_ref - torque(parameters.value("stiffness"), 10)) <= 1);

  // A parameter takes effect only with the commit.
  const double before = parameters.value("stiffness");
  auto writes = parameters.set("stiffness", 0.5);
  const law::HostWord commit = writes.back();
  writes.pop_back();
  s.write_engine(writes);
  s.ticks(20);
  CHECK(std::abs(s.out().core.tau_ref - torque(before, 10)) <= 1);
  s.write_engine({commit});
  s.ticks(40);
  CHECK(std::abs(s.out().core.tau_ref - torque(parameters.value("stiffness"), 10)) <= 1);

  // A parameter out of its range is refused, and its number is reported.
  writes.front().data = 0x7fffffff;
  s.write_engine(writes);
  s.write_engine({commit});
  s.ticks(40);
  CHECK(std::abs(s.out().core.tau_ref - torque(parameters.value("stiffness"), 10)) <= 1);
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
  REQUIRE(s.ask(take).size() == 1);
  REQUIRE(s.ask(take).size() == 1);
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
  REQUIRE(s.event_clocks.size() >= 3);
  std::printf("events in clock %d of a tick\n", s.event_clocks.back());
  s.play();
}

TEST_CASE("feltgate_linked: a law of which the last part is missing is not armed") {
  const auto all = law::load_into_zeros(image());
  for (const std::size_t part : {std::size_t{2}, all.size() / 2, all.size() - 6}) {
    Life s;
    s.clocks(5000);
    s.write_engine({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(part)});
    s.arm();
    CHECK_FALSE(s.out().core.gates_enable);
    CHECK(s.out().core.tau_ref == 0);
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
  REQUIRE(s.out().core.armed);
  s.control(true);
  s.send(request(1, 210, EngineMap::port_first, 64));
  s.clocks(10'000);
  s.control(false);
  s.ticks(2);
  CHECK_FALSE(s.out().core.gates_enable);
  // The panel clears a fault while the engine processes a commit of the host.
  s.arm();
  s.in.stop = true;
  s.clocks(1);
  s.in.stop = false;
  s.ticks(3);
  CHECK(s.out().core.faults != 0);
  s.control(false);
  s.send(request(2, 220, static_cast<std::uint32_t>(EngineMap::port_first + H::commit), 1));
  s.in.clear_faults = true;
  s.clocks(1);
  s.in.clear_faults = false;
  s.clocks(5000);
  CHECK(s.out().core.faults == 0);
  s.play();
}
