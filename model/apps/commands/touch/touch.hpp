// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What `feltgate touch` was asked and what it tells: text, JSON, rows of a CSV file; and at a
// board. Documentation: docs/touch.md
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/law_engine.hpp"
#include "sim/axes_loop/axes_scene.hpp"
#include "sim/touch/touch_run.hpp"

namespace feltgate {

struct TouchArguments {
  std::string glb, stroke, motion, engine = "twin,double", json, csv, make, out;
  std::vector<std::string> materials;
  std::int64_t faces = 0;       ///< at most so many; 0: all of the file
  touch::TouchRequest request;  ///< without stroke, materials and way of the mesh
  double size_m = 0.06, depth_m = 2e-3, speed_m_s = 0.1;
  std::array<double, 3> centre_m{};
  std::string board;   ///< port of one; empty: the simulated device
  int baud = 1000000;  ///< of its line
  double seconds = 0;  ///< how long at a board; 0: until Ctrl-C
  bool as_is = false, mesh_only = false, quiet = false;
};

/// What fewer faces cost.
struct Decimation {
  std::int64_t faces = 0, faces_before = 0;
  double hausdorff_m = 0, share = 0;  ///< that of the mesh's largest side
  std::int64_t opened = 0;            ///< edges at a border that were none before
  touch::Jumps jumps, before;         ///< of the normals at its edges
  touch::MeshReport file;             ///< of the mesh before
  double force_step_n = 0;            ///< at 95 % of the edges, at the stroke's depth and stiffness

  /// What one should know before one touches it; empty: nothing.
  std::vector<std::string> warnings() const;
};

/// Updates and rows in numbers.
struct TouchSummary {
  double touching = 0;  ///< share of the poses
  int constraints = 0;
  double depth_m = 0, force_n = 0, median_s = 0, rare_s = 0;
};
TouchSummary summary_of(const touch::TouchRun& run);

/// The mesh in words.
std::string mesh_text(const TouchArguments& a, const touch::Soup& soup, const touch::Mesh& mesh,
                      double scale, const std::optional<Decimation>& fewer);
/// The stroke in words and a table.
std::string run_text(const TouchArguments& a, const touch::TouchRun& run);
nlohmann::ordered_json mesh_json(const TouchArguments& a, const touch::Mesh& mesh, double scale,
                                 const std::optional<Decimation>& fewer);
void add_run(nlohmann::ordered_json& j, const touch::TouchRun& run);
/// A row for each plane, after a line of names.
void write_rows(std::FILE* to, const touch::TouchRun& run);

/// What a session at a board was.
struct BoardTouch {
  touch::TouchRun run;  ///< poses, planes, and the force that the law asked for then; no result
  double rate_hz = 0;   ///< at which poses are asked for
  std::int64_t skipped = 0;  ///< poses that a newer one had overtaken
  host::BurstCounts counts;
};

/// The stylus with planes that is shipped.
AxesScene stylus_scene();

/// `feltgate touch --board` (docs/touch.md): the planes of a mesh for a stylus at a
/// port, as fast as its line allows. Loads the law if the board has another one, arms it, and sends
/// planes until `a.seconds` are over or Ctrl-C; the motors are off afterwards. A pen that is in the
/// mesh feels nothing until it is led out. Errors: std::invalid_argument, also for a board that is
/// no stylus; host::Refused, host::LinkLost.
BoardTouch touch_board(const TouchArguments& a, const touch::Mesh& mesh,
                       const touch::TouchRequest& request);
std::string board_text(const BoardTouch& b);
void add_board(nlohmann::ordered_json& j, const BoardTouch& b);

}  // namespace feltgate
