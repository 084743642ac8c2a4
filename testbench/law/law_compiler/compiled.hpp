// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws of the tests through the compiler, for the default target, and their runs beside their
// bounds. docs/laws.md
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "law/compile.hpp"
#include "law/diagnostics.hpp"
#include "law/measure.hpp"
#include "mismatch.hpp"

namespace feltgate::law {

/// Errors: LawError, with x.law as the file.
inline Compiled compiled(const std::string& text) { return compile_text(text, "x.law", Target{}); }

/// What the compiler says against a law; "compiled" where it says nothing.
inline std::string refusal(const std::string& text) {
  try {
    (void)compiled(text);
  } catch (const LawError& e) {
    return e.what();
  }
  return "compiled";
}

/// A law of rtl/laws, compiled once.
inline const Compiled& compiled_shipped(const std::string& name) {
  static std::map<std::string, Compiled> known;
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  return known[name] = compile_file(FELTGATE_ROOT "/rtl/laws/" + name + ".law", Target{});
}

/// The names of the laws of rtl/laws, sorted.
inline std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(FELTGATE_ROOT "/rtl/laws")) {
    if (entry.path().extension() == ".law") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A law of constructs.txt.
struct Construct {
  std::string name;
  int instructions = 0;  ///< no more
  double bound_nm = 0;   ///< no more
  std::string text;
};

inline std::vector<Construct> constructs() {
  std::ifstream file(FELTGATE_ROOT "/testbench/law/constructs.txt");
  std::vector<Construct> all;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("== ", 0) == 0) {
      Construct& c = all.emplace_back();
      std::istringstream(line.substr(3)) >> c.name >> c.instructions >> c.bound_nm;
    } else if (!all.empty()) {
      all.back().text += line + "\n";
    }
  }
  return all;
}

/// The number of runs of a law: more in a whole run.
inline std::int64_t runs_of(std::int64_t usual) { return test::whole_run() ? 20000 : usual; }

/// The measured errors are within the bound, which does not cover the runs in strips: few.
inline void check_within(const Compiled& c, const Measured& m) {
  CHECK(m.in_strips * 20 <= m.runs);
  for (std::size_t o = 0; o < m.output.size(); ++o) {
    INFO(c.law.name << " output " << o << ": measured " << m.output[o] << ", bound "
                    << c.bound.output[o]);
    // The law itself runs in double.
    CHECK(m.output[o] <= c.bound.output[o] * (1 + 1e-9) + 1e-8);
  }
}

}  // namespace feltgate::law
