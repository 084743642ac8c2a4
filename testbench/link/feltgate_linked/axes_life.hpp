// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked with AXES axes: its ports, and a host that loads a law and moves levers at the
// twin's pins; play() then runs the RTL beside a twin. Documentation:
// docs/link.md
#pragma once

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
