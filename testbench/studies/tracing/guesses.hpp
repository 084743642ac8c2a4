// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which of seven shapes a trace is of, by what is remembered of it: its way with errors of a memory
// that nobody sees grow, its stiffness and damping where they are cues.
// Documentation: docs/devices/shapes.md
#pragma once

#include <array>
#include <random>
#include <string>
#include <vector>

#include "blind_robot.hpp"

namespace feltgate::test {

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

/// guesses[of][as].
using Confusion = std::array<std::array<int, kShapes.size()>, kShapes.size()>;
double right(const Confusion& guesses);

}  // namespace feltgate::test
