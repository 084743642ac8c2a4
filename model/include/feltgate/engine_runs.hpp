// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine's twin run by run: it replaces many calls of Engine::clock() while no host writes and
// at most one thread runs. Documentation: docs/blocks/engine.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "feltgate/engine.hpp"
#include "feltgate/engine_runs_parts.hpp"
#include "feltgate/engine_watch.hpp"

namespace feltgate::law {

/// An engine that computes a whole run as soon as its inputs are known, and shows each result in
/// the clock in which the hardware shows it. Writes since the start of the run before can be
/// undone, so the clocked twin can continue from any clock with the same state as if it had been
/// used throughout.
template <int AxisCount>
class EngineRuns {
 public:
  using Clocked = Engine<AxisCount>;
  using In = typename Clocked::In;
  using Out = typename Clocked::Out;
  using Axes = typename EngineInputs<AxisCount>::Axes;
  using Timing = RunTiming;

  EngineRuns(unsigned max_age, int torque_bits, const Timing& timing)
      : engine_(max_age, torque_bits), ticks_(timing) {}

  /// The engine as clocked twin, from the present clock on.
  Clocked& clocked() {
    leave();
    return engine_;
  }
  void reset() {
    clocked().reset();
    watch_ = {};
  }
  void clock(const In& in) {
    leave();
    const bool takes = engine_.commit_.taken(in.tick), late = engine_.mailbox_late();
    const bool stops = engine_.lines_.clearing;
    engine_.clock(in);
    watch_.clock(in.tick, in.tick_count, engine_.running(0), engine_.out().fresh, takes, late,
                 stops);
    if (rest_ > 0) --rest_;
  }
  const EngineWatch& watch() const { return watch_; }
  /// The axes take the torque in this clock; with torque() instead while runs are computed as a
  /// whole.
  void take() { watch_.take(); }
  /// Whether a commit is under way: then parameters cannot be written.
  bool committing() const { return engine_.commit_.committing(); }

  /// Whether runs are computed as a whole.
  bool on() const { return on_; }
  /// Tries to switch to whole runs; returns whether they are on. `in` are the inputs of the next
  /// clock, which is `clock_of_tick` of its tick. A run must start in that clock, or no thread run
  /// at all.
  bool enter(const In& in, int clock_of_tick);
  /// Returns to the clocked twin.
  void leave();
  /// Returns to the clocked twin for at least rest_clocks clocks.
  void give_up() {
    leave();
    rest_ = rest_clocks;
  }

  /// Whether tick() may be called for the clock `ahead` clocks from now. False where an age becomes
  /// too old, or where a run would begin after its inputs are no longer held.
  bool may_tick(int ahead) const {
    const std::int64_t at = now_ + ahead;
    if (engine_.watches_mailbox() && mail_ends(at)) return false;
    if (run_ == 0) return true;
    const Coming& next = comes_.front();
    const bool renewed = coming_ > 0 && next.clock <= at && next.renews(state_.renewed);
    if (!late_ && (renewed ? 0 : state_.age) >= engine_.registers_.max_age) return false;
    // A run with late inputs is known only with the next tick, which is too late for a short run.
    if (shortest_ >= ticks_.long_run() || (state_.count > 1 && !state_.due)) return true;
    const std::int64_t ready = std::max(at + 2 + thread_, end_ + 1);
    return ready + words + 3 <= at + ticks_.known_for();
  }
  /// A tick; the inputs are latched in the clock `ahead` clocks from now.
  void tick(int ahead, const Axes& position, const Axes& velocity, const Axes& tau_hat) {
    const std::int64_t at = now_ + ahead, counts = at + 1 + thread_;
    settle(at);
    watch_.stale = silent_;
    ticks_.add({at, position, velocity, tau_hat});
    if (run_ == 0) {
      watch_.begins = false;
      mark(at);
      count_mail(at);
      return;
    }
    load(at);
    start(at);
    settle(at);
    watch_.begins = false;
    count_mail(at);
    if (loading_) {
      cursor_ = at + 1;
      word_ = 0;
    }
    state_.age = (state_.age + 1) & 0xffffU;  // 0 again where outputs appear in this clock
    start(counts);
    if (state_.count > 1) {
      --state_.count;
    } else {
      state_.count = engine_.inputs_.dividers_[static_cast<std::size_t>(thread_)];
      state_.overrun |= state_.due;
      if (!state_.due) due_from_ = counts + 1;
      state_.due = true;
    }
    start(never);
    load(at + ticks_.known_for() + 1);
    start(never);
  }
  /// The torques in force in the clock `ahead` clocks from now, in which the cores take them.
  const std::array<std::int32_t, AxisCount>& torque(int ahead) {
    settle(now_ + ahead);
    watch_.take();
    return state_.torque;
  }
  /// Reports that `clocks` clocks have passed and what the axes show now. Calls `on_event(clock,
  /// number)` for each event in these clocks; clock 0 is the first of them.
  template <class OnEvent>
  void advance(int clocks, const Axes& position, const Axes& velocity, OnEvent&& on_event) {
    auto event = untold_.begin();
    for (; event != untold_.end() && event->clock < now_ + clocks; ++event) {
      on_event(static_cast<int>(event->clock - now_), event->number);
    }
    untold_.erase(untold_.begin(), event);
    now_ += clocks;
    ticks_.show(position, velocity);
    settle(now_);
    if (endless_) give_up();
  }
  /// Writes the outputs; while on(), only those that change.
  void show(Out* out) const {
    if (!on_) {
      *out = engine_.out();
      return;
    }
    out->torque = state_.torque;
    out->fresh = fresh_at_ == now_;
    out->event_valid = false;
    for (const Event& e : events_) {
      if (e.clock != now_) continue;
      out->event_valid = true;
      out->event_number = e.number;
      out->event_value = e.value;
    }
  }

