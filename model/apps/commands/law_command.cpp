// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate law. Documentation: docs/laws.md
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/commands/commands.hpp"
#include "apps/commands/law_target.hpp"
#include "apps/commands/made_law.hpp"
#include "design/design.hpp"
#include "feltgate/nearest.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "files/program.hpp"
#include "law/gappa.hpp"
#include "law/listing.hpp"
#include "law/verdict.hpp"

namespace feltgate {

namespace {

using Json = nlohmann::ordered_json;
using law::Compiled;
using law::Measured;

struct LawArguments {
  std::string law, design = "lever", json, out, gappa, memories;
  int cells = 4;
  bool listing = false, quiet = false;
};

std::string json(const Compiled& c, const Measured& m, const law::GappaCount* g) {
  Json j{{"schema", "feltgate-law/1"}, {"version", FELTGATE_VERSION}};
  j["law"] = c.law.name;
  j["design"] = c.target.design;
  j["instructions"] = c.assembled.instructions.size();
  j["clocks_per_instruction"] = c.target.round_clocks;
  j["clocks_per_run"] =
      engine_period(static_cast<int>(c.assembled.instructions.size()), c.target.axes);
  j["ticks_per_run"] = c.divider;
  j["rate_hz"] = c.rate_hz;
  j["unproven"] = c.bound.unproven.size();
  j["cells"] = c.bound.cells;
  j["states_bounded"] = c.bound.states_bounded;
  j["parameters"] = Json::array();
  for (const law::ImageWord& w : c.image.words) {
    j["parameters"].push_back({{"name", w.name},
                               {"word", w.word},
                               {"unit", w.unit},
                               {"value_si", w.initial * w.scale},
                               {"step_si", w.scale},
                               {"lower_word", w.lower},
                               {"upper_word", w.upper},
                               {"formula", w.formula}});
  }
  const std::vector<law::Span> ranges = law::output_ranges(c.law, c.target);
  const std::vector<bool> useful = law::useful_bounds(c, m);
  j["outputs"] = Json::array();
  for (std::size_t o = 0; o < c.law.outputs.size(); ++o) {
    j["outputs"].push_back({{"name", c.law.outputs[o].name},
                            {"axis", c.law.outputs[o].axis},
                            {"bound_nm", c.bound.output[o]},
                            {"bound_as_set_nm", c.bound.as_set[o]},
                            {"range_nm", {ranges[o].lo, ranges[o].hi}},
                            {"bound_is_useful", static_cast<bool>(useful[o])},
                            {"reached_nm", {m.reached[o].lo, m.reached[o].hi}},
                            {"measured_nm", m.output.empty() ? 0.0 : m.output[o]}});
  }
  j["all_inputs"] = m.all_inputs;
  j["runs"] = m.runs;
  j["left_out"] = m.in_strips;
  j["free_runs"] = {{"runs", m.free.runs},
                    {"starts", m.free.acting},
                    {"starts_that_left_the_law", m.free.left},
                    {"largest_error_nm", m.free.most}};
  const law::Verdict v = law::verdict(c, m);
  j["failures"] = v.failures;
  j["warnings"] = v.warnings;
  j["strips"] = Json::array();
  for (const law::Strip& s : c.bound.strips) {
    j["strips"].push_back({{"line", s.place.line},
                           {"column", s.place.column},
                           {"width_si", s.width},
                           {"jump_nm", s.jump},
                           {"jump_as_set_nm", s.jump_as_set}});
  }
  j["tables"] = Json::array();
  for (const law::TableUse& t : c.program.tables) {
    j["tables"].push_back({{"of", t.what}, {"words", t.words.size()}, {"error_words", t.error}});
  }
  if (g != nullptr) {
    j["gappa"] = {{"instructions", g->steps},
                  {"uncovered", g->uncovered},
                  {"cells", g->cells},
                  {"lemmas", g->lemmas},
                  {"not_proven", g->open}};
  }
  return files::json_text(j);
}

/// Writes the lemmas as files in the folder and proves each with Gappa.
law::GappaCount gappa(const Compiled& c, const LawArguments& a) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  const law::GappaCount count = law::prove_again(c, a.cells, [&](const law::GappaLemma& l) {
    const std::string path = (std::filesystem::path(a.gappa) / l.name).string();
    files::OutputFile file("--gappa", path);
    file.write(l.text);
    file.commit();
    return files::run_program({"gappa", path}, nowhere, nowhere) == 0;
  });
  close(nowhere);
  return count;
}

std::string text(const Compiled& c, const law::GappaCount& g) {
  std::string s = fmt::format(
      "gappa: {} of {} instructions covered; {} of {} lemmas proven, of {} of {} cells\n",
      g.steps - static_cast<int>(g.uncovered.size()), g.steps,
      g.lemmas - static_cast<int>(g.open.size()), g.lemmas, g.cells, g.all_cells);
  for (const int i : g.uncovered) {
    const law::Step& step = c.program.steps[static_cast<std::size_t>(i)];
    s += fmt::format("gappa: not covered: instruction {}, {}, of line {}\n", i,
                     EngineMap::op_names[static_cast<std::size_t>(step.op)], step.place.line);
  }
  for (const std::string& name : g.open) s += fmt::format("gappa: not proven: {}\n", name);
  return s;
}

/// Writes the initial memory contents of an engine without a host.
void write_memories(const Compiled& c, const std::string& folder) {
  const law::Content content = law::content(c.image, folder + "/");
  const std::pair<const char*, const std::string*> all[] = {{"program.mem", &content.program},
                                                            {"data.mem", &content.data},
                                                            {"table.mem", &content.table},
                                                            {"law.svh", &content.parameters}};
  for (const auto& [name, words] : all) {
    files::OutputFile file("--memories", (std::filesystem::path(folder) / name).string());
    file.write(*words);
    file.commit();
  }
}

int run(const LawArguments& a) {
  const std::string path = find_law(a.law);
  files::Outputs outputs;
  outputs.reads(path);
  outputs.reads(find_file(a.design, "rtl/designs"));
  files::OutputFile* json_file = outputs.open("--json", a.json);
  files::OutputFile* image_file = outputs.open("--output", a.out);
  outputs.folder("--gappa", a.gappa);
  outputs.folder("--memories", a.memories);
  const Compiled c = law::compile_file(path, law_target(a.design));
  Measured m = law::measure_all(c);
  if (!m.all_inputs) m = law::measure(c, 1, 50000);
  m.free = law::measure_free(c, 1, 20000);
  law::GappaCount again;
  if (!a.gappa.empty()) again = gappa(c, a);
  if (json_file != nullptr) json_file->write(json(c, m, a.gappa.empty() ? nullptr : &again));
  if (image_file != nullptr) image_file->write(law::text(c.image));
  if (!a.memories.empty()) write_memories(c, a.memories);
  if (!a.quiet) {
    outputs.say(law::report(c, m) + (a.gappa.empty() ? "" : text(c, again)) +
                (a.listing ? law::listing(c) : ""));
  }
  outputs.commit();
  const int code = end_of(law::verdict(c, m));
  return again.open.empty() ? code : exit_failed;
}

}  // namespace

