// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate extremes, a program of its own because it is a test. Documentation: docs/extremes.md
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "apps/commands/commands.hpp"
#include "campaigns/extremes/case.hpp"
#include "feltgate/nearest.hpp"
#include "files/output_file.hpp"

namespace feltgate {

namespace {

struct ExtremesArguments {
  std::vector<std::string> names;
  std::string json, progress_file;
  bool long_too = false, markdown = false, list = false;
};

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<extremes::Case> chosen(const ExtremesArguments& a) {
  std::vector<extremes::Case> out;
  std::string known;
  std::vector<std::string> names;
  for (const extremes::Case& c : extremes::cases()) {
    names.emplace_back(c.name);
    known += (known.empty() ? "" : ", ") + std::string(c.name);
    const bool named = std::find(a.names.begin(), a.names.end(), c.name) != a.names.end();
    if (!named && !a.names.empty()) continue;
    if (c.long_only && !a.long_too) {
      if (named) {
        throw std::invalid_argument(std::string(c.name) + " takes an hour of CPU time; add --long");
      }
      continue;
    }
    out.push_back(c);
  }
  for (const std::string& name : a.names) {
    if (std::none_of(out.begin(), out.end(), [&](const auto& c) { return name == c.name; })) {
      throw std::invalid_argument(fmt::format("case \"{}\" is unknown; {}choose among {}", name,
                                              config::did_you_mean(name, names), known));
    }
  }
  return out;
}

int run(const ExtremesArguments& a) {
  const auto cases = chosen(a);
  if (a.list) {
    for (const auto& c : cases) fmt::print("{:<10} {:<22} {}\n", c.group, c.name, c.about);
    return exit_ok;
  }
  files::Outputs outputs;
  files::OutputFile* json = outputs.open("--json", a.json);
  std::vector<extremes::Result> results;
  std::string broken;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Progress progress(std::string("extremes: ") + cases[i].name, false);
    extremes::Settings settings;
    settings.root = repository();
    settings.progress = [&, begun = std::chrono::steady_clock::now()](double done) {
      progress.update(done);
      if (a.progress_file.empty()) return;
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;
      std::ofstream(a.progress_file) << fmt::format("{}: {:.1f} %, {:.0f} s left\n", cases[i].name,
                                                    100 * done, spent.count() * (1 / done - 1));
    };
    progress.update(static_cast<double>(i) / static_cast<double>(cases.size()));
    results.push_back({cases[i], cases[i].run(settings)});
    if (!results.back().outcome.holds()) broken += std::string(" ") + cases[i].name;
    if (!a.markdown) outputs.say(extremes::markdown(results.back()) + "\n");
  }
  if (a.markdown) {
    outputs.say(
        extremes::page(results, text_of(repository() + "/testbench/campaigns/extremes/table.md")));
  } else {
    outputs.say(fmt::format("{} cases{}{}\n", results.size(),
                            broken.empty() ? ", all hold" : ", broken:", broken));
  }
  if (json != nullptr) json->write(extremes::json(results));
  outputs.commit();
  return broken.empty() ? exit_ok : exit_failed;
}

}  // namespace
}  // namespace feltgate

int main(int argc, char** argv) {
  using namespace feltgate;
  CLI::App app{"the core at its limits: expected, RTL, twin, double and a verdict for each case"};
  app.name("feltgate extremes");
  app.footer(
      "  feltgate extremes                      every short case (a minute or two)\n"
      "  feltgate extremes --list               names and what they are about\n"
      "  feltgate extremes wrap_32 decoder_limit\n"
      "  feltgate extremes day --long           24 hours of device time in the twin\n"
      "  feltgate extremes --markdown > table.md && mv table.md testbench/campaigns/extremes/\n"
      "Exit code: 0 every case holds, 1 one does not, 2 unusable input.");
  ExtremesArguments a;
  app.add_option("case", a.names, "cases; all short ones when none is named")->type_name("CASE");
  app.add_option("--json", a.json, "the table as JSON")->type_name("FILE");
  app.add_option("--progress", a.progress_file, "day: how far it is and the time left")
      ->type_name("FILE");
  app.add_flag("--markdown", a.markdown,
               "print the record testbench/campaigns/extremes/table.md instead");
  app.add_flag("--long", a.long_too, "also cases that take an hour of CPU time");
  app.add_flag("--list", a.list, "only name the cases");
  int exit_code = exit_ok;
  app.callback([&] { exit_code = run(a); });
  return run_command_line(app, argc, argv, exit_code);
}
