// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/texture/image.hpp"

#include <fmt/format.h>
#include <png.h>

#include <stdexcept>

namespace feltgate::texture {

Image read_png(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const auto refuse = [&](const std::string& said) {
    png_image_free(&png);
    throw std::invalid_argument(path + ":1: " + said);
  };
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) {
    refuse(fmt::format("no PNG image ({}); give an 8-bit PNG", png.message));
  }
  if ((png.format & PNG_FORMAT_FLAG_LINEAR) != 0) refuse("16 bits a channel; save it with 8");
  if (png.width < 2 || png.height < 1 || png.width > most_side || png.height > most_side) {
    refuse(fmt::format("{} x {} pixels; a texture has 2 to {} along a row, and up to {} rows",
                       png.width, png.height, most_side, most_side));
  }
  png.format = PNG_FORMAT_GRAY;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(png));
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&png, &black, pixels.data(), 0, nullptr) == 0) {
    refuse(fmt::format("the image is broken ({}); save it again", png.message));
  }
  Image image{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  for (const png_byte p : pixels) image.share.push_back(p / 255.0);
  return image;
}

}  // namespace feltgate::texture
