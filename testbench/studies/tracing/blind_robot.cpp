// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "blind_robot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "../shape/shape_case.hpp"
#include "axes_fixture.hpp"

namespace feltgate::test {

namespace {

constexpr double kStep_s = 1e-3;
constexpr double kSpeed_m_s = 0.05;    ///< along the outline
constexpr double kPress_n = 0.1;       ///< that it means to feel
constexpr double kFollow_m_s_n = 0.3;  ///< inward for what it feels too little
constexpr int kProbes = 400;           ///< milliseconds of pressing in
constexpr std::size_t kSlope = 6;      ///< milliseconds to both sides for a speed
constexpr double kPi = 3.14159265358979323846;
constexpr double kFelt_n = 0.02;     ///< less is nothing
constexpr double kCorner_m = 3e-3;   ///< of the arc on which it looks for what it lost
constexpr double kReturn_m = 4e-3;   ///< as near to the beginning as that is back
constexpr double kLeast_m = 0.06;    ///< of a walk around
constexpr double kLonger = 8;        ///< of the weight of the normal before
constexpr Point kMiddle{0.0, 0.12};  ///< where it expects a shape

Point unit(Point p) {
  const double size = shape::length(p);
  return size > 0 ? p * (1 / size) : Point{0, 1};
}
Point left_of(Point p) { return {-p.y, p.x}; }

}  // namespace

BlindRobot::BlindRobot(const std::vector<std::string>& columns, Point start_m, double patience_s)
    : patience_s_(patience_s), end_m_(start_m) {
  const auto at = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                    columns.begin());
  };
  for (std::size_t n = 0; n < 2; ++n) {
    position_[n] = at("position_rad." + std::to_string(n));
    torque_[n] = at("tau_ref_nm." + std::to_string(n));
  }
}

PenLead BlindRobot::lead(const std::vector<double>& row) {
  const double a = row[position_[0]], b = row[position_[1]];
  Touch now;
  now.time_s = trace_.seconds = row[0];
  now.pen_m = {shape::link_m * (std::cos(a) + std::cos(b)),
               shape::link_m * (std::sin(a) + std::sin(b))};
  now.force_n = shape::force_at(now.pen_m, {row[torque_[0]], row[torque_[1]]});
  remember(now);
  const Point rate = way(now);
  end_m_ = end_m_ + rate * kStep_s;
  return {{end_m_.x, end_m_.y}, {rate.x, rate.y}};
}

Point BlindRobot::way(const Touch& now) {
  const double felt_n = shape::length(now.force_n);
  if (felt_n > kFelt_n && probes_ < kProbes) {
    if (!met_) normal_ = unit(now.force_n);
    met_ = true;
    ++probes_;
    const double press_n = kPress_n * (1 - 0.5 * std::cos(6 * kPi * probes_ / kProbes));
    return normal_ * (kFollow_m_s_n * (felt_n - press_n));
  }
  if (felt_n > kFelt_n) {
    normal_ = unit(normal_ * kLonger + unit(now.force_n));
    heading_ = left_of(normal_);
    return heading_ * kSpeed_m_s + normal_ * (kFollow_m_s_n * (felt_n - kPress_n));
  }
  if (probes_ < kProbes) return (met_ ? normal_ * -1 : unit(kMiddle - end_m_)) * kSpeed_m_s;
  // Around a corner: the shape is to the left.
  const double turn = kSpeed_m_s / kCorner_m * kStep_s;
  heading_ = unit(heading_ + left_of(heading_) * turn);
  normal_ = left_of(heading_) * -1;
  return heading_ * kSpeed_m_s;
}

void BlindRobot::remember(const Touch& now) {
  if (shape::length(now.force_n) <= kFelt_n) return;
  if (probes_ < kProbes) {
    trace_.probed.push_back(now);
    return;
  }
  if (!trace_.touches.empty()) {
    walked_m_ += shape::length(now.pen_m - trace_.touches.back().pen_m);
  }
  trace_.touches.push_back(now);
  const double apart_m = shape::length(now.pen_m - trace_.touches.front().pen_m);
  trace_.closed = walked_m_ > kLeast_m && apart_m < kReturn_m;
}

Material felt_material(const Trace& trace) {
  const std::vector<Touch>& all = trace.probed;
  if (all.size() < 4 * kSlope) return {};
  const Point outward = unit(all.front().force_n);
  // Force = offset + K in - B out', least squares; speeds over some counts of the encoders.
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (std::size_t i = kSlope; i + kSlope < all.size(); ++i) {
    const Touch &before = all[i - kSlope], &after = all[i + kSlope];
    const double out_m_s =
        dot(after.pen_m - before.pen_m, outward) / (after.time_s - before.time_s);
    const Eigen::Vector3d known(1, -dot(all[i].pen_m - all.front().pen_m, outward), -out_m_s);
    squares += known * known.transpose();
    sums += known * dot(all[i].force_n, outward);
  }
  const Eigen::Vector3d found = squares.ldlt().solve(sums);
  return {found[1], found[2]};
}

Trace traced(int shape, double stiffness_n_m, double damping_ns_m, Point start_m) {
  return traced("hidden_shapes",
                {{"shape", static_cast<double>(shape)},
                 {"stiffness", stiffness_n_m},
                 {"damping", damping_ns_m}},
                start_m);
}

