// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The motor's constants from what drive and coast-down determine, as text, JSON and values of a
// design file. Documentation: docs/calibration.md, docs/json.md
#include "host/identify/identify.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/calibrate/regression.hpp"
#include "host/calibrate/report.hpp"

namespace feltgate::host {

namespace {

using nlohmann::ordered_json;
using Vector = Eigen::Matrix<double, 5, 1>;
using Function = double (*)(const Vector& v, double r);

/// a, b, c of the drive, B/J and F/J of the coast-down.
struct Known {
  Vector values;
  Eigen::Matrix<double, 5, 5> covariance;
  double t;  ///< Student's
  double resistance_ohm;

  Known(const Drive& d, const Coast& c, double r)
      : t(student_t(kConfidence, std::min(d.freedom, c.freedom))), resistance_ohm(r) {
    values << d.inertia_v_s2.value, d.speed_v_s.value, d.both_v.value, c.damping_1_s.value,
        c.friction_rad_s2.value;
    covariance.setZero();
    covariance.topLeftCorner<3, 3>() = d.covariance;
    covariance.bottomRightCorner<2, 2>() = c.covariance;
  }

  /// A function of the values, with the interval of its gradient.
  Interval of(Function f) const {
    Vector gradient;
    for (int k = 0; k < 5; ++k) {
      const double step = std::sqrt(covariance(k, k)) / 16;
      Vector up = values, down = values;
      up[k] += step;
      down[k] -= step;
      gradient[k] = step > 0 ? (f(up, resistance_ohm) - f(down, resistance_ohm)) / (2 * step) : 0;
    }
    const double value = f(values, resistance_ohm);
    const double half = t * std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
    return {value, value - half, value + half};
  }
};

double emf(const Vector& v, double) { return v[1] - v[0] * v[3]; }
double inertia(const Vector& v, double r) { return v[0] * emf(v, r) / r; }

std::vector<Figure> figures_of(const Drive& d) {
  return {{"J R/Kt", "j_r_over_kt_v_s2", "V s^2/rad", d.inertia_v_s2},
          {"Ke + B R/Kt", "ke_plus_b_r_over_kt_v_s", "V s/rad", d.speed_v_s},
          {"F R/Kt + dead voltage", "friction_and_dead_v", "V", d.both_v}};
}
std::vector<Figure> figures_of(const Coast& c) {
  return {{"B/J", "b_over_j_1_s", "1/s", c.damping_1_s},
          {"F/J", "f_over_j_rad_s2", "rad/s^2", c.friction_rad_s2}};
}
std::vector<Figure> figures_of(const Constants& c) {
  return {{"Ke = Kt", "ke_v_s_rad", "V s/rad, Nm/A", c.emf_v_s_rad},
          {"R", "resistance_ohm", "ohm", c.resistance_ohm},
          {"J", "inertia_kg_m2", "kg m^2", c.inertia_kg_m2},
          {"B", "damping_nm_s_rad", "Nm s/rad", c.damping_nm_s_rad},
          {"F", "friction_nm", "Nm", c.friction_nm},
          {"dead voltage", "dead_voltage_v", "V with the dead time's part", c.dead_voltage_v}};
}

ordered_json json_of(const std::vector<Figure>& figures) {
  ordered_json j;
  for (const Figure& f : figures) j[f.key] = f.value ? report_json(*f.value) : nullptr;
  return j;
}

}  // namespace

Constants constants_of(const Drive& drive, const std::optional<Coast>& coast,
                       double resistance_ohm) {
  Constants c;
  if (resistance_ohm > 0)
    c.resistance_ohm = Interval{resistance_ohm, resistance_ohm, resistance_ohm};
  if (coast) {
    const Known known(drive, *coast, resistance_ohm);
    c.emf_v_s_rad = known.of(emf);
    c.dead_voltage_v = known.of([](const Vector& v, double) { return v[2] - v[0] * v[4]; });
    if (resistance_ohm > 0) {
      c.inertia_kg_m2 = known.of(inertia);
      c.damping_nm_s_rad = known.of([](const Vector& v, double r) { return inertia(v, r) * v[3]; });
      c.friction_nm = known.of([](const Vector& v, double r) { return inertia(v, r) * v[4]; });
    }
  }
  if (!coast) {
    c.next.push_back(
        "a coast-down separates Ke from B R/Kt and friction from dead voltage: turn the lever "
        "fast, disarm, record until it stands (--coast FILE)");
  }
  if (resistance_ohm <= 0) {
    c.next.push_back(
        "nothing here tells J from R: measure R by an ohmmeter across motor, wiring and bridge "
        "(--resistance OHM)");
  }
  return c;
}

std::string report_text(const Drive& drive, const std::optional<Coast>& coast, const Constants& c) {
  std::string text = fmt::format("driven; intervals: {:g} %\n", 100 * kConfidence);
  text += figures_text(figures_of(drive));
  if (coast) text += "coast-down:\n" + figures_text(figures_of(*coast));
  text += "constants:\n" + figures_text(figures_of(c));
  if (!c.emf_v_s_rad && !c.resistance_ohm) text += "  none yet: these recordings give products\n";
  for (const std::string& n : c.next) text += "next: " + n + "\n";
  return text;
}

ordered_json report_json(const Drive& drive, const std::optional<Coast>& coast,
                         const Constants& c) {
  return {{"schema", "feltgate-identify/1"},
          {"confidence", kConfidence},
          {"driven", json_of(figures_of(drive))},
          {"coast", coast ? json_of(figures_of(*coast)) : nullptr},
          {"constants", json_of(figures_of(c))},
          {"next", c.next}};
}

std::vector<Change> changes_of(const Constants& c, const design::Elaborated& e) {
  std::vector<Change> changes;
  const auto measured = [](const Interval& i) {
    return fmt::format("measured, {:g} % {}", 100 * kConfidence, text_of(i));
  };
  const auto add = [&](const char* section, const char* key, const std::optional<Interval>& i) {
    if (i) changes.push_back({section, key, i->value, i->half() > 0 ? measured(*i) : "given"});
  };
  add("motor", "resistance_ohm", c.resistance_ohm);
  add("motor", "emf_constant_v_s_rad", c.emf_v_s_rad);
  if (!e.design.emf_in_law()) return changes;
  add("observer", "torque_constant_nm_a", c.emf_v_s_rad);
  add("observer", "inertia_kg_m2", c.inertia_kg_m2);
  if (c.dead_voltage_v) {
    const double part = e.word("dead_voltage").si - e.design.dead_voltage_v;
    changes.push_back(
        {"voltage", "dead_voltage_v", std::max(0.0, c.dead_voltage_v->value - part),
         fmt::format("{}; less {:.3g} V of the dead time", measured(*c.dead_voltage_v), part)});
  }
  return changes;
}

// Weighted integrals of a recording over windows.

namespace {

constexpr std::size_t kRows = 32;  ///< least rows in a window
constexpr double kShortest_s = 0.03;
constexpr double kSlowest_s = 3e-3;  ///< longest time between rows
/// Largest step of the voltage between rows, relative to its range.
constexpr double kJump = 0.03;
constexpr std::size_t kPieces = 6;  ///< parts of a window in which the speed is checked for a turn

Window window(const Recording& r, std::size_t first, std::size_t last) {
  Window w;
  w.first = first;
  w.last = last;
  const double from_s = r.time_s[first], length = r.time_s[last] - from_s;
  const double middle_rad = r.angle_rad[(first + last) / 2];
  for (std::size_t k = first; k <= last; ++k) {
    // The weight (x(1-x))^5 on 0..1, normalised to integral 1, with its first three derivatives.
    constexpr double norm = 2772;  // 11!/(5!)^2
    const double x = (r.time_s[k] - from_s) / length, u = x * (1 - x), du = 1 - 2 * x;
    const double u3 = u * u * u, value = norm * u3 * u * u, slope = norm * 5 * u3 * u * du;
    const double bend = norm * (20 * u3 * du * du - 10 * u3 * u);
    const double twist = norm * (60 * u * u * du * du * du - 120 * u3 * du);
    // The trapezoidal rule is as exact as any where the integrand vanishes so smoothly at the ends.
    const double before = k > first ? r.time_s[k] - r.time_s[k - 1] : 0;
    const double after = k < last ? r.time_s[k + 1] - r.time_s[k] : 0;
    const double dx = (before + after) / 2 / length;
    const double way = r.angle_rad[k] - middle_rad;
    w.voltage_v += dx * value * r.voltage_v[k];
    w.speed_rad_s -= dx * slope * way / length;
    w.acceleration_rad_s2 += dx * bend * way / (length * length);
    w.jerk_rad_s3 -= dx * twist * way / (length * length * length);
  }
  w.slowest_rad_s = std::abs(w.speed_rad_s);
  for (std::size_t piece = 0; piece < kPieces; ++piece) {
    const std::size_t a = first + (last - first) * piece / kPieces;
    const std::size_t b = first + (last - first) * (piece + 1) / kPieces;
    const double speed = (r.angle_rad[b] - r.angle_rad[a]) / (r.time_s[b] - r.time_s[a]);
    w.slowest_rad_s = std::min(w.slowest_rad_s, w.speed_rad_s < 0 ? -speed : speed);
  }
  return w;
}

}  // namespace

std::vector<Window> windows_of(const Recording& r) {
  const double step_s = r.length_s() / static_cast<double>(r.rows() - 1);
  if (step_s > kSlowest_s) {
    throw MeasurementError(fmt::format(
        "{}:1: a row every {:.3g} ms; the speed changes within tens of ms, record every ms", r.name,
        1e3 * step_s));
  }
  const auto rows = std::max(kRows, static_cast<std::size_t>(std::lround(kShortest_s / step_s)));
  const auto [low, high] = std::minmax_element(r.voltage_v.begin(), r.voltage_v.end());
  const double jump = kJump * (*high - *low);
  std::vector<Window> windows;
  std::size_t first = 0;
  for (std::size_t k = 1; k < r.rows(); ++k) {
    if (std::abs(r.voltage_v[k] - r.voltage_v[k - 1]) > jump ||
        r.time_s[k] - r.time_s[k - 1] > 1.5 * step_s) {
      first = k;
    } else if (k - first == rows) {
      windows.push_back(window(r, first, k));
      first = k;
    }
  }
  if (windows.empty()) {
    throw MeasurementError(fmt::format(
        "{}:1: the voltage or the time jumps every {:.3g} ms or sooner; hold each voltage for 0.1 "
        "s or more, a row a ms",
        r.name, 1e3 * static_cast<double>(rows) * step_s));
  }
  return windows;
}

// Recordings of a drive and of a coast-down.

Recording recording_of(const ColumnTable& table, double count_rad, bool needs_voltage) {
  Recording r;
  r.name = table.file();
  const std::size_t time = table.need({"time_s", "t_s", "time", "t"}, "time");
  const bool in_rad = table.find({"position_rad", "theta_rad", "angle_rad"}).has_value();
  const std::size_t angle = table.need(
      {"position_rad", "theta_rad", "angle_rad", "position", "position_counts", "count", "counts"},
      "the position");
  const std::vector<std::string> voltages{"voltage_v", "voltage", "v"};
  const auto voltage =
      needs_voltage ? std::optional(table.need(voltages, "the voltage")) : table.find(voltages);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = table.at(row, time), a = table.at(row, angle);
    const double v = voltage ? table.at(row, *voltage) : 0.0;
    if (!std::isfinite(t) || !std::isfinite(a) || !std::isfinite(v)) {
      table.fail(row, "a field is empty", "take the row out");
    }
    if (!r.time_s.empty() && !(t > r.time_s.back())) {
      table.fail(row, "time does not go on", "sort the rows, and take repeated ones out");
    }
    r.time_s.push_back(t);
    r.voltage_v.push_back(v);
    r.angle_rad.push_back(in_rad ? a : a * count_rad);
  }
  constexpr std::size_t fewest_rows = 64;
  if (r.rows() < fewest_rows) {
    throw MeasurementError(
        fmt::format("{}:1: {} rows; record at least {}, better a thousand over a second", r.name,
                    r.rows(), fewest_rows));
  }
  return r;
}

