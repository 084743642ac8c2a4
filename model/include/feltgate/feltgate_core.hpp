// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/feltgate_core.sv: the whole core, every output pin and register in every clock.
// The wave is computed in a few steps; each result appears in the clock in which the RTL shows it.
// clock() advances one clock, run() a stretch without input changes, with identical results.
// Documentation: docs/architecture.md
#pragma once

#include <cstddef>
#include <cstdint>

#include "feltgate/core_ports.hpp"
#include "feltgate/core_steps.hpp"
#include "feltgate/core_wave.hpp"
#include "feltgate/current_loop.hpp"
#include "feltgate/hall_sensor.hpp"
#include "feltgate/hold_timer.hpp"
#include "feltgate/registers.hpp"
#include "feltgate/self_test.hpp"
#include "feltgate/supervisor.hpp"
#include "feltgate/three_phase_bridge.hpp"

namespace feltgate {

/// ReadBack = false: no snapshot in the registers, every read gives 0 (a parameter of the RTL).
template <class D, bool ReadBack = true>
class FeltgateCore {
 public:
  using In = CoreIn;
  using Out = CoreOut;

  FeltgateCore() {
    reset();
    note_supervisor_words();
  }

  /// The parameter RAM keeps its words, as in the RTL.
  void reset() {
    registers_.lose_snapshot(clock_ - 1 - Map::first_wave_clock);
    clock_ = 0;
    registers_.reset();
    decoder_.reset();
    wave_.reset();
    loop_.reset();
    monitor_ = made_monitor();
    hold_ = {};
    supervisor_.reset();
    gates_.reset();
    self_test_ = {};
    operand_v_ = operand_w_ = 0;
    passed_to_ = -1;
    writes_ = 0;
    out_ = Out{};
    show();
  }

  /// Advances one clock with these inputs.
  void clock(const In& in) {
    catch_up();
    wave_.watch(clock_, clock_ + 1, decoder_.out().travel);
    const bool tick = clock_ == D::clocks_per_tick - 1;
    const std::uint8_t scene = wanted_scene(in);
    const bool zero = tick && registers_.sets_zero();
    const bool clear = tick && registers_.commands(D::C::command_clear_faults);

    // Each block sees the other blocks' registers before the clock edge.
    typename Supervisor<D>::In sup = supervisor_inputs(clock_);
    sup.tick = tick;
    ask(in, &sup);
    const bool open = supervisor_.out().gates_enable;
    if (renders_law() && in.law_late && open) sup.trips |= fault_bit(Fault::engine);
    if (in.axis_fault && open) sup.trips |= fault_bit(Fault::axis);
    if (registers_.out().stop) sup.trips |= fault_bit(Fault::stop);
    sup.stop = in.stop;
    sup.clear_faults = clear;
    sup.kick = tick && registers_.commands(D::C::command_kick);
    sup.encoder_error = decoder_.out().illegal;
    if (registers_.out().word_error) sup.trips |= fault_bit(Fault::word);
    if (clock_ == core_steps::clock_of(T::channel)) {
      if (monitor_.trips()) sup.trips |= fault_bit(Fault::channel);
      if (monitor_.index_trips()) sup.trips |= fault_bit(Fault::index);
    }
    if (loop_.trips(open)) sup.trips |= fault_bit(Fault::current);
    if (absolute_state(decoder_) != 0 && open) sup.trips |= fault_bit(Fault::encoder);
    auto pwm = bridge_inputs(open, bridge_duty());
    pwm.clear = supervisor_.stopped(in.stop);
    out_.snapshot_valid = false;
    out_.word_valid = ReadBack && core_steps::stores_word(clock_);
    core_steps::for_each_step_of(clock_, [&](Step step) { take<true>(step, in, decoder_.out()); });
    if (self_test_.failed()) sup.trips |= fault_bit(Fault::self_test);
    if constexpr (kLoop) loop_.clock(loop_inputs(in, clear && !sup.arm_request()));
    supervisor_.clock(sup);
    const bool held = out_.armed || supervisor_.out().armed;
    const auto d = decoder_inputs(in, zero, clear && !sup.arm_request(), open);
    if (!decoder_.settled(d)) decoder_.clock(d);

    const bool committed = tick && registers_.out().reg_busy;
    const int written = registers_.parameter_waiting(held);
    if (tick && (registers_.restarts(out_.scene) || (renders_law() && in.law_restart))) {
      wave_.restart();
    }
    registers_.clock(register_inputs(in, tick, held));
    if (tick) {
      out_.scene = scene;
      if (committed) {
        ++writes_;
        if (written >= 0) take_word(written);
      }
    }
    gates_.advance(pwm, 1);
    advance_clock(1);
    show();
  }

