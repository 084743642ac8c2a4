// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The syntax tree of a law file: statements and expressions, before names and units are resolved.
// Documentation: docs/laws.md
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "law/diagnostics.hpp"
#include "law/units.hpp"

namespace feltgate::law {

struct Expression;
using ExpressionPtr = std::shared_ptr<const Expression>;

struct Expression {
  enum class Kind {
    number,  ///< value, unit
    name,
    call,    ///< name(arguments)
    index,   ///< name[argument]
    unary,   ///< name: "-" or "not"
    binary,  ///< name: the operator
    power,   ///< argument to the whole power `value`
    choice,  ///< if, then, else
    reduce,  ///< name: "sum", "min", "max"; over `variable` from, to, body
  };
  Kind kind = Kind::number;
  std::size_t offset = 0;  ///< in the text; for a binary expression, of its operator
  std::string name, variable;
  double value = 0;  ///< as written, without the unit's factor
  std::string unit_text;
  UnitValue unit;
  std::vector<ExpressionPtr> arguments;
  int depth = 1;
  bool brackets = false;  ///< stands in brackets
};

struct Statement {
  enum class Kind {
    param,
    mailbox,
    let,
    var,
    set,
    state,
    phase,
    boolean,
    next,
    table,
    array,
    line,
    loop,
    out,
    event,
    rate,
    require,
  };
  Kind kind = Kind::let;
  std::size_t offset = 0, name_offset = 0;
  std::string name;
  std::string variable;  ///< of a table or loop
  ExpressionPtr value;   ///< the expression after "=", or an event's value
  ExpressionPtr lower, upper;
  ExpressionPtr age;        ///< of a mailbox
  ExpressionPtr condition;  ///< of an event or a requirement
  ExpressionPtr index;      ///< out torque[index]; line NAME[length]
  ExpressionPtr segments;   ///< of a table
  bool whole = false;
  bool periodic = false;                ///< of a table
  std::vector<ExpressionPtr> elements;  ///< of an array
  UnitValue unit;                       ///< behind an array
  std::string unit_text;
  std::vector<Statement> body;  ///< of a loop
};

/// Parses the statements of a text. An error is reported, and parsing resumes at the next line that
/// begins with a statement. Recursion stays below a few hundred calls for any text.
std::vector<Statement> parse_statements(std::string_view text, Diagnostics& diagnostics);

/// Whether `word` is a keyword: "param", "if", "and", ...
bool is_keyword(std::string_view word);

}  // namespace feltgate::law