Trace traced(const std::string& law, const std::map<std::string, double>& parameters, Point start_m,
             double patience_s, const std::optional<PlaneHostSettings>& world) {
  AxesScene scene = scene_named("hidden_shapes");
  auto& setup = std::get<PantographSetup>(scene.device);
  setup.hand = {};
  setup.hand.start_m = plant::Vec2{start_m.x, start_m.y};
  plant::PenPhase phase;
  phase.kind = plant::PenPhase::Kind::kImpedance;
  phase.impedance.mass_kg = 0.1;
  phase.impedance.damping_ns_m = 8;
  phase.impedance.stiffness_n_m = 300;
  setup.hand.phases = {phase};
  scene.scenario.duration_s = patience_s + 1;
  scene.scenario.law = law;
  scene.scenario.events.clear();
  scene.scenario.expectations.clear();
  scene.scenario.parameters = parameters;
  scene.plane = world;
  BlindRobot robot(axes_columns(scene), start_m, patience_s);
  struct Enough {};
  try {
    (void)run_scene(scene, "twin", nullptr, 1000, [&](const std::vector<double>& row) {
      if (robot.done()) throw Enough{};
      return robot.lead(row);
    });
  } catch (const Enough&) {
  }
  return robot.trace();
}

namespace {

constexpr double kRadius_m = 2e-3;  ///< of the corners in the law
constexpr double kPace_m = 2e-3;    ///< in which a way is remembered
/// What tells shapes apart, each in the size of its own spread.
constexpr double kApart_m = 1.5e-3, kStiffness_share = 0.15, kDamping_ns_m = 0.01;
constexpr double kDegree = 3.14159265358979323846 / 180;

/// Places a pace apart on a closed line.
std::vector<Point> paced(const std::vector<Point>& line) {
  std::vector<Point> places;
  double left_m = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point step = line[(i + 1) % line.size()] - line[i];
    const double size = shape::length(step);
    for (; left_m < size; left_m += kPace_m) places.push_back(line[i] + step * (left_m / size));
    left_m -= size;
  }
  return places;
}

std::vector<Point> about_its_middle(std::vector<Point> places) {
  Point sum{};
  for (const Point p : places) sum = sum + p;
  for (Point& p : places) p = p - sum * (1 / static_cast<double>(places.size()));
  return places;
}

/// Where the outline is, as far as it is known how deep the pen was.
std::vector<Point> surface(const Trace& trace, double stiffness_n_m) {
  std::vector<Point> places;
  for (const Touch& t : trace.touches) {
    const Point at = t.pen_m + t.force_n * (1 / stiffness_n_m);
    if (places.empty() || shape::length(at - places.back()) >= kPace_m) places.push_back(at);
  }
  return places;
}

/// The way as it is remembered; what is missing at its end is spread over all of it, for the
/// robot knows that it came back.
std::vector<Point> remembered(const std::vector<Point>& way, bool closed, const Memory& memory,
                              std::mt19937_64& random) {
  std::normal_distribution<double> error;
  std::vector<Point> places{way.front()};
  double off_rad = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Point step = way[i] - way[i - 1];
    const double cm = 100 * shape::length(step);
    off_rad += memory.degrees_per_root_cm * kDegree * std::sqrt(cm) * error(random);
    const double c = std::cos(off_rad), s = std::sin(off_rad);
    places.push_back(places.back() + Point{c * step.x - s * step.y, s * step.x + c * step.y});
  }
  if (!closed) return places;
  const Point missing = (way.back() - way.front()) - (places.back() - places.front());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] =
        places[i] + missing * (static_cast<double>(i) / static_cast<double>(way.size() - 1));
  }
  return places;
}

double nearest_m(Point p, const std::vector<Point>& places) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point q : places) least = std::min(least, shape::length(p - q));
  return least;
}

/// Mean distance of the places of each from the other.
double apart_m(const std::vector<Point>& a, const std::vector<Point>& b) {
  double to_b = 0, to_a = 0;
  for (const Point p : a) to_b += nearest_m(p, b) / static_cast<double>(a.size());
  for (const Point p : b) to_a += nearest_m(p, a) / static_cast<double>(b.size());
  return 0.5 * (to_a + to_b);
}

}  // namespace

Guesser::Guesser() {
  for (std::size_t i = 0; i < kShapes.size(); ++i) {
    outlines_[i] = about_its_middle(
        paced(shape::sampled(shape::curve_of(kShapes[i].name, kRadius_m), 100).at));
  }
}

int Guesser::guess(const Trace& trace, const Cues& cues, const Memory& memory,
                   std::mt19937_64& random) const {
  const Material felt = felt_material(trace);
  const double stiffness = std::max(felt.stiffness_n_m, 1.0);
  const std::vector<Point> way = surface(trace, cues.stiffness ? stiffness : kHard_n_m);
  if (way.size() < 3) return 0;
  const std::vector<Point> places =
      about_its_middle(paced(remembered(way, trace.closed, memory, random)));
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kShapes.size(); ++i) {
    double off = std::pow(apart_m(places, outlines_[i]) / kApart_m, 2);
    if (cues.stiffness) {
      off += std::pow(std::log(stiffness / kShapes[i].stiffness_n_m) / kStiffness_share, 2);
    }
    if (cues.damping)
      off += std::pow((felt.damping_ns_m - kShapes[i].damping_ns_m) / kDamping_ns_m, 2);
    if (off >= least) continue;
    least = off;
    best = static_cast<int>(i);
  }
  return best;
}

}  // namespace feltgate::test
