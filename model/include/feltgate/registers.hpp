// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/wave/registers.sv: register port, parameter RAM, control word, commands and
// snapshot. A write takes effect at the end of the tick, a parameter saturated to its format; a
// disarm and a stop do not wait behind an earlier write. A word is on the parameter bus 2 clocks
// after its slot is fetched; read data follow their address by 3 clocks. Documentation:
// docs/architecture.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include "feltgate/generated/map.hpp"
#include "feltgate/parameter.hpp"
#include "feltgate/while_armed.hpp"

namespace feltgate {

/// The four check bits beside a parameter word: parities of every fourth bit; 0 and 2 are inverted.
constexpr unsigned check_of(std::uint32_t word) {
  std::uint32_t folded = word ^ word >> 16;
  folded ^= folded >> 8;
  return ((folded ^ folded >> 4) & 15U) ^ 5U;
}

/// D: a generated design. ReadBack = false: no snapshot, every read gives 0.
template <class D, bool ReadBack = true>
class Registers {
 public:
  struct In {
    bool tick = false;  ///< last clock of a tick
    std::uint16_t reg_addr = 0;
    std::uint32_t reg_wdata = 0;
    bool reg_write = false;         ///< held until a clock in which out().reg_busy is low
    bool armed = false;             ///< in the clock of tick also: about to be armed
    bool polarity_holds = false;    ///< encoder_polarity keeps its value
    bool set_zero = false;          ///< from the panel
    std::uint8_t slot_fetch = 0;    ///< slot of the parameter that goes on the bus
    bool scene_slot_fetch = false;  ///< the slot is one of the scene's parameters
    std::uint8_t scene = 0;         ///< in force
    bool region_high = false;       ///< voltage_gain_high replaces voltage_gain
    bool at_least_full = false;     ///< torque_limit is on the bus
    bool at_least_hold = false;     ///< hold_limit is
    bool at_least_test = false;     ///< self_test_torque is
    bool derated = false;           ///< hold_limit limits too
    bool testing = false;           ///< self_test_torque limits too
    std::uint8_t snap_slot = 0;
    bool snap_valid = false;  ///< snap_data goes into the snapshot at snap_slot
    std::uint32_t snap_data = 0;
  };
  struct Out {
    std::uint32_t reg_rdata = 0;
    bool reg_busy = false;    ///< a write waits for the end of the tick
    std::uint32_t param = 0;  ///< the parameter bus
    bool word_error = false;  ///< the word on the bus one clock ago has changed by itself
    std::uint16_t control = static_cast<std::uint16_t>(D::control_reset);
    bool disarm = false;     ///< a disarm was written since the end of the last tick
    bool stop = false;       ///< a stop was commanded since the end of the last tick
    bool refused = false;    ///< the last parameter write was, because the core was armed
    bool saturated = false;  ///< the last parameter written did not fit its format
    bool set_zero = false;   ///< these four only in peek(): high in the clock of tick
    bool clear_faults = false;
    bool kick = false;
    bool restart = false;  ///< this write may make the torque jump
  };

  Registers() {
    for (const auto& p : D::parameters) {
      parameters_[static_cast<std::size_t>(p.address)] = static_cast<std::uint32_t>(p.raw);
    }
  }

  /// Both RAMs keep their words.
  void reset() {
    out_ = Out();
    target_ = Target::none;
    address_ = 0;
    data_ = 0;
    zero_ = false;
    warm_ = false;
    fetch_wrong_ = bus_wrong_ = held_wrong_ = false;
    least_ = 0;
    least_at_ = D::A::torque_limit;
    write_bank_ = 0;
    frozen_ = false;
    source_ = source_2_ = Source::nowhere;
    parameter_2_ = snapshot_2_ = 0;
  }

