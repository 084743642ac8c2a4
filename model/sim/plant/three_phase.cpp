// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Three half bridges, a star of windings and its torque. Documentation: docs/plant.md#three-phases
#include "sim/plant/three_phase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace feltgate::plant {

namespace {

constexpr std::size_t kPhases = 3;
constexpr double kSin120 = 0.86602540378443864676372317075294;

/// V - e - R*i of a phase: one value, or where its leg is at a step of its curve any between.
struct Drives {
  double low_v = 0.0, high_v = 0.0;
  const LegVoltage* low = nullptr;   ///< leg at low_v: the current grows from here
  const LegVoltage* high = nullptr;  ///< leg at high_v: it falls from here
  bool at_step() const { return low != high; }
  /// What is left for L*di/dt with the neutral at this voltage.
  double left_v(double neutral_v) const {
    return std::max(0.0, low_v - neutral_v) + std::min(0.0, high_v - neutral_v);
  }
};

const LegVoltage& at(const LegCurve& leg, double current_a) {
  if (!leg.stepped || current_a > leg.edge_a) return leg.above;
  return current_a < -leg.edge_a ? leg.below : leg.between;
}

Drives drives_of(const LegCurve& leg, double current_a, double less_v, double bus_v) {
  const LegVoltage *low = &at(leg, current_a), *high = low;
  if (leg.stepped && std::abs(current_a) == leg.edge_a) {
    const bool once = leg.edge_a == 0.0;
    low = once || current_a > 0.0 ? &leg.above : &leg.between;
    high = once || current_a < 0.0 ? &leg.below : &leg.between;
  }
  return {low->volts(bus_v) - less_v, high->volts(bus_v) - less_v, low, high};
}

/// The neutral's voltage: there the currents of the star change by 0 in sum. The sum falls with it,
/// in straight pieces; any voltage does where no current changes.
double neutral_of(const std::array<Drives, kPhases>& drives, const std::array<bool, 3>& connected) {
  const double infinite = std::numeric_limits<double>::infinity();
  double top = -infinite, bottom = infinite;
  for (std::size_t k = 0; k < kPhases; ++k) {
    if (!connected[k]) continue;
    top = std::max(top, drives[k].low_v);
    bottom = std::min(bottom, drives[k].high_v);
  }
  if (top <= bottom) return 0.5 * (top + bottom);
  // The piece with the root: its two ends are the nearest corners.
  for (std::size_t k = 0; k < kPhases; ++k) {
    if (!connected[k]) continue;
    for (const double corner : {drives[k].low_v, drives[k].high_v}) {
      if (!(corner > bottom && corner < top)) continue;
      double sum = 0.0;
      for (std::size_t j = 0; j < kPhases; ++j) {
        if (connected[j]) sum += drives[j].left_v(corner);
      }
      (sum >= 0.0 ? bottom : top) = corner;
    }
  }
  // Those that conduct on this piece share its voltage.
  double sum_v = 0.0, count = 0.0;
  for (std::size_t k = 0; k < kPhases; ++k) {
    if (!connected[k]) continue;
    const bool up = drives[k].low_v >= top;
    if (!up && drives[k].high_v > bottom) continue;
    sum_v += up ? drives[k].low_v : drives[k].high_v;
    count += 1.0;
  }
  return sum_v / count;
}

/// Share of its current that the leg of a phase takes from the bus.
double bus_share(const Drives& d, double neutral_v, double left_v) {
  if (!d.at_step()) return d.low->share;
  if (left_v != 0.0) return left_v > 0.0 ? d.low->share : d.high->share;
  const double wide_v = d.high_v - d.low_v;
  const double way = wide_v > 0.0 ? (neutral_v - d.low_v) / wide_v : 0.0;
  return d.low->share + way * (d.high->share - d.low->share);
}

/// The current at which the leg's voltage steps next, for a current that grows or falls; infinite
/// if there is none.
double next_edge_a(const LegCurve& leg, double current_a, bool grows) {
  const double infinite = std::numeric_limits<double>::infinity();
  const double none = grows ? infinite : -infinite;
  if (!leg.stepped) return none;
  const double first = grows ? -leg.edge_a : leg.edge_a;
  for (const double edge : {first, -first}) {
    if (grows ? edge > current_a : edge < current_a) return edge;
  }
  return none;
}

}  // namespace

