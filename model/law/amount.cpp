// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/amount.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace feltgate::law {

namespace {

constexpr const char* kBoardWords[][2] = {{"count", "rad"}, {"ticks", "s"}, {"tick", "s"}};

/// Replaces the board's units by SI units: "Nm/count" becomes Nm/rad.
std::string si_text(std::string unit) {
  unit.erase(0, unit.find_first_not_of("0123456789 "));  // the number in "128 ticks"
  for (const auto& [own, si] : kBoardWords) {
    const std::size_t at = unit.find(own);
    if (at != std::string::npos) unit.replace(at, std::string(own).size(), si);
  }
  return unit;
}

/// Properties of a unit's text that scan_unit() does not return.
struct Rest {
  double factor = 1;    ///< of the board's units in the text
  double of_angle = 0;  ///< power of angle: 1 in rad, -1 in Nm/deg; laws treat angles as numbers
};

Rest rest_of(const std::string& unit, const BoardUnits& board) {
  Rest rest;
  if (unit[0] > '0' && unit[0] <= '9') rest.factor = std::strtod(unit.c_str(), nullptr);
  for (std::size_t at = 0; at < unit.size(); ++at) {
    const std::size_t begin = at;
    while (at < unit.size() && is_letter(unit[at])) ++at;
    if (at == begin) continue;
    const std::string word = unit.substr(begin, at - begin);
    double power = at + 1 < unit.size() && unit[at] == '^' ? std::atoi(&unit[at + 1]) : 1;
    if (unit.rfind('/', begin) != std::string::npos) power = -power;
    if (word == "count") rest.factor *= std::pow(board.count_rad, power);
    if (word == "tick" || word == "ticks") rest.factor *= std::pow(board.tick_s, power);
    const bool radians = word.size() >= 3 && word.compare(word.size() - 3, 3, "rad") == 0;
    if (radians || word == "deg" || word == "turn" || word == "turns" || word == "count") {
      rest.of_angle += power;
    }
  }
  return rest;
}

struct Meaning {
  UnitValue value;
  double of_angle = 0;
};

/// The meaning of a unit's text; nothing if a part of the text is not a unit.
std::optional<Meaning> unit_of(const std::string& text, const BoardUnits& board) {
  std::string si = si_text(text.rfind("1/", 0) == 0 ? text.substr(1) : text);
  UnitValue value;
  try {
    if (si.empty() || scan_unit(si, value) != si.size()) return {};
  } catch (const UnitError& e) {
    throw std::invalid_argument(fmt::format("\"{}\" is {}; {}", text, e.what, e.mend));
  }
  const Rest rest = rest_of(text, board);
  value.to_si *= rest.factor;
  return Meaning{value, rest.of_angle};
}

std::string without_blanks(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return text;
}

/// How to write an amount whose unit is wrong. It proposes a number only if a blank alone is
/// missing: for 5 mNms/rad, 5 mNm s/rad.
std::string mend_of(const Amount& a, const std::string& unit) {
  const std::string own = without_blanks(unit);
  for (const char* prefix : {"", "n", "u", "m", "k", "M"}) {
    if (without_blanks(a.unit) == prefix + own) {
      return fmt::format("write {:g} {}{}", a.number, prefix, unit);
    }
  }
  const std::string si = si_text(unit);
  return "give it in " + unit + (si == unit ? "" : ", or in " + si);
}

}  // namespace

Amount read_amount(const std::string& text, const std::string& example) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  std::string unit = end;
  if (end == text.c_str() || !std::isfinite(number)) {
    throw std::invalid_argument(
        fmt::format("\"{}\" is no number; give one, with its unit if you like: {}", text, example));
  }
  if (unit[0] == ',') {
    throw std::invalid_argument(
        fmt::format("\"{}\" is no number; write its point as a point: 5.5", text));
  }
  unit.erase(0, unit.find_first_not_of(' '));
  unit.erase(unit.find_last_not_of(' ') + 1);
  return {number, unit};
}

double amount_in(const std::string& text, const std::string& unit, const BoardUnits& board) {
  const bool plain = unit.empty() || unit == "1";
  const Amount a = read_amount(text, plain ? "0.25" : "0.25 " + unit);
  if (a.unit.empty() || a.unit == unit) return a.number;
  if (plain) {
    throw std::invalid_argument(
        fmt::format("{} takes a number without a unit; give the number alone", text));
  }
  const auto given = unit_of(a.unit, board), own = unit_of(unit, board);
  const double factor = given && own ? given->value.to_si / own->value.to_si : 0;
  if (!std::isnormal(factor) || !(given->value.unit == own->value.unit) ||
      given->of_angle != own->of_angle) {
    throw std::invalid_argument(fmt::format("{} is not in {}; {}", text, unit, mend_of(a, unit)));
  }
  return a.number * factor;
}

}  // namespace feltgate::law
