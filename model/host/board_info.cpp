// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Identification of a board. Documentation: docs/host.md
#include "host/board_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "design/generate.hpp"
#include "feltgate/generated/link.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::host {

namespace {

using M = LinkMap;

std::uint32_t field(std::uint32_t word, int bit, int width) {
  return word >> bit & ((1u << width) - 1);
}

}  // namespace

std::string BoardInfo::board_name() const {
  switch (board) {
    case 0:
      return "no board of this project";
    case 1:
      return "DE0-Nano";
    case 2:
      return "ULX3S";
    case 3:
      return "Tang Nano 9K";
    default:
      return fmt::format("board {}", board);
  }
}

BoardInfo read_board(Link& link) {
  const std::vector<std::uint32_t> w = link.read(M::A::identity, M::A::inputs - M::A::identity + 1);
  const auto at = [&w](int address) {
    return w[static_cast<std::size_t>(address - M::A::identity)];
  };
  if (at(M::A::identity) != M::identity) {
    throw std::runtime_error(
        fmt::format("{}: no feltgate; the board calls itself 0x{:08x} instead of 0x{:08x}",
                    link.name(), at(M::A::identity), M::identity));
  }
  BoardInfo b;
  b.major = static_cast<int>(at(M::A::version) >> 16);
  b.minor = static_cast<int>(at(M::A::version) & 0xffff);
  if (b.major != static_cast<int>(M::version >> 16)) {
    throw std::runtime_error(fmt::format(
        "{}: its link has version {}.{}, this host knows {}.x; build the board's file and the host "
        "from one version",
        link.name(), b.major, b.minor, M::version >> 16));
  }
  const std::uint32_t features = at(M::A::features);
  const auto has = [features](int bit) { return (features >> bit & 1u) != 0; };
  b.design_crc = at(M::A::design_crc);
  b.clock_hz = at(M::A::clock_hz);
  b.clocks_per_tick = std::max(1, static_cast<int>(at(M::A::clocks_per_tick)));
  b.simulated = has(M::B::features_simulated);
  b.has_capture = has(M::B::features_capture);
  b.has_stream = has(M::B::features_stream);
  b.has_engine = has(M::B::features_engine);
  b.capture_rows =
      1 << std::min(16u, field(features, M::B::features_rows_log2, M::B::features_rows_log2_width));
  b.capture_columns =
      static_cast<int>(field(features, M::B::features_columns, M::B::features_columns_width));
  b.frames_good = at(M::A::frames_good);
  b.frames_bad = at(M::A::frames_bad);
  b.board = static_cast<int>(at(M::A::board));
  b.inputs = at(M::A::inputs);
  return b;
}

KnownDesign read_known_design(const std::string& root, const std::string& path) {
  design::Design read = design::read_design(path);
  read.allow_coarse = true;  // the design is already in a board
  KnownDesign known;
  known.design = design::elaborate(read, design::read_registers(root + "/rtl/registers.toml"));
  known.crc = design::design_crc(known.design);
  return known;
}

std::optional<KnownDesign> design_by_crc(const std::string& root, std::uint32_t crc) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(root + "/rtl/designs")) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) {
    try {
      KnownDesign known = read_known_design(root, path);
      if (known.crc == crc) return known;
    } catch (const config::ConfigError&) {
      // An unfinished file of somebody must not hide the board's design.
    }
  }
  return {};
}

}  // namespace feltgate::host
