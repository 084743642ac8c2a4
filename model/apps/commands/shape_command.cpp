// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate shape. Documentation: docs/devices/shapes.md
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/made_law.hpp"
#include "files/output_file.hpp"
#include "studies/shape/shape_law.hpp"

namespace feltgate {

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
  files::Outputs outputs;
  outputs.reads(a.svg);
  files::OutputFile* file = outputs.open("--output", a.out);
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
  const std::string name = std::filesystem::path(a.svg).stem().string();
  a.law.summary =
      fmt::format("{}: {} vertices, corners of {:.3g} mm", name, a.vertices, 1e3 * a.radius_m);
  const std::string said =
      fmt::format("{}: {} corners in the file, {:.1f} mm around, {} vertices\n", a.svg,
                  outline.size(), 1e3 * curve.length_m, a.vertices);
  return make_law(shape::law_text(polygon, a.law), a.out.empty() ? name + ".law" : a.out, a.design,
                  said, file, &outputs);
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
      "  feltgate law ./fish.law\n"
      "Exit code: 0 all well, 1 what was measured of the law is not what was proven, 2 unusable\n"
      "input; nothing is written then.");
  sub->add_option("svg", a->svg, "an SVG file with one closed outline")
      ->required()
      ->type_name("FILE")
      ->check(checks::no_folder());
  sub->add_option("-o,--output", a->out, "the law file")->type_name("FILE");
  sub->add_option("--vertices", a->vertices, "on the outline, more where it bends")
      ->type_name("N")
      ->check(CLI::Range(shape::fewest_vertices, shape::most_vertices))
      ->capture_default_str();
  add_length(*sub, "--radius", &a->radius_m, "of every corner, 5mm; 0mm: as drawn")
      ->check(finite(0));
  add_length(*sub, "--size", &a->size_m, "larger side of the shape, 60mm")->check(finite(1e-3));
  sub->add_option("--centre", a->centre_m, "its middle, m, motors at 0 0")
      ->type_name("X Y")
      ->check(finite())
      ->capture_default_str();
  add_spring(*sub, &a->law, shape::most_stiffness_n_per_m, shape::most_damping_ns_per_m);
  add_design(*sub, &a->design);
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

}  // namespace feltgate
