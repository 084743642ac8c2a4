// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The table of the cases: on a terminal, as JSON, and as the record table.md.
// Documentation: docs/extremes.md
#pragma once

#include <string>
#include <vector>

#include "campaigns/extremes/case.hpp"

namespace feltgate::extremes {

/// A case that has run.
struct Result {
  Case which;
  Outcome outcome;
};

/// Four digits, no trailing zeros.
std::string number(double value);

/// One case as text for a terminal.
std::string text(const Result& result);

/// All results as a JSON object.
std::string json(const std::vector<Result>& results);

/// The rows of one case in the form of the page, with its heading.
std::string markdown(const Result& result);

/// Returns the text of the record table.md. The section of a long case that has not run is copied from
/// `before`, the old page.
std::string page(const std::vector<Result>& results, const std::string& before);

/// Lists the rows of the committed `page` that differ from `result`, one line each. A measured
/// value may differ by 1 % (another libm); a value marked chaotic is not compared.
std::vector<std::string> stale_rows(const std::string& page, const Result& result);

}  // namespace feltgate::extremes