  /// Advances `clocks` clocks with the inputs held; reg_write and set_zero must be low. Equals so
  /// many calls of clock(), but goes from event to event where only the wave acts. `on_snapshot()`
  /// is called whenever out() holds a valid snapshot.
  template <class OnSnapshot>
  void run(const In& in, std::int64_t clocks, OnSnapshot&& on_snapshot);

  bool calm(const In& in, std::int64_t clocks) const;
  /// Whether something could close the gates before the tick ends, with the inputs held. May return
  /// true when false would hold.
  bool may_trip(const In& in) const;

  /// Fault injection: inverts a bit of the parameter RAM, see Registers::flip(); between two ticks.
  void flip(int address, int bit) {
    registers_.flip(address, bit);
    take_word(address);
  }

  /// Fault injection: inverts a held control bit, see Registers::flip_control().
  void flip_control(int bit) { registers_.flip_control(bit); }

  const Out& out() const { return out_; }
  /// Whether run() stores the words of every tick, or only of those that a host can read back.
  void keep_words(bool keep) { keep_words_ = keep; }
  /// A word of the running tick's snapshot by its slot; all are valid when on_snapshot() is called.
  std::uint32_t word(int slot) const { return registers_.running_word(slot); }
  /// Clocks since reset for which each gate was on: a_hi, a_lo, b_hi, b_lo, c_hi, c_lo.
  GateCounts gate_clocks() const { return gates_.on_clocks(); }
  /// Of three phases: clocks of this PWM period in which leg 0, 1 or 2 is to be high; else 0.
  int on_time(std::size_t leg) const { return gates_.on_time(leg); }
  /// Free-running count at the start of the running wave.
  std::int16_t sampled_travel() const { return wave_.sampled_travel(); }
  /// Result of the self-test, as in the status word.
  SelfTestResult self_test_result() const { return self_test_.result(); }
  bool testing() const { return self_test_.busy(out_.armed); }
  /// For the other axes: whether this axis asks to be armed in the next clock (arm_request), and
  /// whether nothing refuses its request (ready).
  bool arm_request(const In& in) const;
  /// Whether in the next clock position, velocity and tau_hat are those of this tick.
  bool measured() const { return clock_ == after(T::tau_hat); }
  /// Whether the position becomes 0 in the next clock.
  bool zeroed() const { return clock_ == D::clocks_per_tick - 1 && registers_.sets_zero(); }
  bool ready() const;
  /// Whether no write or command waits for the end of the tick.
  bool at_rest() const { return registers_.at_rest(); }
  /// Register writes carried out so far.
  std::int64_t writes() const { return writes_; }
  /// The next clock's number in its tick, 0 .. clocks_per_tick - 1.
  int clock_of_tick() const { return clock_; }

 private:
  using Step = Map::Step;
  using T = Map::T;
  static constexpr bool kAbsolute = D::absolute_encoder != 0;
  using Decoder = DecoderOf<D>;
  using Bridge = BridgeOf<D>;
  /// The clock of the tick after the one of wave clock t.
  static constexpr int after(int t) { return core_steps::clock_of(t) + 1; }
  static constexpr int kSnapshot = core_steps::clock_of(T::snapshot);
  static_assert(kSnapshot < D::clocks_per_tick, "a tick's snapshot lies in it");
  static constexpr int kNever = 1 << 30;
  /// First clock of the tick in which the supervisor looks at its watchdog.
  static constexpr int kWatchdogOperand = core_steps::clock_of(Map::W::watchdog_ticks) - 1;

  template <int Bit, int Width>
  static unsigned field(std::uint32_t word) {
    return (word >> Bit) & ((1u << Width) - 1);
  }
  static bool bit(std::uint32_t word, int n) { return ((word >> n) & 1u) != 0; }
  static std::int64_t factor(std::uint32_t param) {
    return param & ((1u << D::coefficient_bits) - 1);
  }