// Least squares over a driven recording and over a coast-down.

namespace {

constexpr int kRounds = 20;
constexpr std::size_t kFewest = 5;
/// Below this speed, friction still depends on the speed.
constexpr double kCreep_rad_s = 2;
/// Least voltage that must drive the current: below it, the effect of dead time depends on the
/// current's ripple.
constexpr double kFlowing_v = 0.4;

double sign(double x) { return x < 0 ? -1.0 : 1.0; }

Regression regression(const std::vector<const Window*>& used, double electrical_s) {
  const auto n = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd x(n, 3);
  Eigen::VectorXd y(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Window& w = *used[static_cast<std::size_t>(k)];
    x.row(k) << w.acceleration_rad_s2 + electrical_s * w.jerk_rad_s3, w.speed_rad_s,
        sign(w.speed_rad_s);
    y[k] = w.voltage_v;
  }
  return {x, y, kConfidence};
}

}  // namespace

Drive identify_drive(const Recording& r, double electrical_s) {
  const std::vector<Window> windows = windows_of(r);
  std::vector<const Window*> moving, used;
  for (const Window& w : windows) {
    if (w.slowest_rad_s <= kCreep_rad_s) continue;
    moving.push_back(&w);
    // First guess: a lever that speeds up has a current along its motion.
    if (w.acceleration_rad_s2 * w.speed_rad_s > 0) used.push_back(&w);
  }
  for (int round = 0; round < kRounds; ++round) {
    if (used.size() < kFewest) {
      throw MeasurementError(fmt::format(
          "{}: of {} windows in which the lever turns one way faster than {:g} rad/s a current "
          "drives it in {}; step the voltage to and fro, each for 0.1 s or more, or further",
          r.name, moving.size(), kCreep_rad_s, used.size()));
    }
    const Regression fit = regression(used, electrical_s);
    // Next the windows in which the voltage after back-EMF and dead voltage drives a current along
    // the motion.
    const auto before = used;
    used.clear();
    for (const Window* w : moving) {
      const double left = w->voltage_v - fit.value(1) * w->speed_rad_s;
      // Within the window the speed changes by about this much in each direction.
      const double span = std::abs(fit.value(1) * w->acceleration_rad_s2) *
                          (r.time_s[w->last] - r.time_s[w->first]) / 3;
      if (left * sign(w->speed_rad_s) - span >= fit.value(2) + kFlowing_v) used.push_back(w);
    }
    if (used == before) break;
  }
  const Regression fit = regression(used, electrical_s);
  if (!(fit.value(0) > 0 && fit.value(1) > 0)) {
    throw MeasurementError(fmt::format(
        "{}: a larger voltage slows the lever down; turn the sign of one column round, or set "
        "control.encoder_polarity",
        r.name));
  }
  return {fit.coefficient(0), fit.coefficient(1), fit.coefficient(2), fit.freedom(),
          fit.covariance()};
}

