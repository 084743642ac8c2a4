// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked of one axis and of several with whatever comes over the wire: RTL against twin on
// every clock, and the twin from event to event against its clocks. Documentation: docs/link.md
#include "catch.hpp"
#include "feltgate_linked_twin.hpp"

using namespace feltgate;
using namespace feltgate::test;
using A = LinkMap::A;

namespace {

/// Levers, a panel, and the bytes of a host, which uses the words of all axes and of their view.
struct Stimulus {
  explicit Stimulus(std::uint64_t seed)
      : random(seed), frames(Random(seed + 1)), line(D::clock_hz, BAUD) {}

  In operator()(std::int64_t, const Out& out) {
    if (line.unsent() == 0 && gap-- <= 0) {
      if (random.one_in(4)) {
        arm_and_disarm();
      } else if (kAxisCount == 1 || random.coin()) {
        send(frames.any());
      } else {
        const std::uint32_t view = LinkViewMap::first + random.below(16);
        const std::uint32_t at = random.coin() ? view : random.below(0x1000);
        send(request(1 + static_cast<int>(random.below(2)), next(), at, 1 + random.below(47)));
      }
      gap = static_cast<int>(random.below(random.one_in(4) ? 40'000 : 2'000));
    }
    if (random.one_in(20'000)) low = 1 + static_cast<int>(random.below(300));
    in.uart_rx = line.level() && low == 0;
    if (low > 0) --low;
    line.clock(out.uart_tx);
    for (std::size_t n = 0; n < kAxisCount; ++n) {
      if (random.one_in(900)) phase[n] += random.one_in(5) ? 3 : 1;
      encoder_of(in, n) = pins_at(phase[n], (phase[n] & 0xfffU) == 0);
    }
    panel(in);
    if (random.one_in(60'000)) in.arm = !in.arm;
    in.stop = random.one_in(400'000);
    in.clear_faults = random.one_in(50'000);
    if (random.one_in(10'000)) in.inputs = static_cast<std::uint8_t>(random.below(256));
    return in;
  }

  void panel(LinkedIn& one) {
    one.encoder_data = random.coin();  // without the options nothing follows from these
    one.current_data = random.coin();
    one.driver_fault = random.coin();
    one.hall = static_cast<std::uint8_t>(random.below(8));
    panel_of(one);
  }
  template <int N>
  void panel(LinkedAxesIn<N>& all) {
    for (auto& axis : all.axis) panel_of(axis);
  }
  template <class Axis>
  void panel_of(Axis& axis) {
    axis.set_zero = random.one_in(100'000);
    if (random.one_in(200'000)) axis.scene = static_cast<std::uint8_t>(random.below(10));
  }

  int next() { return frames.sequence = (frames.sequence + 1) & 255; }
  void send(const Bytes& wire) {
    for (const std::uint8_t byte : wire) line.send(byte);
  }
  void write_all(int address, std::uint32_t word) {
    for (std::uint32_t n = 0; n < kAxisCount; ++n) {
      send(request(2, next(), kStride * n + static_cast<std::uint32_t>(address), word));
    }
  }
  /// The host arms, and sometimes disarms while a long reply is being sent.
  void arm_and_disarm() {
    const int scene = kAxisCount == 1 ? D::S::damper : D::S::free;
    write_all(D::C::control, control_word(false, scene));
    write_all(D::C::command, 1U << D::C::command_clear_faults);
    write_all(D::C::control, control_word(true, scene));
    if (random.coin()) send(request(2, next(), A::stream_period, random.below(2000)));
    if (random.coin()) send(request(2, next(), A::stream_words, random.below(4096)));
    if (random.coin()) send(request(2, next(), A::capture_words, random.below(4096)));
    if (random.coin()) send(request(2, next(), A::capture_control, random.below(8)));
    if (random.coin()) send(request(1, next(), LinkMap::memory + random.below(200), 20));
    if (kAxisCount > 1) return;
    send(request(1, next(), LinkMap::words, 40));
    write_all(D::C::control, control_word(false, scene));
  }

  Random random;
  RandomFrames frames;
  UartLine line;
  In in;
  int gap = 10, low = 0;
  std::array<unsigned, kAxisCount> phase{};
};

}  // namespace

TEST_CASE("feltgate_linked: whatever comes over the wire, RTL against twin") {
  constexpr std::int64_t clocks = kAxisCount == 1 ? 900'000 : 700'000;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Bench bench("feltgate_linked", seed);
    bench.run(Stimulus(seed), scaled_clocks(clocks), {seed == 2 ? 60'000U : 0U});
  }
}

/// What is there at the pins. The word at the register port is compared where the link sends it.
static CoreOut outputs(const Twin::Out& out, std::size_t n) {
  CoreOut o = linked::axis(out, n);
  o.reg_rdata = 0;
  return o;
}

TEST_CASE("feltgate_linked: from event to event as clock by clock") {
  const auto fast = std::make_unique<Twin>(), slow = std::make_unique<Twin>();
  UartLine line(D::clock_hz, BAUD);
  RandomFrames frames(Random(5));
  Random random(6);
  In in;
  Bytes from_fast, from_slow;
  std::array<unsigned, kAxisCount> phase{};
  const auto send = [&](const Bytes& wire) {
    for (const std::uint8_t byte : wire) {
      line.send(byte);
      fast->send(byte);
    }
  };
#if defined(LAW) || defined(AXES)
  const auto load = law::load_into_zeros(image());
  for (std::size_t k = 0; k < load.size(); ++k) {
    send(request(2, static_cast<int>(k & 255),
                 EngineMap::port_first + static_cast<unsigned>(load[k].address), load[k].data));
  }
#endif
  for (int k = 0; k < 1500; ++k) {
    if (random.one_in(3)) send(frames.any());
    if (k % 500 == 50) {  // a capture, by an event if there are any, then a stream, then none
      for (int w = 0; kAxisCount > 1 && w < 12; ++w) {
        send(request(2, w + 1, static_cast<std::uint32_t>(LinkViewMap::first + w),
                     LinkViewMap::choice(w % kAxisCount, 11 - w)));
      }
      if (D::engine != 0) {
        send(request(2, 13, A::trigger_mode, LinkMap::trigger_event));
        send(request(2, 14, A::trigger_level, LinkMap::any_event));
      }
      send(request(2, 15, A::capture_words, 0x0d7));
      send(request(2, 16, A::capture_control, D::engine != 0 ? 1 : 1 + 4));
    }
    if (k % 500 == 300) send(request(2, 17, A::stream_period, 700));
    if (k % 500 == 400) {
      send(request(1, 18, LinkMap::memory, 64));
      send(request(2, 19, A::stream_period, 0));
    }
    for (std::uint32_t n = 0; n < kAxisCount && k % 100 == 20; ++n) {
      send(request(2, 20 + static_cast<int>(n), kStride * n + D::C::control,
                   control_word(k % 200 == 20, D::engine != 0 ? D::S::law : D::S::free)));
    }
    for (std::size_t n = 0; n < kAxisCount; ++n) {
      if (random.one_in(3)) phase[n] += random.one_in(4) ? 3 : 1;
      encoder_of(in, n) = pins_at(phase[n]);
    }
    in.arm = random.coin();
    const auto clocks = static_cast<std::int64_t>(1 + random.below(3000));
    std::int64_t snapshots = 0;
    fast->run(in, clocks, [&] { ++snapshots; });
    for (std::int64_t c = 0; c < clocks; ++c) {
      in.uart_rx = line.level();
      line.clock(slow->out().uart_tx);
      slow->clock(in);
      snapshots -= linked::axis(slow->out(), 0).snapshot_valid;
    }
    REQUIRE(snapshots == 0);
    REQUIRE(fast->out().uart_tx == slow->out().uart_tx);
    for (std::size_t n = 0; n < kAxisCount; ++n) {
      REQUIRE(outputs(fast->out(), n) == outputs(slow->out(), n));
    }
    for (const std::uint8_t byte : fast->take_received()) from_fast.push_back(byte);
    for (const std::uint8_t byte : line.take_received()) from_slow.push_back(byte);
    REQUIRE(from_fast == from_slow);
  }
  CHECK(from_fast.size() > 1000);
}
