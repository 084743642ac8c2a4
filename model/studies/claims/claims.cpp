// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/claims.md
#include "studies/claims/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "files/json_text.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::claims {

namespace {

/// The figures of a column, each with its name.
std::string listed(const Claim& c, double Figure::*column, int digits) {
  std::string out;
  for (const Figure& f : c.figures) {
    if (std::isnan(f.*column)) continue;
    out += fmt::format("{}{}: {:.{}g}{}{}", out.empty() ? "" : "; ", f.what, f.*column, digits,
                       f.unit.empty() ? "" : " ", f.unit);
  }
  return out;
}

std::string joined(const std::string& how, const std::string& figures) {
  return figures.empty() ? how : how + ". " + figures;
}

std::string closed_form(const Claim& c) {
  return joined(c.formula, listed(c, &Figure::formula, 5));
}

std::string simulation(const Claim& c) {
  return joined(c.simulation, listed(c, &Figure::simulated, 4));
}

nlohmann::ordered_json or_null(double x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

const char* name_of(Asked::Kind kind) {
  switch (kind) {
    case Asked::Kind::near:
      return "near";
    case Asked::Kind::at_most:
      return "at_most";
    case Asked::Kind::at_least:
      return "at_least";
    case Asked::Kind::nothing:
      break;
  }
  return "nothing";
}

}  // namespace

bool Asked::met(double x) const {
  switch (kind) {
    case Kind::near:
      return std::abs(x - value) <= within;
    case Kind::at_most:
      return x <= value;
    case Kind::at_least:
      return x >= value;
    case Kind::nothing:
      break;
  }
  return false;
}

bool Figure::agrees() const {
  if (std::isnan(formula) && std::isnan(simulated)) return false;
  return (std::isnan(formula) || asked.met(formula)) &&
         (std::isnan(simulated) || asked.met(simulated));
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::holds_if:
      return "holds if";
    case Verdict::cannot_be_had:
      break;
  }
  return "cannot be had";
}

void Claim::explains(std::string what, std::string unit, double by_formula, double simulated) {
  figures.push_back({std::move(what), std::move(unit), by_formula, simulated, {}, false});
}

void Claim::asks(std::string what, std::string unit, double by_formula, double simulated,
                 Asked asked) {
  figures.push_back({std::move(what), std::move(unit), by_formula, simulated, asked, false});
}

void Claim::asks_if(std::string what, std::string unit, double by_formula, double simulated,
                    Asked asked) {
  figures.push_back({std::move(what), std::move(unit), by_formula, simulated, asked, true});
}

Verdict Claim::verdict() const {
  int plain = 0, conditional = 0;
  bool plain_agree = true, conditional_agree = true;
  for (const Figure& f : figures) {
    if (!f.judges()) continue;
    ++(f.conditional ? conditional : plain);
    bool& all = f.conditional ? conditional_agree : plain_agree;
    all = all && f.agrees();
  }
  if (plain > 0 && plain_agree) return Verdict::holds;
  if (conditional > 0 && conditional_agree) return Verdict::holds_if;
  return Verdict::cannot_be_had;
}

Scenario Lab::scene(const std::string& name) const {
  Scenario s = read_scenario(root_ + "/vectors/scenes/" + name + ".toml");
  s.expectations.clear();
  return s;
}

plant::Parameters Lab::plant(const std::string& name) const {
  return plant::read_plant_file(root_ + "/vectors/plants/" + name + ".toml");
}

design::Elaborated Lab::design(const std::string& name) const {
  return design::elaborate(design::read_design(root_ + "/rtl/designs/" + name + ".toml"),
                           design::read_registers(root_ + "/rtl/registers.toml"));
}

RunResult Lab::run(Scenario s, const plant::Parameters& plant, const std::string& design,
                   const std::function<void(const Row&)>& row, const PlantStep& step) const {
  resolve_effects(s, plant.effects);
  resolve_amounts(s, design_named(design));
  RunOptions options;
  options.design = design;
  options.engine = "twin";
  options.row = row;
  const auto clock_hz = static_cast<double>(design_named(design).clock_hz);
  Clock now = 0;
  if (step) {
    options.plant_step = [&](Clock clocks, const plant::Observables& o) {
      now += clocks;
      step(static_cast<double>(now) / clock_hz, o);
    };
  }
  return run_scenario(s, plant, options);
}

const std::vector<Paper>& papers() {
  static const std::vector<Paper> all{
      {"The Haptic Lever",
       "A. G. Rodríguez Ramírez, M. Nandayapa, O. O. Vergara Villegas, F. García Luna, *Haptic "
       "Augmentation Towards a Smart Learning Environment: The Haptic Lever Design*"},
      {"A wrist device",
       "*Virtual Reality Haptics*: a wearable haptic device, shown on a virtual drum kit"},
      {"Haptic Hunt",
       "A. Aranzola, B. Wong, C. Cementon, S. Li, *Haptic Hunt: a pantograph rendering of complex "
       "shapes*, 2026"},
      {"TouchWorld",
       "A. Sadirova, H. H.-V. Nguyen, M. Imad, S. Ramkumar, *TouchWorld: Haptic Exploration of "
       "AI-Generated 3D Environments*, 2026"},
      {"DIMPLE and textures",
       "A report on work from March to September 2008: DIMPLE, the ERGOS device, bowing with six "
       "degrees of freedom, textures"}};
  return all;
}