Legs Legs::averaged(const Phases& duty, bool enabled) {
  Legs legs;
  legs.mode = enabled ? Mode::kAveraged : Mode::kOff;
  legs.duty = duty;
  return legs;
}

Legs Legs::gates(double a_hi, double a_lo, double b_hi, double b_lo, double c_hi, double c_lo) {
  return {Mode::kSwitched, {}, {a_hi, b_hi, c_hi}, {a_lo, b_lo, c_lo}};
}

LegModel::LegModel(const Drive& drive, const SupplyParameters& supply, const PhaseParameters& motor,
                   const Effects& effects)
    : diode_v_(supply.diode_drop_v),
      dead_fraction_(effects.dead_time ? drive.dead_time_s * drive.pwm_hz : 0.0),
      least_(drive.shortest_s > 0 ? (drive.dead_time_s + drive.shortest_s) * drive.pwm_hz : 0.0),
      ripple_a_v_(effects.inductance ? 0.5 / (motor.inductance_h * drive.pwm_hz) : 0.0) {
  if (!(drive.clock_hz > 0.0) || !(drive.pwm_hz > 0.0) || !(drive.dead_time_s >= 0.0) ||
      !(drive.dead_time_s * drive.pwm_hz < 0.5) || !(least_ <= 0.5)) {
    throw std::invalid_argument(
        "three phases: dead time and shortest pulse must be below half a PWM period");
  }
}

// Mean share of the period of a PWM that gives whole pulses only (docs/blocks/pwm.md).
double LegModel::whole_pulses(double on) const {
  if (dead_fraction_ <= 0.0 || least_ <= 0.0) return on;
  return std::min(on, 1.0 - least_);
}

// Dead time delays each turn-on. A leg whose current flows out at both edges of its pulse is high
// for that much less; one whose current flows in at both, for that much more. Where the ripple
// turns the current over between the edges, nothing is lost: these are the edges of the curve.
void LegModel::average(const Phases& duty, double bus_v, const std::array<bool, 3>& connected) {
  duty_ = duty;
  bus_v_ = bus_v;
  connected_ = connected;
  const double count = std::max(1, connected[0] + connected[1] + connected[2]);
  Phases on;
  for (std::size_t k = 0; k < kPhases; ++k) on[k] = whole_pulses(std::clamp(duty[k], 0.0, 1.0));
  for (std::size_t k = 0; k < kPhases; ++k) {
    const double high = on[k], low = 1.0 - high;
    const double lost = std::min(dead_fraction_, high), gained = std::min(dead_fraction_, low);
    const bool switches = high > 0.0 && low > 0.0;
    LegCurve& leg = curves_[k];
    leg = {};
    leg.between = leg.below = leg.above = {high, 0.0};
    leg.stepped = switches && dead_fraction_ > 0.0;
    if (!leg.stepped) continue;
    const double diodes_v = (dead_fraction_ + std::min(lost, gained)) * diode_v_;
    leg.above = {high - lost, -diodes_v};
    leg.below = {high + gained, diodes_v};
    // The centred pulses of the other legs: from the middle of its pulse to its edge the current
    // gains this much on its mean. Where the current turns over, the dead times of both legs hide
    // that much of the difference of two pulses.
    double gain = 0.0;
    for (std::size_t j = 0; j < kPhases; ++j) {
      if (!connected[j]) continue;
      const double apart = std::max(0.0, std::abs(on[j] - high) - 2.0 * dead_fraction_);
      gain += apart * (on[j] < high ? low : high);
    }
    leg.edge_a = ripple_a_v_ * bus_v * gain / count;
  }
}