  void take_word(int address) {
    wave_.set_word(address, registers_.parameter(address));
    note_supervisor_words();
  }
  void note_supervisor_words() {
    using A = typename D::A;
    const auto word = [this](int address) { return registers_.parameter(address); };
    supervisor_words_ = {
        word(A::inverse_resistance), word(A::emf_over_resistance), word(A::nominal_current_squared),
        word(A::overspeed),          word(A::i2t_budget),          word(A::polarity_speed),
        word(A::polarity_current),   word(A::polarity_ticks),      word(A::watchdog_ticks)};
    self_test_words_ = {word(A::self_test_quiet), word(A::self_test_pulse),
                        word(A::self_test_arms)};
  }

  Mode mode() const {
    return static_cast<Mode>(
        field<D::C::control_mode, D::C::control_mode_width>(registers_.out().control));
  }

  bool host() const { return bit(registers_.out().control, D::C::control_host); }
  /// The requests to the supervisor: who has control, and what is requested.
  void ask(const In& in, typename Supervisor<D>::In* sup) const;
  /// The supervisor's wave inputs in clock c of the tick; its parameter words come from the RAM in
  /// the order of the bus.
  typename Supervisor<D>::In supervisor_inputs(int c) const {
    using M = Map::M;
    typename Supervisor<D>::In sup;
    const int t = c - Map::first_wave_clock;
    if (t < 0 || t >= Map::wave_length) return sup;
    sup.wave = std::uint64_t{1} << t;
    sup.param = registers_.parameter(t);
    sup.velocity = static_cast<std::int32_t>(out_.velocity);
    sup.current_ref = out_.current_ref;
    if (t == M::inverse_resistance) sup.product = operand_v_;
    if (t == M::emf_over_resistance) sup.product = operand_w_;
    if (t == M::current_square) {
      std::int64_t estimate = supervisor_.out().current_estimate;
      if constexpr (kLoop) estimate = loop_.heat_current();
      sup.product = estimate * estimate;
    }
    return sup;
  }

  static constexpr bool kLoop = D::current_loop != 0;
  std::int16_t bridge_duty() const;
  auto loop_inputs(const In& in, bool clear) const;

  static constexpr bool kLaw = scene_built<D>(Map::S::law);
  bool renders_law() const { return kLaw && out_.scene == Map::S::law; }

  /// One step, except the supervisor's. Read: the host may read the snapshot's words.
  template <bool Read>
  [[gnu::always_inline]] void take(Step step, const In& in, const QuadDecoder::Out& decoded) {
    using R = Map::R;
    const auto keep = [this](int slot, auto word) {
      if (!Read || !ReadBack) return;
      out_.word_slot = static_cast<std::uint8_t>(slot);
      out_.word_data = static_cast<std::uint32_t>(word);
      registers_.write_snapshot(slot, out_.word_data);
    };
    switch (step) {
      case Step::read_tick:
        return keep(R::tick, out_.tick_count);
      case Step::read_position:
        return keep(R::position, out_.position);
      case Step::read_status:
        return keep(R::status, status(in, decoded.error));
      case Step::read_faults:
        return keep(R::faults, faults());
      case Step::read_velocity:
        return keep(R::velocity, out_.velocity);
      case Step::read_index:
        return keep(R::index, decoded.index_position);
      case Step::read_encoder:
        return keep(R::encoder, std::uint32_t{decoded.rejected_count} << 16 | decoded.error_count);
      case Step::read_tau_hat:
        return keep(R::tau_hat, out_.tau_hat);
      case Step::read_tau_ref:
        return keep(R::tau_ref, out_.tau_ref);
      case Step::read_current_ref:
        return keep(R::current_ref, wave_.current());
      case Step::read_voltage:
        return keep(R::voltage, wave_.applied());
      case Step::read_duty:
        return keep(R::duty, wave_.duty());
      case Step::operand_inverse_resistance:
        operand_v_ = out_.voltage * factor(supervisor_words_.inverse_resistance);
        return;
      case Step::operand_emf_over_resistance:
        operand_w_ = out_.velocity * factor(supervisor_words_.emf_over_resistance);
        return;
      case Step::snapshot:
        out_.snapshot_valid = true;
        return;
      case Step::levels:
        monitor_.tick(decoded.levels, out_.tick_count, decoded.index_wrong, decoded.count);
        wave_.set_frozen(monitor_.chatters());
        return;
      case Step::hold:
        hold_.tick(out_.armed, moved(decoder_, monitor_), wave_.beyond(D::A::hold_torque),
                   out_.tick_count, registers_.parameter(D::A::hold_time));
        wave_.set_derated(hold_.derated());
        return;
      case Step::self_test:
        self_test_.turn(out_.armed, mode() == Mode::voltage, out_.tick_count, self_test_words_,
                        in.axis_waits);
        return;
      case Step::law_torque:
        if (kLaw) wave_.program(in.law_late ? 0 : in.law_torque);
        return;
      case Step::sample:
        self_test_.sample(static_cast<std::uint16_t>(decoded.travel >> D::self_test_drop));
        [[fallthrough]];
      default:
        wave_.take(step, decoded.position, decoded.travel, mode(), pulse(in), out_);
    }
  }

