// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The symbol table of a law file while it is read from top to bottom. Documentation: docs/laws.md
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
  int index = -1;       ///< of a state, table, array or line
  Place place;
  std::string unit_text;  ///< as written in the definition
  bool used = false;
};

/// Nested scopes: the file, and the body of each loop. A name is defined once.
class Scope {
 public:
  Scope() : levels_(1) {}

  void open() { levels_.emplace_back(); }
  /// Closes the innermost scope and returns its symbols.
  std::map<std::string, Symbol> close();

  /// The symbol of a name; nullptr when the name is not defined.
  Symbol* find(const std::string& name);
  void define(const std::string& name, const Symbol& symbol) { levels_.back()[name] = symbol; }
  std::vector<std::string> names() const;

 private:
  std::vector<std::map<std::string, Symbol>> levels_;
};

/// Whether `name` is a built-in function or value of the language.
bool is_function(const std::string& name);
bool is_given_value(const std::string& name);
/// Whether `name` is built in and a law must not define it.
bool is_reserved(const std::string& name);
const std::vector<std::string>& given_names();

}  // namespace feltgate::law
