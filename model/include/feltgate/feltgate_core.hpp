// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/feltgate_core.sv: the whole core, every output pin and register on every clock.
// The wave is computed in a few steps and each result shown in the clock in which the RTL shows it.
// clock() advances one clock, skip() a stretch in which no input changes, with identical results.
// Documentation: docs/blocks/feltgate_core.md
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "feltgate/core_ports.hpp"
#include "feltgate/core_wave.hpp"
#include "feltgate/pwm.hpp"
#include "feltgate/quad_decoder.hpp"
#include "feltgate/registers.hpp"
#include "feltgate/sequencer.hpp"
#include "feltgate/supervisor.hpp"

namespace feltgate {

template <class D>
class FeltgateCore {
 public:
  using In = CoreIn;
  using Out = CoreOut;

  FeltgateCore() {
    static_assert(map_fits_sequencer(), "rtl/registers.toml: a slot lies in the wrong bank");
    reset();
    note_supervisor_words();
  }

  /// The parameter RAM keeps its words, as in the RTL.
  void reset() {
    sequencer_.reset();
    registers_.reset();
    decoder_.reset();
    wave_.reset();
    supervisor_.reset();
    pwm_.reset();
    operand_v_ = operand_w_ = 0;
    zero_pending_ = false;
    writes_ = 0;
    gate_clocks_ = {};
    out_ = Out{};
    show_limits();
  }

  void clock(const In& in) {
    const int c = sequencer_.clock_of_tick();
    const bool tick = c == D::clocks_per_tick - 1;
    const int t = c - 2;  // clock of the wave
    const std::uint32_t control = registers_.out().control;
    const bool host = bit(control, D::C::control_host);

    // What the rest of the core sees of the registers in this clock, before the edge.
    typename Registers<D>::In reg = register_inputs(in, c, tick);
    const bool zero = tick && (registers_.commands(D::C::command_set_zero) || zero_pending_);
    const bool clear = tick && registers_.commands(D::C::command_clear_faults);
    const bool kick = tick && registers_.commands(D::C::command_kick);
    const std::int16_t travel = static_cast<std::int16_t>(decoder_.out().travel);
    const std::int32_t position = decoder_.out().position;

    // Supervisor and PWM see the registers of the clock before.
    typename Supervisor<D>::In sup;
    sup.tick = tick;
    sup.arm = host ? bit(control, D::C::control_arm) : in.arm;
    sup.stop = in.stop;
    sup.clear_faults = clear;
    sup.kick = kick;
    sup.encoder_error = decoder_.out().illegal;
    sup.velocity = static_cast<std::int32_t>(out_.velocity);
    sup.current_ref = out_.current_ref;
    sup.wave = sequencer_.out().wave;
    sup.param = registers_.out().param;
    if (t == 5) operand_v_ = out_.voltage * factor(registers_.out().param);
    if (t == 7) operand_w_ = out_.velocity * factor(registers_.out().param);
    if (t == 9) sup.product = operand_v_;
    if (t == 11) sup.product = operand_w_;
    if (t == 17) {
      const std::int64_t estimate = supervisor_.out().current_estimate;
      sup.product = estimate * estimate;
    }
    const bool gates_before = supervisor_.out().gates_enable;
    pwm_.clock(pwm_inputs(gates_before, control));
    supervisor_.clock(sup);
    const QuadDecoder::In d = decoder_inputs(in, control, zero, clear);
    if (!decoder_.settled(d)) decoder_.clock(d);

    wave_.clock(t, position, travel, mode(), out_);

    const bool committed = tick && registers_.out().reg_busy;
    registers_.clock(reg);
    if (tick) {
      const unsigned wanted = host ? (control >> D::C::control_scene) & 15u : in.scene;
      out_.scene = static_cast<std::uint8_t>(wanted);
      if (committed) {
        ++writes_;
        if (pending_address_ < 512) {
          wave_.set_word(pending_address_, registers_.parameter(pending_address_));
          note_supervisor_words();
        }
      }
    }
    if (in.reg_write && !out_.reg_busy) pending_address_ = in.reg_addr;
    zero_pending_ = in.set_zero || (zero_pending_ && !tick);
    sequencer_.clock({});
    show(t);
    count_gates(1);
  }

