// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate law. Documentation: docs/law-compiler.md
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "config/nearest.hpp"
#include "design/design.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "law/cpp.hpp"
#include "law/listing.hpp"
#include "tools/commands.hpp"

namespace feltgate {

namespace {

using Json = nlohmann::ordered_json;
using law::Compiled;
using law::Measured;

struct LawArguments {
  std::string law, design = "lever", json, out, cpp;
  bool listing = false, quiet = false;
};

/// The path of a law: given as one, or a name in rtl/laws.
std::string law_path(const std::string& name) {
  namespace fs = std::filesystem;
  if (name.find('/') != std::string::npos || fs::path(name).extension() == ".law") return name;
  const fs::path folder = fs::path(repository()) / "rtl/laws", path = folder / (name + ".law");
  if (fs::exists(path)) return path.string();
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".law") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  throw std::invalid_argument(
      fmt::format("\"{}\" is not in rtl/laws; {}choose one of {}, or give the path of a file", name,
                  config::did_you_mean(name, names), fmt::join(names, ", ")));
}

law::Target target(const std::string& design) {
  const auto e = design::elaborate(design::read_design(find_file(design, "rtl/designs")),
                                   design::read_registers(repository() + "/rtl/registers.toml"));
  law::Target t;
  t.design = e.design.name;
  t.tick_hz = e.design.tick_hz;
  t.clocks_per_tick = e.design.clocks_per_tick();
  t.counts_per_turn = 4 * e.design.lines;
  t.velocity = e.design.velocity;
  t.torque = e.design.torque;
  return t;
}

std::string json(const Compiled& c, const Measured& m) {
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
  j["outputs"] = Json::array();
  for (std::size_t o = 0; o < c.law.outputs.size(); ++o) {
    j["outputs"].push_back({{"name", c.law.outputs[o].name},
                            {"axis", c.law.outputs[o].axis},
                            {"bound_nm", c.bound.output[o]},
                            {"measured_nm", m.output.empty() ? 0.0 : m.output[o]}});
  }
  j["all_inputs"] = m.all_inputs;
  j["runs"] = m.runs;
  j["strips"] = Json::array();
  for (const law::Strip& s : c.bound.strips) {
    j["strips"].push_back({{"line", s.place.line},
                           {"column", s.place.column},
                           {"width_si", s.width},
                           {"jump_nm", s.jump}});
  }
  j["tables"] = Json::array();
  for (const law::TableUse& t : c.program.tables) {
    j["tables"].push_back({{"of", t.what}, {"words", t.words.size()}, {"error_words", t.error}});
  }
  return files::json_text(j);
}

int run(const LawArguments& a) {
  const std::string path = law_path(a.law);
  files::Outputs outputs;
  outputs.reads(path);
  outputs.reads(find_file(a.design, "rtl/designs"));
  files::OutputFile* json_file = outputs.open("--json", a.json);
  files::OutputFile* image_file = outputs.open("--out", a.out);
  files::OutputFile* cpp_file = outputs.open("--cpp", a.cpp);
  const Compiled c = law::compile_file(path, target(a.design));
  Measured m = law::measure_all(c);
  if (!m.all_inputs) m = law::measure(c, 1, 50000);
  if (json_file != nullptr) json_file->write(json(c, m));
  if (image_file != nullptr) image_file->write(law::text(c.image));
  if (cpp_file != nullptr) cpp_file->write(law::cpp_header(c, a.law));
  if (!a.quiet) {
    outputs.say(law::report(c, m) + (a.listing ? law::listing(c) : ""));
  }
  outputs.commit();
  for (std::size_t o = 0; o < m.output.size(); ++o) {
    if (m.output[o] > c.bound.output[o] * (1 + 1e-9) + 1e-9) return exit_failed;
  }
  return exit_ok;
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
      "by side (docs/law-compiler.md).\n"
      "  feltgate law detent\n"
      "  feltgate law detent --listing\n"
      "  feltgate law detent --out detent.img --json detent.json\n"
      "  feltgate law detent --cpp detent.hpp\n"
      "Exit code: 0 all well, 1 a run left its bound, 2 unusable input: a law that cannot be "
      "read,\n"
      "proven, fitted or scheduled, with line, reason and mend.");
  sub->add_option("law", a->law, "name in rtl/laws, or the path of a law file")
      ->required()
      ->type_name("LAW");
  sub->add_option("--design", a->design, "design point in rtl/designs")
      ->type_name("DESIGN")
      ->capture_default_str();
  sub->add_flag("--listing", a->listing, "every instruction: format, range and error");
  sub->add_option("--out", a->out, "the image that an engine runs")->type_name("FILE");
  sub->add_option("--cpp", a->cpp, "the law as a C++ template over the number type")
      ->type_name("FILE");
  sub->add_option("--json", a->json, "the same as JSON (docs/json.md)")->type_name("FILE");
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

}  // namespace feltgate
