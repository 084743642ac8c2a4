// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes constants from combinations of them, once other measurements separate them.
// Documentation: docs/identify.md
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "host/identify/identify.hpp"

namespace feltgate::host {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Values with a covariance; gives the interval of any function of them, from its gradient.
class Known {
 public:
  Known(double confidence, int freedom) : confidence_(confidence), freedom_(freedom) {}

  /// Adds values that are independent of the earlier ones; returns the index of the first.
  Index add(const VectorXd& values, const MatrixXd& covariance) {
    const Index at = values_.size(), n = values.size();
    values_.conservativeResize(at + n);
    values_.tail(n) = values;
    MatrixXd grown = MatrixXd::Zero(at + n, at + n);
    grown.topLeftCorner(at, at) = covariance_;
    grown.bottomRightCorner(n, n) = covariance;
    covariance_ = grown;
    return at;
  }

  Interval of(const std::function<double(const VectorXd&)>& f) const {
    const double value = f(values_);
    VectorXd gradient(values_.size());
    for (Index k = 0; k < values_.size(); ++k) {
      const double deviation = std::sqrt(covariance_(k, k));
      const double step = deviation > 0 ? deviation / 16 : 0;
      VectorXd up = values_, down = values_;
      up[k] += step;
      down[k] -= step;
      gradient[k] = step > 0 ? (f(up) - f(down)) / (2 * step) : 0;
    }
    const double variance = gradient.dot(covariance_ * gradient);
    const double half = student_t(confidence_, freedom_) * std::sqrt(std::max(0.0, variance));
    return {value, value - half, value + half};
  }

 private:
  double confidence_;
  int freedom_;
  VectorXd values_;
  MatrixXd covariance_;
};

VectorXd values(std::initializer_list<double> v) {
  VectorXd x(static_cast<Index>(v.size()));
  std::copy(v.begin(), v.end(), x.data());
  return x;
}

MatrixXd variance(double deviation) { return MatrixXd::Constant(1, 1, deviation * deviation); }

double relative(const Interval& i) { return std::abs(i.half() / i.value); }

void say_next(const Drive& drive, bool coast, bool scale, bool brakes, Constants* c) {
  if (relative(drive.inertia_v_s2) > 0.02 || relative(drive.speed_v_s) > 0.02) {
    c->next.push_back(
        "J R/Kt and Ke + B R/Kt are not within 2 % yet: drive for longer, with steps of both signs "
        "and two sizes, each held for 0.1 s or more");
  }
  if (!coast) {
    c->next.push_back(
        "a coast-down separates Ke from B R/Kt and friction from dead voltage: turn the lever "
        "fast, "
        "disarm, record until it stands (--coast FILE)");
  }
  if (!scale) {
    c->next.push_back(
        "nothing here tells J from R. One of these does: R by an ohmmeter across motor, wiring and "
        "bridge (--resistance OHM); the same drive with a known inertia more on the shaft "
        "(--loaded FILE --added-inertia KGM2); the shaft lying, a known weight on the lever "
        "(--weighed FILE --weight KG --radius M --level RAD)");
  }
  if (!coast && !brakes) {
    c->next.push_back(
        "friction and dead voltage are one number as long as the motor only drives; step the "
        "voltage from one sign to the other while the lever is fast");
  }
}

}  // namespace

