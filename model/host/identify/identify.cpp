// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The motor's constants from what drive and coast-down determine, as text, JSON and values of a
// design file. Documentation: docs/calibration.md, docs/json.md
#include "host/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

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

/// A figure, once for text and JSON; without a value it is null, and in no text.
struct Figure {
  const char *name, *key, *unit;
  std::optional<Interval> value;
};

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

std::string lines(const std::vector<Figure>& figures) {
  std::string text;
  for (const Figure& f : figures) {
    if (f.value) text += fmt::format("  {:<22} {} {}\n", f.name, text_of(*f.value), f.unit);
  }
  return text;
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
  text += lines(figures_of(drive));
  if (coast) text += "coast-down:\n" + lines(figures_of(*coast));
  text += "constants:\n" + lines(figures_of(c));
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

}  // namespace feltgate::host
