// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Seeded changes of an input. Documentation: docs/testing.md
#include <iterator>
#include <sstream>
#include <utility>

#include "fuzz.hpp"

namespace feltgate::fuzz {

namespace {

using test::Random;

constexpr std::size_t kMost = 1U << 16U;  ///< an input never grows beyond this

/// Numbers at the limits of a reader, and texts that are not numbers.
const std::vector<std::string>& numbers() {
  static const std::vector<std::string> all = [] {
    std::istringstream words(
        "0 -0.0 -1 1 2 3 7 40 63 64 65 127 256 1e-9 1e-300 5e-324 1e300 1.8e308 -1e300 1e9 "
        "1e12 1e18 nan -nan inf -inf 1_000 0x7fffffff 2147483648 9223372036854775807 "
        "-9223372036854775808 18446744073709551616 4611686018427387904 0.1 1e-12 00 1e 1. "
        "true 1979-05-27 99999999999999999999999999");
    return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
  }();
  return all;
}

/// Pieces with a meaning in one of the formats.
constexpr const char* kPieces[] = {
    "\n",   "\r\n",    "\"",    "\"\"\"",  "'''",      "\\n",  "\\u0000", "\\",     "[[",
    "]]",   "[",       "]",     "{",       "}",        "=",    "#",       ",",      ";",
    "\t",   " ",       ".",     "-",       "+",        "$end", "$var",    "$scope", "#0",
    "b1 ",  "x",       "z",     "*/",      "/*",       "//",   "\xff",    "\xc3",   "\xef\xbb\xbf",
    "\x7f", "\x1b[2J", "end 9", "probe1=", "logic-1-2"};

std::size_t index_below(Random& random, std::size_t n) { return n == 0 ? 0 : random.below(n); }

bool in_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '.' || c == '-' || c == '+';
}

/// The part of the text around `at` whose characters all satisfy `belongs`.
template <class Belongs>
std::pair<std::size_t, std::size_t> part_at(const std::string& text, std::size_t at,
                                            Belongs belongs) {
  std::size_t begin = at, end = at;
  while (begin > 0 && belongs(text[begin - 1])) --begin;
  while (end < text.size() && belongs(text[end])) ++end;
  return {begin, end - begin};
}

std::string random_part(const std::string& text, Random& random) {
  if (text.empty()) return {};
  const std::size_t begin = index_below(random, text.size());
  return text.substr(begin, 1 + index_below(random, random.coin() ? 8 : 200));
}

std::string random_line(const std::string& text, Random& random) {
  const auto [begin, size] =
      part_at(text, index_below(random, text.size()), [](char c) { return c != '\n'; });
  return text.substr(begin, size) + "\n";
}

std::string random_word(const std::string& text, Random& random) {
  for (int attempt = 0; attempt < 8 && !text.empty(); ++attempt) {
    const std::size_t at = index_below(random, text.size());
    const auto [begin, size] = part_at(text, at, in_word);
    if (size > 0) return text.substr(begin, size);
  }
  return {};
}

/// The word at or after `at`, replaced.
void replace_word(std::string& text, std::size_t at, const std::string& with, bool number) {
  while (at < text.size() && !(number ? text[at] >= '0' && text[at] <= '9' : in_word(text[at]))) {
    ++at;
  }
  if (at >= text.size()) return;
  const auto [begin, size] = part_at(text, at, in_word);
  text.replace(begin, size, with);
}

void change_bytes(std::string& text, std::size_t at, Random& random) {
  if (text.empty()) return;
  char& c = text[at];
  c = static_cast<char>(random.coin() ? random.below(256)
                                      : static_cast<unsigned char>(c) ^ (1U << random.below(8)));
}

void change_once(std::string& text, const std::string& other, Random& random) {
  const std::size_t at = index_below(random, text.size());
  const auto line = [&text](std::size_t i) {
    return part_at(text, i, [](char c) { return c != '\n'; });
  };
  switch (random.below(13)) {
    case 0:
      return change_bytes(text, at, random);
    case 1:
      text.erase(at, 1 + index_below(random, random.coin() ? 4 : 400));
      return;
    case 2:
      text.insert(at, random_part(text, random));
      return;
    case 3:
      text.insert(at, random_part(other, random));
      return;
    case 4:
    case 5:
    case 6:
      return replace_word(text, at, numbers()[index_below(random, numbers().size())], true);
    case 7:
      return replace_word(text, at, random_word(random.coin() ? text : other, random), false);
    case 8: {
      const auto [begin, size] = line(at);
      text.erase(begin, size + 1);
      return;
    }
    case 9: {
      const auto [begin, size] = line(at);
      (void)size;
      text.insert(begin, random_line(random.coin() ? text : other, random));
      return;
    }
    case 10:
      text.insert(at, kPieces[index_below(random, std::size(kPieces))]);
      return;
    case 11:
      return replace_word(text, at, std::to_string(random.between(-300, 300)), true);
    default:
      if (random.one_in(4)) text.resize(at);
  }
}

}  // namespace

std::string mutated(std::string input, const std::string& other, Random& random) {
  for (std::uint32_t left = 1 + random.below(random.coin() ? 2 : 6); left > 0; --left) {
    change_once(input, other, random);
  }
  if (input.size() > kMost) input.resize(kMost);
  return input;
}

}  // namespace feltgate::fuzz
