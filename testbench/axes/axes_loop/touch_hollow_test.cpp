// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A hollow in which a pen swings by itself: the host in the loop, against the linear loop with the
// age of its planes. docs/touch.md
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "touch_meshes.hpp"

namespace feltgate::test {
namespace {

using touch::Mesh;

/// A pen of 45 g that a force presses into a hollow of 30 mm, the inside of a ball, and that
/// nothing else holds: it swings sideways, and all of its spring is the host's.
struct Hollow {
  static constexpr double radius_m = 0.03, stiffness_n_m = 600, mass_kg = 0.045;
  double rate_hz = 1000, latency_s = 1e-3, jitter_s = 1e-3, lost = 0;
  double friction_ns_m = 0.1;
  int times = 5;  ///< 20 * 4^times faces
  bool shading = true;

  /// Mean age of the plane in force: a plane is held until the next one that is not lost.
  double age_s() const {
    return (1 + lost) / (1 - lost) / (2 * rate_hz) + latency_s + 0.5 * jitter_s;
  }
  /// Growth of the swing by the linear loop, 1/s: the pole near the one without a host.
  double modelled_1_s(double press_n) const {
    using Complex = std::complex<double>;
    // Of design and device: window and filters of the velocity, writes and run of the law, PWM.
    constexpr double window_s = 767e-6, cutoff_rad_s = 500, words_s = 65e-6, pwm_s = 30e-6;
    constexpr double winding_s = 0.24e-3 / 2.44, emf_ns_m = 0.0234 * 0.0234 / 2.44 / 1e-4;
    const double spring_n_m = press_n / (radius_m + press_n / stiffness_n_m);
    const auto rest = [&](Complex s) {
      const Complex seen = (1.0 - std::exp(-s * window_s)) / (s * window_s) * cutoff_rad_s /
                           (s + cutoff_rad_s) * std::exp(-s * pwm_s);
      const Complex drive = 1.0 / (1.0 + s * winding_s);
      return mass_kg * s * s + friction_ns_m * s + emf_ns_m * drive * s * (1.0 - seen) +
             spring_n_m * drive * std::exp(-s * (age_s() + words_s + pwm_s));
    };
    Complex s(0, std::sqrt(spring_n_m / mass_kg));
    for (int n = 0; n < 30; ++n) {
      const Complex step(1e-6, 0);
      s -= rest(s) * step / (rest(s + step) - rest(s));
    }
    return s.real();
  }
  double border_n() const {
    double quiet = 0.1, loud = 10;
    for (int n = 0; n < 40; ++n) {
      const double middle = 0.5 * (quiet + loud);
      (modelled_1_s(middle) < 0 ? quiet : loud) = middle;
    }
    return quiet;
  }

  /// Way of the pen across the press, m, one row a millisecond from 0.25 s on.
  std::vector<double> swing_m(double press_n, double until_s) const {
    // Along all axes, so that no current changes its sign.
    const Vec3 down{0.55, 0.5, -std::sqrt(1 - 0.55 * 0.55 - 0.25)};
    const Vec3 across = 1 / std::hypot(down.x, down.y) * Vec3{-down.y, down.x, 0};
    // A part of the ball, for a pen cannot begin in a closed one.
    Soup part = icosphere(radius_m, times);
    const auto above = [&](const touch::Triangle& t) {
      return plant::dot(part.at[t[0]], down) < 0.8 * radius_m;
    };
    part.triangles.erase(std::remove_if(part.triangles.begin(), part.triangles.end(), above),
                         part.triangles.end());
    const Mesh mesh = touch::clean(part);
    AxesScene scene = scene_named("stylus_sphere");
    scene.scenario.effects.lugre = false;
    scene.scenario.effects.viscous = true;
    scene.scenario.duration_s = until_s;
    scene.scenario.expectations.clear();
    auto& setup = std::get<StylusSetup>(scene.device);
    const double capstan_m = setup.parameters.lever.lever.radius_m;
    setup.parameters.lever.lever.viscous_nm_s_rad = friction_ns_m * capstan_m * capstan_m;
    const Vec3 start = (radius_m - 0.3e-3) * (std::cos(0.08) * down + std::sin(0.08) * across);
    const double parts[] = {down.x, down.y, down.z}, places[] = {start.x, start.y, start.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      plant::Hand& hand = setup.hand[axis] = {};
      hand.start_rad = places[axis] / capstan_m;
      plant::HandPhase& press = hand.phases.emplace_back();
      press.kind = plant::HandPhase::Kind::kTorque;
      plant::Segment wait, ramp;
      wait.kind = plant::Segment::Kind::kHold;
      wait.duration_s = 0.03;
      ramp.kind = plant::Segment::Kind::kMinimumJerk;
      ramp.duration_s = 0.05;
      ramp.to = press_n * parts[axis] * capstan_m;
      press.profile = {wait, ramp};
    }
    touch::ProxySettings settings;
    settings.shading = shading;
    touch::Proxy proxy(mesh, settings);
    proxy.begin(start);
    PlaneHostSettings& host = *scene.plane;
    host.rate_hz = rate_hz;
    host.latency_s = latency_s;
    host.jitter_s = jitter_s;
    host.lost = lost;
    host.search = [&proxy](Vec3 pen_m) {
      const touch::Touched t = proxy.move(pen_m);
      return std::pair{Plane{t.point_m, t.normal}, PlaneMaterial{stiffness_n_m, 1, 0}};
    };
    const std::vector<std::string> names = axes_columns(scene);
    const auto first =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), "pen_x_m") - names.begin());
    std::vector<double> swing;
    const AxesResult result = run_scene(
        scene, "twin",
        [&](const std::vector<double>& row) {
          const Vec3 pen{row.at(first), row.at(first + 1), row.at(first + 2)};
          if (row[0] > 0.25) swing.push_back(plant::dot(pen, across));
        },
        1000);
    CHECK(result.figures.at("faults") == 0);
    return swing;
  }
};

