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
  /// The words in the order of writing.
  static constexpr int places[words] = {Map::R::tick,    Map::R::position, Map::R::faults,
                                        Map::R::encoder, Map::R::index,    Map::R::velocity,
                                        Map::R::tau_hat, Map::R::tau_ref,  Map::R::current_ref,
                                        Map::R::voltage, Map::R::duty,     Map::R::status};
  SnapshotWord word;
  std::uint32_t read_data() const { return read_data_; }

  /// A word is taken in this clock.
  bool goes() const { return next_ < words && (next_ < early || done_); }
  /// `begin`: tau_ref is new. `end`: duty is new.
  void clock(Memory& m, bool tick, bool begin, bool end, bool freeze, bool thaw, const Values& v,
             int read_addr) {
    read(m, read_addr);
    if (word.valid) m[place(bank_, word.place)] = word.data;
    const bool goes = this->goes();
    word.valid = goes;
    if (goes) word.place = places[next_], word.data = value(next_, v);
    next_ = begin ? 0 : next_ + goes;
    done_ = end || (done_ && !begin);
    end_tick(tick, freeze, thaw);
  }
  /// All words of a tick at once, before its last clock.
  void tick(Memory& m, const Values& v) {
    using R = Map::R;
    std::uint32_t* const to = &m[place(bank_, 0)];
    const auto put = [to](int at, std::int64_t data) { to[at] = static_cast<std::uint32_t>(data); };
    put(R::tick, v.tick);
    put(R::position, v.position);
    put(R::faults, v.faults);
    put(R::encoder, v.encoder);
    put(R::index, v.index);
    put(R::velocity, v.velocity);
    put(R::tau_hat, v.tau_hat);
    put(R::tau_ref, v.tau_ref);
    put(R::current_ref, v.current);
    put(R::voltage, v.voltage);
    put(R::duty, v.duty);
    put(R::status, v.status);
    word = {false, places[words - 1], v.status};
    next_ = words;
    done_ = true;
  }
  /// The word at a place of the snapshot, 0 where there is none.
  static std::uint32_t at(int place, const Values& v) {
    for (int n = 0; n < words; ++n) {
      if (places[n] == place) return value(n, v);
    }
    return 0;
  }
  /// The word at a place, of the running or of the last tick.
  std::uint32_t at(const Memory& m, bool last, int to) const {
    return m[place(last && !frozen_ ? !bank_ : bank_, to)];
  }
  bool rests() const { return next_ == words && !word.valid; }
  /// What the port read in a tick as a whole, after its end.
  void settle(const Memory& m, int read_addr) {
    read_ = read_data_ = m[place(frozen_ ? !bank_ : bank_, read_addr & 63)];
  }
  void end_tick(bool tick, bool freeze, bool thaw) {
    if (tick && !frozen_) bank_ = !bank_;
    frozen_ = freeze || (frozen_ && !thaw);
  }
  /// The host's port, which has no reset.
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
  static std::uint32_t value(int n, const Values& v) {
    const std::int64_t data[words] = {v.tick,    v.position, v.faults,  v.encoder,
                                      v.index,   v.velocity, v.tau_hat, v.tau_ref,
                                      v.current, v.voltage,  v.duty,    v.status};
    return static_cast<std::uint32_t>(data[n]);
  }

  int next_ = words;
  bool done_ = false, bank_ = false, frozen_ = false;
  std::uint32_t read_ = 0, read_data_ = 0;
};

}  // namespace feltgate::axis
