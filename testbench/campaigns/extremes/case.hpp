// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The extremes as named cases. Each case computes the expected result and measures it in RTL, twin
// and floating point. The tests and `feltgate extremes` use the same list; the table of what was
// found is on record in table.md. Documentation: docs/extremes.md
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace feltgate::extremes {

/// The expected result: a value in [low, high], and the text for the table.
struct Expected {
  double low = 0, high = 0;
  std::string text;  ///< text in the table
};
Expected exactly(double value);
Expected near(double value, double tolerance);
Expected between(double low, double high);
Expected at_most(double value);
Expected at_least(double value);

/// One row of the table. A column without a value was not measured.
struct Finding {
  std::string what, unit;
  Expected expected;
  std::optional<double> rtl, twin, real;
  bool real_may_differ = false;  ///< row about quantisation: the bounds do not apply to `real`
  bool chaotic = false;          ///< digits depend on the last bit of the plant: not compared

  bool holds() const;
};

/// What runs: RTL and twin, whose outputs are compared on every clock, or the twin alone.
enum class Cores { lock_step, twin };

struct Outcome {
  std::vector<Finding> findings;
  std::int64_t mismatches = 0;  ///< clocks in which RTL and twin showed different outputs
  std::string first_mismatch;
  double rtl_s = 0, twin_s = 0;  ///< device time simulated
  std::string note;              ///< the part of the case that each engine ran

  bool holds() const;
  /// A row of these three columns.
  Finding& add(const std::string& what, const std::string& unit, const Expected& expected,
               std::optional<double> rtl, std::optional<double> twin,
               std::optional<double> real = {});
  /// A row whose core column is of RTL and twin, or of the twin alone.
  Finding& add(Cores cores, const std::string& what, const std::string& unit,
               const Expected& expected, std::optional<double> core,
               std::optional<double> real = {});
};

struct Settings {
  std::string root;                           ///< the repository
  std::function<void(double done)> progress;  ///< progress of a long case, 0..1; may be empty
};

struct Case {
  const char* group;
  const char* name;
  const char* about;  ///< one sentence for the page
  Outcome (*run)(const Settings&);
  bool long_only = false;  ///< an hour of CPU time: runs only with --long
};

/// Every case, in the order of the page.
std::vector<Case> cases();

// The groups, one source file each.
std::vector<Case> encoder_cases();
std::vector<Case> velocity_cases();
std::vector<Case> filter_cases();
std::vector<Case> observer_cases();
std::vector<Case> scene_cases();
std::vector<Case> loop_cases();
std::vector<Case> engine_cases();
std::vector<Case> axes_cases();
std::vector<Case> day_cases();

/// A case that has run.
struct Result {
  Case which;
  Outcome outcome;
};

/// Four digits, no trailing zeros.
std::string number(double value);

/// All results as a JSON object.
std::string json(const std::vector<Result>& results);

/// One case with its rows and its heading, for a terminal and in the form of the record.
std::string markdown(const Result& result);

/// Returns the text of the record table.md. The section of a long case that has not run is copied
/// from `before`, the old page.
std::string page(const std::vector<Result>& results, const std::string& before);

/// Lists the rows of the committed `page` that differ from `result`, one line each. A measured
/// value may differ by 1 % (another libm); a value marked chaotic is not compared.
std::vector<std::string> stale_rows(const std::string& page, const Result& result);

}  // namespace feltgate::extremes
