// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of several axes: a linkage where its motors cannot give every force, a gimbal whose
// rings coincide, a plane that is lost in touch. The shipped laws run on the engine of three axes.
// Documentation: docs/extremes.md
#include <Vextremes_engine_axes.h>

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "campaigns/extremes/engine_pair.hpp"
#include "law/compile.hpp"
#include "law/evaluate.hpp"
#include "law/load.hpp"

namespace feltgate::extremes {

namespace {

using Pair = EnginePairOf<3, Vextremes_engine_axes>;
using Turns = std::array<int, 3>;  ///< counts of each axis

law::Target three_axes() {
  law::Target t;
  t.axes = 3;
  return t;
}

const int turn = three_axes().counts_per_turn;
const double count_rad = three_axes().count_rad();
const double torque_lsb = std::ldexp(1.0, -three_axes().torque.fraction);
constexpr int kCheck = 5000;  ///< clocks from a commit until all words are checked, at most

double rad_of(double counts) { return counts * count_rad; }

/// A shipped law in the engine, with its evaluation in double beside it.
class LoadedLaw {
 public:
  /// Every `from` in its text becomes `to`.
  LoadedLaw(const Settings& settings, const std::string& name, const std::string& from = "",
            const std::string& to = "")
      : compiled_(law::compile_text(text(settings, name, from, to), name + ".law", three_axes())),
        real_(compiled_.law),
        parameters_(compiled_.image) {
    write(law::load(compiled_.image));
    pair.clock(kCheck);
  }

  Pair pair;

  /// Values of parameters and mailboxes, in the units of the law.
  void set(const std::map<std::string, double>& values) {
    write(parameters_.set(values));
    pair.clock(kCheck);
    const auto& all = compiled_.law.parameters;
    for (std::size_t p = 0; p < all.size(); ++p) {
      const law::ImageWord* word = parameters_.find(all[p].name);
      if (word != nullptr) real_.set_parameter(p, parameters_.value(word->name) * word->to_si);
    }
  }

  /// Puts the axes there, at rest, and waits for the torques of that place.
  void go(const Turns& place) {
    for (std::size_t n = 0; n < 3; ++n) pair.in.position[n] = place[n];
    std::vector<double> inputs;
    for (const law::Input& i : compiled_.law.inputs) {
      const bool position = i.source == law::Source::position;
      inputs.push_back(position ? rad_of(place[static_cast<std::size_t>(i.axis)]) : 0);
    }
    real_.run(inputs);
    pair.clock(3 * compiled_.divider * Pair::clocks_per_tick);
  }

  /// The torque of an axis in Nm; `expected` is a closed form, the tolerance the law's proven
  /// bound.
  void check(Outcome* o, const std::string& what, int axis, double expected) {
    const Both found = pair.torque(axis);
    if (std::fabs(expected) < 1e-12) expected = 0;
    o->add(what, "Nm", near(expected, bound(axis)), found.rtl * torque_lsb, found.twin * torque_lsb,
           real(axis));
  }
  double real(int axis) const {
    const double torque = real_.outputs()[static_cast<std::size_t>(axis)];
    return std::fabs(torque) < 1e-12 ? 0 : torque;
  }
  /// Rounded up to two digits, for the page.
  double bound(int axis) const {
    const double exact = compiled_.bound.output[static_cast<std::size_t>(axis)];
    const double digit = std::pow(10, std::floor(std::log10(exact)) - 1);
    return std::ceil(exact / digit) * digit;
  }
  int ticks_per_mailbox_age() const {
    return EngineMap::mailbox_step * compiled_.image.mailbox_age;
  }

 private:
  static std::string text(const Settings& settings, const std::string& name,
                          const std::string& from, const std::string& to) {
    std::ifstream in(settings.root + "/rtl/laws/" + name + ".law");
    std::ostringstream all;
    all << in.rdbuf();
    std::string text = all.str();
    for (std::size_t i = 0; !from.empty() && (i = text.find(from, i)) != std::string::npos;) {
      text.replace(i, from.size(), to);
      i += to.size();
    }
    return text;
  }
  void write(const std::vector<law::HostWord>& words) {
    for (const law::HostWord& w : words) pair.write(w.address, w.data);
  }

