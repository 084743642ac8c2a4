// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes the files of an image for the RTL. Documentation: docs/blocks/engine.md
#include "law/content.hpp"

#include <fmt/format.h>

#include "law/load.hpp"

namespace feltgate::law {

namespace {

template <class Words>
std::string hex_lines(const Words& words, int bits) {
  std::string lines;
  for (const auto word : words) {
    const auto bits_of = static_cast<std::uint64_t>(word) & ((std::uint64_t{1} << bits) - 1);
    lines += fmt::format("{:0{}x}\n", bits_of, bits / 4);
  }
  return lines;
}

}  // namespace

Content content(const Image& image, const std::string& folder) {
  const EngineMemory m = memory(image);
  std::string fields;
  reset_words(image).for_each([&](unsigned value, int width) {
    fields = fmt::format("{}'d{}", width, value) + (fields.empty() ? "" : ", ") + fields;
  });
  Content c;
  c.program = hex_lines(m.program, EngineMap::program_bits);
  c.data = hex_lines(m.data, EngineMap::data_bits);
  c.table = hex_lines(m.table, EngineMap::program_bits);
  c.parameters = fmt::format(
      "// {} for design {}: `include it among the parameters of feltgate_axes or feltgate_linked.\n"
      ".ProgramContent(\"{}program.mem\"),\n.DataContent(\"{}data.mem\"),\n"
      ".TableContent(\"{}table.mem\"),\n.Reset({{{}}})\n",
      image.name, image.design, folder, folder, folder, fields);
  return c;
}

}  // namespace feltgate::law