  void clock(const In& in) {
    // A read in this clock gives the contents before this clock's writes.
    const std::uint32_t fetched = parameters_[fetch_address(in)];
    out_.word_error = bus_wrong_ || held_wrong_;
    note_limit(in);
    if (warm_) {
      out_.param = fetch_;
      bus_wrong_ = fetch_wrong_;
    }
    fetch_ = fetched;
    const bool writes = in.tick && target_ == Target::parameter;
    fetch_wrong_ = !flipped_.empty() && !writes && wrong(fetch_address(in));
    if constexpr (ReadBack) read(in.reg_addr);
    if (in.snap_valid) write_snapshot(in.snap_slot, in.snap_data);
    warm_ = true;
    const bool accept = in.reg_write && target_ == Target::none;
    if (in.tick) commit(in);
    const bool command = in.reg_write && in.reg_addr == D::C::command;
    const bool control = in.reg_write && in.reg_addr == D::C::control;
    out_.disarm = (control && disarms(in.reg_wdata)) || (out_.disarm && !in.tick);
    out_.stop =
        (command && ((in.reg_wdata >> D::C::command_stop) & 1U) != 0) || (out_.stop && !in.tick);
    zero_ = in.set_zero || (zero_ && !in.tick);
    if (accept) {
      target_ = target_of(in.reg_addr);
      address_ = in.reg_addr & 0x1ffU;
      data_ = in.reg_wdata;
      if (target_ == Target::parameter) {
        data_ = fitted(in.reg_addr, in.reg_wdata);
        out_.saturated = data_ != in.reg_wdata;
      }
    }
    out_.reg_busy = target_ != Target::none;
  }

  /// Registered outputs.
  const Out& out() const { return out_; }

  /// All outputs in a clock with these inputs, also those that depend on them directly.
  Out peek(const In& in) const {
    Out now = out_;
    now.set_zero = in.tick && sets_zero();
    now.restart = in.tick && restarts(in.scene);
    now.clear_faults = in.tick && commands(D::C::command_clear_faults);
    now.kick = in.tick && commands(D::C::command_kick);
    return now;
  }

  /// Whether the command `bit` waits for the end of the tick.
  bool commands(int bit) const { return target_ == Target::command && ((data_ >> bit) & 1U) != 0; }

  /// Whether the position is set to zero at the end of the tick.
  bool sets_zero() const { return zero_ || commands(D::C::command_set_zero); }
  /// Whether something that waits for the end of the tick may make the torque jump.
  bool restarts(int scene) const {
    if (sets_zero() && !is_input_scene(scene)) return true;
    return target_ == Target::parameter &&
           while_armed(static_cast<int>(address_), scene) == WhileArmed::ramps;
  }
  /// The address of the parameter that is written at the end of the tick; -1 for none.
  int parameter_waiting(bool armed) const {
    const bool takes = target_ == Target::parameter && !refuses(armed);
    return takes ? static_cast<int>(address_) : -1;
  }
  /// Whether nothing waits for the end of the tick, and no disarm or stop is pending.
  bool at_rest() const { return target_ == Target::none && !out_.disarm && !out_.stop && !zero_; }

  /// A word of the parameter RAM, 0 <= address < 512.
  std::uint32_t parameter(int address) const {
    return parameters_[static_cast<std::size_t>(address)];
  }
  /// Sets a word, as if a write through the port had taken effect.
  void set_parameter(int address, std::uint32_t word) {
    parameters_[static_cast<std::size_t>(address)] = word;
  }

  /// Fault injection: inverts a stored bit without a write. 0 to 31 are bits of the word, 32 to 35
  /// its check bits. The next write of the word corrects it.
  void flip(int address, int bit) {
    const auto at = static_cast<std::size_t>(address);
    if (bit < 32) parameters_[at] ^= std::uint32_t{1} << bit;
    auto& bits = flipped_[at];
    bits ^= std::uint64_t{1} << bit;
    if (bits == 0) flipped_.erase(at);
  }
  /// Fault injection: the same for a control bit that is held while armed; bit = control_width is
  /// the parity of these bits.
  void flip_control(int bit) {
    if (bit < D::C::control_width) out_.control ^= static_cast<std::uint16_t>(1U << bit);
    held_wrong_ = !held_wrong_;
  }
  /// Whether some word differs from what was written.
  bool flipped() const { return held_wrong_ || !flipped_.empty(); }

