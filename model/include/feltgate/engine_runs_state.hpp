// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// EngineRuns: how it takes over from the engine's clocked twin, and how it hands back. Included by
// engine_runs.hpp. Documentation: docs/blocks/engine.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/engine_runs.hpp"

namespace feltgate::law {

template <int AxisCount>
bool EngineRuns<AxisCount>::enter(const In& in, int clock_of_tick) {
  if (on_) {  // only ticks change anything
    if (addr_ != in.addr) addr_since_ = now_;
    addr_ = in.addr;
    armed_ = in.armed;
    return true;
  }
  if (rest_ > 0 || !at_start(in)) return false;
  const auto& r = engine_.registers_;
  run_ = r.run;
  thread_ = engine_.barrel_.thread5();
  for (int k = 0; k < 6; ++k) {
    const int turn = stage(k).turn;
    if (turn == EngineBarrel::kSystem) system_ = k;
    if (turn == thread_) own_ = k;
  }
  now_ = addr_since_ = 0;
  ticks_.begin(in.tick_count, clock_of_tick);
  addr_ = in.addr;
  armed_ = r.armed;
  program_.begin(thread_, engine_.commit_.bank);
  events_.clear();
  untold_.clear();
  coming_ = 0;
  begins_at_ = fresh_at_ = start_ = never;
  endless_ = loading_ = false;
  state_ = {};
  state_.torque = engine_.outputs_.torque;
  state_.renewed = engine_.outputs_.renewed_;
  state_.age = engine_.outputs_.age_;
  state_.count = engine_.inputs_.counts_[static_cast<std::size_t>(thread_)];
  state_.first = r.first;
  state_.overrun = r.overrun;
  state_.mail_age = engine_.mailbox_.age_;
  state_.mail_late = engine_.mailbox_.late_;
  late_ = engine_.outputs_.late;
  silent_ = engine_.mailbox_late();
  land_input();
  base_ = last_ = state_;
  on_ = true;
  if (run_ != 0) {
    shortest_ = program_.shortest(engine_.barrel_.memory, ticks_.long_run());
    execute(0);
  }
  if (endless_) give_up();
  return on_;
}

template <int AxisCount>
void EngineRuns<AxisCount>::leave() {
  if (!on_) return;
  on_ = false;
  writes_.take_back(engine_.barrel_.memory);
  adopt();
  In in;
  in.armed = armed_;
  in.addr = addr_;
  std::size_t next = 0;
  for (std::int64_t n = base_.clock; n < now_; ++n) {
    next = ticks_.at_or_after(n, next);
    in.tick = ticks_.is_tick(n, next);
    in.tick_count = ticks_.count_at(n);
    in.position = ticks_.position(n, next);
    in.velocity = ticks_.velocity(n, next);
    in.tau_hat = ticks_.tau_hat(n, next);
    const bool ran = engine_.running(0);
    engine_.clock(in);
    // The watch does not know yet of a run whose inputs were late.
    if (engine_.running(0) && !ran && ticks_.beyond(n, next)) watch_.begin(in.tick_count);
  }
  // Reads from before the address changed do not count.
  auto& clocks = engine_.registers_.clocks;
  clocks = static_cast<int>(std::min<std::int64_t>(clocks, now_ - addr_since_));
  watch_.running = engine_.running(0);
}

/// Whether a run starts now or none runs, and nothing else is under way, except a word that the run
/// will read.
template <int AxisCount>
bool EngineRuns<AxisCount>::at_start(const In& in) const {
  const auto& r = engine_.registers_;
  const auto& w = r.written;
  const auto& inputs = engine_.inputs_;
  const auto& outputs = engine_.outputs_;
  if ((r.run & (r.run - 1)) != 0 || engine_.busy() || engine_.commit_.committing() ||
      engine_.crc_.read_ || in.armed != r.armed || in.tick || engine_.mailbox_.jumps ||
      inputs.counting_ || inputs.loading_ || inputs.written_ || inputs.due_ != 0 || outputs.ends_ ||
      w.data || w.program || w.table || r.lands != 0 || stage(4).writes_data) {
    return false;
  }
  for (const auto& axis : outputs.axes_) {
    if (axis.waits) return false;
  }
  // A mailbox that a host has just made too old: the torque becomes 0 in this clock.
  if (engine_.mailbox_late() && (watch_.ended || outputs.torque != State{}.torque)) return false;
  for (const auto& turn : engine_.barrel_.at_) {
    if (turn.valid || turn.writes_program || turn.writes_table) return false;
  }
  return r.run == 0 ? inputs.running == 0
                    : inputs.request == r.run && engine_.barrel_.starts(inputs.request);
}

/// Writes the last words of the inputs, which may still be in the pipeline: the run will read them.
template <int AxisCount>
void EngineRuns<AxisCount>::land_input() {
  for (const int k : {6, 5}) {
    const auto& turn = stage(k);
    if (turn.writes_data) write(turn.address, static_cast<std::int32_t>(turn.extra));
  }
}

/// Sets the clocked twin to the state base_: just before the start of a run, nothing under way.
template <int AxisCount>
void EngineRuns<AxisCount>::adopt() {
  if (base_.clock == 0) return;
  auto& barrel = engine_.barrel_;
  const auto turns = static_cast<int>(base_.clock % stages);
  const auto turns_of = barrel.at_;
  int k = 0;
  for (auto& t : barrel.at_) {
    t = {};
    t.turn = turns_of[static_cast<std::size_t>((k++ + stages - turns) % stages)].turn;
  }
  auto& inputs = engine_.inputs_;
  inputs.due_ = base_.due ? run_ : 0;
  inputs.counted_ = ticks_.counted(base_.clock);
  inputs.counting_ = inputs.counted_ >= 0;
  if (!inputs.counting_) inputs.counted_ = 0;
  inputs.counts_[static_cast<std::size_t>(thread_)] = base_.count;
  auto& outputs = engine_.outputs_;
  outputs.torque = base_.torque;
  outputs.renewed_ = base_.renewed;
  outputs.age_ = base_.age;
  engine_.mailbox_.age_ = base_.mail_age;
  engine_.mailbox_.late_ = base_.mail_late;
  engine_.registers_.first = base_.first;
  engine_.registers_.overrun = base_.overrun;
}

}  // namespace feltgate::law