 private:
  using State = RunState<AxisCount>;
  using Coming = RunOutputs<AxisCount>;
  struct Event {
    std::int64_t clock;
    int number;
    std::int32_t value;
  };
  static constexpr std::int64_t never = INT64_MAX / 2;
  static constexpr int words = EngineInputs<AxisCount>::kWords;
  static constexpr int stages = 6;  ///< clocks of a round; one turn per stage
  /// most instructions of a run that is computed as a whole
  static constexpr int longest = 1000;
  static constexpr int rest_clocks = 5000;  ///< pause after longer runs

  const EngineBarrel::Turn& stage(int k) const {
    return engine_.barrel_.at_[static_cast<std::size_t>(k)];
  }
  /// Whether the turn that was at stage `from` at clock 0 is at stage `to` (0 to 5) at clock n.
  static bool at_stage(std::int64_t n, int from, int to) { return (from + n - to) % stages == 0; }
  /// Whether the mailbox becomes too old in clock n of a tick.
  bool mail_ends(std::int64_t n) const {
    return !state_.mail_late && ticks_.count_at(n) % EngineMap::mailbox_step == 0 &&
           state_.mail_age >= engine_.registers_.mailbox_age;
  }
  void count_mail(std::int64_t n) {
    state_.mail_late |= mail_ends(n);
    const bool counts = ticks_.count_at(n) % EngineMap::mailbox_step == 0;
    if (counts) state_.mail_age = (state_.mail_age + 1) & 0xffffU;
  }

  /// Writes the inputs of a run that is due, one word after another, in the clocks before `limit`.
  void load(std::int64_t limit) {
    if (!state_.due) return;
    if (!loading_) {
      const std::int64_t ready = std::max(due_from_, end_ + 1);
      if (ready >= limit) return;
      loading_ = true;
      word_ = 0;
      cursor_ = ready + 1;
    }
    for (; cursor_ < limit; ++cursor_) {
      if (word_ == words) {
        loading_ = state_.due = false;
        begins_at_ = cursor_ + 1;
        start_ = cursor_ + 2;
        while (!at_stage(start_, own_, 5)) ++start_;
        return;
      }
      if (!at_stage(cursor_, system_, 2)) take_input(word_++);
    }
  }
  void take_input(int word) {
    const int base = thread_ * EngineMap::private_words;
    if (word == words - 1) {
      write(base + EngineMap::input_tick, engine_wrap(ticks_.count_at(cursor_)));
      return;
    }
    const std::size_t last = ticks_.size() - 1;
    const Axes from = word % 3 == 0   ? ticks_.position(cursor_, last)
                      : word % 3 == 1 ? ticks_.velocity(cursor_, last)
                                      : ticks_.tau_hat(cursor_, last);
    write(base + EngineMap::input_first + word, from[static_cast<std::size_t>(word / 3)]);
  }
  /// Starts the run whose inputs are complete, if it starts in clock `until` or earlier.
  void start(std::int64_t until) {
    if (start_ > until || start_ == never) return;
    const std::int64_t n = start_;
    start_ = never;
    mark(n);
    execute(n);
  }
  /// A run starts at clock n: the start of the run before becomes base_, the oldest state to return
  /// to.
  void mark(std::int64_t n) {
    const std::int64_t before = base_.clock;
    base_ = last_;
    last_ = state_;
    for (int k = 0; k < coming_; ++k) comes_[static_cast<std::size_t>(k)].appear(&last_, silent_);
    last_.clock = n;
    writes_.mark();
    ticks_.forget(base_.clock);
    const auto kept = std::partition_point(
        events_.begin(), events_.end(), [this](const Event& e) { return e.clock < base_.clock; });
    for (auto e = events_.begin(); e != kept; ++e) {
      engine_.events_.clock(true, {e->number, e->value, ticks_.count_at(e->clock)}, false);
    }
    // What is kept in the clock before base_ is not counted yet.
    const bool just_now = kept != events_.begin() && std::prev(kept)->clock == base_.clock - 1;
    if (base_.clock != before && !just_now) engine_.events_.count_last();
    events_.erase(events_.begin(), kept);
  }