  law::Compiled compiled_;
  law::Evaluation<double> real_;
  law::LoadedParameters parameters_;
};

Outcome linkage_singular(const Settings& settings) {
  Outcome o;
  LoadedLaw law(settings, "pantograph");
  // Links of 0.1 m; the floor, at y = 0.08 m, pushes with 500 N/m upwards. The torques are the
  // transposed Jacobian times that force.
  const auto torques = [&](const std::string& what, int a, int b) {
    law.go({a, b, 0});
    const double y = 0.1 * (std::sin(rad_of(a)) + std::sin(rad_of(b)));
    const double force = 500 * std::max(0.08 - y, 0.0);
    law.check(&o, what + ", first motor", 0, 0.1 * std::cos(rad_of(a)) * force);
    law.check(&o, what + ", second motor", 1, 0.1 * std::cos(rad_of(b)) * force);
  };
  torques("stretched sideways, 40 N across the links", 0, 0);
  torques("stretched downwards, 140 N along the links", -turn / 4, -turn / 4);
  torques("a count beside that", -turn / 4 + 1, -turn / 4 + 1);
  torques("folded, the tip on the axis", 0, turn / 2);
  torques("folded upright", turn / 4, -turn / 4);
  torques("stretched sideways, 31 turns on", 31 * turn, 31 * turn);
  law.pair.report(&o);
  o.note =
      "Law `pantograph` at rest, engine alone. At a singular place the motors cannot give a force "
      "along the links; the law asks them for none, and stays finite.";
  return o;
}

/// Where a handle in three rings points, as a rotation matrix: z, then y, then x.
using Matrix = std::array<std::array<double, 3>, 3>;
Matrix times(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}
Matrix rotation(std::size_t axis, double angle) {
  Matrix m{};
  const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
  m[axis][axis] = 1;
  m[j][j] = m[k][k] = std::cos(angle);
  m[k][j] = std::sin(angle);
  m[j][k] = -m[k][j];
  return m;
}

Outcome gimbal_lock(const Settings& settings) {
  Outcome o;
  LoadedLaw law(settings, "gimbal");
  law.set({{"stiffness", 0.25}});
  // The spring turns the handle back to its first orientation: a turn by `angle` about an axis
  // gives 2 k sin(angle / 2) about it, by the shorter way; each motor gives the part along its
  // ring.
  const auto torques = [&](const std::string& what, const Turns& at) {
    law.go(at);
    const Matrix z = rotation(2, rad_of(at[0])), y = rotation(1, rad_of(at[1]));
    const Matrix zy = times(z, y), all = times(zy, rotation(0, rad_of(at[2])));
    const double trace = all[0][0] + all[1][1] + all[2][2];
    const double cosine = 0.5 * std::sqrt(std::max(0.0, 1 + trace));  // of half the turn
    for (int axis = 0; axis < 3; ++axis) {
      const std::array<double, 3> ring = axis == 0 ? std::array<double, 3>{0, 0, 1}
                                         : axis == 1
                                             ? std::array<double, 3>{z[0][1], z[1][1], z[2][1]}
                                             : std::array<double, 3>{zy[0][0], zy[1][0], zy[2][0]};
      // The antisymmetric part of the matrix is 2 sin(angle) times the axis of the turn.
      const double about[] = {all[2][1] - all[1][2], all[0][2] - all[2][0], all[1][0] - all[0][1]};
      double along = 0;
      for (std::size_t i = 0; i < 3; ++i) along += ring[i] * about[i];
      law.check(&o, what + ", motor " + "zyx"[axis], axis, -0.25 * along / (2 * cosine));
    }
  };
  torques("middle ring at 90 deg, outer at 30 deg", {turn / 12, turn / 4, 0});
  torques("middle ring at 90 deg, outer 30, inner 20 deg", {turn / 12, turn / 4, turn / 18});
  torques("the rings turn together: nothing", {turn / 8, turn / 4, turn / 8});
  torques("middle ring at -90 deg, outer at 30 deg", {turn / 12, -turn / 4, 0});
  torques("middle ring at 179.9 deg", {0, turn / 2 - 1, 0});
  torques("middle ring at 180.1 deg, the other way", {0, turn / 2 + 1, 0});
  torques("outer ring at 30 deg, a turn on", {turn / 12 + turn, 0, 0});
  law.pair.report(&o);
  o.note =
      "Law `gimbal` with 0.25 Nm/rad, engine alone; the expected torques are computed with "
      "rotation matrices, the law uses quaternions. With the middle ring at 90 deg the outer and "
      "the inner "
      "one turn about the same line.";
  return o;
}

Outcome plane_lost(const Settings& settings) {
  Outcome o;
  LoadedLaw law(settings, "local_plane", "max_age 200 ms", "max_age 20 ms");
  const std::map<std::string, double> plane = {
      {"point_y", 0.1}, {"normal_y", 1}, {"stiffness", 1000}};
  law.set(plane);
  // The tip at 0.09 m, 10 mm in the material: 10 N upwards, 0.1 m * cos(a) of it for each motor.
  const int a = static_cast<int>(std::lround(std::asin(0.45) / count_rad));
  const Turns at{a, turn / 2 - a, 0};
  law.go(at);
  const double force = 1000 * (0.1 - 0.2 * std::sin(rad_of(a)));
  const double torque = 0.1 * std::cos(rad_of(a)) * force;
  law.check(&o, "in touch, first motor", 0, torque);
  law.check(&o, "in touch, second motor", 1, -torque);

  // The host sends nothing more.
  law.set(plane);
  const int age = law.ticks_per_mailbox_age();
  Both ticks{-1, -1};
  for (int k = 1; k <= age + 200 && (ticks.rtl < 0 || ticks.twin < 0); ++k) {
    law.pair.clock(Pair::clocks_per_tick);
    const Both now = law.pair.torque(0);
    if (now.rtl == 0 && ticks.rtl < 0) ticks.rtl = k;
    if (now.twin == 0 && ticks.twin < 0) ticks.twin = k;
  }
  const double waited_ms = 1e-3 * kCheck / Pair::clocks_per_tick;  // ticks of 1 us
  const double step_ms = 1e-3 * EngineMap::mailbox_step;
  o.add("from the last word to no torque", "ms", between(20 - 2 * step_ms, 20),
        ticks.rtl * 1e-3 + waited_ms, ticks.twin * 1e-3 + waited_ms);
  const Both second = law.pair.torque(1), status = law.pair.read(EngineMap::H::status);
  const auto late = [](double word) {
    return static_cast<double>(static_cast<unsigned>(word) >> EngineMap::S::status_mailbox_late &
                               1U);
  };
  o.add("second motor then", "Nm", exactly(0), second.rtl, second.twin);
  o.add("the status says so", "", exactly(1), late(status.rtl), late(status.twin));

  law.set(plane);
  law.go(at);
  law.check(&o, "the host comes back, first motor", 0, torque);
  law.pair.report(&o);
  o.note =
      "Law `local_plane`, whose mailboxes may be 20 ms old here; the age is counted in steps of 64 "
      "ticks. The core's ramp, which follows, brings the torque down with 5 Nm/s; it is not in "
      "this case.";
  return o;
}

}  // namespace

std::vector<Case> axes_cases() {
  const char* group = "Several axes";
  return {
      {group, "linkage_singular",
       "A pantograph stretched and folded: the force of a floor where a motor cannot give it.",
       linkage_singular},
      {group, "gimbal_lock", "A gimbal whose outer and inner ring turn about the same line.",
       gimbal_lock},
      {group, "plane_lost", "A plane from a host that falls silent while the pen is in it.",
       plane_lost},
  };
}

}  // namespace feltgate::extremes
