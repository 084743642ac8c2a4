// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A triangle mesh under a pen: read from a GLB file, placed into the pen's reach, cleaned, and told
// what it is; fewer faces of it; the tree by which its triangles are found; the god-object of C.
// Zilles and K. Salisbury, 1995, a point that follows the pen and stays on its side. Documentation:
// docs/touch.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/plant/rotation.hpp"

namespace feltgate::touch {

using plant::Vec3;
using Triangle = std::array<std::uint32_t, 3>;

/// std::atan2(y, x) within 4e-15, by sums, products, quotients and roots alone: the planes of a
/// mesh have the same bits with every standard library.
double arctangent(double y, double x);

/// Triangles as a file has them, in the frame of the device: x to the right, y away, z up; m.
struct Soup {
  std::vector<Vec3> at;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> parts;  ///< of each triangle: its place in `materials`
  std::vector<std::string> materials;
  std::int64_t primitives = 0, not_triangles = 0;  ///< primitives read; points and lines left out
  std::int64_t skins = 0,
               animations = 0;          ///< nodes with a skin, and movements: left out, rest pose
  std::vector<std::string> extensions;  ///< used by the file and not known: left out
};

/// Reads a GLB file: every primitive of every node of its scene, by the nodes' transforms,
/// instances and weights of morph targets. The file's y-up frame is turned into the device's.
/// Errors: std::invalid_argument "path: what; mend".
Soup read_glb(const std::string& path);

/// Where a mesh shall be.
struct Placing {
  double size_m = 0.06;  ///< largest side of its box; 0: as in the file
  Vec3 centre_m;         ///< of its box; unused where size_m is 0
};
/// Moves and scales; returns the scale. Errors: std::invalid_argument where it has no extent, or
/// would be out of reach_m.
double place(Soup& soup, const Placing& placing);
/// The law takes points within this distance along each axis.
constexpr double reach_m = 0.25;

/// A part that is connected by edges.
struct Component {
  std::int64_t vertices = 0, edges = 0, faces = 0;
  std::int64_t border_loops = 0;  ///< 0: closed
  bool manifold = true;           ///< no edge has more than two faces
  bool orientable = true;         ///< its faces can be turned to one side
  double volume_m3 = 0;           ///< negative: its faces look inwards; only where it is closed

  std::int64_t euler() const { return vertices - edges + faces; }
  /// Number of handles, with discs in its borders; none where it is not manifold or orientable.
  std::optional<std::int64_t> genus() const;
};

/// What was found and what was done about it.
struct MeshReport {
  std::int64_t triangles_read = 0, vertices_read = 0;
  std::int64_t welded = 0;      ///< vertices that became one with another
  std::int64_t degenerate = 0;  ///< triangles without an area, dropped
  std::int64_t duplicates = 0;  ///< triangles with the corners of another, dropped
  std::int64_t border_edges = 0, nonmanifold_edges = 0;
  std::int64_t inverted_edges = 0;  ///< their two faces look to different sides
  std::int64_t turned = 0;          ///< triangles that were turned for the normals
  std::vector<Component> components;
};

/// A mesh to touch.
struct Mesh {
  std::vector<Vec3> at;
  std::vector<Triangle> triangles;   ///< of one side in each component, where that is possible
  std::vector<std::uint32_t> parts;  ///< of each triangle: its place in `materials`
  std::vector<std::string> materials;
  std::vector<bool> closed;                  ///< whether each triangle's component is
  std::vector<std::array<Vec3, 3>> normals;  ///< at the corners, smooth below the crease
  MeshReport report;

  /// Out of the face, as long as twice its area; m^2.
  Vec3 across(const Triangle& t) const {
    return plant::cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
  }
  /// That, of length 1.
  Vec3 normal(const Triangle& t) const {
    const Vec3 n = across(t);
    return 1 / plant::length(n) * n;
  }
};

/// Welds, drops what is degenerate or double, turns faces to one side, and computes normals that
/// are smooth where neighbours differ by less than `crease_rad`. Errors: std::invalid_argument
/// where nothing is left.
Mesh clean(const Soup& soup, double crease_rad = 0.7);

/// At most `most_faces` faces of the same surface, with its materials; more where its topology or
/// the borders between materials need them. Corners are some of the mesh's. Errors:
/// std::invalid_argument where none is left.
Soup decimate(const Mesh& mesh, std::size_t most_faces);
/// The farthest that a corner or the middle of a face of one mesh is away from the other mesh, m.
double hausdorff_m(const Mesh& a, const Mesh& b);
/// Angles between the normals of two faces with one edge, rad. At a depth d below such an edge the
/// force of a spring K turns by the angle phi in one step: K d 2 sin(phi / 2), N.
struct Jumps {
  double largest_rad = 0;
  double most_rad = 0;  ///< no more than this on 95 % of the length of all edges
};
Jumps jumps_of(const Mesh& mesh);

/// How often the closed components wind around a point: 1 inside of one that looks outwards, -1
/// where it looks inwards, 0 outside.
double winding(const Mesh& mesh, Vec3 at);

/// The point of a triangle that is nearest to another point.
struct Near {
  double distance_m = 0;
  Vec3 point_m;
  std::size_t triangle = 0;
};
Near nearest_of_triangle(const Mesh& mesh, std::size_t triangle, Vec3 to);

/// Triangles in a tree of boxes. The mesh must outlive it.
class TriangleTree {
 public:
  explicit TriangleTree(const Mesh& mesh);

