// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_faults: runs a part of the campaign and prints one line of JSON per fault.
// scripts/faults.py starts this program and makes the table. Documentation: docs/testing.md
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "apps/commands/commands.hpp"
#include "campaigns/faults/faults.hpp"
#include "campaigns/faults/world.hpp"

namespace feltgate {

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  faults::StateCampaign state;
  int pins = 0, part = 0, parts = 1;
  double clean_s = 0;
  std::string replay, design = "lever";
};

void say(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

std::vector<std::string> act_names() {
  std::vector<std::string> names;
  for (const auto& a : faults::acts()) names.push_back(a.name);
  return names;
}

int run_states(const Arguments& a, std::vector<faults::StateFault> all) {
  const auto bits = faults::state_bits();
  const auto names = act_names();
  std::vector<faults::StateFault> mine;
  for (const auto& f : all) {
    if (static_cast<int>(f.act) % a.parts == a.part) mine.push_back(f);
  }
  const std::int64_t mismatches = faults::run(
      a.state, mine, [&](const faults::StateResult& r) { say(faults::line_of(r, bits, names)); });
  say(Json{{"mismatches", mismatches}}.dump());
  return mismatches == 0 ? exit_ok : exit_failed;
}

int replay(const Arguments& a) {
  std::ifstream in(a.replay);
  if (!in) throw std::invalid_argument(a.replay + ": cannot be read");
  std::vector<faults::StateFault> states;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const faults::CaseLine c = faults::read_case(line);
    if (c.pins) {
      say(faults::line_of(faults::run_pin_fault(a.state.root, c.kind, c.seed, c.design)));
    } else {
      states.push_back(c.state);
    }
  }
  return run_states(a, states);
}

int run(const Arguments& a) {
  if (!a.replay.empty()) return replay(a);
  if (a.clean_s > 0) {
    const double seconds = a.clean_s / a.parts;
    const std::uint64_t seed = a.state.seed * 1000 + static_cast<std::uint64_t>(a.part);
    const auto progress = [](double done) { say(Json{{"done", done}}.dump()); };
    const auto r = a.design == "lever"
                       ? faults::run_clean(a.state.root, seconds, seed, progress)
                       : faults::run_option_clean(a.state.root, a.design, seconds, seed, progress);
    say(Json{{"clean_s", r.seconds()},
             {"scenes_s", r.scenes_s},
             {"recordings_s", r.recordings_s},
             {"dither_s", r.dither_s},
             {"alarms", r.alarms},
             {"first", r.first}}
            .dump());
    return r.alarms == 0 ? exit_ok : exit_failed;
  }
  const std::vector<faults::StateFault> states = faults::plan(a.state);
  const auto& kinds = faults::pin_kinds(a.design);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const int n = a.pins == 0 ? 0 : std::max(1, a.pins * kinds[k].share / 100);
    for (int i = 0; i < n; ++i) {
      if (i % a.parts != a.part) continue;
      say(faults::line_of(faults::run_pin_fault(
          a.state.root, k, a.state.seed * 1'000'000 + static_cast<std::uint64_t>(i), a.design)));
    }
  }
  if (a.state.flips_per_bit == 0 && a.state.doubles == 0 && a.state.resets == 0) return exit_ok;
  return run_states(a, states);
}

}  // namespace
}  // namespace feltgate

int main(int argc, char** argv) {
  using namespace feltgate;
  CLI::App app{
      "a part of the fault campaign, a line of JSON for each fault; started by feltgate faults"};
  app.name("feltgate_faults");
  Arguments a;
  a.state.root = repository();
  a.state.flips_per_bit = 0;
  app.add_option("--seed", a.state.seed, "of the campaign");
  app.add_option("--flips", a.state.flips_per_bit, "of each bit of state");
  app.add_option("--doubles", a.state.doubles, "flips of two bits at once");
  app.add_option("--resets", a.state.resets, "brown-outs");
  app.add_option("--acts", a.state.acts, "scenes that act, so many of them at most");
  app.add_option("--only", a.state.only, "registers with this in their name");
  app.add_option("--pins", a.pins, "faults at pins and register port");
  std::vector<std::string> designs = faults::option_designs();
  designs.insert(designs.begin(), a.design);
  app.add_option("--design", a.design, "whose pins are broken; flips are of lever")
      ->check(CLI::IsMember(designs));
  app.add_option("--parts", a.parts, "of so many parts");
  app.add_option("--part", a.part, "this one, from 0");
  app.add_option("--clean", a.clean_s, "seconds of device time without a fault instead");
  app.add_option("--replay", a.replay, "the cases of this list instead");
  int exit_code = exit_ok;
  app.callback([&] { exit_code = run(a); });
  return run_command_line(app, argc, argv, exit_code);
}
