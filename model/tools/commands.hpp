// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The subcommands of the feltgate program. Commands parse, call and print; they compute nothing.
// Documentation: README.md
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "design/design.hpp"

namespace feltgate {

/// Exit codes: 0 all well, 1 a mismatch or a broken expectation, 2 input that cannot be used;
/// from 128 on a signal, 130 for Ctrl-C.
enum Exit : int { exit_ok = 0, exit_failed = 1, exit_unusable = 2, exit_signal = 128 };

/// A subcommand adds its options to the program and sets *exit_code when it has run.
void add_run(CLI::App& app, int* exit_code);
void add_replay(CLI::App& app, int* exit_code);
void add_import(CLI::App& app, int* exit_code);
void add_design(CLI::App& app, int* exit_code);
void add_stability(CLI::App& app, int* exit_code);
void add_rates(CLI::App& app, int* exit_code);
void add_trim(CLI::App& app, int* exit_code);
void add_budget(CLI::App& app, int* exit_code);
void add_law(CLI::App& app, int* exit_code);
void add_shape(CLI::App& app, int* exit_code);
void add_texture(CLI::App& app, int* exit_code);
/// demo, figures, explore and synth are orchestration: Python scripts that call this program.
void add_scripts(CLI::App& app, int* exit_code);

/// The repository: FELTGATE_ROOT, or where this program was built from.
std::string repository();

/// `name` itself when it is a path (has a slash or the suffix), else folder/name.toml of the
/// repository. Throws std::invalid_argument listing what there is.
std::string find_file(const std::string& name, const std::string& folder);

/// The path of a law: given as one, or a name in rtl/laws. Throws likewise.
std::string find_law(const std::string& name);

/// Parses the command line, which runs the command that it names, and returns the exit code: the
/// command's own, or that of an error, which is told on stderr as one line that begins with the
/// program's name, the nearest name suggested for what is misspelt.
int run_command_line(CLI::App& app, int argc, char** argv, const int& exit_code);

/// Runs scripts/NAME with these words, its stdout going to `out`; returns its exit code.
int run_script(const std::string& name, const std::vector<std::string>& words, std::FILE* out);

/// The design point of this name with everything that follows from it, against the register map.
design::Elaborated elaborated_design(const std::string& name);

/// Name of the design that `given` means: a name that is built in, or the path of the file of one.
/// Throws std::invalid_argument that says how to build another one in.
std::string built_design(const std::string& given);

/// A spelling of an option that was documented once: still understood, no longer shown.
template <class Value>
CLI::Option* old_spelling(CLI::App* app, const std::string& name, Value& value,
                          const CLI::Validator& check) {
  // A hidden option has no name in messages; its check says it.
  const auto named = [name, check](std::string& word) {
    const std::string error = check(word);
    return error.empty() ? error : name + ": " + error;
  };
  return app->add_option(name, value)->group("")->transform(CLI::Validator(named, ""));
}

/// Where the waveform around a mismatch goes: mismatch/ in the build folder, or in this one.
std::string mismatch_path(const std::string& subject, const std::string& design);
/// Says where it is and how to look at it.
void tell_mismatch(const std::string& first_mismatch, const std::string& path);
/// Clocks shown before and after the first mismatch.
constexpr long long mismatch_before = 200, mismatch_after = 20;

/// Progress with rate and time left on a terminal; silent elsewhere.
class Progress {
 public:
  Progress(std::string label, bool quiet);
  ~Progress();
  /// done in 0..1
  void update(double done);
  /// Clears the line.
  void finish();

 private:
  std::string label_;
  bool on_;
  double start_s_, last_s_ = 0;
};

}  // namespace feltgate
