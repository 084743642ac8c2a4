// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Interface of a closed loop to the law that the engine runs in a scene. Documentation:
// docs/laws.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../backends/backend.hpp"

namespace feltgate {

/// What a chain of its own has measured for a law: in SI units, and the words of one in fixed
/// point.
struct LawSample {
  double velocity_rad_s = 0, tau_hat_nm = 0;
  std::int64_t velocity = 0;
  std::int32_t tau_hat = 0;
};

/// A law's program in the numbers of a rider: it runs when the engine's program runs, on the same
/// samples.
class LawRider {
 public:
  using Torques = std::array<double, most_axes>;
  virtual ~LawRider() = default;
  /// Sets the state after arming and entry into the scene. The torques of a run before it stay in
  /// force, as in the engine, until one that began later ends.
  void enter() { reset(); }
  /// The next set of host values comes into force.
  virtual void change() = 0;
  /// Torques, Nm, of the run that is in force in the tick of `s`, the snapshot of axis 0; nullptr
  /// if not known.
  const Torques* in_force(const Snapshot& s) {
    if (!s.law_known) return nullptr;
    while (!runs_.empty() && static_cast<std::int32_t>(s.law_tick - runs_.front().first) > 0) {
      runs_.pop_front();
    }
    return runs_.empty() || runs_.front().first != s.law_tick ? nullptr : &runs_.front().second;
  }
  /// Executes the run that began with the tick of these snapshots, one per axis, if any; call it
  /// after in_force(). `own`, one per axis, replaces the core's measurements; nullptr: it does not.
  void follow(const Snapshot* axes, const LawSample* own) {
    if (axes[0].law_begins) runs_.emplace_back(axes[0].tick, run(axes, own));
  }

 protected:
  /// Sets the initial state.
  virtual void reset() = 0;
  /// One run on these samples.
  virtual Torques run(const Snapshot* axes, const LawSample* own) = 0;

 private:
  std::deque<std::pair<std::uint32_t, Torques>> runs_;  ///< by the tick of their samples
};

/// Runs the words of a law once more beside the engine, for an observer.
class LawWatch {
 public:
  virtual ~LawWatch() = default;
  /// Sets the state after arming and entry into the scene.
  virtual void enter() = 0;
  /// The next set of host values comes into force.
  virtual void change() = 0;
  /// Executes the run that began with the samples of this tick.
  virtual void run(const Snapshot& s) = 0;
};

/// A law for one design, of one axis or several: the host's writes (address of the register port,
/// word) and the riders.
class SceneLaw {
 public:
  using Writes = std::vector<std::pair<int, std::uint32_t>>;
  virtual ~SceneLaw() = default;
  virtual const std::string& name() const = 0;
  /// Whether it reads neither a velocity nor a tau_hat.
  virtual bool of_position_alone() const = 0;
  /// Largest error of an axis' torque against real arithmetic, Nm, on the words that the engine
  /// got. Infinite if its states are not bounded, or if a comparison can have the other result.
  virtual double bound_on_words_nm(std::size_t axis) const = 0;
  /// The same on the counts of the tick. Infinite for a law that uses more than the position.
  double bound_nm(std::size_t axis) const {
    return of_position_alone() ? bound_on_words_nm(axis) : std::numeric_limits<double>::infinity();
  }
  /// The writes that load it into an engine that is in its state after configuration.
  virtual Writes load() const = 0;
  virtual bool has(const std::string& parameter) const = 0;
  /// Unit of a parameter as in the law's file; empty: none.
  virtual std::string unit(const std::string& parameter) const = 0;
  /// Throws as set() would for one value, except for requirements that involve several parameters.
  virtual void check(const std::string& parameter, double value) const = 0;
  /// Throws as set() would.
  virtual void check(const std::map<std::string, double>& values) const = 0;
  /// The present value, as rounded to its word, in the unit of the law's file.
  virtual double value(const std::string& parameter) const = 0;
  /// Writes for values in the units of the law's file; they come into force together. Empty: sends
  /// the present values again, which keeps a mailbox fresh. Errors: std::invalid_argument with the
  /// range.
  virtual Writes set(const std::map<std::string, double>& values) = 0;
  /// Whether the host must keep this parameter fresh.
  virtual bool is_mailbox(const std::string& parameter) const = 0;
  virtual bool has_mailbox() const = 0;
  /// The nearest value that set() accepts.
  virtual double within(const std::string& parameter, double value) const = 0;
  /// Time from run to run, s.
  virtual double period_s() const = 0;
  /// Name and value, in SI units, of an event of its program.
  virtual std::pair<std::string, double> event(const LawEvent& told) const = 0;
  /// Gets every value that set() is given, as rounded to its word; empty: none.
  using ToldValue = std::function<void(const std::string& parameter, double value)>;
  void tell_values(ToldValue to) { told_value_ = std::move(to); }
  /// A rider; kinds as in make_real_chain(). It starts with the values before the first set(); each
  /// change() takes the next set.
  virtual std::unique_ptr<LawRider> rider(const std::string& kind) const = 0;
  /// Names of its states, including those of low-passes.
  virtual std::vector<std::string> states() const = 0;
  /// After each run, `told` gets the time of its samples and the states that the words leave, in
  /// SI.
  using Told = std::function<void(double at_s, const std::vector<double>& states)>;
  virtual std::unique_ptr<LawWatch> watch(Told told) const = 0;

 protected:
  ToldValue told_value_;
};

}  // namespace feltgate