  /// Stores one word in the snapshot of the running tick, 0 <= slot < 64.
  void write_snapshot(int slot, std::uint32_t word) {
    if constexpr (ReadBack) {
      last_ = bank_index(write_bank_, slot);
      before_ = snapshot_[last_];
      snapshot_[last_] = word;
    }
  }
  std::uint32_t running_word(int slot) const { return snapshot_[bank_index(write_bank_, slot)]; }
  /// For a reset in the clock after: the word at `slot` was on its way to the RAM and is lost.
  void lose_snapshot(int slot) {
    if (ReadBack && slot >= 0 && static_cast<int>(last_ & 63U) == slot) snapshot_[last_] = before_;
  }
  /// Equals `clocks` calls of clock() that do not include the last clock of a tick. Conditions: no
  /// write, reg_addr held, the snapshot's words given to write_snapshot(), at least one tick since
  /// the reset. The parameter bus is not updated.
  void skip(std::uint16_t reg_addr, int clocks) {
    if constexpr (ReadBack) {
      if (clocks >= kReadClocks) {
        read_steadily(reg_addr);
      } else {
        for (int k = 0; k < clocks; ++k) read(reg_addr);
      }
    } else {
      (void)reg_addr, (void)clocks;
    }
  }
  /// The additional effect of the last clock of a tick, with no write waiting.
  void skip_end_of_tick() {
    if (ReadBack && !frozen_) write_bank_ ^= 1;
  }
  /// Equals a whole tick of clock() calls; conditions as for skip().
  void skip_tick(std::uint16_t reg_addr) {
    skip(reg_addr, kReadClocks);
    skip_end_of_tick();
  }
  /// Equals `ticks` ticks before a skip_tick(); nobody must be able to read the words of these
  /// ticks.
  void skip_unread_ticks(std::uint32_t ticks) {
    if (ReadBack && !frozen_) write_bank_ ^= static_cast<int>(ticks & 1U);
  }

 private:
  static constexpr int kReadClocks = 3;  // from an address to its word
  enum class Target : std::uint8_t { none, parameter, control, command };
  enum class Source : std::uint8_t { nowhere, parameter, snapshot, control };

  static Target target_of(std::uint16_t address) {
    if (address < 0x200) return Target::parameter;
    if (address == D::C::control) return Target::control;
    return address == D::C::command ? Target::command : Target::none;
  }
  static Source source_of(std::uint16_t address) {
    if (address < 0x200) return Source::parameter;
    if (address == D::C::control) return Source::control;
    return (address >> 6) == Map::C::snapshot >> 6 ? Source::snapshot : Source::nowhere;
  }
  static std::uint32_t fitted(int address, std::uint32_t word) {
    for (const auto& p : D::parameters) {
      if (p.address == address) return feltgate::fitted(p.format, word);
    }
    return word;
  }
  std::size_t fetch_address(const In& in) const {
    if (in.scene_slot_fetch) return (in.scene * 32U + (in.slot_fetch & 31U)) & 0x1ffU;
    switch (in.slot_fetch) {
      case D::A::torque_limit:
        return least_at_;
      case Map::T::least_full:
        return D::A::torque_limit;
      case Map::T::least_hold:
        return D::A::hold_limit;
      case Map::T::least_test:
        return D::A::self_test_torque;
      case D::A::voltage_gain:
        return in.region_high ? D::A::voltage_gain_high : D::A::voltage_gain;
      default:
        return in.slot_fetch;
    }
  }
  /// The limit of the torque is the least of all that limit it; they come by one after the other.
  void note_limit(const In& in) {
    constexpr int unused = 32 - D::f.torque.width();
    const std::int32_t limit = static_cast<std::int32_t>(out_.param << unused) >> unused;
    const bool limits = (in.at_least_hold && in.derated) || (in.at_least_test && in.testing);
    if (!in.at_least_full && !(limits && limit < least_)) return;
    least_ = limit;
    least_at_ = in.at_least_full   ? D::A::torque_limit
                : in.at_least_hold ? D::A::hold_limit
                                   : D::A::self_test_torque;
  }
  static std::size_t bank_index(int bank, int slot) {
    return static_cast<std::size_t>(bank * 64 + slot);
  }
  /// Whether one of the four parities, each of every fourth bit and its check bit, is wrong.
  bool wrong(std::size_t address) const {
    const auto found = flipped_.find(address);
    if (found == flipped_.end()) return false;
    std::uint64_t bits = found->second;
    bits ^= bits >> 16 ^ bits >> 32;
    bits ^= bits >> 8;
    return ((bits ^ bits >> 4) & 15U) != 0;
  }
  int read_bank() const { return write_bank_ ^ 1; }

