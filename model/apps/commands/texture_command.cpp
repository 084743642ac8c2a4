// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate texture. Documentation: docs/devices/shapes.md
#include <fmt/format.h>

#include <filesystem>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/made_law.hpp"
#include "files/output_file.hpp"
#include "studies/texture/texture_law.hpp"

namespace feltgate {

namespace {

struct TextureArguments {
  std::string png, out, normals = "interpolated", design = "lever";
  texture::LawRequest law;
};

int run(TextureArguments a) {
  files::Outputs outputs;
  outputs.reads(a.png);
  files::OutputFile* file = outputs.open("--output", a.out);
  const texture::Image image = texture::read_png(a.png);
  const std::string name = std::filesystem::path(a.png).stem().string();
  a.law.summary = fmt::format("{}: {} x {} texels of {:.4g} mm, under three axes", name,
                              image.width, image.height, 1e3 * a.law.texel_m);
  if (a.normals == "facets") a.law.normals = texture::Normals::facets;
  const std::string text = of_file(a.png, [&] { return texture::field_law(image, a.law); });
  return make_law(text, a.out.empty() ? name + ".law" : a.out, a.design,
                  fmt::format("{}: {} x {} pixels\n", a.png, image.width, image.height), file,
                  &outputs);
}

}  // namespace

void add_texture(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<TextureArguments>();
  CLI::App* sub = app.add_subcommand("texture", "an image as a height field under a pen");
  sub->footer(
      "Reads a PNG of 8 bits and up to 16 x 16 pixels, whose grey is height: black the surface, "
      "white\n"
      "--depth above it, and writes a force law for three Cartesian axes on capstans of 10 mm\n"
      "(docs/devices/shapes.md). The law is compiled and proven before anything is written.\n"
      "  feltgate texture vectors/textures/valley.png --texel 2mm --depth 8mm -o valley.law\n"
      "  feltgate texture vectors/textures/valley.png --texel 2mm --normals facets\n"
      "Stiffness, damping, depth and height stay parameters that the host may change.\n"
      "Exit code: 0 all well, 1 what was measured of the law is not what was proven, 2 unusable\n"
      "input; nothing is written then.");
  sub->add_option("png", a->png, "the image")
      ->required()
      ->type_name("FILE")
      ->check(checks::no_folder());
  sub->add_option("-o,--output", a->out, "the law file")->type_name("FILE");
  add_length(*sub, "--texel", &a->law.texel_m, "from pixel to pixel, 1mm")
      ->check(CLI::Range(0.05e-3, 20e-3));
  add_length(*sub, "--depth", &a->law.depth_m, "from black to white, 2mm")
      ->check(CLI::Range(0.01e-3, texture::most_depth_m));
  add_spring(*sub, &a->law, texture::most_stiffness_n_per_m, texture::most_damping_ns_per_m);
  sub->add_option("--normals", a->normals, "interpolated between pixels, or facets")
      ->check(CLI::IsMember({"interpolated", "facets"}))
      ->type_name("KIND")
      ->capture_default_str();
  add_design(*sub, &a->design);
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

}  // namespace feltgate