  /// `clocks` clocks with the inputs held; reg_write and set_zero must be low. The same as so many
  /// calls of clock(), a whole tick at a time where nothing but the tick itself happens.
  /// `on_snapshot()` is called whenever out() holds a valid snapshot.
  template <class OnSnapshot>
  void run(const In& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    while (clocks > 0) {
      if (clocks >= D::clocks_per_tick && can_skip(in)) {
        clocks -= D::clocks_per_tick;
        // Only the last snapshots of a stretch can ever be read back.
        skip_tick(in, clocks < 3 * D::clocks_per_tick, on_snapshot);
      } else {
        clock(in);
        if (out_.snapshot_valid) on_snapshot();
        --clocks;
      }
    }
  }

  const Out& out() const { return out_; }
  /// Clocks since reset for which each gate was on: a_hi, a_lo, b_hi, b_lo.
  const std::array<std::int64_t, 4>& gate_clocks() const { return gate_clocks_; }
  /// Free-running count that the running wave started from.
  std::int16_t sampled_travel() const { return wave_.sampled_travel(); }
  /// Register writes carried out so far.
  std::int64_t writes() const { return writes_; }
  /// The clock of the tick that comes next, 0 .. clocks_per_tick - 1.
  int clock_of_tick() const { return sequencer_.clock_of_tick(); }

 private:
  static constexpr std::uint64_t slot_bit(int read_address) {
    return std::uint64_t{1} << (read_address & 63);
  }
  /// Wave clocks in which a word of the snapshot passes by.
  static constexpr std::uint64_t kSnapshotSlots =
      slot_bit(D::C::read_tick) | slot_bit(D::C::read_position) | slot_bit(D::C::read_status) |
      slot_bit(D::C::read_encoder) | slot_bit(D::C::read_index) | slot_bit(D::C::read_velocity) |
      slot_bit(D::C::read_tau_hat) | slot_bit(D::C::read_tau_ref) |
      slot_bit(D::C::read_current_ref) | slot_bit(D::C::read_voltage) | slot_bit(D::C::read_duty);
  /// The register map keeps to the sequencer: a scene's words in the scene's slots, others outside.
  static constexpr bool map_fits_sequencer() {
    for (const ParameterInfo& p : D::parameters) {
      const bool of_scene = p.address >= 64;
      const int slot = of_scene ? p.address % 32 : p.address;
      const bool in_bank = ((Sequencer<D::clocks_per_tick>::kSceneSlots >> slot) & 1u) != 0;
      if (in_bank != of_scene) return false;
    }
    return true;
  }

  static bool bit(std::uint32_t word, int n) { return ((word >> n) & 1u) != 0; }
  static std::int64_t factor(std::uint32_t param) {
    return param & ((1u << D::coefficient_bits) - 1);
  }

  void note_supervisor_words() {
    using A = typename D::A;
    const auto word = [this](int address) { return registers_.parameter(address); };
    supervisor_words_ = {
        word(A::inverse_resistance), word(A::emf_over_resistance), word(A::nominal_current_squared),
        word(A::overspeed),          word(A::i2t_budget),          word(A::polarity_speed),
        word(A::polarity_current),   word(A::polarity_ticks),      word(A::watchdog_ticks)};
  }

  Mode mode() const {
    return static_cast<Mode>((registers_.out().control >> D::C::control_mode) & 3u);
  }

  typename Registers<D>::In register_inputs(const In& in, int c, bool tick) const {
    typename Registers<D>::In reg;
    const int t = c - 2;
    reg.tick = tick;
    reg.reg_addr = in.reg_addr;
    reg.reg_wdata = in.reg_wdata;
    reg.reg_write = in.reg_write;
    reg.slot_fetch = static_cast<std::uint8_t>(sequencer_.out().slot_fetch);
    reg.scene_slot_fetch = sequencer_.out().scene_slot_fetch;
    reg.scene = out_.scene;
    reg.region_high = wave_.region_high();
    if (t >= 0 && t < 50 && ((kSnapshotSlots >> t) & 1u) != 0) {
      reg.snap_valid = true;
      reg.snap_slot = static_cast<std::uint8_t>(t);
      reg.snap_data = snapshot_word(t);
    }
    return reg;
  }

