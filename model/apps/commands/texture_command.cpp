// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate texture. Documentation: docs/devices/shapes.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
#include "studies/texture/texture_force.hpp"
#include "studies/texture/texture_law.hpp"

namespace feltgate {

namespace {

struct TextureArguments {
  std::string png, out, path, design = "lever", normals = "interpolated";
  int row = -1;
  double texel_m = 1e-3, depth_m = 2e-3, stiffness = 500, damping = 0;
  double surface_m = texture::LawRequest{}.surface_m;
  bool surface_told = false, field = false, table = false, quiet = false;
};

texture::LawRequest request(const TextureArguments& a) {
  texture::LawRequest r;
  r.texel_m = a.texel_m;
  r.depth_m = a.depth_m;
  r.stiffness_n_per_m = a.stiffness;
  r.damping_ns_per_m = a.damping;
  r.surface_m = a.field ? 0 : a.surface_m;
  r.normals = a.normals == "facets" ? texture::Normals::facets : texture::Normals::interpolated;
  return r;
}

/// Firmness of the row with texels from 10 mm to 0.1 mm, its slopes as they are.
std::string firmness_table(const std::vector<double>& row, texture::LawRequest r,
                           const law::Target& design) {
  std::string s = fmt::format("\n{:>8} {:>9} {:>15} {:>15}\n", "texel mm", "depth mm",
                              "split, share", "plane, share");
  const double ratio = r.depth_m / r.texel_m;
  for (const double texel_mm : {10.0, 3.0, 1.0, 0.3, 0.1}) {
    r.texel_m = 1e-3 * texel_mm;
    r.depth_m = ratio * r.texel_m;
    const auto compiled = law::compile_text(texture::row_law(row, r), "texture.law", design);
    const auto f = texture::firmness(compiled, row, r);
    s += fmt::format("{:>8.1f} {:>9.3f} {:>15.3f} {:>15.3f}\n", texel_mm, 1e3 * r.depth_m, f.split,
                     f.plane);
  }
  return s +
         "shares of the stiffness: upright force gained from black to 3 mm below it, with the "
         "depth split\n(engine's words) and along the normal of a plane that ends with its "
         "texel (real numbers)\n";
}

/// A way along the row, 1 mm below black, in the engine's words; its height is where force begins.
std::string path_of(const law::Compiled& c, const std::vector<double>& row,
                    const texture::LawRequest& r) {
  const double middle = 0.5 * (static_cast<double>(row.size()) - 1);
  const double half_m = std::min(0.05, middle * r.texel_m), below_m = 1e-3;
  texture::check_reach(r, half_m, below_m);
  texture::Words words(c);
  std::string s = "pen_x_m,pen_y_m,height_m,force_x_n,force_y_n\n";
  for (double x = -half_m; x <= half_m; x += std::min(0.25e-3, r.texel_m)) {
    const auto f = texture::pen_force(words, {x, r.surface_m - below_m});
    const double q = std::clamp(f.at_m.x / r.texel_m + middle, 0.0, 2 * middle);
    const auto i = std::min(static_cast<std::size_t>(q), row.size() - 2);
    const double share = row[i] + (q - static_cast<double>(i)) * (row[i + 1] - row[i]);
    s += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", f.at_m.x, f.at_m.y,
                     r.surface_m + r.depth_m * share, f.force_n.x, f.force_n.y);
  }
  return s;
}

int run(const TextureArguments& a) {
  if (a.field && (a.table || a.row >= 0 || !a.path.empty() || a.surface_told)) {
    throw std::invalid_argument(
        "--field takes the whole image, black at 0; leave away --row, --table, --path and "
        "--surface");
  }
  if (a.table && a.depth_m > a.texel_m) {
    throw std::invalid_argument(
        fmt::format("--table grows texels to 10 mm, which end with 10 mm of depth; say --depth "
                    "{:.4g}mm at most",
                    1e3 * a.texel_m));
  }
  files::Outputs outputs;
  outputs.reads(a.png);
  files::OutputFile* file = outputs.open("--output", a.out);
  files::OutputFile* path_file = outputs.open("--path", a.path);
  const texture::Image image = texture::read_png(a.png);
  const int row = a.row < 0 ? image.height / 2 : a.row;
  if (row >= image.height) {
    throw std::invalid_argument(fmt::format("{}:1: no row {}; the image has {}, 0 is the upper one",
                                            a.png, row, image.height));
  }
  texture::LawRequest r = request(a);
  const std::string stem = std::filesystem::path(a.png).stem().string();
  r.summary = a.field ? fmt::format("{}: {} x {} texels of {:.4g} mm, under three axes", stem,
                                    image.width, image.height, 1e3 * a.texel_m)
                      : fmt::format("{}: {} texels of {:.4g} mm, under the pen of a pantograph",
                                    stem, image.width, 1e3 * a.texel_m);
  const std::vector<double> shares = texture::row_of(image, row);
  const std::string text = of_file(
      a.png, [&] { return a.field ? texture::field_law(image, r) : texture::row_law(shares, r); });
  const law::Target design = law_target(a.design);
  const law::Compiled c = law::compile_text(text, a.out.empty() ? stem + ".law" : a.out, design);
  std::string said = fmt::format("{}: {} x {} pixels, ", a.png, image.width, image.height);
  said += a.field ? std::string("all of them\n") : fmt::format("row {}\n", row);
  law::Verdict verdict;
  if (a.table) {
    said += of_file(a.png, [&] { return firmness_table(shares, r, design); });
  } else {
    const law::Measured m = law::measure(c, 1, 20000);
    said += "\n" + law::report(c, m);
    verdict = law::verdict(c, m);
  }
  if (file != nullptr) file->write(text);
  if (path_file != nullptr) path_file->write(path_of(c, shares, r));
  if (!a.quiet) outputs.say(said);
  outputs.commit();
  return end_of(verdict);
}

}  // namespace

