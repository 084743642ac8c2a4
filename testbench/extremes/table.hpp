// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The table of the cases: on a terminal, as JSON, and as docs/extremes.md.
// Documentation: docs/extremes.md
#pragma once

#include <string>
#include <vector>

#include "extremes/case.hpp"

namespace feltgate::extremes {

/// A case that has run.
struct Result {
  Case which;
  Outcome outcome;
};

/// Four digits, no trailing zeros.
std::string number(double value);

/// One case for reading on a terminal.
std::string text(const Result& result);

/// All results as a JSON object.
std::string json(const std::vector<Result>& results);

/// The rows of one case as the page has them, with its heading.
std::string markdown(const Result& result);

/// docs/extremes.md; the section of a long case that has not run is taken from `before`, the page
/// as it was.
std::string page(const std::vector<Result>& results, const std::string& before);

/// What in the committed `page` no longer says what `result` says, one line each; a measured value
/// may differ by 1 % (another libm), one marked chaotic is not compared.
std::vector<std::string> stale_rows(const std::string& page, const Result& result);

}  // namespace feltgate::extremes
