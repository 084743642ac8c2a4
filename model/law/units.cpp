// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace feltgate::law {

namespace {

constexpr int kMostPower = 8;

struct KnownUnit {
  const char* name;
  Unit unit;
  double to_si;
  bool prefixed;  ///< whether n, u, m, k, M may stand before it
};

constexpr KnownUnit kSymbols[] = {
    {"Nm", kNewtonMetre, 1, true},      {"N", {{1, 1, -2, 0}}, 1, true},
    {"m", {{1, 0, 0, 0}}, 1, true},     {"rad", kNumber, 1, true},
    {"deg", kNumber, kPi / 180, false}, {"turn", kNumber, 2 * kPi, false},
    {"turns", kNumber, 2 * kPi, false}, {"s", kSecond, 1, true},
    {"Hz", kPerSecond, 1, true},        {"g", {{0, 1, 0, 0}}, 1e-3, true},
    {"J", kNewtonMetre, 1, true},       {"W", {{2, 1, -3, 0}}, 1, true},
    {"A", {{0, 0, 0, 1}}, 1, true},     {"V", {{2, 1, -3, -1}}, 1, true},
    {"ohm", {{2, 1, -3, -2}}, 1, true},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

double prefix(char c) {
  switch (c) {
    case 'n':
      return 1e-9;
    case 'u':
      return 1e-6;
    case 'm':
      return 1e-3;
    case 'k':
      return 1e3;
    case 'M':
      return 1e6;
    default:
      return 0;
  }
}

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::size_t scan(UnitValue& value) {
    std::size_t end = 0;  // end of the valid unit so far
    bool divided = false;
    if (factor(value, 1)) end = at_;
    while (true) {
      at_ = end;
      skip_blanks();
      const std::size_t next = at_;
      const char c = peek();
      if (c == '/') {
        ++at_;
        skip_blanks();
        if (!group(value) && !factor(value, -1)) return end;
        divided = true;
      } else if (end > 0) {
        UnitValue more = value;
        if (!factor(more, 1)) return end;
        if (divided) {
          throw UnitError{next, "a unit that can be read in two ways",
                          "after \"/\" write N/(m s), or put the factor before it: N s/m"};
        }
        value = more;
      } else {
        return end;
      }
      end = at_;
    }
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_blanks() {
    while (peek() == ' ' || peek() == '\t') ++at_;
  }

  /// Reads a group "(m s)" after a slash.
  bool group(UnitValue& value) {
    if (peek() != '(') return false;
    const std::size_t begin = at_++;
    UnitValue inside = value;
    skip_blanks();
    bool any = false;
    while (factor(inside, -1)) {
      any = true;
      skip_blanks();
    }
    if (!any || peek() != ')') {
      at_ = begin;
      return false;
    }
    ++at_;
    value = inside;
    return true;
  }

  /// Reads a symbol with its power, and multiplies `value` by it to the power of `sign`.
  bool factor(UnitValue& value, int sign) {
    const std::size_t begin = at_;
    while (is_letter(peek())) ++at_;
    const auto symbol = unit_symbol(text_.substr(begin, at_ - begin));
    if (!symbol || is_digit(peek()) || peek() == '_') {
      at_ = begin;
      return false;
    }
    const int power = sign * read_power();
    value.unit = value.unit + symbol->unit * power;
    value.to_si *= std::pow(symbol->to_si, power);
    return true;
  }

  int read_power() {
    if (peek() != '^') return 1;
    const std::size_t begin = at_++;
    const bool negative = peek() == '-';
    if (negative) ++at_;
    int power = 0, digits = 0;
    for (; is_digit(peek()); ++at_, ++digits) power = std::min(power * 10 + (peek() - '0'), 1000);
    if (digits == 0 || power == 0 || power > kMostPower) {
      throw UnitError{begin, "a unit's power that is no whole number from 1 to 8",
                      "write for example m^2 or s^-1"};
    }
    return negative ? -power : power;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<UnitValue> unit_symbol(std::string_view symbol) {
  for (const KnownUnit& s : kSymbols) {
    const std::string_view name = s.name;
    if (symbol == name) return UnitValue{s.unit, s.to_si};
    if (s.prefixed && symbol.size() == name.size() + 1 && symbol.substr(1) == name &&
        prefix(symbol[0]) != 0) {
      return UnitValue{s.unit, prefix(symbol[0]) * s.to_si};
    }
  }
  return {};
}

const std::vector<std::string>& unit_symbols() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names;
    for (const KnownUnit& s : kSymbols) names.emplace_back(s.name);
    for (const char* often : {"mm", "um", "ms", "us", "kHz", "kg", "mNm"})
      names.emplace_back(often);
    return names;
  }();
  return all;
}

std::size_t scan_unit(std::string_view text, UnitValue& value) {
  UnitValue read;
  const std::size_t length = Scanner(text).scan(read);
  if (length > 0) value = read;
  return length;
}

Unit operator+(const Unit& a, const Unit& b) {
  Unit sum = a;
  for (std::size_t i = 0; i < sum.exponents.size(); ++i) sum.exponents[i] += b.exponents[i];
  return sum;
}

Unit operator-(const Unit& a, const Unit& b) { return a + b * -1; }

Unit operator*(const Unit& a, int power) {
  Unit result = a;
  for (int& exponent : result.exponents) exponent *= power;
  return result;
}

std::string text_of(const Unit& unit) {
  struct Known {
    Unit unit;
    const char* name;
  };
  static constexpr Known known[] = {
      {kNumber, "a number"},    {kNewtonMetre, "Nm"},       {{{1, 1, -2, 0}}, "N"},
      {{{0, 1, -2, 0}}, "N/m"}, {{{0, 1, -1, 0}}, "N s/m"}, {{{2, 1, -1, 0}}, "Nm s/rad"},
      {{{1, 0, -1, 0}}, "m/s"}, {{{1, 0, -2, 0}}, "m/s^2"}, {{{2, 1, -3, 0}}, "Nm/s"},
      {{{2, 1, -3, -1}}, "V"},  {{{2, 1, -3, -2}}, "ohm"},
  };
  for (const Known& k : known) {
    if (k.unit == unit) return k.name;
  }
  static constexpr const char* base[] = {"m", "kg", "s", "A"};
  static constexpr std::size_t order[] = {1, 0, 2, 3};  // kg m^2/s^2, as it is usually written
  std::string above, below;
  int factors_below = 0;
  for (const std::size_t i : order) {
    const int e = unit.exponents[i];
    if (e == 0) continue;
    std::string& part = e > 0 ? above : below;
    factors_below += e < 0 ? 1 : 0;
    part += (part.empty() ? "" : " ") + std::string(base[i]);
    if (std::abs(e) > 1) part += "^" + fmt::format("{}", std::abs(e));
  }
  if (below.empty()) return above;
  if (above.empty()) above = "1";
  return factors_below > 1 ? above + "/(" + below + ")" : above + "/" + below;
}

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
