// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Records what a run of a core has exercised, and lists what it has not. Documentation:
// docs/testing.md
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "feltgate/core_ports.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/while_armed.hpp"

namespace feltgate::test {

/// The words of the snapshot, by their slots.
inline constexpr std::array<int, 12> snapshot_slots{
    Map::R::tick,    Map::R::position,    Map::R::status,   Map::R::faults,
    Map::R::encoder, Map::R::index,       Map::R::velocity, Map::R::tau_hat,
    Map::R::tau_ref, Map::R::current_ref, Map::R::voltage,  Map::R::duty};

/// Coverage of one run.
class Coverage {
 public:
  /// Takes the outputs after each clock.
  void add(const CoreOut& o) {
    ++clocks_;
    armed_ += o.armed;
    for (std::size_t b = 0; b < limits_.size(); ++b) limits_[b] += (o.limits >> b) & 1u;
    derated_ += (o.limits & limit::hold) != 0;
    frozen_ += o.armed && (o.limits & limit::chatter) != 0;
    if (o.armed) ++scenes_[o.scene & 15u];
    if (gates_ && !o.gates_enable) ++faults_[o.first_fault & 15u];
    gates_ = o.gates_enable;
  }
  /// The same, with the inputs of this clock and the number of the next clock in the tick.
  void add(const CoreIn& in, const CoreOut& o, int clock_of_tick) {
    const bool busy = busy_;
    busy_ = o.reg_busy;
    add(o);
    same_address_ = in.reg_addr == address_ ? same_address_ + 1 : 1;
    address_ = in.reg_addr;
    if (same_address_ == 3 && in.reg_addr >= Map::C::snapshot) {
      ++words_[static_cast<std::size_t>((in.reg_addr - Map::C::snapshot) & 63)];
    }
    if (in.set_zero && clock_of_tick == 0) ++zeroes_at_the_end_;
    if (!in.reg_write) return;
    const bool command = in.reg_addr == Map::C::command;
    const bool kick = command && ((in.reg_wdata >> Map::C::command_kick) & 1u) != 0;
    if (kick && !busy && ((in.reg_wdata >> Map::C::command_clear_faults) & 1u) == 0) ++kicks_;
    const bool disarm = in.reg_addr == Map::C::control && disarms(in.reg_wdata);
    if (disarm && busy) ++disarms_past_a_write_;
  }
  void merge(const Coverage& o) {
    clocks_ += o.clocks_;
    armed_ += o.armed_;
    derated_ += o.derated_;
    frozen_ += o.frozen_;
    zeroes_at_the_end_ += o.zeroes_at_the_end_;
    kicks_ += o.kicks_;
    disarms_past_a_write_ += o.disarms_past_a_write_;
    const auto sum = [](auto& all, const auto& more) {
      for (std::size_t k = 0; k < all.size(); ++k) all[k] += more[k];
    };
    sum(limits_, o.limits_);
    sum(scenes_, o.scenes_);
    sum(faults_, o.faults_);
    sum(words_, o.words_);
  }

  double armed_share() const { return share(armed_); }
  double duty_pinned_share() const { return share(limits_[Map::L::duty]); }
  double tau_ref_pinned_share() const { return share(limits_[Map::L::torque]); }
  double eased_share() const { return share(derated_); }
  double frozen_share() const { return share(frozen_); }
  /// Number of scenes below `numbers` that ran armed, without the reserved number 1 and the scenes
  /// not built.
  int scenes_seen(std::size_t numbers) const {
    int n = 0;
    for (std::size_t s = 0; s < numbers; ++s) n += s != 1 && scenes_[s] > 0 ? 1 : 0;
    return n;
  }
  /// Lists, one word each, what was reached less than `times` times; empty if there is nothing.
  /// `outside`: the run also drives programs and other axes; `looped`: the modulator of a current
  /// loop; `edges`: the encoder is incremental; `fine`: it has no index and so many counts that no
  /// motion reaches the limit of tau_hat.
  std::string gaps(std::int64_t times, bool outside = false, bool looped = false, bool edges = true,
                   bool fine = false) const {
    std::string text;
    const auto ask = [&](std::int64_t n, const std::string& what) {
      if (n < times) text += what + ' ' + std::to_string(n) + ", ";
    };
    for (std::size_t n = 1; n < fault_names.size(); ++n) {
      const auto cause = static_cast<Fault>(n);
      const bool of_others = cause == Fault::engine || cause == Fault::axis;
      const bool of_edges = cause == Fault::channel || (cause == Fault::index && !fine);
      const bool comes = cause == Fault::current ? looped
                         : of_edges              ? edges
                         : cause == Fault::index ? false
                                                 : !broken_hardware_alone(cause);
      if (of_others ? outside : comes) ask(faults_[n], std::string("fault ") + fault_names[n]);
    }
    for (std::size_t b = 0; b < limits_.size(); ++b)
      // The motions that reach these two are jumps to an absolute encoder.
      if ((edges || (b != Map::L::chatter && b != Map::L::velocity && b != Map::L::tau_hat)) &&
          !(fine && b == Map::L::tau_hat))
        ask(limits_[b], std::string("limit ") + limit::names[b]);
    for (const int slot : snapshot_slots)
      ask(words_[static_cast<std::size_t>(slot)], "word " + std::to_string(slot));
    ask(zeroes_at_the_end_, "zero in the last clock of a tick");
    ask(kicks_, "kick without a clear");
    ask(disarms_past_a_write_, "disarm past a write");
    return text;
  }
  std::string text() const {
    std::string faults;
    for (std::size_t n = 1; n < fault_names.size(); ++n) {
      if (faults_[n] > 0)
        faults += std::string(" ") + fault_names[n] + ' ' + std::to_string(faults_[n]);
    }
    return "armed " + std::to_string(armed_share()) + ", duty pinned " +
           std::to_string(duty_pinned_share()) + ", tau_ref pinned " +
           std::to_string(tau_ref_pinned_share()) + ", eased " + std::to_string(eased_share()) +
           ", frozen " + std::to_string(frozen_share()) + ", scenes " +
           std::to_string(scenes_seen(11)) + ", faults" + faults;
  }

 private:
  /// True for causes that no input of a whole core can produce (ticks_stand_test and word_flip_test
  /// test them).
  static bool broken_hardware_alone(Fault cause) {
    return cause == Fault::tick || cause == Fault::word || cause == Fault::jump;
  }
  double share(std::int64_t n) const {
    return clocks_ == 0 ? 0.0 : static_cast<double>(n) / static_cast<double>(clocks_);
  }

  std::int64_t clocks_ = 0, armed_ = 0, derated_ = 0, frozen_ = 0;
  std::int64_t zeroes_at_the_end_ = 0, kicks_ = 0, disarms_past_a_write_ = 0;
  std::array<std::int64_t, limit::names.size()> limits_{};  ///< clocks
  std::array<std::int64_t, 16> scenes_{};                   ///< clocks armed in each scene
  std::array<std::int64_t, 16> faults_{};                   ///< first causes that closed the gates
  std::array<std::int64_t, 64> words_{};                    ///< reads, by slot
  bool gates_ = false, busy_ = false;
  int address_ = -1, same_address_ = 0;
};

}  // namespace feltgate::test