Constants separate(const Drive& drive, const std::optional<Coast>& coast, const Separation& given,
                   double confidence) {
  Constants c;
  int freedom = drive.freedom;
  if (coast) freedom = std::min(freedom, coast->freedom);
  if (given.loaded) freedom = std::min(freedom, given.loaded->freedom);
  if (given.weighed) freedom = std::min(freedom, given.weighed->freedom);
  Known known(confidence, freedom);
  known.add(values({drive.inertia_v_s2.value, drive.speed_v_s.value, drive.both_v.value}),
            drive.covariance);
  const auto a = [](const VectorXd& v) { return v[0]; };
  using Function = std::function<double(const VectorXd&)>;
  Function emf, resistance, damping_1_s, friction_rad_s2;
  if (coast) {
    const Index at = known.add(values({coast->damping_1_s.value, coast->friction_rad_s2.value}),
                               coast->covariance);
    damping_1_s = [at](const VectorXd& v) { return v[at]; };
    friction_rad_s2 = [at](const VectorXd& v) { return v[at + 1]; };
    emf = [damping_1_s](const VectorXd& v) { return v[1] - v[0] * damping_1_s(v); };
  } else if (given.emf_constant_v_s_rad) {
    const double ke = *given.emf_constant_v_s_rad;
    emf = [ke](const VectorXd&) { return ke; };
    damping_1_s = [ke](const VectorXd& v) { return (v[1] - ke) / v[0]; };
    if (drive.friction_v) {
      const double cf = drive.friction_v->value;
      const double deviation = drive.friction_v->half() / student_t(confidence, drive.freedom);
      const Index at = known.add(values({cf}), variance(deviation));
      friction_rad_s2 = [at](const VectorXd& v) { return v[at] / v[0]; };
    }
  }
  if (emf) c.emf_v_s_rad = known.of(emf);
  if (given.resistance_ohm) {
    const Index at =
        known.add(values({*given.resistance_ohm}), variance(given.resistance_error_ohm));
    resistance = [at](const VectorXd& v) { return v[at]; };
  } else if (emf && given.loaded) {
    const Index at = known.add(values({given.loaded->inertia_v_s2.value}),
                               given.loaded->covariance.topLeftCorner(1, 1));
    const double more = given.added_kg_m2;
    if (given.loaded->inertia_v_s2.value <= drive.inertia_v_s2.value) {
      throw MeasurementError(
          "with the added inertia the lever speeds up faster than without; are the two recordings "
          "exchanged?");
    }
    resistance = [at, more, emf](const VectorXd& v) { return (v[at] - v[0]) * emf(v) / more; };
  } else if (emf && given.weighed) {
    const double deviation =
        given.weighed->volts_per_nm.half() / student_t(confidence, given.weighed->freedom);
    const Index at = known.add(values({given.weighed->volts_per_nm.value}), variance(deviation));
    resistance = [at, emf](const VectorXd& v) { return v[at] * emf(v); };
  }
  if (friction_rad_s2) {
    c.dead_voltage_v = known.of(
        [a, friction_rad_s2](const VectorXd& v) { return v[2] - a(v) * friction_rad_s2(v); });
  }
  const bool scale = static_cast<bool>(resistance);
  if (scale) c.resistance_ohm = known.of(resistance);
  if (scale && emf) {
    const Function inertia = [a, emf, resistance](const VectorXd& v) {
      return a(v) * emf(v) / resistance(v);
    };
    c.inertia_kg_m2 = known.of(inertia);
    if (damping_1_s) {
      c.damping_nm_s_rad = known.of(
          [inertia, damping_1_s](const VectorXd& v) { return inertia(v) * damping_1_s(v); });
    }
    if (friction_rad_s2) {
      c.friction_nm = known.of([inertia, friction_rad_s2](const VectorXd& v) {
        return inertia(v) * friction_rad_s2(v);
      });
    }
  }
  say_next(drive, coast.has_value(), scale || given.loaded || given.weighed,
           drive.friction_v.has_value(), &c);
  if (!emf && scale) {
    c.warnings.push_back(
        "with R alone the product J/Kt is known, not J; the coast-down gives Ke, which is Kt in SI "
        "units");
  }
  if (coast && coast->damping_1_s.low <= 0 && coast->damping_1_s.high >= 0) {
    c.warnings.push_back(
        "the coast-down does not tell B from zero: its friction is dry within the noise");
  }
  return c;
}

}  // namespace feltgate::host