const std::vector<Source>& sources() {
  static const std::vector<Source> all = [] {
    std::vector<Source> both = haptic_lever();
    for (const Source& s : other_papers()) both.push_back(s);
    return both;
  }();
  return all;
}

std::string text(const Answer& row) {
  const Claim& c = row.claim;
  const std::string marked = fmt::format(
      "{}: {}\n  claim       {} ({})\n  closed form {}\n  simulation  {}\n  why         {}\n\n",
      row.source.name, name_of(c.verdict()), c.says, c.where, closed_form(c), simulation(c), c.why);
  // A link of the page becomes the path of a file.
  static const std::regex link(R"(\[([^\]]*)\]\(([^)#]*)[^)]*\))");
  return std::regex_replace(marked, link, "$1 (docs/$2)");
}

std::string json(const std::vector<Answer>& answers) {
  nlohmann::ordered_json j{{"schema", "feltgate-claims/1"}, {"version", FELTGATE_VERSION}};
  j["claims"] = nlohmann::ordered_json::array();
  for (const Answer& row : answers) {
    const Claim& c = row.claim;
    nlohmann::ordered_json claim{
        {"name", row.source.name},
        {"paper", papers()[static_cast<std::size_t>(row.source.paper)].title},
        {"where", c.where},
        {"claim", c.says},
        {"verdict", name_of(c.verdict())},
        {"why", c.why},
        {"closed_form", c.formula},
        {"simulation", c.simulation}};
    claim["figures"] = nlohmann::ordered_json::array();
    for (const Figure& f : c.figures) {
      nlohmann::ordered_json figure{{"what", f.what},
                                    {"unit", f.unit},
                                    {"closed_form", or_null(f.formula)},
                                    {"simulated", or_null(f.simulated)},
                                    {"asked", name_of(f.asked.kind)}};
      if (f.judges()) {
        figure["value"] = or_null(f.asked.value);
        figure["within"] = f.asked.within;
        figure["conditional"] = f.conditional;
        figure["agrees"] = f.agrees();
      }
      claim["figures"].push_back(figure);
    }
    j["claims"].push_back(claim);
  }
  return files::json_text(j);
}

std::string summary(const std::vector<Answer>& answers) {
  int holds = 0, holds_if = 0;
  for (const Answer& answer : answers) {
    holds += answer.claim.verdict() == Verdict::holds;
    holds_if += answer.claim.verdict() == Verdict::holds_if;
  }
  const auto all = static_cast<int>(answers.size());
  return fmt::format("{} claims: {} hold, {} hold under a condition, {} cannot be had.\n", all,
                     holds, holds_if, all - holds - holds_if);
}

std::string page(const std::vector<Answer>& answers) {
  std::string out = R"(# What five papers claim, and what their own numbers say

Command: `./feltgate claims` · study: [model/studies/claims](../model/studies/claims) · test:
[claims_test.cpp](../testbench/studies/claims/claims_test.cpp) · this page is written by `./feltgate claims --markdown`; a
test fails when it is out of date.

Each row is a claim: its place in the paper, its closed form with the paper's own numbers, and a simulation if one can
judge it. *Simulation* is the twin of the core in closed loop with the plant, unless the row says otherwise; nothing ran
on a board. A dash means that no simulation can judge the claim, for the reason beside it. The verdict is computed from
the figures:

- **holds**: closed form and simulation give what the paper says;
- **holds if**: they do so under the condition of the last column, which the paper does not state;
- **cannot be had**: the paper's own numbers do not give it, or a number is missing.

The figures of a column follow its text, each with its name and unit. They are from a 2-core x86_64 VM, 2026-11-26, and
take 8 s of processor time.

```
./feltgate claims                          every claim, as text
./feltgate claims window half_nm_of_7_a    only these
./feltgate claims --json claims.json       the same for a program
```
)";
  out += "\n" + summary(answers);
  int paper = -1;  // the answers are in the order of the papers
  for (const Answer& row : answers) {
    if (row.source.paper != paper) {
      paper = row.source.paper;
      const Paper& p = papers()[static_cast<std::size_t>(paper)];
      out += fmt::format(
          "\n## {}\n\n{}\n\n| claim | where | closed form | simulation | verdict |\n"
          "|---|---|---|---|---|\n",
          p.title, p.source);
    }
    const Claim& c = row.claim;
    out += fmt::format("| `{}`: {} | {} | {} | {} | **{}**{} {} |\n", row.source.name, c.says,
                       c.where, closed_form(c), simulation(c), name_of(c.verdict()),
                       c.verdict() == Verdict::holds_if ? "" : ":", c.why);
  }
  return out;
}

}  // namespace feltgate::claims
