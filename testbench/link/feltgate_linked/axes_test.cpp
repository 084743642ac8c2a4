// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked of a design with two axes or three: RTL against twin on every clock, with a host
// at the wire that loads a law, arms, chooses words of all axes, and stops at any of them.
// Documentation: docs/link.md
#include <Vfeltgate_linked.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "encoder_phase.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/linked_core.hpp"
#include "frames.hpp"
#include "law/compile.hpp"
#include "law/load.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "sim/backends/rtl_axes_ports.hpp"

// feltgate_linked with AXES axes: its ports, and a host that loads a law and moves levers at the
// twin's pins; play() then runs the RTL beside a twin.

#if AXES == 2
#include "feltgate/generated/pantograph_law.hpp"
#else
#include "feltgate/generated/stylus_law.hpp"
#endif

namespace feltgate::test {

#if AXES == 2
using D = PantographLaw;
#else
using D = StylusLaw;
#endif
using A = LinkMap::A;
using N = LinkMap::N;
using H = EngineMap::H;
constexpr int kTick = D::clocks_per_tick;
constexpr std::uint32_t kStride = axes_stride;

struct Twin : LinkedCore<D, AXES> {
  Twin() : LinkedCore<D, AXES>(LinkedOptions{BAUD, false, 0}) {}
};
using In = Twin::In;
using Out = Twin::Out;

struct Adapter {
  static void drive(Vfeltgate_linked& rtl, const In& in) {
    for (int n = 0; n < AXES; ++n) {
      const auto& axis = in.axis[static_cast<std::size_t>(n)];
      set_bits(rtl.enc_a_i, n, 1, axis.encoder.a);
      set_bits(rtl.enc_b_i, n, 1, axis.encoder.b);
      set_bits(rtl.enc_z_i, n, 1, axis.encoder.z);
      set_bits(rtl.set_zero_i, n, 1, axis.set_zero);
      set_bits(rtl.scene_i, 4 * n, 4, axis.scene);
    }
    FELTGATE_DRIVE(rtl, in, arm, stop, clear_faults, uart_rx, inputs);
  }
  static void at_edge(Vfeltgate_linked& rtl) { rtl.stop_i = 0; }
  template <class Check>
  static void compare(Check& check, const Vfeltgate_linked& rtl, const Out& out) {
    check("uart_tx", rtl.uart_tx_o, out.uart_tx);
    check("snapshot_valid", rtl.snapshot_valid_o, out.axis[0].snapshot_valid);
    for (int n = 0; n < AXES; ++n) {
      const CoreOut& o = out.axis[static_cast<std::size_t>(n)];
      using C = Map::C;
      const auto word = [&](const char* name, const auto& port, int width, std::uint32_t twin) {
        check(name, bits_of(port, n * width, width), std::uint64_t{twin});
      };
      word("gate_a_hi", rtl.gate_a_hi_o, 1, o.gates & 1u);
      word("gate_a_lo", rtl.gate_a_lo_o, 1, o.gates >> 1 & 1u);
      word("gate_b_hi", rtl.gate_b_hi_o, 1, o.gates >> 2 & 1u);
      word("gate_b_lo", rtl.gate_b_lo_o, 1, o.gates >> 3 & 1u);
      word("position", rtl.position_o, 32, static_cast<std::uint32_t>(o.position));
      word("limits", rtl.limits_o, C::status_limits_width, o.limits);
      word("faults", rtl.faults_o, C::faults_seen_width, o.faults);
      word("first_fault", rtl.first_fault_o, C::faults_first_width, o.first_fault);
      word("scene", rtl.scene_o, 4, o.scene);
      word("armed", rtl.armed_o, 1, o.armed);
      word("gates_enable", rtl.gates_enable_o, 1, o.gates_enable);
    }
  }
};
struct LockTwin : Twin {
  using In = Twin::In;
  using Out = Twin::Out;
};
using Bench = LockStep<Vfeltgate_linked, LockTwin, Adapter>;

inline std::uint32_t control_word(bool arm, int scene) {
  return static_cast<std::uint32_t>(D::control_reset) | 1U << D::C::control_host |
         std::uint32_t{arm} << D::C::control_arm |
         static_cast<std::uint32_t>(scene) << D::C::control_scene;
}

/// A spring at each axis, and an event of the last one.
inline const law::Image& image() {
  static const law::Image made = [] {
    std::string text = "param stiffness = 0.0625 Nm/rad in 0 .. 0.25 Nm/rad\n";
    text += "event beyond when position[" + std::string(AXES == 2 ? "1" : "2") + "] > 0.01\n";
    for (int n = 0; n < AXES; ++n) {
      const std::string axis = n == 0 ? "0" : n == 1 ? "1" : "2";
      text += "out torque[" + axis + "] = -stiffness * position[" + axis + "]\n";
    }
    return law::compile_text(text, "test", law::target_of(design_info<D>())).image;
  }();
  return made;
}

/// A host and levers at the twin's pins; what they did is then played to the RTL.
class Life {
 public:
  In in;