const std::array<LegCurve, 3>& LegModel::curves(const Legs& legs, double bus_v,
                                                const std::array<bool, 3>& connected) {
  if (legs.mode == Legs::Mode::kAveraged) {
    if (legs.duty != duty_ || bus_v != bus_v_ || connected != connected_) {
      average(legs.duty, bus_v, connected);
    }
    return curves_;
  }
  bus_v_ = -1.0;
  for (std::size_t k = 0; k < kPhases; ++k) {
    const double high = legs.high[k], rest = 1.0 - high - legs.low[k];
    const double off = rest < 0.0 ? 0.0 : rest;  // a NaN stays one
    LegCurve& leg = curves_[k];
    leg.stepped = off > 0.0;
    leg.edge_a = 0.0;
    // Out through the low diode, in through the high one.
    leg.above = leg.between = {high, -off * diode_v_};
    leg.below = {high + off, off * diode_v_};
  }
  return curves_;
}

void StarWinding::set_step(double dt_s) {
  dt_s_ = dt_s;
  reach_ = -std::expm1(-dt_s / tau_s_);
}

void StarWinding::open(std::size_t phase) {
  connected_.at(phase) = false;
  const std::size_t one = (phase + 1) % kPhases, other = (phase + 2) % kPhases;
  const double loop_a = 0.5 * (current_a_[one] - current_a_[other]);
  const bool closed = connected_[one] && connected_[other];
  current_a_[phase] = 0.0;
  current_a_[one] = closed ? loop_a : 0.0;
  current_a_[other] = closed ? -loop_a : 0.0;
}

// A value that is not finite stays one: comparisons with it must not turn it into a blocked diode.
StarStep StarWinding::fail() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  current_a_ = {nan, nan, nan};
  return {current_a_, nan};
}

StarStep StarWinding::advance(const std::array<LegCurve, 3>& legs, const Phases& emf_v,
                              double bus_v) {
  // Each diode turns over a few times in a step at most; without an end it would be an error here.
  constexpr int most_pieces = 64;
  StarStep step;
  double left_s = dt_s_, reach = reach_;
  Phases charge{};
  double drawn = 0.0;
  for (int piece = 0; piece < most_pieces; ++piece) {
    std::array<Drives, kPhases> drives;
    double sum = 0.0;
    for (std::size_t k = 0; k < kPhases; ++k) {
      drives[k] =
          drives_of(legs[k], current_a_[k], emf_v[k] + resistance_ohm_ * current_a_[k], bus_v);
      sum += drives[k].low_v + drives[k].high_v;
    }
    if (!std::isfinite(sum)) return fail();
    const double neutral_v = neutral_of(drives, connected_);

    // How far towards its end each current goes, 1 being infinite time, and the first at an edge.
    Phases way_a{}, edge_a{};
    double first = reach;
    std::size_t turned = kPhases;
    for (std::size_t k = 0; k < kPhases; ++k) {
      const double left_v = connected_[k] ? drives[k].left_v(neutral_v) : 0.0;
      way_a[k] = left_v / resistance_ohm_;
      if (left_v == 0.0) continue;
      edge_a[k] = next_edge_a(legs[k], current_a_[k], left_v > 0.0);
      const double share = (edge_a[k] - current_a_[k]) / way_a[k];
      if (share >= first) continue;
      first = share;
      turned = k;
    }
    const bool whole = turned == kPhases;
    const double t = whole ? left_s : -tau_s_ * std::log1p(-first);
    const double grown_s = t - tau_s_ * first;
    std::size_t balance = kPhases;  // takes the rounding of the sum
    for (std::size_t k = 0; k < kPhases; ++k) {
      const double part = current_a_[k] * t + way_a[k] * grown_s;
      charge[k] += part;
      if (part != 0.0) drawn += bus_share(drives[k], neutral_v, way_a[k]) * part;
      current_a_[k] = k == turned ? edge_a[k] : current_a_[k] + way_a[k] * first;
      if (k != turned && way_a[k] != 0.0) balance = k;
    }
    if (balance < kPhases) {
      current_a_[balance] = 0.0;
      current_a_[balance] = 0.0 - (current_a_[0] + current_a_[1] + current_a_[2]);
    }
    left_s -= t;
    if (whole || left_s <= 0.0) {
      for (std::size_t k = 0; k < kPhases; ++k) step.mean_a[k] = charge[k] / dt_s_;
      step.bridge_a = drawn / dt_s_;
      return step;
    }
    reach = -std::expm1(-left_s / tau_s_);
  }
  return fail();
}

