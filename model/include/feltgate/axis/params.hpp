// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/host/params.sv, the parameters: a RAM of 512 words with check bits, and a register
// for each word that a block takes. The first clocks of a tick load the words of its scene, the
// others go round the common words. docs/blocks/host.md
#pragma once

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

/// RAM and registers. A reset does not change them.
struct ParamsMemory {
  static constexpr int places[5] = {1, 2, 3, 6, 10};  ///< of a scene's words in its bank
  std::array<std::uint64_t, 512> ram{};               ///< word, and above it the check
  Words<std::int64_t> p;
  int scene = -1;     ///< scene whose words p holds; -1: not known
  bool whole = true;  ///< RAM and registers agree, all checks are right

  static std::uint64_t checked(std::uint32_t word) {
    const std::uint32_t half = word >> 16 ^ word, quarter = half >> 8 ^ half;
    return std::uint64_t{((quarter >> 4 ^ quarter) & 15) ^ 5} << 32 | word;
  }
  ParamsMemory(const Design& d, const WordFormats& formats) {
    ram.fill(checked(0));
    for (const Word& w : d.words) {
      ram[static_cast<std::size_t>(w.address)] = checked(w.reset);
      formats.load(p, w.address, w.reset);
    }
  }
  /// Whether all checks are right, and each common word is in its register.
  bool agrees(const WordFormats& formats) const {
    for (int address = 0; address < 512; ++address) {
      const std::uint32_t of = word(address);
      if (ram[static_cast<std::size_t>(address)] != checked(of)) return false;
      if (address < 64 && !formats.holds(p, address, of)) return false;
    }
    return true;
  }
  /// Fault injection: inverts a bit of a word, or from bit 32 on of its check.
  void flip(int address, int bit) {
    ram[static_cast<std::size_t>(address)] ^= std::uint64_t{1} << bit;
    whole = false;
  }
  /// The words of a scene, by a tick as a whole.
  void load_scene(const WordFormats& formats, int of) {
    if (scene == of) return;
    for (const int place : places) formats.load_scene(p, place, word(of * 32 + place));
    scene = of;
  }
  std::uint32_t word(int address) const {
    return static_cast<std::uint32_t>(ram[static_cast<std::size_t>(address)]);
  }
};

class Params {
 public:
  bool word_error() const { return error_; }
  std::uint32_t read_data() const { return read_data_; }

  /// `clock`: of the tick. `scene`: of the tick. `write`: in its last clock.
  void clock(ParamsMemory& m, const WordFormats& formats, int clock, int scene, bool write,
             int address, std::uint32_t data, int read_addr) {
    read(m, read_addr);
    // Into its register: a word that is written, or the one that was fetched.
    if (write) {
      load(m, formats, address, data);
    } else if (good_) {
      load(m, formats, good_place_, word_);
    }
    take();
    good_ = good_ && !write;
    fetched_ = warm_ && !write;
    warm_ = true;
    fetch(m, clock, scene);
    if (write) {
      m.ram[static_cast<std::size_t>(address)] = ParamsMemory::checked(data);
      if (address >= 64) m.scene = -1;
      m.whole = m.whole || m.agrees(formats);
    }
  }
  /// All clocks of a tick without a write, if RAM and registers agree; then settle().
  void tick(int clocks) { next_ = (next_ + clocks - 5) & 63; }
  /// The last fetches and reads of a tick as a whole.
  void settle(const ParamsMemory& m, int read_addr) {
    next_ = (next_ - 2) & 63;
    fetched_ = true;
    fetch(m, 5, 0);
    take();
    fetch(m, 5, 0);
    read(m, read_addr);
    read(m, read_addr);
    warm_ = true;
  }
  /// The host's port has no reset.
  void read(const ParamsMemory& m, int read_addr) {
    read_data_ = read_;
    read_ = m.word(read_addr & 511);
  }
  /// After a reset; the port goes on.
  void reset() {
    place_ = next_ = 0;
    fetched_ = warm_ = good_ = error_ = false;
  }

 private:
  /// Of the word that was fetched.
  void take() {
    word_ = static_cast<std::uint32_t>(fetch_);
    good_place_ = place_;
    error_ = fetched_ && fetch_ != ParamsMemory::checked(word_);
    good_ = fetched_ && !error_;
  }
  void fetch(const ParamsMemory& m, int clock, int scene) {
    const bool of_scene = clock < 5;
    const int place = of_scene ? ParamsMemory::places[clock] : next_;
    place_ = of_scene ? 15 * 32 + place : place;
    fetch_ = m.ram[static_cast<std::size_t>(of_scene ? scene * 32 + place : place)];
    if (!of_scene) next_ = (next_ + 1) & 63;
  }
  static void load(ParamsMemory& m, const WordFormats& formats, int to, std::uint32_t word) {
    if (to < 64) {
      formats.load(m.p, to, word);
    } else if (to >> 5 == 15) {
      m.scene = -1;
      for (const int place : ParamsMemory::places) {
        if (place == (to & 31)) formats.load_scene(m.p, place, word);
      }
    }
  }

  int place_ = 0, next_ = 0;
  std::uint64_t fetch_ = 0;
  bool fetched_ = false, warm_ = false, error_ = false;
  std::uint32_t word_ = 0;  ///< into its register in the next clock, if good_
  int good_place_ = 0;
  bool good_ = false;
  std::uint32_t read_ = 0, read_data_ = 0;
};

}  // namespace feltgate::axis
