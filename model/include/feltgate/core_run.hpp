// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin from event to event: the part of FeltgateCore that stands for many calls of
// clock() while the inputs hold. Included by feltgate_core.hpp.
// Documentation: docs/blocks/feltgate_core.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>

#include "feltgate/feltgate_core.hpp"

namespace feltgate {

template <class D, bool ReadBack>
template <class OnSnapshot>
void FeltgateCore<D, ReadBack>::run(const In& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
  constexpr int tick = D::clocks_per_tick;
  bool settled = false;  // as far as known; holds until a clock() changes the decoder's inputs
  while (clocks > 0) {
    const int from = sequencer_.clock_of_tick();
    const bool at_rest = !registers_.out().reg_busy && !zero_pending_;
    if (!can_pass(in) || (from == tick - 1 && !at_rest)) {
      clock(in);
      if (out_.snapshot_valid) on_snapshot();
      --clocks;
      settled = false;
      continue;
    }
    if (!settled) settled = decoder_.settled(decoder_inputs(in, false, false));
    if (settled && from == 0 && clocks >= tick && at_rest) {
      // Only the last two snapshots of a stretch can ever be read back.
      const auto ticks = static_cast<std::uint32_t>(clocks / tick);
      const std::uint32_t unread = !ReadBack ? ticks : ticks > 2 ? ticks - 2 : 0;
      for (std::uint32_t k = 0; k < unread; ++k) pass_tick<false>(in, on_snapshot);
      registers_.skip_unread_ticks(unread);
      for (std::uint32_t k = unread; k < ticks; ++k) {
        pass_tick<true>(in, on_snapshot);
        registers_.skip_tick(in.reg_addr);
      }
      sequencer_.skip_ticks(ticks);
      show();
      clocks -= std::int64_t{ticks} * tick;
    } else {
      const int end = at_rest ? tick : tick - 1;
      int to = static_cast<int>(std::min<std::int64_t>(end, from + clocks));
      if (!settled) to = std::min(to, next_look_at_decoder(from));
      to = pass(in, from, to, on_snapshot);
      clocks -= to - from;
    }
  }
}

/// Nothing is under way that asks for clock(): an error or a stop, or the first tick.
template <class D, bool ReadBack>
bool FeltgateCore<D, ReadBack>::can_pass(const In& in) const {
  return sequencer_.out().tick_count != 0 && supervisor_.steady(in.stop) &&
         !(in.stop && supervisor_.out().gates_enable) && !decoder_.out().illegal &&
         !(in_supervisor_wave(sequencer_.clock_of_tick()) &&
           passed_to_ != sequencer_.clock_of_tick());
}

/// As long as the inputs hold, `clocks` clocks from now change neither the duty in force nor the
/// enable of the gates, and bring no snapshot: whoever wants no more may ask for them later. False
/// is always right.
template <class D, bool ReadBack>
bool FeltgateCore<D, ReadBack>::calm(const In& in, std::int64_t clocks) const {
  if (sequencer_.clock_of_tick() != 0 || clocks >= kSnapshot || gates_.clocks_to_duty() < clocks ||
      registers_.out().reg_busy || zero_pending_ || !can_pass(in) ||
      !decoder_.settled(decoder_inputs(in, false, false))) {
    return false;
  }
  // What can close the gates is over-speed, over-current and a wrong polarity.
  const auto limit = static_cast<std::int32_t>(supervisor_words_.overspeed);
  const auto slow = [limit](std::int64_t w) { return w <= limit && -w <= limit; };
  return !out_.gates_enable ||
         (!supervisor_.near_trip(supervisor_words_) && slow(out_.velocity) &&
          slow(wave_.velocity_input(static_cast<std::int16_t>(decoder_.out().travel))));
}

/// The next clock after `from` in which the wave looks at the decoder.
template <class D, bool ReadBack>
int FeltgateCore<D, ReadBack>::next_look_at_decoder(int from) {
  for (const int t : {0, 2, 11, 14}) {
    if (from < t + kWave) return t + kWave;
  }
  return D::clocks_per_tick;
}

/// A whole tick but for registers and sequencer, the decoder at rest. `Read`: the host may see its
/// words.
template <class D, bool ReadBack>
template <bool Read, class OnSnapshot>
void FeltgateCore<D, ReadBack>::pass_tick(const In& in, OnSnapshot&& on_snapshot) {
  constexpr int tick = D::clocks_per_tick;
  const QuadDecoder::Out& decoded = decoder_.out();
  const auto keep = [&](std::initializer_list<int> clocks) {
    if (!Read) return;
    for (const int t : clocks) registers_.write_snapshot(t, snapshot_word(t, decoded));
  };
  keep({0, 2});  // the status before this tick's limits
  operand_v_ = out_.voltage * factor(supervisor_words_.inverse_resistance);
  operand_w_ = out_.velocity * factor(supervisor_words_.emf_over_resistance);
  const std::int32_t current_before = out_.current_ref;
  const std::int16_t duty_before = out_.duty;
  wave_.tick(decoded.position, static_cast<std::int16_t>(decoded.travel), mode(), out_);
  keep({1, 9, 11, 14, 23, 28, 34, 40, 46});

  const auto velocity = static_cast<std::int32_t>(out_.velocity);
  const bool enabled = out_.gates_enable;
  int open = enabled ? kNever : 0;  // the gates are open before this clock
  if (supervisor_.at_speed(supervisor_words_, operand_v_, operand_w_, velocity)) open = kSpeed;
  if (supervisor_.at_heat(supervisor_words_)) open = kHeat;
  if (supervisor_.at_polarity(supervisor_words_, velocity, current_before)) open = kPolarity;
  const bool quiet = (open == kNever || !enabled) && gates_.quiet_for(tick, enabled);
  if (!quiet) advance_gates_by_duty(open, duty_before);
  show_state();
  out_.snapshot_valid = true;
  on_snapshot();
  out_.snapshot_valid = false;
  if (supervisor_.at_watchdog(supervisor_words_)) open = kWatchdog;
  end_of_tick(in);
  const bool live = supervisor_.out().gates_enable;
  if (quiet && live == enabled) {
    gates_.pass(tick);
  } else {
    advance_gates(quiet ? 0 : kSnapshot, tick - 1, open, out_.duty);
    gates_.advance(pwm_inputs(tick - 1 < open, out_.duty), 1, live);
  }
  out_.armed = supervisor_.out().armed;
  out_.gates_enable = live;
  ++out_.tick_count;
}

/// Gates of a tick up to the snapshot.
template <class D, bool ReadBack>
void FeltgateCore<D, ReadBack>::advance_gates_by_duty(int open, std::int16_t duty_before) {
  // In most ticks no duty is taken after the new one has come.
  const int taken = gates_.clocks_to_duty();
  if (D::pwm_period >= kSnapshot && (taken < kDuty || taken >= kSnapshot)) {
    advance_gates(0, kSnapshot, open, duty_before);
  } else {
    advance_gates(0, kDuty, open, duty_before);
    advance_gates(kDuty, kSnapshot, open, out_.duty);
  }
}

/// Arming and scene in the last clock of a tick.
template <class D, bool ReadBack>
void FeltgateCore<D, ReadBack>::end_of_tick(const In& in) {
  const std::uint32_t control = registers_.out().control;
  const bool host = bit(control, D::C::control_host);
  supervisor_.at_end(supervisor_words_, host ? bit(control, D::C::control_arm) : in.arm);
  out_.scene = static_cast<std::uint8_t>(host ? (control >> D::C::control_scene) & 15u : in.scene);
}

/// Clocks [from, to) of a tick, from < to. Returns the clock that was reached: it is before `to`
/// where an encoder error comes up.
template <class D, bool ReadBack>
template <class OnSnapshot>
int FeltgateCore<D, ReadBack>::pass(const In& in, int from, int to, OnSnapshot&& on_snapshot) {
  const QuadDecoder::Out decoded = decoder_.out();
  to = advance_decoder(in, from, to);
  const auto has = [from, to](int t) { return from <= t + kWave && t + kWave < to; };
  const auto keep = [&](int t) {
    if (ReadBack && has(t)) registers_.write_snapshot(t, snapshot_word(t, decoded));
  };
  const auto wave = [&](int t) {
    if (has(t)) {
      wave_.clock(t, decoded.position, static_cast<std::int16_t>(decoded.travel), mode(), out_);
    }
  };
  int open = supervisor_.out().gates_enable ? kNever : 0;  // the gates are open before this clock
  out_.snapshot_valid = false;
  keep(0);
  wave(0);
  keep(1);
  keep(2);
  wave(2);
  if (has(5)) operand_v_ = out_.voltage * factor(supervisor_words_.inverse_resistance);
  if (has(7)) operand_w_ = out_.velocity * factor(supervisor_words_.emf_over_resistance);
  wave(8);
  for (const int t : {9, 11, 14}) keep(t);
  const auto velocity = static_cast<std::int32_t>(out_.velocity);
  if (has(17)) {
    before_wave_ = supervisor_;
    if (supervisor_.at_speed(supervisor_words_, operand_v_, operand_w_, velocity)) open = kSpeed;
  }
  if (has(19) && supervisor_.at_heat(supervisor_words_)) open = kHeat;
  if (has(22) && supervisor_.at_polarity(supervisor_words_, velocity, out_.current_ref)) {
    open = kPolarity;
  }
  wave(22);
  keep(23);
  for (const int t : {24, 25, 27}) wave(t);
  keep(28);
  wave(33);
  keep(34);
  wave(39);
  keep(40);
  const std::int16_t duty_before = out_.duty;
  wave(45);
  keep(46);
  int gates_at = advance_gates(from, std::min(to, kDuty), open, duty_before);
  if (has(46)) {
    gates_at = advance_gates(gates_at, kSnapshot, open, out_.duty);
    show_state();
    out_.snapshot_valid = true;
    on_snapshot();
    out_.snapshot_valid = to == kSnapshot;
  }
  if (has(47) && supervisor_.at_watchdog(supervisor_words_)) open = kWatchdog;
  registers_.skip(in.reg_addr, to - from);
  if (to == D::clocks_per_tick) {
    advance_gates(gates_at, to - 1, open, out_.duty);
    end_of_tick(in);
    gates_.advance(pwm_inputs(to - 1 < open, out_.duty), 1, supervisor_.out().gates_enable);
    registers_.skip_end_of_tick();
  } else {
    advance_gates(gates_at, to, open, out_.duty);
  }
  sequencer_.skip(to - from);
  passed_to_ = sequencer_.clock_of_tick();
  show();
  return to;
}

/// Clocks [from, to) of the decoder, or fewer: to the clock that sees an encoder error.
template <class D, bool ReadBack>
int FeltgateCore<D, ReadBack>::advance_decoder(const In& in, int from, int to) {
  const QuadDecoder::In d = decoder_inputs(in, false, false);
  for (int c = from; c < to; ++c) {
    if (decoder_.settled(d)) return to;
    if (c > from && decoder_.out().illegal) return c;
    decoder_.clock(d);
  }
  return to;
}

/// Gates of the clocks [from, to), open before the clock `open`; returns the clock reached. A fall
/// shows in the outputs with the clock that makes it.
template <class D, bool ReadBack>
int FeltgateCore<D, ReadBack>::advance_gates(int from, int to, int open, std::int16_t duty) {
  const int end = std::min(to, open);
  if (from < end) gates_.advance(pwm_inputs(true, duty), end - from, end < open);
  from = std::max(from, end);
  if (from < to) gates_.advance(pwm_inputs(false, duty), to - from, false);
  return std::max(from, to);
}

/// Before a clock() that follows a pass(): the supervisor's registers between its steps, by its own
/// clocks, whose inputs have not changed since.
template <class D, bool ReadBack>
void FeltgateCore<D, ReadBack>::catch_up(int c) {
  if (passed_to_ != c) return;
  passed_to_ = -1;
  const bool watchdog = c > 45 + kWave;
  if (!in_supervisor_wave(c) && !watchdog) return;
  if (!watchdog && c > 17 + kWave) supervisor_ = before_wave_;
  const bool stop = supervisor_.steady(true);
  for (int t = watchdog ? 45 : kSupervisorWave; t < c - kWave; ++t) {
    typename Supervisor<D>::In sup = supervisor_inputs(t);
    sup.stop = stop;
    supervisor_.clock(sup);
  }
}

}  // namespace feltgate