  Near nearest(Vec3 to) const;
  /// Every triangle that is at most `distance_m` away from `to`.
  void within(Vec3 to, double distance_m, std::vector<Near>& found) const;
  /// The share of `way` that a ball can go from `from` until it touches a triangle; 1: all of it.
  /// A ball that touches one may go along it or away. It may come nearer than its radius by a
  /// millionth of this, by rounding.
  double free_way(Vec3 from, Vec3 way, double radius_m) const;

 private:
  struct Box {
    Vec3 low, high;
  };
  struct Node {
    Box box;
    std::uint32_t first = 0;  ///< of a leaf: in order_; else: the first of its two children
    std::uint32_t count = 0;  ///< triangles of a leaf; 0: no leaf
  };
  void split(std::size_t node, const std::vector<Box>& boxes, const std::vector<Vec3>& middles,
             int depth);
  template <class Reject, class Each>
  void walk(Reject&& reject, Each&& each) const;
  static double away_m(const Box& box, Vec3 from);

  const Mesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

struct ProxySettings {
  /// The proxy is a ball of this radius, so that it never lies in a triangle; what it reports is
  /// the surface.
  double radius_m = 10e-6;
  double friction = 0;   ///< the proxy stays until the pen has left this cone
  bool shading = false;  ///< normals of corners, interpolated
  /// Tells a second plane where two faces meet in an edge, at an angle of 40 to 140 degrees between
  /// their normals.
  bool edges = false;
};

/// What the proxy knows after a step.
struct Touched {
  bool touching = false;
  int constraints = 0;   ///< surfaces that hold the proxy back: 0 to 3
  Vec3 proxy_m;          ///< the god-object, on the surface while it touches
  double depth_m = 0;    ///< of the pen below the plane
  Vec3 point_m, normal;  ///< the plane to render; of the nearest surface while nothing is touched
  std::size_t triangle = 0;  ///< that the plane is of
  /// The plane beyond the nearest edge; its normal is 0 where there is none.
  Vec3 second_point_m, second;
  bool convex = false;  ///< material is where both planes have it, else where either has
};

/// The law local_edge takes two normals whose product is at most this either way: edges at which
/// faces turn by 40 to 140 degrees.
constexpr double edge_lean_most = 0.766;

/// The edges of a mesh that this law takes. The mesh must outlive it.
class SharpEdges {
 public:
  explicit SharpEdges(const Mesh& mesh);
  SharpEdges(const SharpEdges&) = delete;
  SharpEdges& operator=(const SharpEdges&) = delete;
  /// Adds the second plane to what a proxy at `at` found, `distance_m` from the nearest surface;
  /// the first becomes a face where the proxy is at the edge itself. Nothing changes where the
  /// plane is no face of the nearest edge.
  void add(Touched& t, Vec3 at, double distance_m) const;

 private:
  const Mesh& mesh_;
  Mesh lines_;  ///< a triangle (a, b, b) for each edge
  std::vector<std::array<std::size_t, 2>> faces_;
  std::vector<bool> convex_;          ///< as seen from where the faces look to
  std::optional<TriangleTree> tree_;  ///< none where there is no such edge
};

/// A proxy on its way. The mesh must outlive it.
class Proxy {
 public:
  Proxy(const Mesh& mesh, const ProxySettings& settings);

  /// Puts it where the pen is. Errors: std::invalid_argument where that is inside of a closed mesh
  /// or on its surface.
  void begin(Vec3 pen_m);
  /// The pen is here now.
  Touched move(Vec3 pen_m);
  /// From the next move on, with shading or without.
  void shade(bool on) { settings_.shading = on; }
  /// From the next move on, with second planes at edges or without.
  void tell_edges(bool on) {
    edges_.reset();
    if (on) edges_.emplace(mesh_);
  }

  /// Middle of its ball.
  Vec3 at() const { return at_; }
  const TriangleTree& tree() const { return tree_; }

 private:
  struct Wall {
    Vec3 normal;
    double least_m;  ///< a step along the normal is at least so long; negative: towards the wall
  };
  struct Goal {
    Vec3 at;
    Vec3 held[3];  ///< normals of the walls that hold it
    int walls = 0;
  };
  Goal goal_of(Vec3 pen_m);
  void find_walls();
  Touched told(Vec3 pen_m, const Goal& goal) const;
  Touched shaded(Touched t, Vec3 pen_m, const Near& near) const;

  const Mesh& mesh_;
  TriangleTree tree_;
  std::optional<SharpEdges> edges_;
  ProxySettings settings_;
  Vec3 at_;
  std::vector<Near> near_;
  std::vector<Wall> walls_;
};

/// Hash over the planes of a stroke around and into a mesh, with the normals of its facets and with
/// smooth ones: the same on every machine. Errors: those of Proxy::begin().
std::uint64_t stroke_hash(const Mesh& mesh);

}  // namespace feltgate::touch
