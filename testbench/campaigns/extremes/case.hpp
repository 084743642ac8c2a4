// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The extremes as named cases. Each case computes the expected result and measures it in RTL, twin
// and floating point. The tests, `feltgate extremes` and docs/extremes.md use the same list.
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

struct Outcome {
  std::vector<Finding> findings;
  std::int64_t mismatches = 0;  ///< clocks in which RTL and twin showed different outputs
  std::string first_mismatch;
  double rtl_s = 0, twin_s = 0;  ///< device time simulated
  std::string note;              ///< the part of the case that each engine ran

  bool holds() const;
};

struct Settings {
  std::string root;                           ///< the repository
  std::function<void(double done)> progress;  ///< progress of a long case, 0..1; may be empty
};

struct Case {
  const char* group;
  const char* name;
  const char* about;  ///< one sentence for the page
  bool long_only;     ///< an hour of CPU time: runs only with --long
  Outcome (*run)(const Settings&);
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

}  // namespace feltgate::extremes