void add_law(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<LawArguments>();
  CLI::App* sub = app.add_subcommand(
      "law", "a force law from a file: its formats, rate and proven error, and its image");
  sub->footer(
      "Reads a law (docs/laws.md), chooses formats, makes instructions for the engine and proves\n"
      "that none saturates and how far torque is from the law in real numbers; then runs both "
      "side\n"
      "by side (docs/laws.md).\n"
      "  feltgate law detent\n"
      "  feltgate law detent --listing\n"
      "  feltgate law detent -o detent.img --json detent.json\n"
      "  feltgate law detent --gappa lemmas\n"
      "  feltgate law detent --design lever_law --memories memories\n"
      "Exit code: 0 all well, 1 a run left its bound or was off by more than 10 % of what the law\n"
      "gave, more than 30 % of the runs, or half of those on one side of a comparison, had to be\n"
      "left out, the bound is as large as all that the law gave in the runs, or Gappa did not\n"
      "prove a lemma, 2 unusable input: a law that cannot be read, proven, fitted or scheduled, "
      "or\n"
      "whose bound is as large as its output's range, with line, reason and mend.");
  sub->add_option("law", a->law, "name in rtl/laws, or the path of a law file")
      ->required()
      ->type_name("LAW");
  add_design(*sub, &a->design);
  sub->add_flag("--listing", a->listing, "every instruction: format, range and error");
  sub->add_option("-o,--output", a->out, "the image that an engine runs")->type_name("FILE");
  sub->add_option("--json", a->json, "the same as JSON (docs/json.md)")->type_name("FILE");
  sub->add_option("--gappa", a->gappa, "the proof again, by Gappa: its problems as files")
      ->type_name("DIR");
  sub->add_option("--memories", a->memories,
                  "what the RTL's engine holds after configuration, for a board without a host")
      ->type_name("DIR");
  sub->add_option("--cells", a->cells, "cells that Gappa gets; 0: all")
      ->type_name("N")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

}  // namespace feltgate
