// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

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

}  // namespace feltgate::law