  typename Registers<D, ReadBack>::In register_inputs(const In& in, bool tick, bool held) const;
  typename Decoder::In decoder_inputs(const In& in, bool zero, bool clear, bool open = false) const;
  auto bridge_inputs(bool enable, std::int16_t duty) const;
  std::uint8_t wanted_scene(const In& in) const;
  TestPulse pulse(const In& in) const;
  std::uint32_t status(const In& in, bool encoder_error) const;
  std::uint32_t faults() const;

  /// Clocks of a tick that are computed at once.
  struct Stretch {
    int from, to;
    int gates_at;  ///< the clock that the gates have reached
    int open;      ///< the gates are enabled before this clock
    bool quiet;    ///< only a fault changes the gates: they are advanced at the end
    void close(int clock) {
      open = clock;
      quiet = false;
    }
  };
  Stretch stretch(int from, int to) const {
    const bool enabled = supervisor_.out().gates_enable;
    return {from, to, from, enabled ? kNever : 0, gates_.quiet_for(to - from, enabled)};
  }

  /// Whether the supervisor is between its steps; its registers then hold values that only clock()
  /// continues from.
  bool amid_supervisor() const {
    return clock_ > core_steps::clock_of(T::estimate_part) && clock_ < after(T::polarity);
  }
  bool can_pass(const In& in) const;
  bool outside_trips(const In& in) const;
  static int next_look_at_decoder(int from);
  template <bool Read, class OnSnapshot>
  void pass_tick(const In& in, OnSnapshot&& on_snapshot);
  template <class OnSnapshot>
  int pass(const In& in, int from, int to, OnSnapshot&& on_snapshot);
  template <bool Read, class OnSnapshot>
  void take_in(Stretch& s, Step step, const In& in, const QuadDecoder::Out& decoded,
               OnSnapshot&& on_snapshot);
  void end_of_tick(const In& in);
  int advance_decoder(const In& in, int from, int to);
  void gates_to(Stretch& s, int to);
  void finish(const In& in, Stretch& s);
  void catch_up();

  void advance_clock(int clocks) {
    clock_ += clocks;
    if (clock_ < D::clocks_per_tick) return;
    clock_ = 0;
    ++out_.tick_count;
  }

  /// Sets the outputs after the clock edge.
  void show() {
    show_state();
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
    if constexpr (kLoop) loop_.show(&out_);
    if constexpr (kAbsolute) out_.serial = decoder_.serial();
    out_.limits = wave_.limits(out_.gates_enable);
  }

  Registers<D, ReadBack> registers_;
  Decoder decoder_{0, static_cast<std::uint32_t>(D::index_counts)};
  CoreWave<D> wave_;
  CurrentLoop<D> loop_;
  static EncoderMonitorLaw made_monitor() {
    return EncoderMonitorLaw(D::edge_unit_bits, D::fast_edges != 0);
  }
  EncoderMonitorLaw monitor_ = made_monitor();
  HoldTimerLaw hold_;
  Supervisor<D> supervisor_, before_wave_;
  typename Supervisor<D>::Words supervisor_words_;
  SelfTestLaw self_test_;
  SelfTestLaw::Words self_test_words_;
  Bridge gates_{D::pwm_period, D::dead_clocks, D::shortest_clocks, D::modulation};
  std::int64_t operand_v_ = 0, operand_w_ = 0;
  std::int64_t writes_ = 0;
  int clock_ = 0;       ///< clock of the tick
  int passed_to_ = -1;  ///< the clock that a pass() has reached; -1 after a clock()
  bool keep_words_ = false;
  Out out_;
};

}  // namespace feltgate

#include "feltgate/core_inputs.hpp"  // IWYU pragma: export
#include "feltgate/core_run.hpp"     // IWYU pragma: export
#include "feltgate/core_words.hpp"   // IWYU pragma: export
