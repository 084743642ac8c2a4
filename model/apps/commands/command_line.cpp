// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The command line as a whole: errors as one line with the nearest name, exit codes, signals.
// Documentation: README.md
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "apps/commands/commands.hpp"
#include "feltgate/nearest.hpp"
#include "files/output_file.hpp"

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
    check_design_files();
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
