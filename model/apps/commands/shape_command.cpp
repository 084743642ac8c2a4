// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate shape. Documentation: docs/devices/shapes.md
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/law_target.hpp"
#include "apps/commands/made_law.hpp"
#include "files/output_file.hpp"
#include "law/compile.hpp"
#include "law/listing.hpp"
#include "law/measure.hpp"
#include "studies/shape/pen_force.hpp"
#include "studies/shape/shape_law.hpp"

namespace feltgate {

namespace {

constexpr double least_size_m = 1e-3;

struct ShapeArguments {
  std::vector<std::string> svgs;
  std::string out, path, law = "proxy", design = "lever";
  int vertices = 100;
  double radius_m = 5e-3, stiffness = 50, damping = 0;
  std::array<double, 2> centre_m{0.0, 0.12};
  double size_m = 0.06;
  bool texture = false, friction = false, table = false, quiet = false;
};

const std::map<std::string, shape::Kind> kinds{
    {"proxy", shape::Kind::proxy}, {"simple", shape::Kind::simple}, {"walk", shape::Kind::walk}};

std::string name_of(shape::Kind kind) {
  for (const auto& [name, k] : kinds) {
    if (k == kind) return name;
  }
  return {};
}

constexpr double depth_m = 2e-3, step_m = 0.153e-3;

std::string row(const law::Compiled& c, const shape::Felt& f, const std::string& kind,
                int vertices) {
  return fmt::format("{:<8} {:>8} {:>12} {:>8.1f} {:>10.2f} {:>12.1f} {:>12.1f} {:>6}\n", kind,
                     vertices, c.assembled.instructions.size(), c.rate_hz / 1e3,
                     1e3 * std::max(c.bound.output[0], c.bound.output[1]), 100 * f.rms_error,
                     100 * f.most_step, f.jumps);
}

std::string path_of(const shape::Felt& f) {
  std::string s = "pen_x_m,pen_y_m,force_x_n,force_y_n\n";
  for (std::size_t i = 0; i < f.pen_m.size(); ++i) {
    s += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", f.pen_m[i].x, f.pen_m[i].y, f.force_n[i].x,
                     f.force_n[i].y);
  }
  return s;
}

shape::Polygon polygon_of(const std::string& svg, const shape::Curve& curve, int vertices) {
  return of_file(svg, [&] {
    shape::Polygon p = shape::sampled(curve, vertices);
    if (shape::crosses_itself(p.at)) {
      throw std::invalid_argument(fmt::format(
          "with {} vertices the outline crosses itself; take more --vertices", vertices));
    }
    return p;
  });
}

/// An SVG file as a curve within the pen's reach.
struct Drawn {
  shape::Outline read;
  shape::Curve curve;
};

Drawn drawn(const ShapeArguments& a, const std::string& svg) {
  shape::Placing placing;
  placing.size_m = a.size_m;
  placing.centre_m = {a.centre_m[0], a.centre_m[1]};
  Drawn d{shape::read_svg(svg), {}};
  d.curve =
      of_file(svg, [&] { return shape::rounded(shape::placed(d.read, placing), a.radius_m); });
  return d;
}

shape::LawRequest request(const ShapeArguments& a, const std::string& summary) {
  shape::LawRequest r;
  r.summary = summary;
  r.texture = a.texture;
  r.friction = a.friction;
  r.stiffness_n_per_m = a.stiffness;
  r.damping_ns_per_m = a.damping;
  return r;
}

/// Name of the option that needs table memory for the distance along the outline; nullptr if none.
const char* of_way(const ShapeArguments& a) {
  return a.texture ? "--texture" : a.friction ? "--friction" : nullptr;
}

/// Largest number of vertices whose tables fit.
int most_vertices(const ShapeArguments& a) {
  if (a.svgs.size() > 1) return shape::most_resident_words / static_cast<int>(a.svgs.size()) - 3;
  return of_way(a) != nullptr ? shape::most_measured_vertices : shape::most_vertices;
}

/// Options that exclude each other. Throws std::invalid_argument "what; mend".
void check(const ShapeArguments& a) {
  const bool several = a.svgs.size() > 1;
  if (a.svgs.size() > shape::most_shapes) {
    throw std::invalid_argument(fmt::format("{} SVG files; a law holds {} shapes, leave some away",
                                            a.svgs.size(), shape::most_shapes));
  }
  const char* way = of_way(a);
  if (way != nullptr && (a.law != "proxy" || a.table || several)) {
    throw std::invalid_argument(
        fmt::format("{} is for one shape with --law proxy, without --table; leave one away", way));
  }
  if (several && (a.law != "proxy" || a.table || !a.path.empty())) {
    throw std::invalid_argument(
        "--law, --table and --path are of one shape; give one file, or leave them away");
  }
  if (const int most = most_vertices(a); a.vertices > most) {
    const std::string what =
        several ? fmt::format("{} shapes of {} vertices do not fit into table memory",
                              a.svgs.size(), a.vertices)
                : fmt::format("{} takes table memory from {} vertices", way, a.vertices);
    throw std::invalid_argument(fmt::format("{}; say --vertices {}", what, most));
  }
}

/// Makes a law with several shapes.
int run_several(const ShapeArguments& a) {
  files::Outputs outputs;
  for (const std::string& svg : a.svgs) outputs.reads(svg);
  files::OutputFile* file = outputs.open("--output", a.out);
  std::vector<shape::Polygon> polygons;
  std::string names, said;
  for (const std::string& svg : a.svgs) {
    const auto [read, curve] = drawn(a, svg);
    polygons.push_back(polygon_of(svg, curve, a.vertices));
    said += fmt::format("shape {}: {}, {} corners in the file, {:.1f} mm around, {} vertices\n",
                        polygons.size() - 1, svg, read.size(), 1e3 * curve.length_m, a.vertices);
    names += (names.empty() ? "" : ", ") + std::filesystem::path(svg).stem().string();
  }
  const std::string text =
      shape::law_text(polygons, request(a, fmt::format("{}: {} vertices each, corners of {:.3g} mm",
                                                       names, a.vertices, 1e3 * a.radius_m)));
  const law::Compiled c =
      law::compile_text(text, a.out.empty() ? "shapes.law" : a.out, law_target(a.design));
  const law::Measured m = law::measure(c, 1, 20000);
  said += "\n" + law::report(c, m);
  if (file != nullptr) file->write(text);
  if (!a.quiet) outputs.say(said);
  outputs.commit();
  return end_of(law::verdict(c, m));
}

int run(const ShapeArguments& a) {
  check(a);
  if (a.svgs.size() > 1) return run_several(a);
  const std::string& svg = a.svgs.front();
  files::Outputs outputs;
  outputs.reads(svg);
  files::OutputFile* file = outputs.open("--output", a.out);
  files::OutputFile* path_file = outputs.open("--path", a.path);
  const Drawn d = drawn(a, svg);
  const shape::Curve& curve = d.curve;
  const law::Target design = law_target(a.design);
  const std::string stem = std::filesystem::path(svg).stem().string();
  const auto text_of = [&](shape::Kind kind, int vertices) {
    shape::LawRequest r = request(a, fmt::format("{}: {} vertices, corners of {:.3g} mm, {}", stem,
                                                 vertices, 1e3 * a.radius_m, name_of(kind)));
    r.kind = kind;
    return shape::law_text(polygon_of(svg, curve, vertices), r);
  };
  const std::string text = text_of(kinds.at(a.law), a.vertices);
  const law::Compiled c = law::compile_text(text, a.out.empty() ? stem + ".law" : a.out, design);
  std::string said = fmt::format("{}: {} corners in the file, {:.1f} mm around, {} vertices\n", svg,
                                 d.read.size(), 1e3 * curve.length_m, a.vertices);
  law::Verdict verdict;
  if (a.table) {
    said +=
        fmt::format("\n{:<8} {:>8} {:>12} {:>8} {:>10} {:>12} {:>12} {:>6}\n", "law", "vertices",
                    "instructions", "kHz", "bound mNm", "rms error %", "most step %", "jumps");
    for (const shape::Kind kind : {shape::Kind::simple, shape::Kind::walk, shape::Kind::proxy}) {
      for (const int n : {20, 40, 100}) {
        const law::Compiled one = law::compile_text(text_of(kind, n), stem + ".law", design);
        said +=
            row(one, shape::around(one.law, curve, a.stiffness, depth_m, step_m), name_of(kind), n);
      }
    }
    said += fmt::format(
        "around at {:.1f} mm depth in steps of {:.3f} mm: error against the smooth curve, largest "
        "change of force\nin a step, turns of its direction beyond 30 degrees in a step\n",
        1e3 * depth_m, 1e3 * step_m);
  } else {
    const law::Measured m = law::measure(c, 1, 20000);
    said += "\n" + law::report(c, m);
    verdict = law::verdict(c, m);
  }
  if (file != nullptr) file->write(text);
  if (path_file != nullptr) {
    path_file->write(path_of(shape::around(c.law, curve, a.stiffness, depth_m, step_m)));
  }
  if (!a.quiet) outputs.say(said);
  outputs.commit();
  return end_of(verdict);
}

}  // namespace

