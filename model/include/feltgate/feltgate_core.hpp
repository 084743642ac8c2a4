// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/feltgate_core.sv: the whole core, every output pin and register on every clock.
// The wave is computed in a few steps and each result shown in the clock in which the RTL shows it.
// clock() advances one clock, run() a stretch in which no input changes, with identical results.
// Documentation: docs/blocks/feltgate_core.md
#pragma once

#include <array>
#include <cstdint>

#include "feltgate/core_gates.hpp"
#include "feltgate/core_ports.hpp"
#include "feltgate/core_wave.hpp"
#include "feltgate/quad_decoder.hpp"
#include "feltgate/registers.hpp"
#include "feltgate/sequencer.hpp"
#include "feltgate/supervisor.hpp"

namespace feltgate {

/// ReadBack = false: no snapshot in the registers, every read gives 0 (parameter of the RTL).
template <class D, bool ReadBack = true>
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
    gates_.reset();
    operand_v_ = operand_w_ = 0;
    passed_to_ = -1;
    zero_pending_ = false;
    writes_ = 0;
    out_ = Out{};
    show();
  }

  void clock(const In& in) {
    const int c = sequencer_.clock_of_tick();
    catch_up(c);
    const bool tick = c == D::clocks_per_tick - 1;
    const int t = c - kWave;  // clock of the wave
    const std::uint32_t control = registers_.out().control;
    const bool host = bit(control, D::C::control_host);

    // What the rest of the core sees of the registers in this clock, before the edge.
    const typename Registers<D, ReadBack>::In reg = register_inputs(in, t, tick);
    const bool zero = tick && (registers_.commands(D::C::command_set_zero) || zero_pending_);
    const bool clear = tick && registers_.commands(D::C::command_clear_faults);
    const std::int16_t travel = static_cast<std::int16_t>(decoder_.out().travel);
    const std::int32_t position = decoder_.out().position;

    // Supervisor and PWM see the registers of the clock before.
    if (t == 5) operand_v_ = out_.voltage * factor(supervisor_words_.inverse_resistance);
    if (t == 7) operand_w_ = out_.velocity * factor(supervisor_words_.emf_over_resistance);
    typename Supervisor<D>::In sup = supervisor_inputs(t);
    sup.tick = tick;
    sup.arm = host ? bit(control, D::C::control_arm) : in.arm;
    sup.stop = in.stop;
    sup.clear_faults = clear;
    sup.kick = tick && registers_.commands(D::C::command_kick);
    sup.encoder_error = decoder_.out().illegal;
    gates_.clock(pwm_inputs(supervisor_.out().gates_enable, out_.duty));
    supervisor_.clock(sup);
    const QuadDecoder::In d = decoder_inputs(in, zero, clear);
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
    gates_.show(supervisor_.out().gates_enable);
    show();
    out_.snapshot_valid = t == 46;
  }

  /// `clocks` clocks with the inputs held; reg_write and set_zero must be low. The same as so many
  /// calls of clock(), from event to event where nothing but the wave itself happens.
  /// `on_snapshot()` is called whenever out() holds a valid snapshot.
  template <class OnSnapshot>
  void run(const In& in, std::int64_t clocks, OnSnapshot&& on_snapshot);

  bool calm(const In& in, std::int64_t clocks) const;

  const Out& out() const { return out_; }
  /// Clocks since reset for which each gate was on: a_hi, a_lo, b_hi, b_lo.
  std::array<std::int64_t, 4> gate_clocks() const { return gates_.on_clocks(); }
  /// Free-running count that the running wave started from.
  std::int16_t sampled_travel() const { return wave_.sampled_travel(); }
  /// Register writes carried out so far.
  std::int64_t writes() const { return writes_; }
  /// The clock of the tick that comes next, 0 .. clocks_per_tick - 1.
  int clock_of_tick() const { return sequencer_.clock_of_tick(); }

 private:
  static constexpr int kWave = 2;            // clock of the tick that is wave clock 0
  static constexpr int kSupervisorWave = 9;  // first wave clock of the supervisor
  // Clocks of the tick by which something has come up.
  static constexpr int kSpeed = 17 + kWave + 1, kHeat = 19 + kWave + 1, kPolarity = 22 + kWave + 1;
  static constexpr int kDuty = 45 + kWave + 1, kSnapshot = 46 + kWave + 1;
  static constexpr int kWatchdog = 47 + kWave + 1, kNever = 1 << 30;

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

  /// What the wave brings to the supervisor in its clock t; its words come from the RAM as the bus
  /// would bring them.
  typename Supervisor<D>::In supervisor_inputs(int t) const {
    typename Supervisor<D>::In sup;
    if (t < 0 || t >= 50) return sup;
    sup.wave = std::uint64_t{1} << t;
    sup.param = registers_.parameter(t);
    sup.velocity = static_cast<std::int32_t>(out_.velocity);
    sup.current_ref = out_.current_ref;
    if (t == 9) sup.product = operand_v_;
    if (t == 11) sup.product = operand_w_;
    if (t == 17) {
      const std::int64_t estimate = supervisor_.out().current_estimate;
      sup.product = estimate * estimate;
    }
    return sup;
  }

  typename Registers<D, ReadBack>::In register_inputs(const In& in, int t, bool tick) const {
    typename Registers<D, ReadBack>::In reg;
    reg.tick = tick;
    reg.reg_addr = in.reg_addr;
    reg.reg_wdata = in.reg_wdata;
    reg.reg_write = in.reg_write;
    if (ReadBack && t >= 0 && t < 50 && ((kSnapshotSlots >> t) & 1u) != 0) {
      reg.snap_valid = true;
      reg.snap_slot = static_cast<std::uint8_t>(t);
      reg.snap_data = snapshot_word(t, decoder_.out());
    }
    return reg;
  }

  std::uint32_t snapshot_word(int t, const QuadDecoder::Out& decoded) const {
    switch (t) {
      case 0:
        return out_.tick_count;
      case 1:
        return static_cast<std::uint32_t>(out_.position);
      case 2:
        return status(decoded.error);
      case 9:
        return static_cast<std::uint32_t>(out_.velocity);
      case 11:
        return static_cast<std::uint32_t>(decoded.index_position);
      case 14:
        return static_cast<std::uint32_t>(decoded.rejected_count) << 16 | decoded.error_count;
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

  std::uint32_t status(bool encoder_error) const {
    return static_cast<std::uint32_t>(encoder_error) << 27 |
           static_cast<std::uint32_t>(mode()) << 25 | static_cast<std::uint32_t>(out_.armed) << 24 |
           static_cast<std::uint32_t>(out_.scene) << 20 |
           static_cast<std::uint32_t>(out_.limits) << 12 |
           static_cast<std::uint32_t>(out_.first_fault) << 8 | out_.faults;
  }

  QuadDecoder::In decoder_inputs(const In& in, bool zero, bool clear) const {
    const std::uint32_t control = registers_.out().control;
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

  Pwm::In pwm_inputs(bool enable, std::int16_t duty) const {
    const std::uint32_t control = registers_.out().control;
    Pwm::In p;
    p.enable = enable;
    p.mode = bit(control, D::C::control_pwm_mode);
    p.polarity = bit(control, D::C::control_motor_polarity);
    p.duty = duty;
    return p;
  }

  /// Where the supervisor's registers hold what a step of it has not yet used up.
  static constexpr bool in_supervisor_wave(int c) {
    return c > kSupervisorWave + kWave && c <= 22 + kWave;
  }
  bool can_pass(const In& in) const;
  static int next_look_at_decoder(int from);
  template <bool Read, class OnSnapshot>
  void pass_tick(const In& in, OnSnapshot&& on_snapshot);
  template <class OnSnapshot>
  int pass(const In& in, int from, int to, OnSnapshot&& on_snapshot);
  void advance_gates_by_duty(int open, std::int16_t duty_before);
  void end_of_tick(const In& in);
  int advance_decoder(const In& in, int from, int to);
  int advance_gates(int from, int to, int open, std::int16_t duty);
  void catch_up(int c);

  /// Outputs after the edge.
  void show() {
    show_state();
    out_.tick_count = sequencer_.out().tick_count;
    out_.reg_rdata = registers_.out().reg_rdata;
    out_.reg_busy = registers_.out().reg_busy;
  }
  void show_state() {
    out_.armed = supervisor_.out().armed;
    out_.gates_enable = supervisor_.out().gates_enable;
    out_.faults = supervisor_.out().faults;
    out_.first_fault = supervisor_.out().first_fault;
    out_.duty_active = gates_.duty_active();
    out_.gates = gates_.bits();
    out_.limits = wave_.limits(out_.gates_enable);
  }

  Sequencer<D::clocks_per_tick> sequencer_;
  Registers<D, ReadBack> registers_;
  QuadDecoder decoder_;
  CoreWave<D> wave_;
  Supervisor<D> supervisor_, before_wave_;
  typename Supervisor<D>::Words supervisor_words_;
  CoreGates gates_{D::pwm_period, D::dead_clocks};
  std::int64_t operand_v_ = 0, operand_w_ = 0;
  int pending_address_ = 0;
  bool zero_pending_ = false;
  std::int64_t writes_ = 0;
  int passed_to_ = -1;  ///< the clock that a pass() has reached, -1 after a clock()
  Out out_;
};

}  // namespace feltgate

#include "feltgate/core_run.hpp"  // IWYU pragma: export
