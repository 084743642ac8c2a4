// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Poles of the loop that a design closes around a plant: lever free, everything linear, boxcar and
// hold of the tick exact. Derivation: docs/designs.md
#pragma once

#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "sim/plant/parameters.hpp"

namespace feltgate::stability {

/// The loop in one region of the voltage law.
struct LoopRegion {
  std::string where;  ///< in which range of torque references it holds
  double voltage_gain_ohm = 0;
  int unstable = 0;  ///< poles right of growth_limit_rad_s, all of them
  /// The poles with |Re|, |Im| < pole_range_rad_s, rightmost first; of a complex pair only the one
  /// above the axis. What the boxcar adds lies further left.
  std::vector<std::complex<double>> poles_rad_s;
};

struct ClosedLoop {
  std::string plant;
  double damping_nm_s_rad = 0;  ///< linear friction of the plant
  double inertia_ratio = 0;     ///< Jn/J
  double feed_forward = 0;      ///< Jn*Kp: this part of the current does not pass the observer
  double stall_pole_rad_s = 0;  ///< of tau_hat while the lever is blocked; the same for every plant
  std::vector<LoopRegion> regions;

  bool stable() const;
};

/// Slower growth than this, doubling in over a minute, is not told from the standing pole at 0 of a
/// lever without friction: quantised back-EMF compensation leaves up to 1e-3 rad/s there.
constexpr double growth_limit_rad_s = 0.01;

constexpr double pole_range_rad_s = 1e4;

/// The loop of the quantised design around a plant whose wiring is what the design's polarity flags
/// say. Of the plant count: inductance, back-EMF and viscous friction where its effects have them.
ClosedLoop closed_loop(const design::Elaborated& e, const plant::Parameters& plant);

/// Throws config::ConfigError at the line to change when the loop is unstable; the message names
/// the pole and the changes of the design, each tried, that make it stable.
void refuse_unstable(const design::Elaborated& e, const plant::Parameters& plant);

/// What `feltgate design --plant` prints.
std::string loop_table(const ClosedLoop& loop);

// Zeros of an analytic function by the argument principle: the number of zeros in a region is the
// number of turns that the function makes around 0 along its border.

using Complex = std::complex<double>;
/// Analytic in the region asked for, f(conj(s)) = conj(f(s)).
using AnalyticFunction = std::function<Complex(Complex)>;

/// Zeros with Re s > `real` and |Im s| < `top` of a function that repeats with period 2j*top and
/// tends to a constant as Re s grows. `pieces`: steps along the line that are surely short enough
/// for the function to be followed; they shorten toward Im s = 0, and where it turns fast.
int zeros_right_of(const AnalyticFunction& f, double real, double top, int pieces);

/// Zeros in the rectangle between two corners (lower left, upper right), as often as their
/// multiplicity, to 1e-9 of its size. The border should be free of zeros.
std::vector<Complex> zeros_in(const AnalyticFunction& f, Complex low, Complex high);

}  // namespace feltgate::stability
