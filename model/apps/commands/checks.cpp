// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Validators of the command line. They check the text itself, before a conversion can wrap a
// number. Documentation: README.md
#include "apps/commands/checks.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <type_traits>

#include "law/units.hpp"

namespace feltgate::checks {

namespace {

/// Converts the whole text to a number; false if it is not a number.
template <class Number>
bool parse(const std::string& text, Number* value) {
  const char* end = text.data() + text.size();
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const auto [stopped, error] = std::from_chars(begin, end, *value);
  return error == std::errc() && stopped == end && begin != end;
}

/// Writes 1e6 as 1000000; leaves what is no whole number as it is.
void write_out(std::string& text) {
  double value = 0;
  constexpr double exact = 9007199254740992;  // 2^53
  if (!parse(text, &value) || std::trunc(value) != value || std::abs(value) > exact) return;
  text = fmt::format("{}", static_cast<std::int64_t>(value));
}

bool has_unit(const std::string& text) {
  try {
    return !law::read_amount(text, "").unit.empty();
  } catch (const std::invalid_argument&) {
    return false;  // no number at all
  }
}

/// `kind` and `range` form the message; the help shows only the range. A number with another unit
/// is converted to `unit`.
template <class Number>
CLI::Validator accepts(const std::string& kind, const std::string& range,
                       std::function<bool(Number)> good, const std::string& unit = "") {
  const auto check = [kind, range, good, unit](std::string& text) {
    const std::string given = text;
    if (!unit.empty() && has_unit(text)) {
      try {
        text = fmt::format("{:.17g}", law::amount_in(text, unit));
      } catch (const std::invalid_argument& error) {
        return std::string(error.what());
      }
    }
    if constexpr (std::is_same_v<Number, std::int64_t>) write_out(text);
    Number value{};
    if (parse(text, &value) && good(value)) return std::string();
    return fmt::format("{} is not a {} {}", given, kind, range);
  };
  return CLI::Validator(check, range);
}

std::string with_unit(const std::string& range, const std::string& unit) {
  return unit.empty() ? range : range + " " + unit;
}

}  // namespace

CLI::Validator number(double min, double max, const std::string& unit) {
  return accepts<double>(
      "number", with_unit(fmt::format("from {:g} to {:.12g}", min, max), unit),
      [min, max](double v) { return v >= min && v <= max; }, unit);
}

CLI::Validator positive(double max, const std::string& unit) {
  return accepts<double>(
      "number", with_unit(fmt::format("above 0, to {:.12g}", max), unit),
      [max](double v) { return v > 0 && v <= max; }, unit);
}

CLI::Validator whole(std::int64_t min, std::int64_t max, const std::string& unit) {
  return accepts<std::int64_t>(
      "whole number", with_unit(fmt::format("from {} to {}", min, max), unit),
      [min, max](std::int64_t v) { return v >= min && v <= max; }, unit);
}

CLI::Validator seed() {
  auto check = accepts<std::uint64_t>("whole number", "from 0 to 18446744073709551615",
                                      [](std::uint64_t) { return true; });
  return check.description("");
}

CLI::Validator no_folder() {
  return CLI::Validator(
      [](std::string& path) {
        std::error_code ignored;
        const bool folder = std::filesystem::is_directory(path, ignored);
        return folder ? path + " is a folder; give a file in it" : std::string();
      },
      "");
}

CLI::Validator seconds() { return positive(100'000, "s"); }

}  // namespace feltgate::checks
