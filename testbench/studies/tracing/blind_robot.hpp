// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A robot that holds the pen of the pantograph and sees nothing: it knows where its pen is by the
// encoders and what it feels by the torques, and follows the outline of what it meets.
// Documentation: docs/devices/shapes.md
#pragma once

#include <array>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "sim/axes_loop/axes_run.hpp"
#include "studies/shape/rhombus.hpp"

namespace feltgate::test {

using shape::Point;

/// A millisecond of contact.
struct Touch {
  double time_s = 0;
  Point pen_m, force_n;
};

/// The data kept from a walk around a shape.
struct Trace {
  std::vector<Touch> probed;   ///< of pressing straight in, before the walk
  std::vector<Touch> touches;  ///< of the walk
  bool closed = false;         ///< came back to where it began
  double seconds = 0;          ///< until then, or until it gave up
};

/// The data on the shape from pressing in and letting go.
struct Material {
  double stiffness_n_m = 0, damping_ns_m = 0;
};
Material felt_material(const Trace& trace);

/// Leads the hand of a scene, one decision a millisecond.
class BlindRobot {
 public:
  /// `columns` of the rows that it will be shown; the pen starts here. It gives up after its
  /// patience.
  BlindRobot(const std::vector<std::string>& columns, Point start_m, double patience_s);
  PenLead lead(const std::vector<double>& row);
  bool done() const { return trace_.closed || trace_.seconds >= patience_s_; }
  const Trace& trace() const { return trace_; }

 private:
  Point way(const Touch& now);
  void remember(const Touch& now);

  double patience_s_;
  std::size_t position_[2], torque_[2];
  Point end_m_;       ///< of its spring
  Point normal_;      ///< of what it touched last, outward, smoothed
  Point heading_;     ///< while it looks for what it lost
  bool met_ = false;  ///< has felt something
  int probes_ = 0;    ///< milliseconds of pressing in
  double walked_m_ = 0;
  Trace trace_;
};

constexpr double most_patience_s = 9;

/// A law of shapes with these parameters under the robot's pen, the twin from pins to pins in
/// closed loop with the plant. `law` is a name or a path; `world` sends planes, to local_plane.
Trace traced(const std::string& law, const std::map<std::string, double>& parameters, Point start_m,
             double patience_s = most_patience_s,
             const std::optional<PlaneHostSettings>& world = std::nullopt);
/// The hidden shape of this number with a material.
Trace traced(int shape, double stiffness_n_m, double damping_ns_m, Point start_m);

// Which of seven shapes a trace is of, by what is remembered of it: its way with errors of a memory
// that nobody sees grow, its stiffness and damping where they are cues.

/// Of rtl/laws/hidden_shapes.law, by number, with the materials of the page's game.
struct Shape {
  const char* name;
  double stiffness_n_m, damping_ns_m;
};
constexpr double kHard_n_m = 50, kSoft_n_m = 30, kSlippery_ns_m = 0, kSticky_ns_m = 0.03;
constexpr std::array<Shape, 7> kShapes{{{"square", kHard_n_m, kSlippery_ns_m},
                                        {"bell", kHard_n_m, kSlippery_ns_m},
                                        {"banana", kSoft_n_m, kSlippery_ns_m},
                                        {"fish", kSoft_n_m, kSlippery_ns_m},
                                        {"horseshoe", kHard_n_m, kSticky_ns_m},
                                        {"mushroom", kSoft_n_m, kSticky_ns_m},
                                        {"duck", kHard_n_m, kSticky_ns_m}}};

/// Where the pen starts, outside of every shape.
constexpr std::array<Point, 4> kStarts{{{0, 0.17}, {-0.055, 0.12}, {0.055, 0.12}, {0, 0.075}}};

struct Cues {
  bool stiffness = false, damping = false;
};

/// How a way is remembered: its direction is off by a random walk.
struct Memory {
  double degrees_per_root_cm = 0;
};

/// Of the memory's error, degrees per root cm: the robot is then about as often right as people.
constexpr double kLikePeople = 10;

/// Knows the outlines of the seven shapes.
class Guesser {
 public:
  Guesser();
  /// The number of the shape that this trace is most like.
  int guess(const Trace& trace, const Cues& cues, const Memory& memory,
            std::mt19937_64& random) const;

 private:
  std::array<std::vector<Point>, kShapes.size()> outlines_;  ///< about their middles
};

}  // namespace feltgate::test
