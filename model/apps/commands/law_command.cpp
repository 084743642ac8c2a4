// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate law, and shape and texture, which make a law from a drawing or an image. Documentation:
// docs/laws.md, docs/devices/shapes.md
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "apps/commands/commands.hpp"
#include "design/engine_map.hpp"
#include "files/output_file.hpp"
#include "files/program.hpp"
#include "files/table.hpp"
#include "law/compile.hpp"
#include "law/gappa.hpp"
#include "law/listing.hpp"
#include "law/measure.hpp"
#include "law/verdict.hpp"
#include "studies/shape/shape_law.hpp"
#include "studies/texture/texture_law.hpp"

namespace feltgate {

namespace {

using Json = nlohmann::ordered_json;
using law::Compiled;
using law::Measured;

/// The exit code of a command that makes a law; prints the failures again as the last lines.
int end_of(const law::Verdict& verdict) {
  for (const std::string& f : verdict.failures) fmt::print(stderr, "feltgate: failed: {}\n", f);
  return verdict.failures.empty() ? exit_ok : exit_failed;
}

/// Makes a law of the file `in`; make(name) returns its text and what to say of it. Compiles and
/// measures the law, and writes it to `out` unless that is empty. Returns the exit code.
template <class Make>
int make_law(const std::string& in, const std::string& out, const std::string& design,
             const Make& make) {
  files::Outputs outputs;
  outputs.reads(in);
  files::OutputFile* file = outputs.open("--output", out);
  const std::string name = std::filesystem::path(in).stem().string();
  const auto [text, said] = make(name);
  const law::Compiled c = law::compile_text(text, out.empty() ? name + ".law" : out,
                                            design::law_target(elaborated_design(design)));
  const law::Measured m = law::measure(c, 1, 20000);
  if (file != nullptr) file->write(text);
  outputs.say(said + "\n" + law::report(c, m));
  outputs.commit();
  return end_of(law::verdict(c, m));
}

/// Returns make(); adds the name of the file to its errors.
template <class Make>
auto of_file(const std::string& file, const Make& make) {
  try {
    return make();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(fmt::format("{}:1: {}", file, e.what()));
  }
}

/// A finite number of at least `low` (CLI::Range would accept a NaN); shows nothing in the help.
CLI::Validator finite(double low = -1e300) {
  return {[low](std::string& text) {
            double value = 0;
            if (!CLI::detail::lexical_cast(text, value)) return text + " is no number";
            if (!std::isfinite(value)) return text + " is no finite number; give one";
            if (value < low) return fmt::format("{:g} is too small; give {:g} or more", value, low);
            return std::string();
          },
          ""};
}

/// Adds an option for a length with its unit, mm or m; `value` receives m.
CLI::Option* add_length(CLI::App& to, const std::string& name, double* value,
                        const std::string& what) {
  static const std::map<std::string, double> units{{"mm", 1e-3}, {"m", 1.0}};
  return option(to, name, *value, "LENGTH", what)
      ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::UNIT_REQUIRED))
      ->check(finite());
}

/// Adds the options for the spring and the damper of a law.
template <class Request>
void add_spring(CLI::App& to, Request* request, double most_n_per_m, double most_ns_per_m) {
  defaulted(to, "--stiffness", request->stiffness_n_per_m, "N/m",
            "N/m at first; the host may change it")
      ->check(CLI::Range(0.0, most_n_per_m))
      ->check(finite());
  defaulted(to, "--damping", request->damping_ns_per_m, "N s/m", "N s/m, likewise")
      ->check(CLI::Range(0.0, most_ns_per_m))
      ->check(finite());
}

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
  const Compiled c = law::compile_file(path, design::law_target(elaborated_design(a.design)));
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
      R"(Reads a law (docs/laws.md), chooses formats, makes instructions for the engine and proves
that none saturates and how far torque is from the law in real numbers; then runs both side
by side (docs/laws.md).
  feltgate law detent
  feltgate law detent --listing
  feltgate law detent -o detent.img --json detent.json
  feltgate law detent --gappa lemmas
  feltgate law detent --design lever_law --memories memories
Exit code: 0 all well, 1 a run left its bound or was off by more than 10 % of what the law
gave, more than 30 % of the runs, or half of those on one side of a comparison, had to be
left out, the bound is as large as all that the law gave in the runs, or Gappa did not
prove a lemma, 2 unusable input: a law that cannot be read, proven, fitted or scheduled, or
whose bound is as large as its output's range, with line, reason and mend.)");
  option(*sub, "law", a->law, "LAW", "name in rtl/laws, or the path of a law file")->required();
  defaulted(*sub, "--design", a->design, "DESIGN", "design point in rtl/designs");
  sub->add_flag("--listing", a->listing, "every instruction: format, range and error");
  option(*sub, "-o,--output", a->out, "FILE", "the image that an engine runs");
  option(*sub, "--json", a->json, "FILE", "the same as JSON (docs/json.md)");
  option(*sub, "--gappa", a->gappa, "DIR", "the proof again, by Gappa: its problems as files");
  option(*sub, "--memories", a->memories, "DIR",
         "what the RTL's engine holds after configuration, for a board without a host");
  defaulted(*sub, "--cells", a->cells, "N", "cells that Gappa gets; 0: all", CLI::Range(0, 1000));
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

