// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Common parts of the commands that make a law from a drawing or an image.
// Documentation: docs/devices/shapes.md
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>

#include "apps/commands/commands.hpp"
#include "apps/commands/law_target.hpp"
#include "files/output_file.hpp"
#include "law/compile.hpp"
#include "law/listing.hpp"
#include "law/measure.hpp"
#include "law/verdict.hpp"

namespace feltgate {

/// The exit code of a command that makes a law; prints the failures again as the last lines.
inline int end_of(const law::Verdict& verdict) {
  for (const std::string& f : verdict.failures) fmt::print(stderr, "feltgate: failed: {}\n", f);
  return verdict.failures.empty() ? exit_ok : exit_failed;
}

/// Compiles and measures the text of a law, writes it to `file` unless that is null, says `said`
/// and the compiler's report. Returns the exit code.
inline int make_law(const std::string& text, const std::string& name, const std::string& design,
                    const std::string& said, files::OutputFile* file, files::Outputs* outputs) {
  const law::Compiled c = law::compile_text(text, name, law_target(design));
  const law::Measured m = law::measure(c, 1, 20000);
  if (file != nullptr) file->write(text);
  outputs->say(said + "\n" + law::report(c, m));
  outputs->commit();
  return end_of(law::verdict(c, m));
}

/// Returns make(); adds the name of the file to its errors.
template <class Make>
auto of_file(const std::string& file, const Make& make) {
  try {
    return make();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(fmt::format("{}:1: {}", file, e.what()));
  }
}

/// A finite number of at least `low` (CLI::Range would accept a NaN); shows nothing in the help.
inline CLI::Validator finite(double low = -1e300) {
  return {[low](std::string& text) {
            double value = 0;
            if (!CLI::detail::lexical_cast(text, value)) return text + " is no number";
            if (!std::isfinite(value)) return text + " is no finite number; give one";
            if (value < low) return fmt::format("{:g} is too small; give {:g} or more", value, low);
            return std::string();
          },
          ""};
}

/// Adds an option for a length with its unit, mm or m; `value` receives m.
inline CLI::Option* add_length(CLI::App& to, const std::string& name, double* value,
                               const std::string& what) {
  static const std::map<std::string, double> units{{"mm", 1e-3}, {"m", 1.0}};
  return to.add_option(name, *value, what)
      ->type_name("LENGTH")
      ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::UNIT_REQUIRED))
      ->check(finite());
}

/// Adds the options for the spring and the damper of a law.
template <class Request>
void add_spring(CLI::App& to, Request* request, double most_n_per_m, double most_ns_per_m) {
  to.add_option("--stiffness", request->stiffness_n_per_m, "N/m at first; the host may change it")
      ->type_name("N/m")
      ->check(CLI::Range(0.0, most_n_per_m))
      ->check(finite())
      ->capture_default_str();
  to.add_option("--damping", request->damping_ns_per_m, "N s/m, likewise")
      ->type_name("N s/m")
      ->check(CLI::Range(0.0, most_ns_per_m))
      ->check(finite())
      ->capture_default_str();
}

inline void add_design(CLI::App& to, std::string* design) {
  to.add_option("--design", *design, "design point in rtl/designs")
      ->type_name("DESIGN")
      ->capture_default_str();
}

}  // namespace feltgate