StarStep StarWinding::settle(const std::array<LegCurve, 3>& legs, const Phases& emf_v,
                             double bus_v) {
  std::array<Drives, kPhases> drives;
  double sum = 0.0;
  for (std::size_t k = 0; k < kPhases; ++k) {
    drives[k] = drives_of(legs[k], 0.0, emf_v[k], bus_v);
    sum += drives[k].low_v + drives[k].high_v;
  }
  if (!std::isfinite(sum)) return fail();
  const double neutral_v = neutral_of(drives, connected_);
  StarStep step;
  for (std::size_t k = 0; k < kPhases; ++k) {
    const double left_v = connected_[k] ? drives[k].left_v(neutral_v) : 0.0;
    current_a_[k] = left_v / resistance_ohm_;
    if (left_v != 0.0) step.bridge_a += bus_share(drives[k], neutral_v, left_v) * current_a_[k];
  }
  step.mean_a = current_a_;
  return step;
}

ThreePhaseMotor::ThreePhaseMotor(const PhaseParameters& motor, const SupplyParameters& supply,
                                 const Drive& drive, const Effects& effects)
    : p_(motor),
      on_(effects),
      legs_(drive, supply, motor, effects),
      star_(motor.resistance_ohm, motor.inductance_h) {
  if (!(motor.resistance_ohm > 0.0) || !(motor.inductance_h > 0.0) ||
      !(motor.back_emf_v_s_rad > 0.0) || motor.pole_pairs < 1) {
    throw std::invalid_argument(
        "three phases: resistance, inductance, back-EMF and pole pairs must be greater than 0");
  }
  for (const EmfHarmonic& h : motor.harmonics) {
    if (h.order < 1) throw std::invalid_argument("three phases: a harmonic's order is at least 1");
  }
}

Phases ThreePhaseMotor::shape(double electrical_rad) const {
  // cos(n e - n k 120 degrees): a third of a turn for each step of n k.
  const auto turned = [](double cosine, double sine, std::size_t thirds) {
    if (thirds % kPhases == 0) return cosine;
    return -0.5 * cosine + (thirds % kPhases == 1 ? kSin120 : -kSin120) * sine;
  };
  const double cosine = std::cos(electrical_rad), sine = std::sin(electrical_rad);
  Phases shape{cosine, turned(cosine, sine, 1), turned(cosine, sine, 2)};
  for (const EmfHarmonic& h : p_.harmonics) {
    const double c = h.share * std::cos(h.order * electrical_rad);
    const double s = h.share * std::sin(h.order * electrical_rad);
    for (std::size_t k = 0; k < kPhases; ++k) {
      shape[k] += turned(c, s, k * static_cast<std::size_t>(h.order));
    }
  }
  return shape;
}

double ThreePhaseMotor::torque(const Phases& shape, const Phases& current_a) const {
  return p_.back_emf_v_s_rad *
         (shape[0] * current_a[0] + shape[1] * current_a[1] + shape[2] * current_a[2]);
}

double ThreePhaseMotor::amplitude_a(double torque_nm) const {
  return torque_nm / (1.5 * p_.back_emf_v_s_rad);
}

MotorStep ThreePhaseMotor::advance(const Legs& legs, double bus_v, const Shaft& middle) {
  const Phases form = shape(electrical_rad(middle.theta_rad));
  Phases emf_v{};
  if (on_.back_emf) {
    for (std::size_t k = 0; k < kPhases; ++k) {
      emf_v[k] = p_.back_emf_v_s_rad * middle.omega_rad_s * form[k];
    }
  }
  const auto& curves = legs_.curves(legs, bus_v, star_.connected());
  const StarStep step =
      on_.inductance ? star_.advance(curves, emf_v, bus_v) : star_.settle(curves, emf_v, bus_v);
  mean_a_ = step.mean_a;
  const double torque_nm = torque(form, mean_a_);
  return {amplitude_a(torque_nm), torque_nm, step.bridge_a};
}

void ThreePhasePlant::advance(const Legs& legs, Clock clocks) {
  step(motor_, clocks, [this, &legs](double bus_v, const Shaft& middle) {
    return motor_.advance(legs, bus_v, middle);
  });
}

}  // namespace feltgate::plant
