// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Poles of the closed loop: the chain's difference equations and the plant's exact step over one
// tick make one characteristic matrix; the argument principle counts the zeros of its determinant
// and finds them. Derivation: docs/designs.md
#include "design/loop_poles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "config/toml_reader.hpp"
#include "design/winding.hpp"

namespace feltgate::design {

namespace {

/// States and input of the motor with its lever: current, speed, angle, voltage.
enum : std::size_t { kCurrent, kSpeed, kAngle, kVoltage, kPlantSize };
using PlantMatrix = std::array<std::array<double, kPlantSize>, kPlantSize>;

PlantMatrix product(const PlantMatrix& a, const PlantMatrix& b) {
  PlantMatrix c{};
  for (std::size_t i = 0; i < kPlantSize; ++i) {
    for (std::size_t j = 0; j < kPlantSize; ++j) {
      for (std::size_t k = 0; k < kPlantSize; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

void add(PlantMatrix& a, const PlantMatrix& b, double factor) {
  for (std::size_t i = 0; i < kPlantSize; ++i) {
    for (std::size_t j = 0; j < kPlantSize; ++j) a[i][j] += factor * b[i][j];
  }
}

/// exp(a*t) - 1, by a Taylor series and doubling; without the 1, so that slow poles keep digits.
PlantMatrix exp_minus_one(const PlantMatrix& a, double t) {
  double norm = 0;
  for (const auto& row : a) {
    for (const double x : row) norm = std::max(norm, std::abs(x) * t);
  }
  const int doublings = std::max(0, std::ilogb(norm) + 4);
  PlantMatrix term{}, sum{};
  add(term, a, std::ldexp(t, -doublings));
  const PlantMatrix step = term;
  for (int n = 2; n < 20; ++n) {
    add(sum, term, 1.0);
    PlantMatrix next{};
    add(next, product(term, step), 1.0 / n);
    term = next;
  }
  for (int n = 0; n < doublings; ++n) {
    const PlantMatrix square = product(sum, sum);
    add(sum, sum, 1.0);
    add(sum, square, 1.0);
  }
  return sum;
}

double damping_of(const plant::Parameters& p) {
  return (p.effects.viscous ? p.lever.viscous_nm_s_rad : 0.0) +
         (p.effects.lugre ? p.lugre.viscous_nm_s_rad : 0.0);
}

/// The plant's change over one tick in which the voltage is held.
PlantMatrix tick_of(const plant::Parameters& p, double tick_s) {
  const double r = p.motor.resistance_ohm, l = p.motor.inductance_h, j = p.lever.inertia_kg_m2;
  const double kt = p.motor.torque_constant_nm_a;
  const double ke = p.effects.back_emf ? p.motor.back_emf_constant_v_s_rad : 0.0;
  const double b = damping_of(p);
  PlantMatrix rate{};
  if (p.effects.inductance) {
    rate[kCurrent] = {-r / l, -ke / l, 0, 1 / l};
    rate[kSpeed] = {kt / j, -b / j, 0, 0};
  } else {
    rate[kSpeed] = {0, -(kt * ke / r + b) / j, 0, kt / (r * j)};
  }
  rate[kAngle][kSpeed] = 1;
  PlantMatrix change = exp_minus_one(rate, tick_s);
  // A current that follows at once is no state: nothing of it remains after a tick.
  if (!p.effects.inductance) change[kCurrent] = {-1, 0, 0, 0};
  return change;
}

/// exp(x) - 1 without cancellation near 0.
Complex exp_minus_one(Complex x) {
  const double half = std::sin(x.imag() / 2);
  return {std::expm1(x.real()) * std::cos(x.imag()) - 2 * half * half,
          std::exp(x.real()) * std::sin(x.imag())};
}

/// Everything the loop equations need, in one place.
struct LoopCoefficients {
  PlantMatrix tick{};
  double tick_s = 0;
  int m1 = 0;
  double raw_per_rad = 0;  ///< 2^n times counts per radian
  double velocity_a1 = 0, observer_a1 = 0;
  double torque_constant = 0, inertia_gain = 0, observer_gain = 0;
  double emf_constant = 0, voltage_gain = 0;
  double applied = 0;  ///< plant volts per commanded volt
};

/// Unknowns of the loop, one row each.
enum : std::size_t { kI, kW, kV, kVelocity, kObserver, kReference, kLoopSize };
using LoopMatrix = std::array<std::array<Complex, kLoopSize>, kLoopSize>;

Complex determinant(LoopMatrix m) {
  Complex det = 1;
  for (std::size_t c = 0; c < kLoopSize; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < kLoopSize; ++r) {
      if (std::abs(m[r][c]) > std::abs(m[pivot][c])) pivot = r;
    }
    if (m[pivot][c] == Complex{}) return 0;
    if (pivot != c) {
      std::swap(m[pivot], m[c]);
      det = -det;
    }
    det *= m[c][c];
    for (std::size_t r = c + 1; r < kLoopSize; ++r) {
      const Complex factor = m[r][c] / m[c][c];
      for (std::size_t k = c; k < kLoopSize; ++k) m[r][k] -= factor * m[c][k];
    }
  }
  return det;
}

/// Characteristic function of the loop, entire in s; its zeros are the poles.
Complex characteristic(const LoopCoefficients& c, Complex s) {
  const Complex shorter = -exp_minus_one(-s * c.tick_s);  // 1 - w, w: one tick of delay
  const Complex w = 1.0 - shorter;
  const Complex window =
      s == Complex{} ? c.m1 : -exp_minus_one(-s * (c.tick_s * c.m1)) / shorter;  // 1+w+...+w^(m1-1)
  const double raw = c.velocity_a1 * c.raw_per_rad;
  const PlantMatrix& p = c.tick;
  LoopMatrix m{};
  m[kI] = {shorter - w * p[kCurrent][kCurrent], -w * p[kCurrent][kSpeed],
           -w * p[kCurrent][kVoltage]};
  m[kW] = {-w * p[kSpeed][kCurrent], shorter - w * p[kSpeed][kSpeed], -w * p[kSpeed][kVoltage]};
  m[kVelocity] = {-raw * w * window * p[kAngle][kCurrent], -raw * w * window * p[kAngle][kSpeed],
                  -raw * w * window * p[kAngle][kVoltage], shorter + c.velocity_a1 * w};
  m[kObserver][kVelocity] = -c.observer_a1 * c.inertia_gain;
  m[kObserver][kObserver] = shorter + c.observer_a1 * w;
  m[kObserver][kReference] = -c.observer_a1 * c.torque_constant * w;
  m[kReference][kVelocity] = c.observer_gain * c.inertia_gain;
  m[kReference][kObserver] = -c.observer_gain;
  m[kReference][kReference] = 1;
  m[kV][kV] = 1;
  m[kV][kVelocity] = -w * c.applied * c.emf_constant;
  m[kV][kReference] = -w * c.applied * c.voltage_gain;
  return determinant(m);
}

LoopCoefficients coefficients(const Elaborated& e, const plant::Parameters& p) {
  const auto word = [&](const char* name) { return e.word(name).quantised(); };
  LoopCoefficients c;
  c.tick_s = e.design.tick_s();
  c.tick = tick_of(p, c.tick_s);
  c.m1 = e.design.m1;
  const double two_pi = 6.283185307179586;
  c.raw_per_rad = 4.0 * p.encoder.lines / two_pi * e.rad_s_per_count();
  c.velocity_a1 = word("velocity_a1");
  c.observer_a1 = word("observer_a1");
  c.torque_constant = word("torque_constant");
  c.inertia_gain = word("inertia_gain");
  c.observer_gain = word("observer_gain");
  c.emf_constant = word("emf_constant");
  c.applied = p.supply.voltage_v / e.design.supply_v;
  return c;
}

LoopRegion region(LoopCoefficients c, const std::string& where, double voltage_gain_ohm) {
  c.voltage_gain = voltage_gain_ohm;
  const auto f = [&](Complex s) { return characteristic(c, s); };
  LoopRegion out;
  out.where = where;
  out.voltage_gain_ohm = voltage_gain_ohm;
  out.unstable = zeros_right_of(f, growth_limit_rad_s, 3.141592653589793 / c.tick_s, 8 * c.m1 + 64);
  // Further left exp(-s*m1*tick) would overflow; above the Nyquist frequency poles repeat.
  const double left = std::min(pole_range_rad_s, 20 / (c.m1 * c.tick_s));
  const double top = std::min(pole_range_rad_s, 3 / c.tick_s);
  for (const Complex& s : zeros_in(f, {-left, -top}, {pole_range_rad_s, top})) {
    if (s.imag() >= 0) out.poles_rad_s.push_back(s);
  }
  std::sort(out.poles_rad_s.begin(), out.poles_rad_s.end(),
            [](Complex a, Complex b) { return a.real() > b.real(); });
  return out;
}

std::string pole_text(Complex s) {
  if (s.imag() == 0) return fmt::format("{:.5g}", s.real());
  return fmt::format("{:.5g}+-{:.5g}j", s.real(), s.imag());
}

}  // namespace

bool ClosedLoop::stable() const {
  return std::all_of(regions.begin(), regions.end(),
                     [](const LoopRegion& r) { return r.unstable == 0; });
}

ClosedLoop closed_loop(const Elaborated& e, const plant::Parameters& plant) {
  const Design& d = e.design;
  const LoopCoefficients c = coefficients(e, plant);
  ClosedLoop loop;
  loop.plant = plant.name;
  loop.damping_nm_s_rad = damping_of(plant);
  loop.inertia_ratio = d.inertia_kg_m2 / plant.lever.inertia_kg_m2;
  loop.feed_forward = d.inertia_kg_m2 * d.kp_1_kg_m2;
  // Blocked: (1 - (1-a1)*w) I = a1*(1 - Jn*Kp)*w I.
  const double kept = c.observer_gain * c.torque_constant;
  loop.stall_pole_rad_s = std::log1p(-c.observer_a1 * (1 - kept)) / c.tick_s;
  const double low = e.word("voltage_gain").quantised();
  const double high = e.word("voltage_gain_high").quantised();
  if (low == high) {
    loop.regions.push_back(region(c, "any torque", low));
  } else {
    loop.regions.push_back(region(c, fmt::format("torque up to {:.4g} Nm", d.region_nm), low));
    loop.regions.push_back(region(c, fmt::format("torque above {:.4g} Nm", d.region_nm), high));
  }
  return loop;
}

void refuse_unstable(const Elaborated& e, const plant::Parameters& plant) {
  const ClosedLoop loop = closed_loop(e, plant);
  const auto worst = std::find_if(loop.regions.begin(), loop.regions.end(),
                                  [](const LoopRegion& r) { return r.unstable > 0; });
  if (worst == loop.regions.end()) return;
  const std::string what = fmt::format(
      "the loop around plant \"{}\" is unstable ({}: pole at {} rad/s; Jn/J = {:.3g}, "
      "Jn*Kp = {:.3g})",
      plant.name, worst->where,
      worst->poles_rad_s.empty() ? "beyond 1e4" : pole_text(worst->poles_rad_s[0]),
      loop.inertia_ratio, loop.feed_forward);
  struct Change {
    const char* key;
    std::string mend;
    std::function<void(Design&)> make;
  };
  const auto value = [](const char* key, double v) {
    return fmt::format("{} = {:.4g}, the plant's", key, v);
  };
  const double emf = plant.motor.back_emf_constant_v_s_rad, inertia = plant.lever.inertia_kg_m2;
  const std::vector<Change> changes{
      {"motor.emf_constant_v_s_rad", value("motor.emf_constant_v_s_rad", emf),
       [&](Design& d) { d.emf_constant_v_s_rad = emf; }},
      {"observer.inertia_kg_m2", value("observer.inertia_kg_m2", inertia),
       [&](Design& d) { d.inertia_kg_m2 = inertia; }},
      {"control.kp_1_kg_m2", "control.kp = \"1/inertia\", which takes the observer out of the loop",
       [&](Design& d) { d.kp_1_kg_m2 = 1 / d.inertia_kg_m2; }}};
  std::string mend, key = "observer.cutoff_rad_s";
  for (const Change& change : changes) {
    Design mended = e.design;
    change.make(mended);
    if (!closed_loop(elaborate(mended, e.registers), plant).stable()) continue;
    if (mend.empty()) key = change.key;
    mend += (mend.empty() ? "set " : ", or ") + change.mend;
  }
  e.design.fail(key, what,
                mend.empty() ? "lower observer.cutoff_rad_s or Jn, or check the plant" : mend);
}

std::string loop_table(const ClosedLoop& loop) {
  std::string text = fmt::format(
      "\nclosed loop around plant {}, lever free, friction {:.3g} Nm s/rad: poles in rad/s\n",
      loop.plant, loop.damping_nm_s_rad);
  for (const LoopRegion& r : loop.regions) {
    text += fmt::format("  {}, gain {:.4g} ohm:", r.where, r.voltage_gain_ohm);
    for (const auto& s : r.poles_rad_s) text += "  " + pole_text(s);
    text += r.unstable == 0 ? "  (stable)\n" : "  (UNSTABLE)\n";
  }
  return text + fmt::format(
                    "  lever blocked: tau_hat at {:.6g}\n"
                    "  Jn/J = {:.4g}; {:.4g} of the current reference is feed-forward "
                    "(Jn*Kp)\n",
                    loop.stall_pole_rad_s, loop.inertia_ratio, loop.feed_forward);
}

}  // namespace feltgate::design