  std::uint32_t snapshot_word(int t) const {
    switch (t) {
      case 0:
        return out_.tick_count;
      case 1:
        return static_cast<std::uint32_t>(out_.position);
      case 2:
        return status();
      case 9:
        return static_cast<std::uint32_t>(out_.velocity);
      case 11:
        return static_cast<std::uint32_t>(decoder_.out().index_position);
      case 14:
        return static_cast<std::uint32_t>(decoder_.out().rejected_count) << 16 |
               decoder_.out().error_count;
      case 23:
        return static_cast<std::uint32_t>(out_.tau_hat);
      case 28:
        return static_cast<std::uint32_t>(out_.tau_ref);
      case 34:
        return static_cast<std::uint32_t>(out_.current_ref);
      case 40:
        return static_cast<std::uint32_t>(out_.voltage);
      default:
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(out_.duty));
    }
  }

  std::uint32_t status() const {
    return static_cast<std::uint32_t>(decoder_.out().error) << 27 |
           static_cast<std::uint32_t>(mode()) << 25 | static_cast<std::uint32_t>(out_.armed) << 24 |
           static_cast<std::uint32_t>(out_.scene) << 20 |
           static_cast<std::uint32_t>(out_.limits) << 12 |
           static_cast<std::uint32_t>(out_.first_fault) << 8 | out_.faults;
  }

  QuadDecoder::In decoder_inputs(const In& in, std::uint32_t control, bool zero, bool clear) const {
    QuadDecoder::In d;
    d.a = in.encoder.a;
    d.b = in.encoder.b;
    d.z = in.encoder.z;
    d.filter = static_cast<std::uint8_t>((control >> D::C::control_filter) & 15u);
    d.polarity = bit(control, D::C::control_encoder_polarity);
    d.set_zero = zero;
    d.clear_error = clear;
    return d;
  }

  Pwm::In pwm_inputs(bool enable, std::uint32_t control) const {
    Pwm::In p;
    p.enable = enable;
    p.mode = bit(control, D::C::control_pwm_mode);
    p.polarity = bit(control, D::C::control_motor_polarity);
    p.duty = out_.duty;
    return p;
  }

  void count_gates(int clocks) {
    for (std::size_t g = 0; g < gate_clocks_.size(); ++g) {
      if (((out_.gates >> g) & 1u) != 0) gate_clocks_[g] += clocks;
    }
  }

  /// At the start of a tick with nothing under way that is not the tick's own.
  bool can_skip(const In& in) const {
    return sequencer_.clock_of_tick() == 0 && sequencer_.out().tick_count != 0 &&
           !registers_.out().reg_busy && !zero_pending_ && supervisor_.steady(in.stop) &&
           !(in.stop && supervisor_.out().gates_enable) &&
           decoder_.settled(decoder_inputs(in, registers_.out().control, false, false));
  }