void add_shape(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<ShapeArguments>();
  CLI::App* sub =
      app.add_subcommand("shape", "an SVG outline as a hidden shape for the pantograph");
  sub->footer(
      "Reads the one closed path of an SVG file, scales and places it into the pen's reach, "
      "rounds\n"
      "its corners, puts vertices along it, and writes a force law that pushes the pen out of it\n"
      "(docs/devices/shapes.md). The law is compiled and proven before anything is written.\n"
      "  feltgate shape vectors/shapes/square.svg\n"
      "  feltgate shape vectors/shapes/fish.svg -o fish.law --vertices 40 --radius 3mm\n"
      "  feltgate shape vectors/shapes/fish.svg --radius 3mm --table\n"
      "  feltgate shape vectors/shapes/square.svg vectors/shapes/fish.svg --vertices 40 -o "
      "two.law\n"
      "  feltgate law ./fish.law\n"
      "Of several shapes the law's parameter `shape` chooses one, 0 the first, while it is felt.\n"
      "Exit code: 0 all well, 1 what was measured of the law is not what was proven, 2 unusable\n"
      "input: no path, several, an open one, one that crosses itself, out of reach, an edge too\n"
      "short for the radius; nothing is written then.");
  sub->add_option("svg", a->svgs, "SVG files with one closed outline each; up to seven in one law")
      ->required()
      ->expected(-1)
      ->type_name("FILE")
      ->check(checks::no_folder());
  sub->add_option("-o,--output", a->out, "the law file")->type_name("FILE");
  sub->add_option("--law", a->law, "proxy, simple (nearest edge), walk (edge by edge)")
      ->check(CLI::IsMember({"proxy", "simple", "walk"}))
      ->type_name("LAW")
      ->capture_default_str();
  const CLI::Option* vertices =
      sub->add_option("--vertices", a->vertices,
                      "on the outline, more where it bends; fewer where 100 do not fit")
          ->type_name("N")
          ->check(CLI::Range(shape::fewest_vertices, shape::most_vertices))
          ->capture_default_str();
  add_length(*sub, "--radius", &a->radius_m, "of every corner, 5mm; 0mm: as drawn")
      ->check(finite(0));
  add_length(*sub, "--size", &a->size_m, "larger side of the shape, 60mm")
      ->check(finite(least_size_m));
  sub->add_option("--centre", a->centre_m, "its middle, m, motors at 0 0")
      ->type_name("X Y")
      ->check(finite())
      ->capture_default_str();
  sub->add_option("--stiffness", a->stiffness, "N/m at first; the host may change it")
      ->type_name("N/m")
      ->check(CLI::Range(0.0, shape::most_stiffness_n_per_m))
      ->check(finite())
      ->capture_default_str();
  sub->add_option("--damping", a->damping, "N s/m, likewise")
      ->type_name("N s/m")
      ->check(CLI::Range(0.0, shape::most_damping_ns_per_m))
      ->check(finite())
      ->capture_default_str();
  sub->add_option("--design", a->design, "design point in rtl/designs")
      ->type_name("DESIGN")
      ->capture_default_str();
  sub->add_flag("--texture", a->texture,
                "ripples along the outline: parameters ripple and ripples, at most 80 vertices");
  sub->add_flag("--friction", a->friction,
                "anchored by the way along the outline: parameters friction and grip, likewise");
  sub->add_option("--path", a->path, "a way around at 2 mm depth: pen and force, as CSV")
      ->type_name("FILE");
  sub->add_flag("--table", a->table, "three laws beside each other instead of the proof");
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, vertices, exit_code] {
    if (vertices->count() == 0) a->vertices = std::min(a->vertices, most_vertices(*a));
    *exit_code = run(*a);
  });
}

}  // namespace feltgate
