// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a loop asks of the law that a scene has the engine run. Documentation: docs/laws.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../engines/engine.hpp"
#include "../reference/real_chain.hpp"

namespace feltgate {

/// A program beside a real chain: the same runs on the same samples as the engine's, in the chain's
/// numbers.
class LawRider {
 public:
  virtual ~LawRider() = default;
  /// As after arming and entry into the scene.
  void enter() {
    reset();
    torques_.clear();
  }
  /// The next values that the host has set come into force.
  virtual void change() = 0;
  /// What the chain is asked for in the tick of `s`; before it rides.
  double torque_nm(const Snapshot& s) {
    if (!s.law_known) return 0;
    while (!torques_.empty() && static_cast<std::int32_t>(s.law_tick - torques_.front().tick) > 0) {
      torques_.pop_front();
    }
    return torques_.empty() || torques_.front().tick != s.law_tick ? 0 : torques_.front().nm;
  }
  /// After the chain has ridden: the run that began with the tick of `s`, if one did.
  void follow(const Snapshot& s, const RealChain& chain) {
    if (s.law_begins) torques_.push_back({s.tick, run(s, chain)});
  }

 protected:
  virtual void reset() = 0;
  /// A run on these samples; its torque in Nm.
  virtual double run(const Snapshot& s, const RealChain& chain) = 0;

 private:
  struct Torque {
    std::uint32_t tick;  ///< of its samples
    double nm;
  };
  std::deque<Torque> torques_;
};

/// The words of a law once more, run beside the engine's for who wants to look into them.
class LawWatch {
 public:
  virtual ~LawWatch() = default;
  /// As after arming and entry into the scene.
  virtual void enter() = 0;
  /// The next values that the host has set come into force.
  virtual void change() = 0;
  /// The run that began with the samples of this tick.
  virtual void run(const Snapshot& s) = 0;
};

/// A law for one design: what the host writes (address of the register port, word), and riders.
class SceneLaw {
 public:
  using Writes = std::vector<std::pair<int, std::uint32_t>>;
  virtual ~SceneLaw() = default;
  virtual const std::string& name() const = 0;
  /// Whether its words run as C++ that was built with the program; else in the interpreter.
  virtual bool compiled() const = 0;
  /// Largest error of its torque against real arithmetic of the same tick's samples, Nm; infinite
  /// where it takes more than the position, or jumps.
  virtual double bound_nm() const = 0;
  /// Into an engine as it is after configuration.
  virtual Writes load() const = 0;
  virtual bool has(const std::string& parameter) const = 0;
  /// As the law's file writes it; empty: none.
  virtual std::string unit(const std::string& parameter) const = 0;
  /// Only the errors of set(), without those of what the law requires of several.
  virtual void check(const std::string& parameter, double value) const = 0;
  /// Only the errors of set().
  virtual void check(const std::map<std::string, double>& values) const = 0;
  /// As rounded to its word, in the unit of the law's file.
  virtual double value(const std::string& parameter) const = 0;
  /// Values in the units of the law's file, which come into force together; none: what stands is
  /// sent anew, which keeps a mailbox fresh. Errors: std::invalid_argument with the range.
  virtual Writes set(const std::map<std::string, double>& values) = 0;
  /// Whether the host has to keep this parameter fresh.
  virtual bool is_mailbox(const std::string& parameter) const = 0;
  virtual bool has_mailbox() const = 0;
  /// The nearest value that set() takes.
  virtual double within(const std::string& parameter, double value) const = 0;
  /// From run to run, s.
  virtual double period_s() const = 0;
  /// What an event of its program says: name, and value in SI.
  virtual std::pair<std::string, double> event(const LawEvent& told) const = 0;
  /// Kinds as make_real_chain(). With the values of before the first set(); change() is the next.
  virtual std::unique_ptr<LawRider> rider(const std::string& kind) const = 0;
  /// Names of its states, those of low-passes among them.
  virtual std::vector<std::string> states() const = 0;
  /// After each run `told` gets the time of its samples and what the words leave in the states, SI.
  using Told = std::function<void(double at_s, const std::vector<double>& states)>;
  virtual std::unique_ptr<LawWatch> watch(Told told) const = 0;
};

}  // namespace feltgate
