// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/host/snapshot.sv: all words of a tick for the host, in two banks. The words go one a
// clock, the chain's last ones after its end. docs/blocks/host.md
#pragma once

#include <array>

#include "feltgate/axis/signals.hpp"

namespace feltgate::axis {

class Snapshot {
 public:
  using Memory = std::array<std::uint32_t, 128>;
  static constexpr int words = 12, early = 9;
  SnapshotWord word;
  std::uint32_t read_data() const { return read_data_; }

  /// `begin`: tau_ref is new. `end`: duty is new.
  void clock(Memory& m, bool tick, bool begin, bool end, bool freeze, bool thaw, const Values& v,
             int read_addr) {
    read(m, read_addr);
    if (word.valid) m[place(bank_, word.place)] = word.data;
    const bool goes = next_ < words && (next_ < early || done_);
    word.valid = goes;
    if (goes) take(next_, v);
    next_ = begin ? 0 : next_ + goes;
    done_ = end || (done_ && !begin);
    end_tick(tick, freeze, thaw);
  }
  /// All words of a tick at once, before its last clock.
  void tick(Memory& m, const Values& v, int read_addr) {
    using C = Map::C;
    std::uint32_t* const to = &m[place(bank_, 0)];
    const auto put = [to](int address, std::int64_t data) {
      to[address - C::snapshot] = static_cast<std::uint32_t>(data);
    };
    put(C::read_tick, v.tick);
    put(C::read_position, v.position);
    put(C::read_faults, v.faults);
    put(C::read_encoder, v.encoder);
    put(C::read_index, v.index);
    put(C::read_velocity, v.velocity);
    put(C::read_tau_hat, v.tau_hat);
    put(C::read_tau_ref, v.tau_ref);
    put(C::read_current_ref, v.current);
    put(C::read_voltage, v.voltage);
    put(C::read_duty, v.duty);
    put(C::read_status, v.status);
    word = {false, C::read_status - C::snapshot, v.status};
    next_ = words;
    done_ = true;
    read(m, read_addr);
    read(m, read_addr);
  }
  bool rests() const { return next_ == words && !word.valid; }
  void end_tick(bool tick, bool freeze, bool thaw) {
    if (tick && !frozen_) bank_ = !bank_;
    frozen_ = freeze || (frozen_ && !thaw);
  }
  /// The host's port has no reset.
  void read(const Memory& m, int read_addr) {
    read_data_ = read_;
    read_ = m[place(!bank_, read_addr & 63)];
  }
  void reset() {
    next_ = words;
    done_ = bank_ = frozen_ = false;
    word = {};
  }

 private:
  static std::size_t place(bool bank, int place) {
    return static_cast<std::size_t>((bank ? 64 : 0) + place);
  }
  /// The words in the order of writing.
  void take(int n, const Values& v) {
    using C = Map::C;
    static constexpr int at[words] = {C::read_tick,    C::read_position, C::read_faults,
                                      C::read_encoder, C::read_index,    C::read_velocity,
                                      C::read_tau_hat, C::read_tau_ref,  C::read_current_ref,
                                      C::read_voltage, C::read_duty,     C::read_status};
    const std::int64_t data[words] = {v.tick,    v.position, v.faults,  v.encoder,
                                      v.index,   v.velocity, v.tau_hat, v.tau_ref,
                                      v.current, v.voltage,  v.duty,    v.status};
    word.place = at[n] - C::snapshot;
    word.data = static_cast<std::uint32_t>(data[n]);
  }

  int next_ = words;
  bool done_ = false, bank_ = false, frozen_ = false;
  std::uint32_t read_ = 0, read_data_ = 0;
};

}  // namespace feltgate::axis
