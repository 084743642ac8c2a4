// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The first difference that a lock-step run finds, and its report. Documentation: docs/testing.md
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

namespace feltgate::test {

/// The first difference between RTL and twin, or the first broken property.
struct Mismatch {
  std::int64_t cycle = 0;
  const char* signal = nullptr;  ///< port name, or the text of the property
  const char* instant = "";      ///< before or after the rising edge
  bool is_property = false;      ///< if true, rtl and twin have no meaning
  std::int64_t rtl = 0;
  std::int64_t twin = 0;
};

/// The low W bits of a word as a two's complement number, 1 <= W <= 64. Verilator gives signed
/// ports of odd widths as unsigned words.
template <int W, class Word>
constexpr std::int64_t sign_extend(Word word) {
  static_assert(W >= 1 && W <= 64 && std::is_unsigned<Word>::value, "");
  constexpr std::uint64_t sign = std::uint64_t{1} << (W - 1);
  constexpr std::uint64_t mask = sign + (sign - 1);
  return static_cast<std::int64_t>(((word & mask) ^ sign) - sign);
}

/// The low W bits of a signed number, in the form that Verilator needs for input ports.
template <int W, class Word = std::uint32_t>
constexpr Word port_bits(std::int64_t value) {
  static_assert(W >= 1 && W < 64, "");
  return static_cast<Word>(static_cast<std::uint64_t>(value) & ((std::uint64_t{1} << W) - 1));
}

/// Compares values; keeps only the first difference, so that the code for equal values stays short.
class Check {
 public:
  template <class RtlWord, class TwinWord>
  void operator()(const char* signal, RtlWord rtl, TwinWord twin) {
    static_assert(sizeof(RtlWord) <= 8 && sizeof(TwinWord) <= 8, "compare wide words in parts");
    std::int64_t rtl_value;
    if constexpr (std::is_signed<TwinWord>::value && sizeof(TwinWord) == sizeof(RtlWord)) {
      rtl_value = static_cast<TwinWord>(rtl);  // a full-width signed port
    } else {
      rtl_value = static_cast<std::int64_t>(rtl);
    }
    const auto twin_value = static_cast<std::int64_t>(twin);
    if (__builtin_expect(rtl_value != twin_value, 0) && first_.signal == nullptr) {
      first_.signal = signal;
      first_.rtl = rtl_value;
      first_.twin = twin_value;
    }
  }
  bool failed() const { return first_.signal != nullptr; }
  Mismatch& first() { return first_; }

 private:
  Mismatch first_;
};

/// Returns false with a mutant: there only the mismatch is needed, as early as possible.
bool waveform_wanted();

/// Path for the waveform of a mismatch: $FELTGATE_MISMATCH_DIR or <build>/mismatch. Creates the
/// folder.
std::string mismatch_file(const char* block);

/// Ends the test case with a message that names the waveform, and its save file if one is
/// committed.
[[noreturn]] void fail_with(const char* block, std::uint64_t seed, const Mismatch& mismatch,
                            const std::string& waveform);

/// n, or n * $FELTGATE_LONG for the long regression.
std::int64_t scaled_clocks(std::int64_t n);

/// n; in a program of seeded defects, where $FELTGATE_DEFECT chooses one or none, n/4 but at
/// least 1. For seeds that each can catch a defect; what a run must reach is checked without
/// defects.
std::uint64_t seeds_of(std::uint64_t n);

/// True in a program of seeded defects.
bool defects_run();

/// True if $FELTGATE_WHOLE asks for all cases; a usual run tries only a part of them.
bool whole_run();

/// Which of `shares` equal parts of its cases a usual run tries, 0 to shares - 1: another one each
/// week. $FELTGATE_WEEK, a number of weeks since 1970, chooses it again.
std::uint64_t share_of_week(std::uint64_t shares);

/// Whether case `k` of a list is tried: of a usual run one in `shares`, of a whole run each.
bool tried(std::uint64_t k, std::uint64_t shares);

/// The same for a whole test case, which says so where it is left out.
bool case_tried(std::uint64_t k, std::uint64_t shares);

}  // namespace feltgate::test
