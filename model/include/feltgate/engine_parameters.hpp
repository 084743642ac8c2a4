// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twins of the engine's parts for parameters, mailbox and delay lines, clock by clock.
// Documentation: docs/blocks/engine.md
#pragma once

#include "feltgate/generated/engine.hpp"

namespace feltgate::law {
template <int AxisCount>
class EngineRuns;
}  // namespace feltgate::law

namespace feltgate {

/// Twin of rtl/engine/engine_commit.sv: checks a parameter set against its ranges, one word after
/// another, and switches to the other bank with the next tick.
class EngineCommit {
 public:
  struct In {
    /// commit: a request. wait: the check must not start. beat: `negative` is a comparison's
    /// result.
    bool commit = false, wait = false, tick = false, beat = false, negative = false;
    unsigned running = 0;   ///< threads in a run, one bit each
    int mailbox_first = 0;  ///< first word of the mailbox
  };

  int bank = 0;          ///< in force
  bool differs = false;  ///< the last commit changed a word below mailbox_first
  bool checking = false, refused = false;
  int refused_word = 0;

  /// Whether a commit is in progress: to the end of the last run that uses the old set.
  bool committing() const { return wanted_ || checking || passed_ || old_ != 0; }
  /// Whether the other bank comes into force with the next clock.
  bool taken(bool tick) const { return passed_ && tick; }
  /// Whether this beat subtracts.
  bool minus() const { return checking && (beat_ & 1) != 0; }
  /// Address in data memory that this beat reads.
  int address() const {
    using D = EngineMap::D;
    const int word = beat_ >> 3 & 31, step = beat_ & 7;
    if (step == 1 || step == 2) return (step == 1 ? D::lower : D::upper) + word;
    const bool other = step == 5 || step == 6 ? bank == 0 : bank != 0;
    return (other ? D::parameter : D::parameter_bank) + word;
  }

  void clock(const In& in) {
    const bool begins = wanted_ && !in.wait, takes = taken(in.tick);
    const bool was_committing = committing();
    old_ &= in.running;
    if (checking && in.beat) {
      const bool negative = in.negative && beat_ % 2 == 0 && beat_ > 1;
      const int of = beat_ & 6;  // 2, 4: an end of the range; 6, 0: the word in force
      const bool range = of == 2 || of == 4, was_refused = refused;
      if (negative && range && !refused) {
        refused = true;
        refused_word = beat_ >> 3 & 31;
      }
      if (negative && !range && beat_ <= in.mailbox_first * 8) differs = true;
      if (beat_ == 256) {
        checking = false;
        passed_ = !was_refused;
      }
      beat_ = (beat_ + 1) & 511;
    }
    if (in.commit && !was_committing) wanted_ = true;
    if (begins) {
      wanted_ = false;
      checking = true;
      refused = differs = false;
      beat_ = 0;
    }
    if (takes) {
      passed_ = false;
      bank = 1 - bank;
      old_ = in.running;
    }
  }

 private:
  bool wanted_ = false, passed_ = false;
  int beat_ = 0;
  unsigned old_ = 0;
};

/// Twin of rtl/engine/engine_mailbox.sv: the age of the mailbox, and when torques may jump.
class EngineMailbox {
 public:
  struct In {
    bool tick = false, step = false, watched = false;  ///< step: this tick counts
    unsigned max_age = 0;                              ///< in counted ticks
    bool taken = false, differs = false;  ///< a new set is in force; it differs in a parameter
  };

  bool jumps = false;  ///< one clock: torques may jump from now on

  /// Whether the mailbox is too old.
  bool late(bool watched) const { return late_ && watched; }

  void clock(const In& in) {
    const bool counts = in.tick && in.step;
    const bool ends = counts && age_ >= in.max_age;
    jumps = in.taken ? in.differs || late(in.watched) : ends && in.watched && !late_;
    late_ = (late_ || ends) && !in.taken;
    if (in.taken) {
      age_ = 0;
    } else if (counts) {
      age_ = (age_ + 1) & 0xffffU;
    }
  }

 private:
  template <int AxisCount>
  friend class law::EngineRuns;

  unsigned age_ = 0;
  bool late_ = true;  // late after a reset: nothing was fed yet
};

/// Twin of rtl/engine/engine_lines.sv: clears the delay lines in table memory.
class EngineLines {
 public:
  bool clearing = false;
  int address = 0;  ///< table word that is cleared next

  /// Whether that word is cleared now.
  bool taken(int line_base, bool free) const {
    return clearing && wait_ == 0 && free && line_base < EngineMap::table_words;
  }

  void clock(bool enter, int line_base, bool free) {
    const bool takes = taken(line_base, free);
    const bool none = line_base >= EngineMap::table_words;
    if (wait_ > 0) --wait_;
    if (enter) {
      clearing = !none;
      wait_ = 2;
      address = EngineMap::table_words - 1;
      return;
    }
    if (none || (takes && address == line_base)) clearing = false;
    if (takes) address = (address - 1) & (EngineMap::table_words - 1);
  }

 private:
  int wait_ = 0;
};

}  // namespace feltgate
