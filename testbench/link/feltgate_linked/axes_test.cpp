// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked of a design with two axes or three: RTL against twin on every clock, with a host
// at the wire that loads a law, arms, chooses words of all axes, and stops at any of them.
// Documentation: docs/link.md
#include <memory>

#include "axes_life.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// Levers, a panel, and the bytes of a host that also uses the words of all axes and of the view.
struct Stimulus {
  explicit Stimulus(std::uint64_t seed)
      : random(seed), frames(Random(seed + 1)), line(D::clock_hz, BAUD) {}

  In operator()(std::int64_t, const Out& out) {
    if (line.unsent() == 0 && gap-- <= 0) {
      if (random.one_in(4)) {
        arm();
      } else if (random.coin()) {
        send(frames.any());
      } else {
        const std::uint32_t view = LinkViewMap::first + random.below(16);
        const std::uint32_t at = random.coin() ? view : random.below(0x1000);
        send(request(1 + static_cast<int>(random.below(2)), next(), at, 1 + random.below(47)));
      }
      gap = static_cast<int>(random.below(random.one_in(4) ? 40'000 : 2'000));
    }
    in.uart_rx = line.level();
    line.clock(out.uart_tx);
    for (auto& axis : in.axis) {
      unsigned& at = phase[static_cast<std::size_t>(&axis - in.axis.data())];
      if (random.one_in(900)) at += random.one_in(5) ? 3 : 1;
      axis.encoder = pins_at(at, (at & 0xfffU) == 0);
      axis.set_zero = random.one_in(100'000);
      if (random.one_in(200'000)) axis.scene = static_cast<std::uint8_t>(random.below(10));
    }
    if (random.one_in(60'000)) in.arm = !in.arm;
    in.stop = random.one_in(400'000);
    in.clear_faults = random.one_in(50'000);
    if (random.one_in(10'000)) in.inputs = static_cast<std::uint8_t>(random.below(256));
    return in;
  }

  int next() { return frames.sequence = (frames.sequence + 1) & 255; }
  void send(const Bytes& wire) {
    for (const std::uint8_t byte : wire) line.send(byte);
  }
  void arm() {
    for (const bool on : {false, true}) {
      for (std::uint32_t n = 0; n < AXES; ++n) {
        send(request(2, next(), kStride * n + D::C::command, 1U << D::C::command_clear_faults));
        send(request(2, next(), kStride * n + D::C::control, control_word(on, D::S::free)));
      }
    }
    if (random.coin()) send(request(2, next(), A::stream_period, random.below(2000)));
    if (random.coin()) send(request(2, next(), A::stream_words, random.below(4096)));
    if (random.coin()) send(request(2, next(), A::capture_words, random.below(4096)));
    if (random.coin()) send(request(2, next(), A::capture_control, random.below(8)));
    if (random.coin()) send(request(1, next(), LinkMap::memory + random.below(200), 20));
  }

  Random random;
  RandomFrames frames;
  UartLine line;
  In in;
  int gap = 10;
  std::array<unsigned, AXES> phase{};
};

}  // namespace

TEST_CASE("feltgate_linked of axes: whatever comes over the wire, RTL against twin") {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Bench bench("feltgate_linked", seed);
    bench.run(Stimulus(seed), scaled_clocks(800'000), {seed == 2 ? 60'000U : 0U});
  }
}

TEST_CASE("feltgate_linked of axes: a law is felt at each axis, and one frame shows them all") {
  Life s;
  s.clocks(5000);
  CHECK(s.read(LinkViewMap::axes)[0] == AXES);
  s.load();
  s.arm();
  REQUIRE(s.all_armed());
  for (int n = 0; n < AXES; ++n) {
    for (int k = 0; k < 5 + 3 * n; ++k) s.turn(n, n != 1);
  }
  s.ticks(40);
  const int last = AXES - 1;
  s.choose(0, last, N::tau_ref);
  s.choose(1, 1, N::position);
  s.choose(3, 0, N::position);
  s.choose(11, last, N::position);
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
  REQUIRE(s.all_armed());
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
    REQUIRE(s.all_armed());
    s.write(at + D::C::control, control_word(false, D::S::free));
    CHECK(s.none_on());
    s.arm(D::S::free);
    REQUIRE(s.all_armed());
    s.write(at + D::C::command, 1U << D::C::command_stop);
    CHECK(s.none_on());
    // The panel clears the faults of all axes.
    s.write_all(D::C::control, control_word(false, D::S::free));
    s.in.clear_faults = true;
    s.clocks(1);
    s.in.clear_faults = false;
    s.ticks(6);
    for (int k = 0; k < AXES; ++k) CHECK(s.out(k).faults == 0);
    // A host that has kicked this axis and is then silent.
    s.arm(D::S::free);
    REQUIRE(s.all_armed());
    s.write(at + static_cast<std::uint32_t>(D::A::watchdog_ticks), 3000);
    s.write(at + D::C::command, 1U << D::C::command_kick);
    s.ticks(1500);
    CHECK(s.all_armed());
    s.ticks(2000);
    CHECK(s.none_on());
    for (int k = 0; k < AXES; ++k) CHECK(s.out(k).faults != 0);
    s.play();
  }
}

TEST_CASE("feltgate_linked of axes: an event triggers the capture of words of all axes") {
  const int last = AXES - 1;
  Life s;
  s.clocks(5000);
  s.load();
  s.arm();
  REQUIRE(s.all_armed());
  s.choose(0, last, N::position);
  s.choose(1, 0, N::position);
  s.write(A::capture_words, 7);
  s.write(A::capture_pre, 3);
  s.write(A::trigger_mode, LinkMap::trigger_event);
  s.write(A::trigger_level, LinkMap::any_event);
  s.write(A::capture_control, 1U << LinkMap::B::capture_control_start);
  for (int k = 0; k < 60; ++k) s.turn(last, true);
  s.ticks(1 << LinkMap::rows_log2);
  REQUIRE(s.read(A::capture_state)[0] == 4);
  const auto event = s.read(static_cast<std::uint32_t>(EngineMap::port_first + H::event_count), 4);
  REQUIRE(event[0] >= 1);
  const std::uint32_t first = s.read(A::capture_first)[0];
  const std::uint32_t row = (first + 3) % (1U << LinkMap::rows_log2);
  const auto words = s.read(LinkMap::memory + 8 * row, 3);
  CHECK(words[2] == event[3]);
  CHECK(words[0] * design_info<D>().count_rad > 0.01);
  CHECK(words[1] == 0);
  s.play();
}

TEST_CASE("feltgate_linked of axes: from event to event as clock by clock") {
  auto fast = std::make_unique<Twin>(), slow = std::make_unique<Twin>();
  UartLine line(D::clock_hz, BAUD);
  RandomFrames frames(Random(5));
  Random random(6);
  In in;
  Bytes from_fast, from_slow;
  std::array<unsigned, AXES> phase{};
  const auto send = [&](const Bytes& wire) {
    for (const std::uint8_t byte : wire) {
      line.send(byte);
      fast->send(byte);
    }
  };
  const auto load = law::load_into_zeros(image());
  for (std::size_t k = 0; k < load.size(); ++k) {
    send(request(2, static_cast<int>(k & 255),
                 EngineMap::port_first + static_cast<unsigned>(load[k].address), load[k].data));
  }
  for (int k = 0; k < 2500; ++k) {
    if (random.one_in(3)) send(frames.any());
    if (k % 500 == 50) {  // a capture by an event, then a stream, then none
      for (int w = 0; w < 12; ++w) {
        send(request(2, w + 1, static_cast<std::uint32_t>(LinkViewMap::first + w),
                     LinkViewMap::choice(w % AXES, 11 - w)));
      }
      send(request(2, 13, A::trigger_mode, LinkMap::trigger_event));
      send(request(2, 14, A::trigger_level, LinkMap::any_event));
      send(request(2, 15, A::capture_words, 0x0d7));
      send(request(2, 16, A::capture_control, 1));
    }
    if (k % 500 == 300) send(request(2, 17, A::stream_period, 700));
    if (k % 500 == 400) {
      send(request(1, 18, LinkMap::memory, 64));
      send(request(2, 19, A::stream_period, 0));
    }
    if (k % 100 == 20) {
      for (std::uint32_t n = 0; n < AXES; ++n) {
        send(request(2, 20 + static_cast<int>(n), kStride * n + D::C::control,
                     control_word(k % 200 == 20, D::S::law)));
      }
    }
    for (std::size_t n = 0; n < AXES; ++n) {
      if (random.one_in(2)) phase[n] += random.one_in(4) ? 3 : 1;
      in.axis[n].encoder = pins_at(phase[n]);
    }
    const auto clocks = static_cast<std::int64_t>(1 + random.below(3000));
    std::int64_t snapshots = 0;
    fast->run(in, clocks, [&] { ++snapshots; });
    for (std::int64_t c = 0; c < clocks; ++c) {
      in.uart_rx = line.level();
      line.clock(slow->out().uart_tx);
      slow->clock(in);
      snapshots -= slow->out().axis[0].snapshot_valid;
    }
    REQUIRE(snapshots == 0);
    REQUIRE(fast->out().uart_tx == slow->out().uart_tx);
    for (std::size_t n = 0; n < AXES; ++n) REQUIRE(fast->out().axis[n] == slow->out().axis[n]);
    for (const std::uint8_t byte : fast->take_received()) from_fast.push_back(byte);
    for (const std::uint8_t byte : line.take_received()) from_slow.push_back(byte);
    REQUIRE(from_fast == from_slow);
  }
  CHECK(from_fast.size() > 1000);
}