  void read(std::uint16_t reg_addr) {
    out_.reg_rdata = selected();
    if (warm_) {
      parameter_2_ = parameter_;
      snapshot_2_ = snapshot_word_;
    }
    parameter_ = parameters_[reg_addr & 0x1ffU];
    snapshot_word_ = snapshot_[bank_index(read_bank(), reg_addr & 63)];
    source_2_ = source_;
    source_ = source_of(reg_addr);
  }
  /// Equals three or more reads of one address.
  void read_steadily(std::uint16_t reg_addr) {
    parameter_ = parameter_2_ = parameters_[reg_addr & 0x1ffU];
    snapshot_word_ = snapshot_2_ = snapshot_[bank_index(read_bank(), reg_addr & 63)];
    source_ = source_2_ = source_of(reg_addr);
    out_.reg_rdata = selected();
  }
  std::uint32_t selected() const {
    switch (source_2_) {
      case Source::parameter:
        return parameter_2_;
      case Source::snapshot:
        return snapshot_2_;
      case Source::control:
        return out_.control;
      default:
        return 0;
    }
  }

  bool refuses(bool armed) const {
    return armed && while_armed(static_cast<int>(address_), 0) == WhileArmed::refused;
  }

  /// The end of a tick.
  void commit(const In& in) {
    const bool swap = !frozen_;  // a tick that ends with a freeze is the one that is kept
    if (target_ == Target::parameter) {
      out_.refused = refuses(in.armed);
      if (!out_.refused) {
        parameters_[address_] = data_;
        flipped_.erase(address_);
      }
    }
    if (target_ == Target::control) {
      const bool holds = in.armed && !out_.disarm;
      constexpr std::uint32_t polarity = 1U << D::C::control_encoder_polarity;
      if (in.polarity_holds) data_ = (data_ & ~polarity) | (out_.control & polarity);
      out_.control = static_cast<std::uint16_t>(control_after(out_.control, data_, holds));
      if (!holds) held_wrong_ = false;
    }
    if (out_.disarm) {
      constexpr unsigned host = 1U << D::C::control_host, arm = 1U << D::C::control_arm;
      out_.control = static_cast<std::uint16_t>((out_.control | host) & ~arm);
    }
    if (ReadBack && target_ == Target::command) {
      frozen_ = commands(D::C::command_freeze) || (frozen_ && !commands(D::C::command_thaw));
    }
    if (ReadBack && swap) write_bank_ ^= 1;
    target_ = Target::none;
  }

  std::array<std::uint32_t, 512> parameters_{};
  std::array<std::uint32_t, ReadBack ? 128 : 1> snapshot_{};
  Out out_;
  Target target_ = Target::none;  ///< target of the waiting write
  std::size_t address_ = 0;
  std::uint32_t data_ = 0;
  bool zero_ = false;  ///< the panel requests it
  bool warm_ = false;
  std::uint32_t fetch_ = 0;
  bool fetch_wrong_ = false, bus_wrong_ = false, held_wrong_ = false;
  std::int32_t least_ = 0;                        ///< of the torque's limits so far
  std::size_t least_at_ = D::A::torque_limit;     ///< and its address
  std::map<std::size_t, std::uint64_t> flipped_;  ///< wrong bits of words, by address
  std::size_t last_ = 0;                          ///< word of the snapshot that was written last
  std::uint32_t before_ = 0;                      ///< its content before that write
  int write_bank_ = 0;
  bool frozen_ = false;
  Source source_ = Source::nowhere;
  Source source_2_ = Source::nowhere;
  std::uint32_t parameter_ = 0;
  std::uint32_t parameter_2_ = 0;
  std::uint32_t snapshot_word_ = 0;
  std::uint32_t snapshot_2_ = 0;
};

}  // namespace feltgate