/// Growth of a swing, 1/s, from its values a millisecond apart: least squares of each by those a
/// quarter and half a period before.
double growth_1_s(const std::vector<double>& swing, double period_s) {
  const auto lag = static_cast<std::size_t>(250 * period_s);
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (std::size_t n = 2 * lag; n < swing.size(); ++n) {
    const Eigen::Vector3d known(1, 1e3 * swing[n - lag], 1e3 * swing[n - 2 * lag]);
    squares += known * known.transpose();
    sums += known * (1e3 * swing[n]);
  }
  const Eigen::Vector3d found = squares.ldlt().solve(sums);
  return std::log(-found[2]) / (2e-3 * static_cast<double>(lag));
}

/// Force at which the swing in the hollow neither grows nor dies, N, between two runs beside it of
/// so many times 2 m / b each.
double measured_border_n(const Hollow& hollow, double times) {
  const double until_s = 0.25 + times * 2 * Hollow::mass_kg / hollow.friction_ns_m;
  double growth[2], force_n[2];
  for (int n = 0; n < 2; ++n) {
    force_n[n] = hollow.border_n() * (n == 0 ? 0.9 : 1.1);
    const double period_s = full_turn * std::sqrt(Hollow::mass_kg * Hollow::radius_m / force_n[n]);
    growth[n] = growth_1_s(hollow.swing_m(force_n[n], until_s), period_s);
    UNSCOPED_INFO(force_n[n] << " N: " << growth[n] << " 1/s, model "
                             << hollow.modelled_1_s(force_n[n]));
  }
  return force_n[0] - growth[0] * (force_n[1] - force_n[0]) / (growth[1] - growth[0]);
}

/// With friction for a border of about 1.5 N.
Hollow hollow_of(double rate_hz, double latency_s, double jitter_s, double lost) {
  Hollow h;
  h.rate_hz = rate_hz, h.latency_s = latency_s, h.jitter_s = jitter_s, h.lost = lost;
  h.friction_ns_m = 1.5 * h.age_s() / 0.0325;
  return h;
}

TEST_CASE("touch: how hard a pen may be pressed into a hollow is told by the age of its planes") {
  const Hollow hollow = hollow_of(100, 1e-3, 10e-3, 0);
  const double is_n = measured_border_n(hollow, 3), should_n = hollow.border_n();
  INFO(should_n << " N, twin " << is_n << " N");
  CHECK(should_n == Approx(1.5).epsilon(0.05));
  CHECK(is_n == Approx(should_n).epsilon(0.05));
}

TEST_CASE("touch: borders in a hollow as a table", "[.table]") {
  struct Case {
    const char* name;
    Hollow hollow;
  };
  for (const Case& c :
       {Case{"1 kHz, 1 to 2 ms late", hollow_of(1000, 1e-3, 1e-3, 0)},
        Case{"1 kHz, 6 ms late", hollow_of(1000, 6e-3, 0, 0)},
        Case{"100 Hz, 1 ms late", hollow_of(100, 1e-3, 0, 0)},
        Case{"100 Hz, 1 to 11 ms late", hollow_of(100, 1e-3, 10e-3, 0)},
        Case{"1 kHz, 1 to 2 ms late, half lost", hollow_of(1000, 1e-3, 1e-3, 0.5)},
        Case{"1 kHz, 1 to 2 ms late, 80 % lost", hollow_of(1000, 1e-3, 1e-3, 0.8)}}) {
    // What is lost at random takes longer to even out.
    const double is_n = measured_border_n(c.hollow, c.hollow.lost > 0 ? 15 : 3);
    const double should_n = c.hollow.border_n();
    WARN(c.name << ": age " << 1e3 * c.hollow.age_s() << " ms, " << c.hollow.friction_ns_m
                << " Ns/m: " << should_n << " N, twin " << is_n << " N, "
                << 100 * (is_n / should_n - 1) << " %");
    CHECK(is_n == Approx(should_n).epsilon(0.05));
  }
}

TEST_CASE("touch: what facets leave of a swing in a hollow", "[.table]") {
  // At half the border. Over an edge the force to the side changes its sign, an age late: a relay
  // of F sin(turn / 2) behind a mass with friction b swings by 4 / pi of it times age / b.
  for (const int times : {3, 4, 5}) {
    Hollow hollow = hollow_of(1000, 6e-3, 0, 0);
    hollow.times = times;
    hollow.shading = false;
    const double press_n = 0.5 * hollow.border_n();
    const std::vector<double> swing = hollow.swing_m(press_n, 3);
    const auto [low, high] = std::minmax_element(swing.end() - 300, swing.end());
    const double faces = 20 * std::pow(4, times), turn_rad = std::sqrt(9.674 / faces);
    WARN(faces << " faces: swing " << 0.5e3 * (*high - *low) << " mm, relay "
               << 1e3 * 4 / 3.14159265 * press_n * std::sin(turn_rad / 2) * hollow.age_s() /
                      hollow.friction_ns_m);
  }
}

}  // namespace
}  // namespace feltgate::test
