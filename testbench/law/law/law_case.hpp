// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Short ways to a law and its numbers, for tests. Documentation: docs/laws.md
#pragma once

#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "catch.hpp"
#include "law/evaluate.hpp"
#include "law/read_law.hpp"

namespace feltgate::law {

/// What is wrong with a text, without the file's name, a line each; "read" where nothing is.
inline std::string messages_of(const std::string& text) {
  try {
    (void)read_law_text(text, "x.law");
  } catch (const LawError& error) {
    std::string all;
    for (const Diagnostic& d : error.diagnostics()) all += message("", d).substr(1) + "\n";
    return all.substr(0, all.size() - 1);
  }
  return "read";
}

/// The law of a text in which nothing is wrong.
inline Law law_of(const std::string& text, double rate_hz = 0) {
  try {
    return read_law_text(text, "a.law", rate_hz);
  } catch (const LawError& error) {
    FAIL(error.what());
    throw;
  }
}

inline Law shipped(const std::string& name) {
  try {
    return read_law(FELTGATE_ROOT "/rtl/laws/" + name + ".law");
  } catch (const LawError& error) {
    FAIL(error.what());
    throw;
  }
}

/// The laws of docs/laws.md.
inline std::vector<std::string> laws_of_page() {
  std::ifstream page(FELTGATE_ROOT "/docs/laws.md");
  std::vector<std::string> laws;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = line == "```law";
      if (inside) laws.emplace_back();
    } else if (inside) {
      laws.back() += line + "\n";
    }
  }
  return laws;
}

/// A law that runs, with inputs and parameters by name. Unnamed inputs are 0.
template <class N = double>
class Running {
 public:
  explicit Running(Law law, Tables tables = Tables::exact)
      : law_(std::move(law)), evaluation_(law_, tables) {}
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void set(const std::string& parameter, N si) { evaluation_.set_parameter(index(parameter), si); }

  /// The torque of axis 0 after a run.
  N torque(const std::map<std::string, N>& inputs) {
    std::vector<N> values;
    for (const Input& input : law_.inputs) {
      const auto found = inputs.find(input.name);
      values.push_back(found == inputs.end() ? N{0} : found->second);
    }
    evaluation_.run(values);
    return output(0);
  }
  /// The torque of an axis in the last run.
  N output(int axis) const {
    for (std::size_t i = 0; i < law_.outputs.size(); ++i) {
      if (law_.outputs[i].axis == axis) return evaluation_.outputs()[i];
    }
    throw std::runtime_error("no such axis");
  }

  std::size_t index(const std::string& parameter) const {
    for (std::size_t i = 0; i < law_.parameters.size(); ++i) {
      if (law_.parameters[i].name == parameter) return i;
    }
    throw std::runtime_error("no parameter " + parameter);
  }

  const Law& law() const { return law_; }
  Evaluation<N>& evaluation() { return evaluation_; }

 private:
  Law law_;
  Evaluation<N> evaluation_;
};

/// The torque of a text at x = position; no number where it cannot be read.
inline double torque_of(const std::string& text, double x = 0) {
  const std::string messages = messages_of(text);
  UNSCOPED_INFO(messages);
  if (messages != "read") return std::nan("");
  return Running<>(law_of(text)).torque({{"position", x}});
}

}  // namespace feltgate::law
