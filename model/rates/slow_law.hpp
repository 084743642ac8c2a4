// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law at another rate than the one it reaches. Documentation: docs/rates.md
#pragma once

#include <string>

#include "law/compile.hpp"

namespace feltgate::rates {

/// Where a law is read from: a file, or a text with the name that messages call it.
struct LawSource {
  std::string path;
  std::string text;  ///< empty: the file at `path`
};

/// The law as read for a rate; 0: for the file's own, or without one where it gives none.
law::Law read(const LawSource& source, double rate_hz);

/// Whether the law has dt or a filter in it: then its states may be springs and masses, which the
/// torque's slope in one run does not show.
bool keeps_time(const LawSource& source);

/// As fast as it gets, or at the rate of its file.
law::Compiled fastest(const LawSource& source, const law::Target& target);

/// The same law, whose states and outputs change in every `runs`-th run only, the first one
/// included; the outputs are held between. Its events happen in these runs too.
law::Law held(law::Law law, int runs, const law::Target& target);

/// The law with a run every `ticks` ticks: by the engine's divider, and where that does not reach
/// so far, held for several of its runs. Errors: LawError, Refused; and std::invalid_argument for a
/// law with a delay line, which counts runs and is another law at another rate.
law::Compiled at_rate(const LawSource& source, const law::Target& target, int ticks);

}  // namespace feltgate::rates
