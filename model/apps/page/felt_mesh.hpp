// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A mesh under the page's stylus: the proxy of `feltgate touch` behind the host of the planes.
// Documentation: docs/page.md
#pragma once

#include "sim/axes_loop/plane_host.hpp"
#include "sim/touch/touch.hpp"

namespace feltgate::page {

/// A knob with six bumps, 60 mm wide: 3072 triangles.
touch::Soup knob_mesh();

/// A mesh and the proxy on it. It stays where it is: the proxy points to the mesh.
class FeltMesh {
 public:
  explicit FeltMesh(touch::Mesh mesh);
  FeltMesh(const FeltMesh&) = delete;
  FeltMesh& operator=(const FeltMesh&) = delete;

  /// Puts the proxy where the pen is. Errors: std::invalid_argument where that is inside of a
  /// closed mesh or on its surface.
  void begin(plant::Vec3 pen_m);
  /// Normals between those of the corners, or those of the facets, from the next move on.
  void shade(bool on) { proxy_.shade(on); }
  /// Both planes of an edge, or the proxy's alone, from the next move on.
  void tell_edges(bool on) { proxy_.tell_edges(on); }
  /// For PlaneHostSettings::search: the pen is here now.
  Plane move(plant::Vec3 pen_m);

  const touch::Mesh& mesh() const { return mesh_; }
  /// What the last move() found.
  const touch::Touched& touched() const { return touched_; }

 private:
  touch::Mesh mesh_;
  touch::Proxy proxy_;
  touch::Touched touched_;
};

}  // namespace feltgate::page
