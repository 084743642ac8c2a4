// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Proven worst-case bounds on |core - real arithmetic| for velocity, tau_hat, torque reference and
// current reference of a design. Theorem, assumptions and proof: docs/error-bounds.md
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "design/design.hpp"
#include "feltgate/fixed.hpp"
#include "studies/bounds/interval.hpp"

namespace feltgate::bounds {

// The properties of a design that an error bound needs: formats, rounding, and each coefficient
// both as the core's integer and as the design's value.

/// A parameter: the core's integer and the design's value.
struct Number {
  std::string name;
  Format format{};
  double si = 0;         ///< the design's value
  std::int64_t raw = 0;  ///< the core's integer

  double used() const;  ///< exact: the integer times 2^-fraction
};

struct ChainNumbers {
  std::string design;
  Formats formats{};
  Round rounding = Round::half_up;
  /// rad/s per count of the N-method: in the core, in the reference chain (2^n, or the exact factor
  /// where a quantised gain stands for it), and by 2*pi/(Er*Tp*m1).
  double used_gain = 0, reference_gain = 0, exact_gain = 0;
  bool quantised_gain = false;  ///< the core multiplies by used_gain and truncates
  int gain_fraction = 0;
  std::vector<Number> numbers;
  std::vector<std::string> scenes;  ///< those built in

  /// The parameter of this name. Throws std::out_of_range when there is none.
  const Number& at(const std::string& name) const;
  bool built(const std::string& scene) const;
  /// Sets a value, rounded to the parameter's word. Throws std::out_of_range as above.
  void set(const std::string& name, double value);
};

ChainNumbers chain_numbers(const design::Elaborated& e);

/// The region of inputs for which a bound is computed.
struct InputRegion {
  /// Largest |N-method velocity| before the low-pass, rad/s; 0: all that the format holds.
  double velocity_rad_s = 0;
  std::string scene;  ///< the scene; empty: the worst of all built-in scenes
  int mode = 0;       ///< of the control word: 0 closed loop, 1 open loop, 2 voltage
  /// Scene law: largest error of the program's torque, Nm; infinite if it reads more than the
  /// position.
  double law_nm = std::numeric_limits<double>::infinity();
};

/// Bounds of one signal against three references; infinity where no bound is proven.
struct ErrorBound {
  double against_quantised = 0;  ///< real arithmetic with the core's own, quantised coefficients
  double against_reference =
      0;                     ///< the reference chain: coefficients exact, 2^n as the design says
  double against_exact = 0;  ///< also the factor of the N-method exact, 2*pi/(Er*Tp*m1)
};

/// Conditions under which nothing saturates; each must hold during the whole motion.
struct SaturationFree {
  int counts_per_window = 0;   ///< |counts in m1 ticks| at most: raw velocity and travel hold it
  double velocity_rad_s = 0;   ///< the same as a velocity
  double tau_hat_rad_s = 0;    ///< |velocity| up to which tau_hat cannot saturate
  double current_rad_s = 0;    ///< |velocity| up to which the current limit cannot act; 0: none
  double position_counts = 0;  ///< |position| at most, for the scenes
};

struct ErrorBounds {
  InputRegion region;  ///< with the velocity filled in
  SaturationFree free;
  ErrorBound velocity_rad_s, tau_hat_nm, tau_ref_nm, current_a, torque_nm;
  /// Smaller bounds for a loop with the feedback of tau_hat; valid only while the current limit
  /// does not act.
  ErrorBound unlimited_tau_hat_nm, unlimited_current_a;
};

/// The bounds hold from reset on, through arming and disarming, while neither the raw velocity nor
/// tau_hat saturates and no ramp runs; limits of torque and current may act.
/// Throws std::invalid_argument for a scene that is not built in.
ErrorBounds error_bounds(const ChainNumbers& numbers, const InputRegion& region = {});
ErrorBounds error_bounds(const design::Elaborated& e, const InputRegion& region = {});

/// The bound of one source of error while the others are exact; the sources add up.
struct SourceBound {
  std::string name;  ///< velocity_n, dob, scenes, torque_control, coefficients, or gain
  double velocity_rad_s = 0, tau_hat_nm = 0, tau_ref_nm = 0, current_a = 0;
};

/// The sources: rounding of each block, against real arithmetic with the core's coefficients; then
/// the quantisation of the coefficients; then 2^n against the exact factor, which no other figure
/// contains.
std::vector<SourceBound> source_bounds(const ChainNumbers& numbers, const InputRegion& region = {});

/// The bounds against the reference chain by the names of the tables: bound_velocity_rad_s,
/// bound_tau_hat_nm, bound_tau_ref_nm, bound_current_a, bound_torque_nm.
std::vector<std::pair<std::string, double>> bound_fields(const ErrorBounds& b);

/// The bounds as text, as `feltgate design` prints them.
std::string bound_table(const ErrorBounds& b);
/// Where a bound comes from, as text: a row for each source.
std::string source_table(const std::vector<SourceBound>& sources);

namespace detail {

/// The reference of a bound: one of the three columns; `gain` differs from the reference chain only
/// in the factor of the N-method.
enum class Level { quantised, reference, exact, gain };

/// Blocks that round; the others are exact.
struct Rounding {
  bool velocity_n = true, dob = true, scenes = true, torque_control = true;
};

/// A coefficient in the core and in the reference of `level`.
struct Pair {
  Interval used, real;
  Interval change() const { return boost::numeric::abs(used - real); }
};
Pair pair_of(const Number& n, Level level);

/// The error of rounding to `f` by the design's mode.
Interval rounding_error(const ChainNumbers& c, Format f);
/// The error of dropping the bits below `f` of a number with `fraction` bits; 0 if there are none.
Interval truncation_error(int fraction, Format f);

/// Bound of |tau_ref - tau_ref of the reference| [Nm] outside the ramp, from the velocity's bound.
double scene_error(const ChainNumbers& c, const InputRegion& region, Level level, bool rounds,
                   double velocity_error_rad_s, double velocity_rad_s);

}  // namespace detail

}  // namespace feltgate::bounds
