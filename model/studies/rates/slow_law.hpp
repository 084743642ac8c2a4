// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compiles a law for a rate below the fastest one. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <string>

#include "law/compile.hpp"

namespace feltgate::rates {

/// Source of a law: a file, or a text with its name in messages.
struct LawSource {
  std::string path;
  std::string text;  ///< empty: the file at `path`
};

/// Reads the law for a rate in Hz; 0: for the file's rate, or without a rate if it gives none.
law::Law read(const LawSource& source, double rate_hz);

/// Whether the law uses dt or a filter. Its states may then be springs and masses, which the slope
/// of the torque in one run does not show.
bool keeps_time(const LawSource& source);

/// Compiles the law for the rate of its file, or else for the fastest rate.
law::Compiled fastest(const LawSource& source, const law::Target& target);

/// The same law, but states and outputs change only in every `runs`-th run, beginning with the
/// first; outputs are held in between. Events also happen only in these runs.
law::Law held(law::Law law, int runs, const law::Target& target);

/// The law with `gain` times its torques, which end at 12 Nm.
law::Law scaled(law::Law law, double gain);

/// Compiles the law for a run every `ticks` ticks, by the engine's divider; beyond the divider's
/// range the law is held for several runs. Throws LawError, Refused, and std::invalid_argument for
/// a law with a delay line, which counts runs and so behaves differently at another rate.
law::Compiled at_rate(const LawSource& source, const law::Target& target, int ticks);

}  // namespace feltgate::rates