  void write(int address, std::int32_t word) {
    writes_.data(engine_.barrel_.memory, address, word);
  }

  /// Executes the run that starts at clock n; its inputs are in the memory.
  void execute(std::int64_t n) {
    EngineMemory& m = engine_.barrel_.memory;
    EngineState s{0, (state_.first >> thread_ & 1U) != 0};
    state_.first &= ~(1U << thread_);
    Coming comes;
    int pc = thread_ * EngineMap::thread_words, count = 0;
    for (bool goes_on = true; goes_on; ++count) {
      if (count == longest) {
        endless_ = true;
        return;
      }
      const RunProgram::Step& step = program_.at(m, pc);
      const EngineInstruction& i = step.i;
      const bool branch = engine_branches(i.op, i.mode, s.flag);
      const std::int32_t x = m.data_at(step.x);
      const int word = engine_table_address(x, i.b);
      s = engine_step(i.op, i.mode, s, x, m.data_at(step.y), m.table_at(word));
      if (i.op == EngineOp::tst && word >= m.line_base) {
        writes_.table(m, word, static_cast<std::uint32_t>(s.acc));
      }
      if (step.to >= 0) write(step.to, s.acc);
      if (i.dst == static_cast<int>(EngineTarget::output) && (i.d & 3) < AxisCount) {
        comes.mask |= 1U << (i.d & 3);
        comes.torque[static_cast<std::size_t>(i.d & 3)] = engine_.outputs_.limited(s.acc);
      }
      if (i.dst == static_cast<int>(EngineTarget::event)) {
        events_.push_back({n + stages * count + 8, i.d, s.acc});
        untold_.push_back(events_.back());
      }
      goes_on = !i.last;
      pc = branch ? i.b : (pc + 1) % EngineMap::program_words;
    }
    end_ = n + stages * count;
    comes.clock = end_ + 3;
    comes_[static_cast<std::size_t>(coming_++)] = comes;
  }
  /// Updates begins and outputs up to clock n.
  void settle(std::int64_t n) {
    if (begins_at_ <= n) {
      if (thread_ == 0) watch_.begin(ticks_.count_at(begins_at_ - 1));
      begins_at_ = never;
    }
    while (coming_ > 0 && comes_[0].clock < n) {
      if (comes_[0].renews(state_.renewed)) {
        fresh_at_ = comes_[0].clock + 1;
        watch_.end();
        if (silent_) watch_.ended.reset();
      }
      comes_[0].appear(&state_, silent_);
      comes_[0] = comes_[1];
      --coming_;
    }
  }

  bool at_start(const In& in) const;
  void land_input();
  void adopt();

  Clocked engine_;  ///< while on(): as at enter(), except memory and events
  EngineWatch watch_;
  bool on_ = false;
  int rest_ = 0;  ///< clocks before the next try

  std::int64_t now_ = 0;  ///< clocks since enter()
  unsigned run_ = 0;
  int thread_ = 0, system_ = 0, own_ = 0;  ///< stages of thread and turns at clock 0
  unsigned addr_ = 0;
  std::int64_t addr_since_ = 0;
  bool armed_ = false, late_ = false, silent_ = false, endless_ = false;
  /// state_: now; base_, last_: at the starts of the run before the last and of the last run.
  State state_, base_, last_;
  std::int64_t end_ = 0;  ///< clock that ends the last run
  std::int64_t begins_at_ = never, fresh_at_ = never;
  /// Inputs: clock since which the thread is due; next clock that may write a word; start of the
  /// run that they are for.
  std::int64_t due_from_ = 0, cursor_ = 0, start_ = never;
  bool loading_ = false;
  int word_ = 0, shortest_ = 0;
  std::array<Coming, 2> comes_{};
  int coming_ = 0;
  RunTicks<Axes> ticks_;       ///< since base_, and the tick before
  RunWrites writes_;           ///< since base_; marked at last_
  std::vector<Event> events_;  ///< since base_
  std::vector<Event> untold_;  ///< events from now_ on
  RunProgram program_;
};

}  // namespace feltgate::law

#include "feltgate/engine_runs_state.hpp"  // IWYU pragma: export
