// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin from event to event: the part of FeltgateCore that stands for many calls of
// clock() while the inputs hold. Included by feltgate_core.hpp.
// Documentation: docs/blocks/feltgate_core.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "feltgate/feltgate_core.hpp"

namespace feltgate {

template <class D>
template <class OnSnapshot>
void FeltgateCore<D>::run(const In& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
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
      // Only the last snapshots of a stretch can ever be read back.
      pass<true>(in, 0, tick, clocks < 3 * tick, on_snapshot);
      clocks -= tick;
    } else {
      const int end = at_rest ? tick : tick - 1;
      int to = static_cast<int>(std::min<std::int64_t>(end, from + clocks));
      if (!settled) to = std::min(to, next_look_at_decoder(from));
      to = pass<false>(in, from, to, true, on_snapshot);
      clocks -= to - from;
    }
  }
}

/// Nothing is under way that asks for clock(): an error or a stop, or the first tick.
template <class D>
bool FeltgateCore<D>::can_pass(const In& in) const {
  return sequencer_.out().tick_count != 0 && supervisor_.steady(in.stop) &&
         !(in.stop && supervisor_.out().gates_enable) && !decoder_.out().illegal &&
         !(in_supervisor_wave(sequencer_.clock_of_tick()) &&
           passed_to_ != sequencer_.clock_of_tick());
}

/// The next clock after `from` in which the wave looks at the decoder.
template <class D>
int FeltgateCore<D>::next_look_at_decoder(int from) {
  for (const int t : {0, 2, 11, 14}) {
    if (from < t + kWave) return t + kWave;
  }
  return D::clocks_per_tick;
}

/// Clocks [from, to) of a tick, from < to. `Whole`: all of them, the decoder at rest. Returns the
/// clock that was reached: it is before `to` where an encoder error comes up.
template <class D>
template <bool Whole, class OnSnapshot>
int FeltgateCore<D>::pass(const In& in, int from, int to, bool keep_words,
                          OnSnapshot&& on_snapshot) {
  const QuadDecoder::Out decoded = decoder_.out();
  if (!Whole) to = advance_decoder(in, from, to);
  const auto has = [from, to](int t) { return Whole || (from <= t + kWave && t + kWave < to); };
  const auto keep = [&](int t) {
    if (keep_words && has(t)) registers_.write_snapshot(t, snapshot_word(t, decoded));
  };
  const auto wave = [&](int t) {
    if (has(t)) {
      wave_.clock(t, decoded.position, static_cast<std::int16_t>(decoded.travel), mode(), out_);
    }
  };
  // The gates are open before this clock.
  int open = supervisor_.out().gates_enable ? std::numeric_limits<int>::max() : 0;
  const auto watch = [&](int t, bool fell) {
    if (fell) open = t + kWave + 1;
  };

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
    if (!Whole) before_wave_ = supervisor_;
    watch(17, supervisor_.at_speed(supervisor_words_, operand_v_, operand_w_, velocity));
  }
  if (has(19)) watch(19, supervisor_.at_heat(supervisor_words_));
  if (has(22)) {
    watch(22, supervisor_.at_polarity(supervisor_words_, velocity, out_.current_ref));
  }
  wave(22);
  keep(23);
  for (const int t : {24, 25, 27}) wave(t);
  keep(28);
  wave(33);
  keep(34);
  wave(39);
  keep(40);
  int gates_at = advance_gates(from, std::min(to, 45 + kWave + 1), open);
  wave(45);
  keep(46);
  if (has(46)) {
    gates_at = advance_gates(gates_at, 46 + kWave + 1, open);
    show();
    out_.snapshot_valid = true;
    on_snapshot();
    out_.snapshot_valid = Whole ? false : to == 46 + kWave + 1;
  }
  constexpr int last = D::clocks_per_tick - 1;
  if (has(47)) watch(47, supervisor_.at_watchdog(supervisor_words_));
  if (Whole || to > last) {
    gates_at = advance_gates(gates_at, last, open);
    const bool enabled = last < open;
    const bool host = bit(registers_.out().control, D::C::control_host);
    const unsigned wanted = registers_.out().control >> D::C::control_scene & 15u;
    supervisor_.at_end(supervisor_words_,
                       host ? bit(registers_.out().control, D::C::control_arm) : in.arm);
    gates_.advance(pwm_inputs(enabled), 1, supervisor_.out().gates_enable);
    out_.scene = static_cast<std::uint8_t>(host ? wanted : in.scene);
  } else {
    advance_gates(gates_at, to, open);
  }
  if (Whole) {
    registers_.skip_tick(in.reg_addr);
    sequencer_.skip_ticks(1);
  } else {
    registers_.skip(in.reg_addr, to - from);
    if (to > last) registers_.skip_end_of_tick();
    sequencer_.skip(to - from);
    passed_to_ = sequencer_.clock_of_tick();
  }
  show();
  return to;
}

/// Clocks [from, to) of the decoder, or fewer: to the clock that sees an encoder error.
template <class D>
int FeltgateCore<D>::advance_decoder(const In& in, int from, int to) {
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
template <class D>
int FeltgateCore<D>::advance_gates(int from, int to, int open) {
  const int end = std::min(to, open);
  if (from < end) gates_.advance(pwm_inputs(true), end - from, end < open);
  from = std::max(from, end);
  if (from < to) gates_.advance(pwm_inputs(false), to - from, false);
  return std::max(from, to);
}

/// Before a clock() that follows a pass(): the supervisor's registers between its steps, by its own
/// clocks, whose inputs have not changed since.
template <class D>
void FeltgateCore<D>::catch_up(int c) {
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
