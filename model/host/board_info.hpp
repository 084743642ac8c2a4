// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board's information about itself, and the design that it has. Documentation: docs/host.md
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "design/design.hpp"
#include "host/link.hpp"

namespace feltgate::host {

/// The words of the link that describe the board.
struct BoardInfo {
  int major = 0, minor = 0;      ///< version of the link
  std::uint32_t design_crc = 0;  ///< identifies the design
  std::int64_t clock_hz = 0;
  int clocks_per_tick = 1;
  bool simulated = false, has_capture = false, has_stream = false;
  bool has_engine = false;  ///< it can run laws
  int capture_rows = 0, capture_columns = 0;
  std::uint32_t frames_good = 0, frames_bad = 0;  ///< as counted by the board
  int board = 0;
  std::uint32_t inputs = 0;  ///< board inputs; see the board's page

  double tick_hz() const { return static_cast<double>(clock_hz) / clocks_per_tick; }
  /// Names such as "DE0-Nano", "board 7".
  std::string board_name() const;
};

/// Reads them. Errors: std::runtime_error if something other than a feltgate answers, or with a
/// version that this host does not know; LinkLost if nothing answers.
BoardInfo read_board(Link& link);

/// A design with all values derived from it, and its CRC.
struct KnownDesign {
  design::Elaborated design;
  std::uint32_t crc = 0;
  const std::string& name() const { return design.design.name; }
};

/// Reads the design file `path` with rtl/registers.toml of the folder `root`.
KnownDesign read_known_design(const std::string& root, const std::string& path);
/// The design in rtl/designs of `root` that has this CRC; skips files that cannot be read.
std::optional<KnownDesign> design_by_crc(const std::string& root, std::uint32_t crc);

}  // namespace feltgate::host
