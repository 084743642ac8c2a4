// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The linked core of a test's design, or AXES axes with their link: the ports of RTL and twin, and
// a host with levers at the twin's pins, which play() then runs on the RTL. Documentation:
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
#include "feltgate/linked_core.hpp"
#include "frames.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#if defined(LAW) || defined(AXES)
#include "feltgate/design_info.hpp"
#include "law/compile.hpp"
#include "law/load.hpp"
#endif
#include "sim/backends/rtl_axes_ports.hpp"
#include "twins.hpp"
#if defined(AXES)
#if AXES == 2
#include "feltgate/generated/pantograph_law.hpp"
#else
#include "feltgate/generated/stylus_law.hpp"
#endif
#elif defined(LAW)
#include "feltgate/generated/lever_law.hpp"
#elif defined(CURRENT)
#include "feltgate/generated/lever_current.hpp"
#elif defined(ABSOLUTE)
#include "feltgate/generated/lever_absolute.hpp"
#elif defined(GIMBAL_MOTOR)
#include "feltgate/generated/gimbal_motor.hpp"
#elif defined(GIMBAL_CURRENT)
#include "feltgate/generated/gimbal_current.hpp"
#elif defined(HALL_MOTOR)
#include "feltgate/generated/hall_motor.hpp"
#else
#include "feltgate/generated/lever.hpp"
#endif

namespace feltgate::test {

#if defined(AXES) && AXES == 2
using D = PantographLaw;
#elif defined(AXES)
using D = StylusLaw;
#elif defined(LAW)
using D = LeverLaw;
#elif defined(CURRENT)
using D = LeverCurrent;
#elif defined(ABSOLUTE)
using D = LeverAbsolute;
#elif defined(GIMBAL_MOTOR)
using D = GimbalMotor;
#elif defined(GIMBAL_CURRENT)
using D = GimbalCurrent;
#elif defined(HALL_MOTOR)
using D = HallMotor;
#else
using D = Lever;
#endif
#if defined(AXES)
constexpr int kAxisCount = AXES;
#else
constexpr int kAxisCount = 1;
#endif
constexpr int kTick = D::clocks_per_tick;
constexpr std::uint32_t kStride = axes_stride;

class FeltgateLinked : public test::LinkedOf<D, kAxisCount> {
 public:
  using In = typename test::LinkedOf<D, kAxisCount>::In;
  using Out = typename test::LinkedOf<D, kAxisCount>::Out;
  FeltgateLinked() : test::LinkedOf<D, kAxisCount>(LinkedOptions{BAUD, false, 0}) {}
};
using Twin = FeltgateLinked;
using In = Twin::In;
using Out = Twin::Out;

struct LinkedAdapter {
#if defined(AXES)
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
#else
  static void drive(Vfeltgate_linked& rtl, const In& in) {
    set_enc_a_i(rtl, in.encoder.a, 0);
    set_enc_b_i(rtl, in.encoder.b, 0);
    set_enc_z_i(rtl, in.encoder.z, 0);
    set_encoder_data_i(rtl, in.encoder_data, 0);
    set_hall_i(rtl, in.hall, 0);
    set_current_data_i(rtl, in.current_data, 0);
    set_driver_fault_i(rtl, in.driver_fault, 0);
    FELTGATE_DRIVE(rtl, in, arm, stop, set_zero, clear_faults, scene, uart_rx, inputs);
  }
  template <class Check>
  static void compare(Check& check, const Vfeltgate_linked& rtl, const Out& out) {
    check("uart_tx", rtl.uart_tx_o, out.uart_tx);
    check("gate_a_hi", rtl.gate_a_hi_o, out.core.gates & 1u);
    check("gate_a_lo", rtl.gate_a_lo_o, (out.core.gates >> 1) & 1u);
    check("gate_b_hi", rtl.gate_b_hi_o, (out.core.gates >> 2) & 1u);
    check("gate_b_lo", rtl.gate_b_lo_o, (out.core.gates >> 3) & 1u);
    check("gate_c_hi", get_gate_c_hi_o(rtl, 0), (out.core.gates >> 4) & 1u);
    check("gate_c_lo", get_gate_c_lo_o(rtl, 0), (out.core.gates >> 5) & 1u);
    check("serial", serial_lines(rtl, feltgate::test::port_bits<D>()), out.core.serial);
    check("current_clock", get_current_clock_o(rtl, 0), out.core.current_clock);
    check("heartbeat", get_heartbeat_o(rtl, 0), out.core.heartbeat);
    check("position", static_cast<std::int32_t>(rtl.position_o), out.core.position);
    FELTGATE_COMPARE(check, rtl, out.core, limits, faults, first_fault, scene, armed, gates_enable,
                     snapshot_valid);
  }
#endif
  static void at_edge(Vfeltgate_linked& rtl) { rtl.stop_i = 0; }
};
using Bench = LockStep<Vfeltgate_linked, Twin, LinkedAdapter>;

/// The pins of one axis' encoder.
inline EncoderPins& encoder_of(LinkedIn& in, std::size_t) { return in.encoder; }
template <int N>
EncoderPins& encoder_of(LinkedAxesIn<N>& in, std::size_t n) {
  return in.axis[n].encoder;
}

inline std::uint32_t control_word(bool arm, int scene) {
  return static_cast<std::uint32_t>(D::control_reset) | 1U << D::C::control_host |
         std::uint32_t{arm} << D::C::control_arm |
         static_cast<std::uint32_t>(scene) << D::C::control_scene;
}

#if defined(LAW) || defined(AXES)
/// A spring at each axis, and an event of the last one.
inline const law::Image& image() {
  static const law::Image made = [] {
    const auto of = [](int n) { return kAxisCount == 1 ? "" : "[" + std::to_string(n) + "]"; };
    const std::string last = "position" + of(kAxisCount - 1);
    std::string text = kAxisCount == 1 ? "param stiffness = 0.25 Nm/rad in 0 .. 1 Nm/rad\n"
                                       : "param stiffness = 0.0625 Nm/rad in 0 .. 0.25 Nm/rad\n";
    text += "event beyond(" + last + ") when " + last + " > 0.01\n";
    for (int n = 0; n < kAxisCount; ++n) {
      text += "out torque" + of(n) + " = -stiffness * position" + of(n) + "\n";
    }
    return law::compile_text(text, "test", law::target_of(design_info<D>())).image;
  }();
  return made;
}
#endif

/// A host and levers at the twin's pins. Their actions are recorded; the RTL runs them later.
class Life {
 public:
  In in;

