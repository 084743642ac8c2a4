// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How far the torque reference of each scene can be off. The position is the same integer in core
// and reference. Documentation: docs/error-bounds.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "feltgate/largest.hpp"
#include "feltgate/nearest.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace feltgate::bounds::detail {

namespace {

constexpr double anything = 1e100;  ///< larger than any signal

/// The scene laws of one design against one reference.
class Scenes {
 public:
  Scenes(const ChainNumbers& c, Level level, bool rounds)
      : c_(c), level_(level), rounds_(rounds), limit_(of("torque_limit")) {}

  Interval error(const std::string& scene, const Interval& velocity_error, const Interval& velocity,
                 double law_nm) const {
    if (scene == "free") return Interval(0.0);
    if (scene == "setpoint") return limits() + word("setpoint_torque");
    if (scene == "membrane") return limits() + membrane();
    if (scene == "spring_tension") return limits() + spring("tension_stiffness", "tension_rest");
    if (scene == "spring_compression") {
      return limits() + spring("compression_stiffness", "compression_contact");
    }
    if (scene == "damper") {
      const Pair b = of("damper_damping");
      return limits() + b.used * velocity_error + slope_change(b, velocity) + rounding();
    }
    if (scene == "wall") return limits() + wall(velocity_error, velocity);
    if (scene == "charge_attract") return limits() + charge("attract");
    if (scene == "charge_repel") return limits() + charge("repel");
    if (scene == "law" && law_nm < endless) return limits() + law(law_nm);
    return {endless, endless};
  }

 private:
  /// Whether core and reference have the same parameters.
  bool same_words() const { return level_ == Level::quantised || level_ == Level::gain; }
  Pair of(const std::string& name) const { return pair_of(c_.at(name), level_); }
  Interval limits() const { return limit_.change(); }
  Interval rounding() const { return only(magnitude(rounding_error(c_, c_.formats.torque))); }
  /// What is rounded off, where scenes round.
  Interval only(double error) const { return Interval(rounds_ ? error : 0.0); }

  /// A word in the torque's format: half a bit whatever the host writes.
  Interval word(const std::string& name) const {
    if (same_words()) return Interval(0.0);
    const double half = std::ldexp(0.5, -c_.formats.torque.fraction);
    return Interval(std::max(half, of(name).change().upper()));
  }

  /// |clamp(k*x) - clamp(k'*x)| for any x, and at most |k - k'| * largest.
  Interval slope_change(const Pair& k, const Interval& largest = Interval(anything)) const {
    const double top = std::max(k.used.lower(), k.real.lower());
    if (top <= 0) return Interval(0.0);
    const double limited = (limit_.real * k.change() / Interval(top)).upper();
    return Interval(std::min(limited, (k.change() * largest).upper()));
  }

  /// A law of the position alone. Without rounding its torques are equal, and only a ramp, whose
  /// step is a coefficient, can part them: by what core and reference may be apart, and core and
  /// quantised, which ramp in step.
  Interval law(double law_nm) const {
    if (rounds_) return Interval(law_nm);
    return Interval(same_words() ? 0.0 : 2.0 * law_nm);
  }

  Interval membrane() const {
    // The faces part the same integers in core and reference, or a count lies between.
    const Number &lower = c_.at("membrane_lower"), &upper = c_.at("membrane_upper");
    const bool same = same_words() || (std::ceil(lower.used()) == std::ceil(lower.si) &&
                                       std::floor(upper.used()) == std::floor(upper.si));
    return same ? word("membrane_torque") : Interval(2.0) * of("membrane_torque").used;
  }

  Interval spring(const std::string& stiffness, const std::string& reference) const {
    const Pair k = of(stiffness);
    return k.used * of(reference).change() + slope_change(k) + rounding();
  }

  Interval wall(const Interval& velocity_error, const Interval& velocity) const {
    // At the contact the damping jumps: core and reference must meet it at the same count.
    const Number& contact = c_.at("wall_contact");
    if (!same_words() && std::floor(contact.used()) != std::floor(contact.si)) {
      return limit_.real;
    }
    const Pair k = of("wall_stiffness"), b = of("wall_damping");
    const double top = std::max(k.used.lower(), k.real.lower());
    // Beyond the torque limit and the largest damping torque both are limited.
    const Interval by_stiffness =
        top > 0 ? k.change() / Interval(top) * (limit_.real + b.real * velocity) : Interval(0.0);
    // Each product keeps two bits below the torque.
    const Interval cut = only(std::ldexp(0.25, -c_.formats.torque.fraction));
    return k.used * of("wall_contact").change() + by_stiffness + b.used * velocity_error +
           b.change() * velocity + cut + rounding();
  }

  Interval charge(const std::string& name) const {
    const Number &core = c_.at(name + "_core"), &centre = c_.at(name + "_centre");
    const bool same = same_words() || (core.used() == core.si &&
                                       std::floor(centre.used()) == std::floor(centre.si));
    if (!same) return {endless, endless};
    const Format force{1, 0, c_.formats.charge.fraction};
    const Interval narrowed = only(magnitude(truncation_error(force.fraction, c_.formats.torque)));
    // The quotient is floored, and ends a step below 1 Nm.
    const Interval step(std::ldexp(1.0, -force.fraction));
    const Interval outside = slope_change(of(name + "_strength")) + only(step.upper());
    const Interval inside =
        slope_change(of(name + "_core_slope")) + only(magnitude(rounding_error(c_, force)));
    const double beyond = rounds_ ? (limit_.real - (Interval(1.0) - step)).upper() : 0.0;
    return boost::numeric::max(outside, core.raw > 0 ? inside : Interval(0.0)) + narrowed +
           Interval(std::max(0.0, beyond));
  }

  const ChainNumbers& c_;
  Level level_;
  bool rounds_;
  Pair limit_;
};

}  // namespace

double scene_error(const ChainNumbers& c, const InputRegion& region, Level level, bool rounds,
                   double velocity_error_rad_s, double velocity_rad_s) {
  const std::string& scene = region.scene;
  const Scenes scenes(c, level, rounds);
  const Interval error(velocity_error_rad_s), velocity(velocity_rad_s);
  if (!scene.empty()) {
    if (!c.built(scene)) {
      throw std::invalid_argument(fmt::format(
          "scene \"{}\" is not built in design {}; {}choose one of {}, or a design that lists it",
          scene, c.design, config::did_you_mean(scene, c.scenes), fmt::join(c.scenes, ", ")));
    }
    return scenes.error(scene, error, velocity, region.law_nm).upper();
  }
  double worst = 0;
  for (const std::string& s : c.scenes) {
    worst = larger(worst, scenes.error(s, error, velocity, region.law_nm).upper());
  }
  return worst;
}

}  // namespace feltgate::bounds::detail
