// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds the name that a misspelt word was probably meant to be: keys, parameters, probes, scenes,
// options. Documentation: docs/designs.md
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace feltgate::config {

/// Number of mistakes between two words: letters inserted, left out, replaced, or swapped with
/// their neighbour (optimal string alignment). Upper and lower case are equal, and '-' equals '_'.
inline std::size_t mistakes_between(std::string_view a, std::string_view b) {
  const auto plain = [](char c) {
    return c == '-' ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  std::vector<std::size_t> two_above, above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    two_above = above;
    above = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = plain(a[i - 1]) == plain(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && plain(a[i - 1]) == plain(b[j - 2]) &&
                           plain(a[i - 2]) == plain(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/// The candidate that `word` was probably meant to be, or nothing. One mistake is allowed for every
/// three letters of the word, at most three. If no candidate is that near, the only one that begins
/// with `word` is taken, where `word` has at least three letters. Of equally near candidates the
/// first one wins. `candidates` holds strings.
template <class Names>
std::string nearest(std::string_view word, const Names& candidates) {
  constexpr std::size_t letters_a_mistake = 3, most_mistakes = 3, longest = 100;
  if (word.size() > longest) return {};  // no name is so long; the run time grows with it
  std::size_t best = std::min(word.size() / letters_a_mistake, most_mistakes) + 1;
  std::string found, continued;
  int continuations = 0;
  for (const auto& candidate : candidates) {
    const std::string_view name = candidate;
    const bool comparable = name.size() < word.size() + best && word.size() < name.size() + best;
    const std::size_t mistakes = comparable ? mistakes_between(word, name) : best;
    if (mistakes < best) {
      best = mistakes;
      found = name;
    }
    if (name.substr(0, word.size()) == word) {
      continued = name;
      ++continuations;
    }
  }
  if (!found.empty()) return found;
  return continuations == 1 && word.size() >= letters_a_mistake ? continued : "";
}

/// `did you mean "x"? ` as the start of a message's advice, or an empty string.
template <class Names>
std::string did_you_mean(std::string_view word, const Names& candidates) {
  const std::string name = nearest(word, candidates);
  return name.empty() ? name : "did you mean \"" + name + "\"? ";
}

}  // namespace feltgate::config