namespace {

struct ShapeArguments {
  std::string svg, out, design = "lever";
  int vertices = shape::most_vertices;
  double radius_m = 5e-3;
  std::array<double, 2> centre_m{0.0, 0.12};
  double size_m = 0.06;
  shape::LawRequest law;
};

int run(ShapeArguments a) {
  return make_law(a.svg, a.out, a.design, [&](const std::string& name) {
    const shape::Outline outline = shape::read_svg(a.svg);
    const shape::Curve curve = of_file(a.svg, [&] {
      return shape::rounded(shape::placed(outline, {a.size_m, {a.centre_m[0], a.centre_m[1]}}),
                            a.radius_m);
    });
    const shape::Polygon polygon = shape::sampled(curve, a.vertices);
    if (shape::crosses_itself(polygon.at)) {
      throw std::invalid_argument(
          fmt::format("{}:1: with {} vertices the outline crosses itself; take more --vertices",
                      a.svg, a.vertices));
    }
    a.law.summary =
        fmt::format("{}: {} vertices, corners of {:.3g} mm", name, a.vertices, 1e3 * a.radius_m);
    return std::pair{shape::law_text(polygon, a.law),
                     fmt::format("{}: {} corners in the file, {:.1f} mm around, {} vertices\n",
                                 a.svg, outline.size(), 1e3 * curve.length_m, a.vertices)};
  });
}

}  // namespace

void add_shape(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<ShapeArguments>();
  CLI::App* sub =
      app.add_subcommand("shape", "an SVG outline as a hidden shape for the pantograph");
  sub->footer(
      R"(Reads the one closed path of an SVG file, scales and places it into the pen's reach, rounds
its corners, puts vertices along it, and writes a force law that pushes the pen out of it
(docs/devices/shapes.md). The law is compiled and proven before anything is written.
  feltgate shape vectors/shapes/square.svg
  feltgate shape vectors/shapes/fish.svg -o fish.law --vertices 40 --radius 3mm
  feltgate law ./fish.law
Exit code: 0 all well, 1 what was measured of the law is not what was proven, 2 unusable
input; nothing is written then.)");
  option(*sub, "svg", a->svg, "FILE", "an SVG file with one closed outline", checks::no_folder())
      ->required();
  option(*sub, "-o,--output", a->out, "FILE", "the law file");
  defaulted(*sub, "--vertices", a->vertices, "N", "on the outline, more where it bends",
            CLI::Range(shape::fewest_vertices, shape::most_vertices));
  add_length(*sub, "--radius", &a->radius_m, "of every corner, 5mm; 0mm: as drawn")
      ->check(finite(0));
  add_length(*sub, "--size", &a->size_m, "larger side of the shape, 60mm")->check(finite(1e-3));
  defaulted(*sub, "--centre", a->centre_m, "X Y", "its middle, m, motors at 0 0", finite());
  add_spring(*sub, &a->law, shape::most_stiffness_n_per_m, shape::most_damping_ns_per_m);
  defaulted(*sub, "--design", a->design, "DESIGN", "design point in rtl/designs");
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

namespace {

struct TextureArguments {
  std::string png, out, normals = "interpolated", design = "lever";
  texture::LawRequest law;
};

int run(TextureArguments a) {
  return make_law(a.png, a.out, a.design, [&](const std::string& name) {
    const texture::Image image = texture::read_png(a.png);
    a.law.summary = fmt::format("{}: {} x {} texels of {:.4g} mm, under three axes", name,
                                image.width, image.height, 1e3 * a.law.texel_m);
    if (a.normals == "facets") a.law.normals = texture::Normals::facets;
    return std::pair{of_file(a.png, [&] { return texture::field_law(image, a.law); }),
                     fmt::format("{}: {} x {} pixels\n", a.png, image.width, image.height)};
  });
}

}  // namespace

void add_texture(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<TextureArguments>();
  CLI::App* sub = app.add_subcommand("texture", "an image as a height field under a pen");
  sub->footer(
      R"(Reads a PNG of 8 bits and up to 16 x 16 pixels, whose grey is height: black the surface, white
--depth above it, and writes a force law for three Cartesian axes on capstans of 10 mm
(docs/devices/shapes.md). The law is compiled and proven before anything is written.
  feltgate texture vectors/textures/valley.png --texel 2mm --depth 8mm -o valley.law
  feltgate texture vectors/textures/valley.png --texel 2mm --normals facets
Stiffness, damping, depth and height stay parameters that the host may change.
Exit code: 0 all well, 1 what was measured of the law is not what was proven, 2 unusable
input; nothing is written then.)");
  option(*sub, "png", a->png, "FILE", "the image", checks::no_folder())->required();
  option(*sub, "-o,--output", a->out, "FILE", "the law file");
  add_length(*sub, "--texel", &a->law.texel_m, "from pixel to pixel, 1mm")
      ->check(CLI::Range(0.05e-3, 20e-3));
  add_length(*sub, "--depth", &a->law.depth_m, "from black to white, 2mm")
      ->check(CLI::Range(0.01e-3, texture::most_depth_m));
  add_spring(*sub, &a->law, texture::most_stiffness_n_per_m, texture::most_damping_ns_per_m);
  defaulted(*sub, "--normals", a->normals, "KIND", "interpolated between pixels, or facets",
            CLI::IsMember({"interpolated", "facets"}));
  defaulted(*sub, "--design", a->design, "DESIGN", "design point in rtl/designs");
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

}  // namespace feltgate
