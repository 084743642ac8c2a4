// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The command line as a whole: errors as one line with the nearest name, exit codes, signals; and
// validators, which check a text before a conversion can wrap a number. Documentation: README.md
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "apps/commands/commands.hpp"
#include "feltgate/nearest.hpp"
#include "files/output_file.hpp"
#include "law/units.hpp"

namespace feltgate {

namespace {

/// Options and subcommands that are candidates for a misspelt word.
std::vector<std::string> words_of(const CLI::App& app, bool options) {
  std::vector<std::string> words;
  for (const CLI::Option* option : app.get_options()) {
    if (!options) break;
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  }
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!options) words.push_back(sub->get_name());
  }
  return words;
}

/// What the parser says; of a hidden option it leaves the name out, and only ": " is left of it.
std::string told(const CLI::ParseError& error) {
  const std::string what = error.what();
  return what.rfind(": ", 0) == 0 ? what.substr(2) : what;
}

/// One line about an error of the parser, with the nearest name for a misspelt one.
std::string parse_error(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  const CLI::App& at = chosen.empty() ? app : *chosen.front();
  const std::string help = at.get_parent() == nullptr || &at == &app
                               ? app.get_name() + " --help"
                               : app.get_name() + " " + at.get_name() + " --help";
  const std::vector<std::string> extra = app.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr &&
      !(chosen.empty() && !extra.empty())) {
    return fmt::format("{}; see {}", told(error), help);
  }
  if (extra.empty()) return fmt::format("{}; see {}", told(error), help);
  const std::string word = extra.front().substr(0, extra.front().find('='));
  const bool option = word.rfind('-', 0) == 0;
  const auto words = words_of(at, option);
  return fmt::format("{} {} is unknown; {}see {}",
                     option           ? "option"
                     : chosen.empty() ? "command"
                                      : "argument",
                     word, config::did_you_mean(word, words), help);
}

/// Refuses an empty word: it usually is an unset variable of the shell.
void refuse_empty_words(int argc, char** argv) {
  for (int n = 1; n < argc; ++n) {
    const std::string word = argv[n];
    if (word.empty()) {
      throw std::invalid_argument(
          fmt::format("the word after {} is empty; give a value, or leave {} out", argv[n - 1],
                      n > 1 ? "both" : "it"));
    }
    if (word.rfind("--", 0) == 0 && word.back() == '=') {
      throw std::invalid_argument(fmt::format("{} has no value; give one, or leave it out", word));
    }
  }
}

/// Prints an error after flushing stdout, so that it is the last line if both go to one place.
void complain(const CLI::App& app, const std::string& what) {
  std::fflush(stdout);
  std::fputs(fmt::format("{}: {}\n", app.get_name(), what).c_str(), stderr);
}

}  // namespace

int run_command_line(CLI::App& app, int argc, char** argv, const int& exit_code) {
  files::end_on_signals();
  try {
    refuse_empty_words(argc, argv);
    use_design_files();
    app.parse(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
    complain(app, "stdout could not be written whole; is the disk full?");
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // help or version, on stdout
    complain(app, parse_error(app, e));
  } catch (const std::exception& e) {
    complain(app, e.what());
  }
  return exit_unusable;
}

}  // namespace feltgate

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