void add_texture(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<TextureArguments>();
  CLI::App* sub =
      app.add_subcommand("texture", "an image as a height field under a pen: a row, or all of it");
  sub->footer(
      "Reads a PNG of 8 bits, whose grey is height: black the surface, white --depth above it. A "
      "row\n"
      "becomes a force law for the pantograph, whose pen comes from above; with --field an image "
      "of up to\n"
      "16 x 16 pixels becomes one for three Cartesian axes on capstans of 10 mm "
      "(docs/devices/shapes.md).\n"
      "The law is compiled and proven before anything is written.\n"
      "  feltgate texture vectors/textures/ripples.png --depth 4mm\n"
      "  feltgate texture vectors/textures/ripples.png --texel 0.125mm --depth 1mm -o ripples.law\n"
      "  feltgate texture vectors/textures/ripples.png --depth 1mm --table\n"
      "  feltgate texture vectors/textures/valley.png --field --texel 2mm --depth 8mm -o "
      "valley.law\n"
      "Stiffness, damping, depth and place stay parameters that the host may change.\n"
      "Exit code: 0 all well, 1 what was measured of the law is not what was proven, 2 unusable\n"
      "input: no PNG, a broken one, 16 bits, 1 x 1 pixels, more than the law holds, too steep;\n"
      "nothing is written then.");
  sub->add_option("png", a->png, "the image")
      ->required()
      ->type_name("FILE")
      ->check(checks::no_folder());
  sub->add_option("-o,--output", a->out, "the law file")->type_name("FILE");
  sub->add_option("--row", a->row, "which row, 0 the upper one; the middle one unless told")
      ->type_name("N")
      ->check(CLI::Range(0, texture::most_side - 1));
  sub->add_flag("--field", a->field, "the whole image, for three axes");
  add_length(*sub, "--texel", &a->texel_m, "from pixel to pixel, 1mm")
      ->check(CLI::Range(0.05e-3, 20e-3));
  add_length(*sub, "--depth", &a->depth_m, "from black to white, 2mm")
      ->check(CLI::Range(0.01e-3, texture::most_depth_m));
  CLI::Option* surface =
      add_length(*sub, "--surface", &a->surface_m, "height of black over the motors, 80mm")
          ->check(CLI::Range(-0.2, 0.2));
  sub->add_option("--stiffness", a->stiffness, "N/m at first; the host may change it")
      ->type_name("N/m")
      ->check(CLI::Range(0.0, texture::most_stiffness_n_per_m))
      ->check(finite())
      ->capture_default_str();
  sub->add_option("--damping", a->damping, "N s/m, likewise")
      ->type_name("N s/m")
      ->check(CLI::Range(0.0, texture::most_damping_ns_per_m))
      ->check(finite())
      ->capture_default_str();
  sub->add_option("--normals", a->normals, "interpolated between pixels, or facets")
      ->check(CLI::IsMember({"interpolated", "facets"}))
      ->type_name("KIND")
      ->capture_default_str();
  sub->add_option("--design", a->design, "design point in rtl/designs")
      ->type_name("DESIGN")
      ->capture_default_str();
  sub->add_option("--path", a->path, "a way along the row, 1 mm below black: pen and force, as CSV")
      ->type_name("FILE");
  sub->add_flag("--table", a->table,
                "firmness with texels of 10 mm to 0.1 mm, with and without the split of the depth");
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, surface, exit_code] {
    a->surface_told = surface->count() > 0;
    *exit_code = run(*a);
  });
}

}  // namespace feltgate
