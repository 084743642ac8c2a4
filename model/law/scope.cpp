// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/scope.hpp"

#include <algorithm>

namespace feltgate::law {

namespace {

const std::vector<std::string> kFunctions{"min", "max",  "clamp", "abs",     "sgn", "sin",
                                          "cos", "sqrt", "exp",   "lowpass", "sum"};
/// Built-in names that a law may redefine.
const std::vector<std::string> kFreeFunctions{"floor", "round", "mod", "noise", "log", "atan2"};
const std::vector<std::string> kFreeValues{"time"};
const std::vector<std::string> kValues{"position", "velocity", "tau_hat", "torque",
                                       "pi",       "dt",       "true",    "false"};

bool holds(const std::vector<std::string>& all, const std::string& name) {
  return std::find(all.begin(), all.end(), name) != all.end();
}

}  // namespace

std::map<std::string, Symbol> Scope::close() {
  std::map<std::string, Symbol> last = std::move(levels_.back());
  levels_.pop_back();
  return last;
}

Symbol* Scope::find(const std::string& name) {
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
    const auto found = level->find(name);
    if (found != level->end()) return &found->second;
  }
  return nullptr;
}

std::vector<std::string> Scope::names() const {
  std::vector<std::string> all;
  for (const auto& level : levels_) {
    for (const auto& [name, symbol] : level) all.push_back(name);
  }
  return all;
}

bool is_function(const std::string& name) {
  return holds(kFunctions, name) || holds(kFreeFunctions, name);
}
bool is_reserved(const std::string& name) {
  return holds(kFunctions, name) || holds(kValues, name);
}
bool is_given_value(const std::string& name) {
  return holds(kValues, name) || holds(kFreeValues, name);
}

const std::vector<std::string>& given_names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = kValues;
    for (const auto* more : {&kFreeValues, &kFunctions, &kFreeFunctions}) {
      names.insert(names.end(), more->begin(), more->end());
    }
    return names;
  }();
  return all;
}

}  // namespace feltgate::law