  const CoreOut& out(int n) const { return twin_->out().axis[static_cast<std::size_t>(n)]; }
  void clocks(std::int64_t count) {
    for (; count > 0; --count) {
      in.uart_rx = line_.level();
      line_.clock(twin_->out().uart_tx);
      inputs_.push_back(in);
      twin_->clock(in);
    }
  }
  void ticks(int n) { clocks(std::int64_t{n} * kTick); }
  void send(const Bytes& wire) {
    for (const std::uint8_t byte : wire) line_.send(byte);
  }
  /// Returns the words of the next frame whose second byte is `second`, without its head.
  std::vector<std::uint32_t> frame(int kind, int second, int patience = 700) {
    for (int wait = 0; wait < patience || line_.unsent() > 0; ++wait) {
      clocks(100);
      for (const std::uint8_t byte : line_.take_received()) {
        wait = 0;
        if (byte != LinkMap::frame_end) {
          frame_.push_back(byte);
          continue;
        }
        const Bytes got = unescaped(std::exchange(frame_, {}));
        if (got.size() < 8 || got[0] != kind) continue;
        if (second < 0 || got[1] == second) return body_words(got);
      }
    }
    return {};
  }
  std::vector<std::uint32_t> read(std::uint32_t address, std::uint32_t words = 1) {
    send(request(1, ++sequence_ & 255, address, words));
    const auto got = frame(0x81, sequence_ & 255);
    REQUIRE(got.size() == words);
    return got;
  }
  /// Returns the status in the reply.
  std::uint32_t write(std::uint32_t address, std::uint32_t word) {
    send(request(2, ++sequence_ & 255, address, word));
    const auto got = frame(0x82, sequence_ & 255);
    REQUIRE(got.size() == 1);
    return got[0];
  }
  void write_all(int address, std::uint32_t word) {
    for (std::uint32_t n = 0; n < AXES; ++n) {
      write(kStride * n + static_cast<std::uint32_t>(address), word);
    }
  }
  void load() {
    const auto words = law::load_into_zeros(image());
    for (std::size_t k = 0; k < words.size(); ++k) {
      const auto address = static_cast<std::uint32_t>(EngineMap::port_first + words[k].address);
      if (k + 1 == words.size()) {
        write(address, words[k].data);
      } else {
        send(request(2, ++sequence_ & 255, address, words[k].data));
      }
    }
  }
  bool all_armed() const {
    bool all = true;
    for (int n = 0; n < AXES; ++n) all &= out(n).armed && out(n).gates_enable;
    return all;
  }
  bool none_on() const {
    bool any = false;
    for (int n = 0; n < AXES; ++n) any |= out(n).gates_enable;
    return !any;
  }
  void arm(int scene = D::S::law) {
    write_all(D::C::control, control_word(false, scene));
    write_all(D::C::command, 1U << D::C::command_clear_faults);
    write_all(D::A::self_test_pulse, 0);
    write_all(D::A::ramp_step, 0x7ffffff);
    write_all(D::C::control, control_word(true, scene));
    for (int k = 0; k < 3000 && !all_armed(); ++k) ticks(1);
  }
  void turn(int n, bool up) {
    unsigned& phase = phase_[static_cast<std::size_t>(n)];
    phase += up ? 1U : 3U;
    in.axis[static_cast<std::size_t>(n)].encoder = pins_at(phase);
    ticks(3);
  }
  void choose(int k, int axis, int word) {
    write(static_cast<std::uint32_t>(LinkViewMap::first + k), LinkViewMap::choice(axis, word));
  }
  void play() {
    Bench bench("feltgate_linked", 7);
    const std::vector<In>& inputs = inputs_;
    bench.run(
        [&inputs](std::int64_t clock) {
          const std::int64_t k = clock - Bench::kFirstReset;
          return k < 0 ? In{} : inputs[static_cast<std::size_t>(k)];
        },
        static_cast<std::int64_t>(inputs.size()) + Bench::kFirstReset);
  }

 private:
  std::unique_ptr<Twin> twin_ = std::make_unique<Twin>();
  UartLine line_{D::clock_hz, BAUD};
  std::vector<In> inputs_;
  Bytes frame_;
  int sequence_ = 0;
  std::array<unsigned, AXES> phase_{};
};

}  // namespace feltgate::test

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
