// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shared functions of the subcommands: paths of files, progress. Documentation: README.md
#include "apps/commands/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "design/design.hpp"
#include "design/info.hpp"
#include "feltgate/nearest.hpp"
#include "files/program.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/backends/backend.hpp"

namespace fs = std::filesystem;

namespace feltgate {

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void refuse_folder(const std::string& name, const std::string& names) {
  std::error_code ignored;
  if (fs::is_directory(name, ignored)) {
    throw std::invalid_argument(
        fmt::format("{}: is a folder; give a file in it, or a name in {}", name, names));
  }
}

[[noreturn]] void refuse_name(const std::string& name, const std::string& folder,
                              const std::set<std::string>& names) {
  throw std::invalid_argument(
      fmt::format("\"{}\" is not in {}; {}choose one of {}, or give the path of a file", name,
                  folder, config::did_you_mean(name, names), fmt::join(names, ", ")));
}

/// The mend for a path that does not exist.
std::string near_path(const std::string& path, const std::string& folder) {
  const std::set<std::string> names = names_in(folder);
  const std::string name = config::nearest(fs::path(path).stem().string(), names);
  return name.empty() ? "check the path"
                      : fmt::format("did you mean {}, which is in {}?", name, folder);
}

/// The command that starts one of the scripts.
std::vector<std::string> script_words(const std::string& name,
                                      const std::vector<std::string>& words) {
  const char* python = std::getenv("FELTGATE_PYTHON");
  std::vector<std::string> all{python != nullptr ? python : "python3",
                               (fs::path(repository()) / "scripts" / name).string()};
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

}  // namespace

int run_script(const std::string& name, const std::vector<std::string>& words, std::FILE* out) {
  std::fflush(out);
  return files::run_program(script_words(name, words), fileno(out));
}

int draw_from_json(const std::string& name, const std::string& json, const std::string& picture,
                   const files::Outputs& outputs) {
  const std::string data =
      (fs::temp_directory_path() / fmt::format("{}_{}.json", name, getpid())).string();
  files::OutputFile numbers("--output", data);
  numbers.write(json);
  numbers.commit();
  const int status = run_script(name, {data, picture}, outputs.text());
  fs::remove(data);
  return status == 0 ? exit_ok : status < exit_signal ? exit_unusable : status;
}

std::string repository() {
  const char* root = std::getenv("FELTGATE_ROOT");
  return root != nullptr ? root : FELTGATE_SOURCE_DIR;
}

std::set<std::string> names_in(const std::string& folder, const std::string& suffix) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(repository()) / folder)) {
    if (entry.path().extension() == suffix) names.insert(entry.path().stem().string());
  }
  return names;
}

std::string find_file(const std::string& name, const std::string& folder) {
  if (design::is_path(name)) {
    std::error_code error;
    const fs::file_status status = fs::status(name, error);
    refuse_folder(name, folder);
    if (!fs::exists(status)) {
      throw std::invalid_argument(
          fmt::format("{}: there is no such file; {}", name, near_path(name, folder)));
    }
    return name;
  }
  const fs::path path = fs::path(repository()) / folder / (name + ".toml");
  if (fs::exists(path)) return path.string();
  refuse_name(name, folder, names_in(folder));
}

std::string find_law(const std::string& name) {
  const bool path_like = name.find_first_not_of('.') == std::string::npos || design::is_path(name);
  if (path_like) refuse_folder(name, "rtl/laws");
  if (name.find('/') != std::string::npos || fs::path(name).extension() == ".law") return name;
  const fs::path path = fs::path(repository()) / "rtl/laws" / (name + ".law");
  if (fs::exists(path)) return path.string();
  refuse_name(name, "rtl/laws", names_in("rtl/laws", ".law"));
}

design::Elaborated elaborated_design(const std::string& name) {
  return design::elaborate(design::read_design(find_file(name, "rtl/designs")),
                           design::read_registers(repository() + "/rtl/registers.toml"));
}

void use_design_files() {
  if (!fs::exists(fs::path(repository()) / "rtl/designs")) return;  // those of the build, then
  set_design_source(
      {[](const std::string& name) { return design::info_of(elaborated_design(name)); },
       [] {
         const std::set<std::string> names = names_in("rtl/designs");
         return std::vector<std::string>(names.begin(), names.end());
       }});
}

std::string built_design(const std::string& given) {
  (void)design_named(given);  // names the choices where it is none
  return given;
}

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), on_(!quiet && isatty(STDERR_FILENO) == 1), start_s_(now_s()) {}

Progress::~Progress() { finish(); }

void Progress::finish() {
  if (on_ && last_s_ > 0) std::fputs("\r\033[K", stderr);
  on_ = false;
}

void Progress::update(double done) {
  const double now = now_s();
  if (!on_ || now - last_s_ < 0.1) return;
  last_s_ = now;
  const double spent = now - start_s_;
  const double left = done > 0 ? spent * (1 - done) / done : 0;
  std::fputs(fmt::format("\r\033[K{}: {:3.0f} %, {:.0f} s left", label_, 100 * done, left).c_str(),
             stderr);
  std::fflush(stderr);
}

void add_scripts(CLI::App& app, int* exit_code) {
  const struct {
    const char* name;
    const char* about;
  } scripts[] = {{"demo", "the main job: every scene and recording, one HTML report"},
                 {"figures", "the paper's figures redrawn from the RTL"},
                 {"explore", "sweeps over designs, their Pareto front as a page"},
                 {"synth", "area and speed of the RTL on ECP5 and Cyclone IV E"}};
  for (const auto& s : scripts) {
    CLI::App* sub = app.add_subcommand(s.name, s.about);
    sub->set_help_flag();  // the script's own --help is the one to read
    sub->prefix_command();
    const std::string script = std::string(s.name) + ".py";
    sub->callback([sub, script, exit_code] {
      setenv("FELTGATE_PROGRAM", fs::read_symlink("/proc/self/exe").c_str(), 1);
      setenv("FELTGATE_ROOT", repository().c_str(), 1);
      *exit_code = exit_unusable;  // unless this process becomes the script
      files::become_program(script_words(script, sub->remaining()));
    });
  }
}

}  // namespace feltgate