Coast identify_coast(const Recording& r) {
  // The last windows in which the lever slows down; before them it was still driven, with another
  // voltage.
  const std::vector<Window> windows = windows_of(r);
  std::vector<const Window*> used;
  for (const Window& w : windows) {
    if (w.slowest_rad_s <= kCreep_rad_s) continue;
    if (w.acceleration_rad_s2 * w.speed_rad_s >= 0 ||
        std::abs(w.voltage_v - windows.back().voltage_v) > kFlowing_v) {
      used.clear();
    } else {
      used.push_back(&w);
    }
  }
  if (used.size() < kFewest) {
    throw MeasurementError(fmt::format(
        "{}: the lever runs down in {} windows only; let it go at a higher speed, and record until "
        "it stands",
        r.name, used.size()));
  }
  // dw/dt = -(B/J) w - (F/J), integrated twice: linear in start, speed, B/J and F/J.
  const std::size_t first = used.front()->first, last = used.back()->last;
  const double direction = sign(used.front()->speed_rad_s);
  const auto n = static_cast<Eigen::Index>(last - first + 1);
  Eigen::MatrixXd x(n, 4);
  Eigen::VectorXd y(n);
  double integral = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t row = first + static_cast<std::size_t>(k);
    const double t = r.time_s[row] - r.time_s[first];
    y[k] = direction * (r.angle_rad[row] - r.angle_rad[first]);
    if (k > 0) integral += (y[k] + y[k - 1]) / 2 * (r.time_s[row] - r.time_s[row - 1]);
    x.row(k) << 1, t, -integral, -t * t / 2;
  }
  const Regression fit(x, y, kConfidence);
  return {fit.coefficient(2), fit.coefficient(3), fit.freedom(),
          fit.covariance().bottomRightCorner(2, 2)};
}

}  // namespace feltgate::host
