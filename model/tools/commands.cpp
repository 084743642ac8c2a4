// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the subcommands share: places of files, progress. Documentation: README.md
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "tools/commands.hpp"

namespace fs = std::filesystem;

namespace feltgate {

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::string repository() {
  const char* root = std::getenv("FELTGATE_ROOT");
  return root != nullptr ? root : FELTGATE_SOURCE_DIR;
}

std::string find_file(const std::string& name, const std::string& folder) {
  if (name.find('/') != std::string::npos || fs::path(name).extension() == ".toml") {
    if (!fs::exists(name))
      throw std::invalid_argument(name + ": there is no such file; check the path");
    return name;
  }
  const fs::path base = fs::path(repository()) / folder;
  const fs::path path = base / (name + ".toml");
  if (fs::exists(path)) return path.string();
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(base)) {
    if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
  }
  std::string list;
  for (const std::string& n : names) list += (list.empty() ? "" : ", ") + n;
  throw std::invalid_argument("\"" + name + "\" is not in " + folder + "; choose one of " + list +
                              " or give the path of a file");
}

std::string mismatch_path(const std::string& subject, const std::string& design) {
  const char* build = std::getenv("FELTGATE_BUILD");
  const fs::path folder = build != nullptr ? fs::path(build) / "mismatch" : fs::path("mismatch");
  fs::create_directories(folder);
  return (folder / (subject + "." + design + ".fst")).string();
}

void tell_mismatch(const std::string& first_mismatch, const std::string& path) {
  std::fprintf(stderr,
               "first mismatch: %s\nwaveform: gtkwave %s %s/scripts/gtkwave/feltgate_core.gtkw\n",
               first_mismatch.c_str(), path.c_str(), repository().c_str());
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
  std::fprintf(stderr, "\r\033[K%s: %3.0f %%, %.0f s left", label_.c_str(), 100 * done, left);
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
    const std::string script = std::string("scripts/") + s.name + ".py";
    sub->callback([sub, script, exit_code] {
      const char* python = std::getenv("FELTGATE_PYTHON");
      const std::string path = (fs::path(repository()) / script).string();
      std::vector<std::string> words{python != nullptr ? python : "python3", path};
      for (const std::string& word : sub->remaining()) words.push_back(word);
      std::vector<char*> argv;
      for (std::string& word : words) argv.push_back(word.data());
      argv.push_back(nullptr);
      setenv("FELTGATE_PROGRAM", fs::read_symlink("/proc/self/exe").c_str(), 1);
      setenv("FELTGATE_ROOT", repository().c_str(), 1);
      execvp(argv[0], argv.data());
      std::perror(argv[0]);
      *exit_code = exit_unusable;
    });
  }
}

}  // namespace feltgate
