// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/texture/image.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cstring>
#include <stdexcept>

namespace feltgate::texture {

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& said) {
  throw std::invalid_argument(path + ":1: " + said);
}

/// libpng's state of an image, freed whatever happens.
struct Reader {
  png_image image;
  Reader() {
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
  }
  ~Reader() { png_image_free(&image); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  std::string message() const { return std::string(image.message); }
};

}  // namespace

Image read_png(const std::string& path) {
  Reader reader;
  png_image& png = reader.image;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) {
    refuse(path, fmt::format("no PNG image ({}); give an 8-bit PNG", reader.message()));
  }
  if ((png.format & PNG_FORMAT_FLAG_LINEAR) != 0) {
    refuse(path, "16 bits a channel; save it with 8");
  }
  if (png.width < 2 || png.height < 1 || png.width > most_side || png.height > most_side) {
    refuse(path, fmt::format("{} x {} pixels; a texture has 2 to {} along a row, and up to {} rows",
                             png.width, png.height, most_side, most_side));
  }
  png.format = PNG_FORMAT_GRAY;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(png));
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&png, &black, pixels.data(), 0, nullptr) == 0) {
    refuse(path, fmt::format("the image is broken ({}); save it again", reader.message()));
  }
  Image image;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  for (const png_byte p : pixels) image.share.push_back(p / 255.0);
  return image;
}

}  // namespace feltgate::texture