  /// One whole tick from its first clock.
  template <class OnSnapshot>
  void skip_tick(const In& in, bool keep_words, OnSnapshot&& on_snapshot) {
    const std::uint32_t control = registers_.out().control;
    const bool host = bit(control, D::C::control_host);
    const bool enabled = out_.gates_enable;
    const auto keep = [&](int t) {
      if (keep_words) registers_.write_snapshot(t, snapshot_word(t));
    };
    typename Supervisor<D>::Tick sup;
    sup.voltage_before = out_.voltage;
    sup.velocity_before = static_cast<std::int32_t>(out_.velocity);
    sup.current_ref = out_.current_ref;
    sup.arm = host ? bit(control, D::C::control_arm) : in.arm;

    out_.snapshot_valid = false;
    keep(0);
    wave_.clock(0, decoder_.out().position, static_cast<std::int16_t>(decoder_.out().travel),
                mode(), out_);
    keep(1);
    keep(2);
    wave_.clock(2, 0, 0, mode(), out_);
    wave_.clock(8, 0, 0, mode(), out_);
    sup.velocity = static_cast<std::int32_t>(out_.velocity);
    // Every cause is seen by wave clock 46, so the snapshot shows it; the gates fall in clock
    // `fell`.
    const int fell = supervisor_.tick(supervisor_words_, sup);
    for (const int t : {9, 11, 14}) keep(t);
    wave_.clock(22, 0, 0, mode(), out_);
    keep(23);
    wave_.clock(24, 0, 0, mode(), out_);
    wave_.clock(25, 0, 0, mode(), out_);
    wave_.clock(27, 0, 0, mode(), out_);
    keep(28);
    wave_.clock(33, 0, 0, mode(), out_);
    keep(34);
    wave_.clock(39, 0, 0, mode(), out_);
    keep(40);
    const int open_clocks = !enabled ? 0 : fell < 0 ? D::clocks_per_tick : fell + 1;
    advance_pwm(0, 48, open_clocks, control);
    wave_.clock(45, 0, 0, mode(), out_);
    keep(46);
    out_.faults = supervisor_.out().faults;
    out_.first_fault = supervisor_.out().first_fault;
    out_.gates_enable = enabled && fell < 0;
    out_.duty_active = pwm_.out().duty_active;
    show_limits();
    out_.snapshot_valid = true;
    on_snapshot();
    out_.snapshot_valid = false;
    advance_pwm(48, D::clocks_per_tick - 1, open_clocks, control);
    // The last clock of the tick: arming, scene, counters.
    pwm_.clock(pwm_inputs(out_.gates_enable, control));
    registers_.skip_tick(in.reg_addr);
    out_.scene =
        static_cast<std::uint8_t>(host ? (control >> D::C::control_scene) & 15u : in.scene);
    sequencer_.skip_ticks(1);
    show(D::clocks_per_tick - 3);
    count_gates(1);
  }

  /// Clocks [from, to) of a tick whose gates are open in its first `open` clocks.
  void advance_pwm(int from, int to, int open, std::uint32_t control) {
    while (from < to) {
      const Pwm::In p = pwm_inputs(from < open, control);
      // Up to where the enable changes; what the gates show after a clock is the next one's enable.
      const int end = from < open - 1 ? std::min(to, open - 1) : from < open ? from + 1 : to;
      const int quiet = std::min(end - from, pwm_.quiet_clocks(p));
      if (quiet > 0) {
        pwm_.skip(quiet);
        from += quiet;
        out_.gates = gate_bits(from < open);
        count_gates(quiet);
      } else {
        pwm_.clock(p);
        ++from;
        out_.gates = gate_bits(from < open);
        count_gates(1);
      }
    }
  }

  std::uint8_t gate_bits(bool enable) const {
    Pwm::In p;
    p.enable = enable;
    const Pwm::Out g = pwm_.peek(p);
    return static_cast<std::uint8_t>(g.gate_a_hi | g.gate_a_lo << 1 | g.gate_b_hi << 2 |
                                     g.gate_b_lo << 3);
  }

  void show_limits() { out_.limits = wave_.limits(out_.gates_enable); }

  /// Outputs after the edge; `t` was the clock of the wave before it.
  void show(int t) {
    out_.armed = supervisor_.out().armed;
    out_.gates_enable = supervisor_.out().gates_enable;
    out_.faults = supervisor_.out().faults;
    out_.first_fault = supervisor_.out().first_fault;
    out_.tick_count = sequencer_.out().tick_count;
    out_.reg_rdata = registers_.out().reg_rdata;
    out_.reg_busy = registers_.out().reg_busy;
    out_.snapshot_valid = t == 46;
    out_.duty_active = pwm_.out().duty_active;
    out_.gates = gate_bits(out_.gates_enable);
    show_limits();
  }

  Sequencer<D::clocks_per_tick> sequencer_;
  Registers<D> registers_;
  QuadDecoder decoder_;
  CoreWave<D> wave_;
  Supervisor<D> supervisor_;
  typename Supervisor<D>::Words supervisor_words_;
  Pwm pwm_{D::pwm_period, D::dead_clocks};
  std::int64_t operand_v_ = 0, operand_w_ = 0;
  int pending_address_ = 0;
  bool zero_pending_ = false;
  std::int64_t writes_ = 0;
  std::array<std::int64_t, 4> gate_clocks_{};
  Out out_;
};

}  // namespace feltgate
