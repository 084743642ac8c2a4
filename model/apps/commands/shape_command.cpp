// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate shape. Documentation: docs/devices/shapes.md
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

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
  std::string out, path, design = "lever";
  int vertices = 100;
  double radius_m = 5e-3, stiffness = 50, damping = 0;
  std::array<double, 2> centre_m{0.0, 0.12};
  double size_m = 0.06;
  bool texture = false, quiet = false;
};

constexpr double depth_m = 2e-3, step_m = 0.153e-3;

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
  r.stiffness_n_per_m = a.stiffness;
  r.damping_ns_per_m = a.damping;
  return r;
}

/// Largest number of vertices whose tables fit.
int most_vertices(const ShapeArguments& a) {
  if (a.svgs.size() > 1) return shape::most_resident_words / static_cast<int>(a.svgs.size()) - 3;
  return a.texture ? shape::most_measured_vertices : shape::most_vertices;
}

/// Options that exclude each other. Throws std::invalid_argument "what; mend".
void check(const ShapeArguments& a) {
  const bool several = a.svgs.size() > 1;
  if (a.svgs.size() > shape::most_shapes) {
    throw std::invalid_argument(fmt::format("{} SVG files; a law holds {} shapes, leave some away",
                                            a.svgs.size(), shape::most_shapes));
  }
  if (several && (a.texture || !a.path.empty())) {
    throw std::invalid_argument(
        "--texture and --path are of one shape; give one file, or leave them away");
  }
  if (const int most = most_vertices(a); a.vertices > most) {
    const std::string what =
        several ? fmt::format("{} shapes of {} vertices do not fit into table memory",
                              a.svgs.size(), a.vertices)
                : fmt::format("--texture takes table memory from {} vertices", a.vertices);
    throw std::invalid_argument(fmt::format("{}; say --vertices {}", what, most));
  }
}

int run(const ShapeArguments& a) {
  check(a);
  const bool several = a.svgs.size() > 1;
  files::Outputs outputs;
  for (const std::string& svg : a.svgs) outputs.reads(svg);
  files::OutputFile* file = outputs.open("--output", a.out);
  files::OutputFile* path_file = outputs.open("--path", a.path);
  std::vector<shape::Polygon> polygons;
  shape::Curve curve;
  std::string names, said;
  for (const std::string& svg : a.svgs) {
    const Drawn d = drawn(a, svg);
    curve = d.curve;
    if (several) said += fmt::format("shape {}: ", polygons.size());
    polygons.push_back(polygon_of(svg, curve, a.vertices));
    said += fmt::format("{}: {} corners in the file, {:.1f} mm around, {} vertices\n", svg,
                        d.read.size(), 1e3 * curve.length_m, a.vertices);
    names += (names.empty() ? "" : ", ") + std::filesystem::path(svg).stem().string();
  }
  const shape::LawRequest r =
      request(a, fmt::format("{}: {} vertices{}, corners of {:.3g} mm", names, a.vertices,
                             several ? " each" : "", 1e3 * a.radius_m));
  const std::string text =
      several ? shape::law_text(polygons, r) : shape::law_text(polygons.front(), r);
  const law::Compiled c = law::compile_text(
      text, a.out.empty() ? (several ? "shapes" : names) + ".law" : a.out, law_target(a.design));
  const law::Measured m = law::measure(c, 1, 20000);
  said += "\n" + law::report(c, m);
  if (file != nullptr) file->write(text);
  if (path_file != nullptr) {
    path_file->write(path_of(shape::around(c.law, curve, a.stiffness, depth_m, step_m)));
  }
  if (!a.quiet) outputs.say(said);
  outputs.commit();
  return end_of(law::verdict(c, m));
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
  sub->add_option("--path", a->path, "a way around at 2 mm depth: pen and force, as CSV")
      ->type_name("FILE");
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, vertices, exit_code] {
    if (vertices->count() == 0) a->vertices = std::min(a->vertices, most_vertices(*a));
    *exit_code = run(*a);
  });
}

}  // namespace feltgate
