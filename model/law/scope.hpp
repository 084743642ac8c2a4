// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the names of a law file mean, while it is read from top to bottom. Documentation:
// docs/laws.md
#pragma once

#include <map>
#include <string>
#include <vector>

#include "law/graph.hpp"
#include "law/syntax.hpp"

namespace feltgate::law {

struct Symbol {
  Statement::Kind kind = Statement::Kind::let;
  NodeId node = kNone;  ///< of a value
  int index = -1;       ///< of state, table, array, line
  Place place;
  std::string unit_text;  ///< as written where it was defined
  bool used = false;
};

/// Scopes inside each other: the file, and a loop's body. A name is defined once.
class Scope {
 public:
  Scope() : levels_(1) {}

  void open() { levels_.emplace_back(); }
  /// Gives the symbols of the innermost scope, which end here.
  std::map<std::string, Symbol> close();

  /// nullptr where nothing has that name.
  Symbol* find(const std::string& name);
  void define(const std::string& name, const Symbol& symbol) { levels_.back()[name] = symbol; }
  std::vector<std::string> names() const;

 private:
  std::vector<std::map<std::string, Symbol>> levels_;
};

/// Functions and values that the language brings along.
bool is_function(const std::string& name);
bool is_given_value(const std::string& name);
/// Of those, what no value of a law may be called.
bool is_reserved(const std::string& name);
const std::vector<std::string>& given_names();

}  // namespace feltgate::law
