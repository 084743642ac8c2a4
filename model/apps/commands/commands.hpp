// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The subcommands of the feltgate program. Commands parse, call and print; they compute nothing.
// Documentation: README.md
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "files/output_file.hpp"

namespace feltgate {

/// Exit codes: 0 success, 1 a mismatch or a failed expectation, 2 unusable input; from 128 on,
/// ended by a signal (130: Ctrl-C).
enum Exit : int { exit_ok = 0, exit_failed = 1, exit_unusable = 2, exit_signal = 128 };

/// A subcommand adds its options to the program and sets *exit_code when it has run.
void add_run(CLI::App& app, int* exit_code);
void add_replay(CLI::App& app, int* exit_code);
void add_import(CLI::App& app, int* exit_code);
void add_design(CLI::App& app, int* exit_code);
void add_stability(CLI::App& app, int* exit_code);
/// `feltgate stability SCENE`: the margin of the scene's law.
int scene_stability(const std::string& scene, const std::string& json, bool bits);
void add_rates(CLI::App& app, int* exit_code);
void add_controllers(CLI::App& app, int* exit_code);
void add_trim(CLI::App& app, int* exit_code);
void add_law(CLI::App& app, int* exit_code);
void add_shape(CLI::App& app, int* exit_code);
void add_texture(CLI::App& app, int* exit_code);
/// demo, figures, explore and synth are orchestration: Python scripts that call this program.
void add_scripts(CLI::App& app, int* exit_code);

/// Path of the repository: FELTGATE_ROOT, or the folder from which this program was built.
std::string repository();

/// Names of the files in a folder of the repository that end so, without that end.
std::set<std::string> names_in(const std::string& folder, const std::string& suffix = ".toml");

/// `name` itself if it is a path (has a slash or the suffix), else folder/name.toml in the
/// repository. Throws std::invalid_argument with a list of the existing names.
std::string find_file(const std::string& name, const std::string& folder);

/// The path of a law, given as a path or as a name in rtl/laws. Throws like find_file().
std::string find_law(const std::string& name);

/// Parses the command line, runs the command, and returns the exit code of the command or of an
/// error. An error is printed on stderr as one line that begins with the program's name; for a
/// misspelt name it suggests the nearest one.
int run_command_line(CLI::App& app, int argc, char** argv, const int& exit_code);

/// Runs scripts/NAME with `words` as arguments and stdout to `out`; returns its exit code.
int run_script(const std::string& name, const std::vector<std::string>& words, std::FILE* out);

/// Draws `json` by scripts/NAME, which gets its file and that of the picture; returns exit_ok or
/// the exit code of this command.
int draw_from_json(const std::string& name, const std::string& json, const std::string& picture,
                   const files::Outputs& outputs);

/// The design point of this name, elaborated against the register map.
design::Elaborated elaborated_design(const std::string& name);

/// design_named() takes designs from rtl/designs, or from the paths of their files.
void use_design_files();

/// Help of a --design that is empty where the scene decides.
inline constexpr const char* design_help =
    "design point in rtl/designs; default: lever, of a law lever_law, of a device its own";

/// `given`, where it is the name of a design or the path of its file. Errors:
/// std::invalid_argument, which names the choices.
std::string built_design(const std::string& given);

/// Adds an option. `type`: what its value is called in the help; empty: by the type of `value`.
template <class Value>
CLI::Option* option(CLI::App& to, const std::string& name, Value& value, const std::string& type,
                    const std::string& about, const CLI::Validator& check = {}) {
  CLI::Option* added = to.add_option(name, value, about)->transform(check);
  return type.empty() ? added : added->type_name(type);
}
/// The same; the help shows the value that it has now.
template <class Value>
CLI::Option* defaulted(CLI::App& to, const std::string& name, Value& value, const std::string& type,
                       const std::string& about, const CLI::Validator& check = {}) {
  return option(to, name, value, type, about, check)->capture_default_str();
}

/// Shows progress, rate and remaining time on a terminal; silent elsewhere.
class Progress {
 public:
  Progress(std::string label, bool quiet);
  ~Progress();
  /// `done`: completed share, 0..1.
  void update(double done);
  /// Clears the line.
  void finish();

 private:
  std::string label_;
  bool on_;
  double start_s_, last_s_ = 0;
};

}  // namespace feltgate

// Checks of words on the command line: finite and within a range, which the message names.

namespace feltgate::checks {

/// A finite number from min to max. `unit` follows the range in help and message; it may be empty.
/// With a unit, attach the check by transform(), because a number with another unit of the same
/// quantity is converted (law/units.hpp).
CLI::Validator number(double min, double max, const std::string& unit);
/// A finite number above 0, at most max.
CLI::Validator positive(double max, const std::string& unit);
/// A whole number from min to max, also written as 1e6. Attach it by transform().
CLI::Validator whole(std::int64_t min, std::int64_t max, const std::string& unit = "");
/// A seed: a whole number from 0 to 2^64 - 1.
CLI::Validator seed();
/// A path that is no folder; whether there is a file is not looked at.
CLI::Validator no_folder();
/// A duration that can be simulated: above 0, at most 100000 s.
CLI::Validator seconds();

}  // namespace feltgate::checks
