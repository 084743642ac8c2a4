// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Poles of the closed loop: the chain's difference equations and the plant's exact step over one
// tick make one characteristic matrix; the argument principle counts the zeros of its determinant
// and finds them. Derivation: docs/designs.md
#include "studies/stability/loop_poles.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <Eigen/LU>

#include "files/toml/toml_reader.hpp"
#include "studies/stability/linear_loop.hpp"

namespace feltgate::stability {

using design::Design;
using design::Elaborated;

namespace {

/// exp(x) - 1 without cancellation near 0.
Complex exp_minus_one(Complex x) {
  const double half = std::sin(x.imag() / 2);
  return {std::expm1(x.real()) * std::cos(x.imag()) - 2 * half * half,
          std::exp(x.real()) * std::sin(x.imag())};
}

/// Unknowns of the loop, one row each.
enum : Eigen::Index { kI, kW, kV, kVelocity, kObserver, kReference, kLoopSize };

/// Characteristic function of the loop, entire in s; its zeros are the poles.
Complex characteristic(const LinearLoop& c, double voltage_gain, Complex s) {
  const Complex shorter = -exp_minus_one(-s * c.tick_s);  // 1 - w, w: one tick of delay
  const Complex w = 1.0 - shorter;
  const Complex window =
      s == Complex{} ? c.m1 : -exp_minus_one(-s * (c.tick_s * c.m1)) / shorter;  // 1+w+...+w^(m1-1)
  const double raw = c.velocity_a1 * c.raw_rad_s_rad;
  const Eigen::Matrix4d& p = c.change;
  Eigen::Matrix<Complex, kLoopSize, kLoopSize> m;
  m.setZero();
  for (const auto& [row, of] : {std::pair{kI, LinearLoop::kCurrent}, {kW, LinearLoop::kSpeed}}) {
    m(row, kI) = -w * p(of, LinearLoop::kCurrent);
    m(row, kW) = -w * p(of, LinearLoop::kSpeed);
    m(row, kV) = -w * p(of, LinearLoop::kVoltage);
    m(row, row) += shorter;
  }
  m(kVelocity, kI) = -raw * w * window * p(LinearLoop::kAngle, LinearLoop::kCurrent);
  m(kVelocity, kW) = -raw * w * window * p(LinearLoop::kAngle, LinearLoop::kSpeed);
  m(kVelocity, kV) = -raw * w * window * p(LinearLoop::kAngle, LinearLoop::kVoltage);
  m(kVelocity, kVelocity) = shorter + c.velocity_a1 * w;
  m(kObserver, kVelocity) = -c.observer_a1 * c.inertia_gain;
  m(kObserver, kObserver) = shorter + c.observer_a1 * w;
  m(kObserver, kReference) = -c.observer_a1 * c.torque_constant * w;
  m(kReference, kVelocity) = c.observer_gain * c.inertia_gain;
  m(kReference, kObserver) = -c.observer_gain;
  m(kReference, kReference) = 1;
  m(kV, kV) = 1;
  m(kV, kVelocity) = -w * c.applied * c.emf_constant;
  m(kV, kReference) = -w * c.applied * voltage_gain;
  return m.determinant();
}

LoopRegion region(const LinearLoop& c, const std::string& where, double voltage_gain_ohm) {
  const auto f = [&](Complex s) { return characteristic(c, voltage_gain_ohm, s); };
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
  const LinearLoop c = make_linear_loop(e, plant);
  ClosedLoop loop;
  loop.plant = plant.name;
  loop.damping_nm_s_rad = c.damping_nm_s_rad;
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

// Counting and finding zeros by the argument principle.

namespace {

constexpr double two_pi = 6.283185307179586;

/// Change of the argument of f from a to b, halving the way until it turns little.
double turn(const AnalyticFunction& f, Complex a, Complex fa, Complex b, Complex fb, int depth) {
  const Complex middle = (a + b) / 2.0, fm = f(middle);
  const double first = std::arg(fm / fa), second = std::arg(fb / fm);
  if (depth == 0 || std::abs(first) + std::abs(second) < 0.5) return first + second;
  return turn(f, a, fa, middle, fm, depth - 1) + turn(f, middle, fm, b, fb, depth - 1);
}

double turn(const AnalyticFunction& f, Complex a, Complex b, int pieces) {
  double sum = 0;
  Complex from = a, f_from = f(a);
  for (int i = 1; i <= pieces; ++i) {
    const Complex to = a + (b - a) * (static_cast<double>(i) / pieces), f_to = f(to);
    sum += turn(f, from, f_from, to, f_to, 30);
    from = to;
    f_from = f_to;
  }
  return sum;
}

int zeros_of(const AnalyticFunction& f, Complex low, Complex high) {
  const Complex right{high.real(), low.imag()}, left{low.real(), high.imag()};
  const double angle = turn(f, low, right, 16) + turn(f, right, high, 16) +
                       turn(f, high, left, 16) + turn(f, left, low, 16);
  return static_cast<int>(std::lround(angle / two_pi));
}

/// Newton's method from the middle; keeps the middle where it leaves the rectangle.
Complex polished(const AnalyticFunction& f, Complex low, Complex high, bool* inside) {
  const Complex middle = (low + high) / 2.0;
  const double size = std::abs(high - low);
  Complex s = middle;
  for (int i = 0; i < 50; ++i) {
    const double h = 1e-5 * size;
    const Complex slope = (f(s + h) - f(s - h)) / (2 * h);
    if (slope == Complex{}) break;
    const Complex step = f(s) / slope;
    s -= step;
    if (std::abs(s - middle) > size) break;
    if (std::abs(step) < 1e-12 * size) break;
  }
  *inside = s.real() >= low.real() && s.real() <= high.real() && s.imag() >= low.imag() &&
            s.imag() <= high.imag();
  return *inside ? s : middle;
}

void collect(const AnalyticFunction& f, Complex low, Complex high, int count, double smallest,
             std::vector<Complex>& found) {
  if (count <= 0) return;
  const Complex size = high - low;
  const bool small = std::abs(size) < smallest;
  if (count == 1 || small) {
    bool inside = false;
    Complex zero = polished(f, low, high, &inside);
    if (inside || small) {
      // On the real axis but for rounding.
      if (std::abs(zero.imag()) < 1e-6 * std::abs(size)) zero.imag(0);
      found.insert(found.end(), static_cast<std::size_t>(count), zero);
      return;
    }
  }
  // Cut the longer side, away from the middle, where symmetric functions have their real zeros.
  const double at = 0.4871;
  const bool upright = size.imag() > size.real();
  const Complex cut_high = upright ? Complex{high.real(), low.imag() + at * size.imag()}
                                   : Complex{low.real() + at * size.real(), high.imag()};
  const Complex cut_low =
      upright ? Complex{low.real(), cut_high.imag()} : Complex{cut_high.real(), low.imag()};
  const int lower = zeros_of(f, low, cut_high);
  collect(f, low, cut_high, lower, smallest, found);
  collect(f, cut_low, high, count - lower, smallest, found);
}

}  // namespace

int zeros_right_of(const AnalyticFunction& f, double real, double top, int pieces) {
  double angle = 0, imag = 0;
  Complex at = f({real, 0});
  while (imag < top) {
    const double step = std::min(std::max(1e-4, 0.05 * imag), top / pieces);
    const double next = std::min(top, imag + step);
    const Complex f_next = f({real, next});
    angle += turn(f, {real, imag}, at, {real, next}, f_next, 30);
    imag = next;
    at = f_next;
  }
  // Upwards with the region on the right: clockwise; the mirrored half turns as much.
  return static_cast<int>(std::lround(-2 * angle / two_pi));
}

std::vector<Complex> zeros_in(const AnalyticFunction& f, Complex low, Complex high) {
  std::vector<Complex> found;
  collect(f, low, high, zeros_of(f, low, high), 1e-6 * std::abs(high - low), found);
  return found;
}

}  // namespace feltgate::stability
