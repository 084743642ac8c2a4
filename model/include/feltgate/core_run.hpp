// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin from event to event: the functions of FeltgateCore that replace many calls of
// clock() while the inputs hold. Included by feltgate_core.hpp.
// Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>

#include "feltgate/feltgate_core.hpp"

/// For the body of an unrolled loop over the steps: as a call, it would look for its step each
/// time.
#ifdef __OPTIMIZE__
#define FELTGATE_INLINED __attribute__((always_inline))
#else
#define FELTGATE_INLINED
#endif

namespace feltgate {

template <class D, bool ReadBack>
template <class OnSnapshot>
void FeltgateCore<D, ReadBack>::run(const In& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
  constexpr int tick = D::clocks_per_tick;
  bool settled = false;  // true only if known; holds until clock() changes the decoder's inputs
  while (clocks > 0) {
    const int from = clock_;
    const bool at_rest = registers_.at_rest();
    if (!can_pass(in) || (from == tick - 1 && !at_rest)) {
      clock(in);
      if (out_.snapshot_valid) on_snapshot();
      --clocks;
      settled = false;
      continue;
    }
    if (!settled) settled = decoder_.settled(decoder_inputs(in, false, false));
    if (settled && from == 0 && clocks >= tick && at_rest) {
      // A host can read back only the last two snapshots of a stretch.
      const auto ticks = static_cast<std::uint32_t>(clocks / tick);
      std::uint32_t unread = ticks;
      if (ReadBack) unread = !keep_words_ && ticks > 2 ? ticks - 2 : 0;
      for (std::uint32_t k = 0; k < unread; ++k) pass_tick<false>(in, on_snapshot);
      registers_.skip_unread_ticks(unread);
      for (std::uint32_t k = unread; k < ticks; ++k) {
        pass_tick<true>(in, on_snapshot);
        registers_.skip_tick(in.reg_addr);
      }
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

/// Whether nothing is under way that needs clock(), such as an error, a stop or the first tick.
template <class D, bool ReadBack>
bool FeltgateCore<D, ReadBack>::can_pass(const In& in) const {
  return !kLoop && !kAbsolute && D::phases == 2 && out_.tick_count != 0 && !registers_.flipped() &&
         !registers_.out().stop && supervisor_.steady(in.stop) &&
         !(supervisor_.stopped(in.stop) && supervisor_.out().gates_enable) &&
         !decoder_.out().illegal && !outside_trips(in) &&
         !(amid_supervisor() && passed_to_ != clock_);
}

/// Whether a late engine or another axis closes the gates, now or as soon as they are enabled.
template <class D, bool ReadBack>
bool FeltgateCore<D, ReadBack>::outside_trips(const In& in) const {
  const bool late = kLaw && in.law_late && (renders_law() || wanted_scene(in) == Map::S::law);
  if (!in.axis_fault && !late) return false;
  return supervisor_.out().gates_enable || (arm_request(in) && ready());
}

/// Whether, with the inputs held, the next `clocks` clocks change neither the duty in force nor the
/// gate enable, and give no snapshot; a caller that needs nothing else may then compute them later.
/// May return false when true would hold.
template <class D, bool ReadBack>
bool FeltgateCore<D, ReadBack>::calm(const In& in, std::int64_t clocks) const {
  if (clock_ != 0 || clocks >= kSnapshot || gates_.clocks_to_duty() < clocks ||
      !registers_.at_rest() || !can_pass(in) ||
      !decoder_.settled(decoder_inputs(in, false, false))) {
    return false;
  }
  if (!out_.gates_enable) return out_.duty_active == 0;
  if (self_test_.busy(out_.armed)) return false;
  // Causes that can close the gates: over-speed, over-current, a wrong polarity, and the findings
  // of the encoder monitor.
  const auto limit = static_cast<std::int32_t>(supervisor_words_.overspeed);
  const auto slow = [limit](std::int64_t w) { return w <= limit && -w <= limit; };
  return !monitor_.chatters() && decoder_.out().index_wrong == monitor_.index_wrong() &&
         !supervisor_.near_trip(supervisor_words_) && slow(out_.velocity) &&
         slow(wave_.velocity_input(static_cast<std::int16_t>(decoder_.out().travel)));
}

template <class D, bool ReadBack>
bool FeltgateCore<D, ReadBack>::may_trip(const In& in) const {
  if (!can_pass(in) || self_test_.busy(out_.armed) || monitor_.chatters() || monitor_.trips() ||
      monitor_.index_trips() || decoder_.out().index_wrong != monitor_.index_wrong() ||
      supervisor_.near_trip(supervisor_words_) || supervisor_.watchdog_due(supervisor_words_)) {
    return true;
  }
  // The decoder's pipeline holds at most so many counts or errors.
  constexpr int under_way = 4;
  const auto d = decoder_inputs(in, false, false);
  const bool moves = !decoder_.settled(d);
  if (moves && (supervisor_.errors_left() < under_way || !decoder_.index_rests(d))) return true;
  if (clock_ > core_steps::clock_of(T::speed)) return false;
  const auto limit = static_cast<std::int32_t>(supervisor_words_.overspeed);
  const auto fast = [limit](std::int64_t w) { return w > limit || -w > limit; };
  if (fast(out_.velocity)) return true;
  const auto next = [this](int counts) {
    return wave_.velocity_input(static_cast<std::int16_t>(decoder_.out().travel + counts));
  };
  return moves ? fast(next(under_way)) || fast(next(-under_way)) : fast(next(0));
}

/// The next clock after `from` in which the wave samples the decoder.
template <class D, bool ReadBack>
int FeltgateCore<D, ReadBack>::next_look_at_decoder(int from) {
  using R = Map::R;
  int next = D::clocks_per_tick;
  for (const int t : {T::sample, T::levels, R::status, R::index, R::encoder}) {
    const int look = core_steps::clock_of(t);
    if (from < look) next = std::min(next, look);
  }
  return next;
}

/// One step in a stretch; a supervisor step also stands for all supervisor clocks before it.
template <class D, bool ReadBack>
template <bool Read, class OnSnapshot>
[[gnu::always_inline]] inline void FeltgateCore<D, ReadBack>::take_in(
    Stretch& s, Step step, const In& in, const QuadDecoder::Out& decoded,
    OnSnapshot&& on_snapshot) {
  const auto& words = supervisor_words_;
  const auto velocity = static_cast<std::int32_t>(out_.velocity);
  switch (step) {
    case Step::channel:
      if (monitor_.trips() && supervisor_.trip(Fault::channel)) s.close(after(T::channel));
      if (monitor_.index_trips() && supervisor_.trip(Fault::index)) s.close(after(T::channel));
      return;
    case Step::speed:
      if (s.to < after(T::polarity)) before_wave_ = supervisor_;
      if (supervisor_.at_speed(words, operand_v_, operand_w_, velocity)) s.close(after(T::speed));
      return;
    case Step::heat:
      if (supervisor_.at_heat(words)) s.close(after(T::heat));
      return;
    case Step::polarity:
      if (supervisor_.at_polarity(words, velocity, out_.current_ref)) s.close(after(T::polarity));
      return;
    case Step::self_test:
      take<Read>(step, in, decoded);
      if (self_test_.failed() && supervisor_.trip(Fault::self_test)) {
        s.close(after(T::self_test));
      }
      return;
    case Step::watchdog:
      if (supervisor_.at_watchdog(words)) s.close(after(T::watchdog));
      return;
    case Step::duty:  // the PWM samples it only in one clock of a period
      gates_to(s, after(T::duty));
      break;
    case Step::snapshot:
      gates_to(s, kSnapshot);
      show_state();
      out_.snapshot_valid = true;
      on_snapshot();
      out_.snapshot_valid = false;
      return;
    default:
      break;
  }
  take<Read>(step, in, decoded);
}

/// A whole tick except the registers, with the decoder at rest. `Read`: the host may read its
/// words.
template <class D, bool ReadBack>
template <bool Read, class OnSnapshot>
void FeltgateCore<D, ReadBack>::pass_tick(const In& in, OnSnapshot&& on_snapshot) {
  Stretch s = stretch(0, D::clocks_per_tick);
  wave_.watch(0, D::clocks_per_tick, decoder_.out().travel);
  core_steps::for_each_step(0, D::clocks_per_tick, [&](Step step) FELTGATE_INLINED {
    take_in<Read>(s, step, in, decoder_.out(), on_snapshot);
  });
  finish(in, s);
  out_.armed = supervisor_.out().armed;
  ++out_.tick_count;
}

/// Arming and scene, which change in the last clock of a tick.
template <class D, bool ReadBack>
void FeltgateCore<D, ReadBack>::end_of_tick(const In& in) {
  typename Supervisor<D>::In sup;
  ask(in, &sup);
  supervisor_.at_end(supervisor_words_, sup);
  if (renders_law() && in.law_restart) wave_.restart();
  out_.scene = wanted_scene(in);
}

/// Computes the clocks [from, to) of a tick, from < to. Returns the clock that it reached, which is
/// before `to` where an encoder error occurs.
template <class D, bool ReadBack>
template <class OnSnapshot>
int FeltgateCore<D, ReadBack>::pass(const In& in, int from, int to, OnSnapshot&& on_snapshot) {
  const QuadDecoder::Out decoded = decoder_.out();
  to = advance_decoder(in, from, to);
  Stretch s = stretch(from, to);
  core_steps::for_each_step(from, to, [&](Step step) FELTGATE_INLINED {
    take_in<ReadBack>(s, step, in, decoded, on_snapshot);
  });
  registers_.skip(in.reg_addr, to - from);
  finish(in, s);
  if (to == D::clocks_per_tick) registers_.skip_end_of_tick();
  advance_clock(to - from);
  passed_to_ = clock_;
  out_.snapshot_valid = to == kSnapshot;
  out_.word_valid = ReadBack && core_steps::stores_word(to - 1);
  show();
  return to;
}

/// Advances the decoder over the clocks [from, to), or only to the clock that sees an encoder
/// error.
template <class D, bool ReadBack>
int FeltgateCore<D, ReadBack>::advance_decoder(const In& in, int from, int to) {
  const auto d = decoder_inputs(in, false, false);
  for (int c = from; c < to; ++c) {
    if (decoder_.settled(d)) {
      wave_.watch(c, to, decoder_.out().travel);
      return to;
    }
    if (c > from && decoder_.out().illegal) return c;
    wave_.watch(c, c + 1, decoder_.out().travel);
    decoder_.clock(d);
  }
  return to;
}

/// Advances the gates to the clock `to`.
template <class D, bool ReadBack>
void FeltgateCore<D, ReadBack>::gates_to(Stretch& s, int to) {
  if (s.quiet) return;
  const int end = std::min(to, s.open);
  if (s.gates_at < end) {
    gates_.advance(bridge_inputs(true, out_.duty), end - s.gates_at);
    s.gates_at = end;
  }
  if (s.gates_at < to) {
    gates_.advance(bridge_inputs(false, out_.duty), to - s.gates_at);
    s.gates_at = to;
  }
}

/// Advances the gates to the end of the stretch; in the last clock of a tick also arming and scene.
template <class D, bool ReadBack>
void FeltgateCore<D, ReadBack>::finish(const In& in, Stretch& s) {
  if (s.to == D::clocks_per_tick) end_of_tick(in);
  if (s.quiet) return gates_.pass(s.to - s.from);
  gates_to(s, s.to);
}

/// Before a clock() that follows a pass(): advances the supervisor's registers, which pass() leaves
/// behind within a tick, by the supervisor's own clocks. Its inputs have not changed since.
template <class D, bool ReadBack>
void FeltgateCore<D, ReadBack>::catch_up() {
  if (passed_to_ != clock_) return;
  passed_to_ = -1;
  const bool watchdog = clock_ > kWatchdogOperand && clock_ <= core_steps::clock_of(T::watchdog);
  const bool amid = amid_supervisor();
  if (!amid && !watchdog) return;
  if (amid && clock_ > core_steps::clock_of(T::speed)) supervisor_ = before_wave_;
  const bool stop = supervisor_.steady(true);
  const int first = amid ? core_steps::clock_of(T::estimate_part) : kWatchdogOperand;
  for (int c = first; c < clock_; ++c) {
    typename Supervisor<D>::In sup = supervisor_inputs(c);
    sup.stop = stop;
    supervisor_.clock(sup);
  }
}

}  // namespace feltgate

#undef FELTGATE_INLINED