  const CoreOut& out(int n = 0) const {
    return linked::axis(twin_->out(), static_cast<std::size_t>(n));
  }
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
  /// Returns the words of the next frame of this kind whose second byte is `second`, if not -1;
  /// empty if the line stays silent.
  std::vector<std::uint32_t> frame(int kind, int second) {
    for (int wait = 0; wait < 700 || line_.unsent() > 0; ++wait) {
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
    send(request(1, next(), address, words));
    const auto got = frame(0x81, sequence_);
    REQUIRE(got.size() == words);
    return got;
  }
  /// Returns the status in the reply.
  std::uint32_t write(std::uint32_t address, std::uint32_t word) {
    send(request(2, next(), address, word));
    const auto got = frame(0x82, sequence_);
    REQUIRE(got.size() == 1);
    return got[0];
  }
  void write_all(int address, std::uint32_t word) {
    for (std::uint32_t n = 0; n < kAxisCount; ++n) {
      write(kStride * n + static_cast<std::uint32_t>(address), word);
    }
  }
  std::vector<std::uint32_t> engine(int address, std::uint32_t words = 1) {
    return read(static_cast<std::uint32_t>(EngineMap::port_first + address), words);
  }
#if defined(LAW) || defined(AXES)
  /// Sends all frames but the last at the full rate of the wire: each acts when its frame is
  /// complete.
  void write_engine(const std::vector<law::HostWord>& words) {
    for (std::size_t k = 0; k < words.size(); ++k) {
      const auto address = static_cast<std::uint32_t>(EngineMap::port_first + words[k].address);
      if (k + 1 == words.size()) {
        write(address, words[k].data);
      } else {
        send(request(2, next(), address, words[k].data));
      }
    }
  }
#endif
  void control(bool arm, int scene = D::S::law) {
    write_all(D::C::control, control_word(arm, scene));
  }
  void arm(int scene = D::S::law) {
    control(false, scene);
    write_all(D::A::self_test_pulse, 0);
    write_all(D::A::ramp_step, 0x7ffffff);
    write_all(D::C::command, 1U << D::C::command_clear_faults);
    control(true, scene);
    for (int k = 0; k < 3000 && !armed(); ++k) ticks(1);
  }
  /// Of all axes.
  bool armed() const {
    bool all = true;
    for (int n = 0; n < kAxisCount; ++n) all &= out(n).armed && out(n).gates_enable;
    return all;
  }
  /// Moves by one count.
  void turn(bool up, int n = 0) {
    unsigned& phase = phase_[static_cast<std::size_t>(n)];
    phase += up ? 1U : 3U;
    EncoderPins& pins = encoder_of(in, static_cast<std::size_t>(n));
    pins = pins_at(phase, pins.z);
  }
  /// Moves by one count and runs four ticks.
  void step(bool up, int n = 0) {
    turn(up, n);
    ticks(4);
  }
  /// Runs the recorded actions on the RTL beside a twin.
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
  int next() { return sequence_ = (sequence_ + 1) & 255; }

  std::unique_ptr<Twin> twin_ = std::make_unique<Twin>();
  UartLine line_{D::clock_hz, BAUD};
  std::vector<In> inputs_;
  Bytes frame_;
  int sequence_ = 0;
  std::array<unsigned, kAxisCount> phase_{};
};

}  // namespace feltgate::test
