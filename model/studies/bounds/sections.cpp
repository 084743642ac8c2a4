// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Worst-case peak gains. Documentation: docs/error-bounds.md
#include "studies/bounds/sections.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "studies/bounds/error_bounds.hpp"

namespace feltgate::bounds {

namespace {

/// Around e.
const Interval euler(2.718281828459045, 2.718281828459046);

}  // namespace

Interval one_pole_gain(const Interval& pole) {
  if (magnitude(pole) >= 1.0) return {endless, endless};
  return Interval(1.0) / (Interval(1.0) - boost::numeric::abs(pole));
}

double lowpass_change_gain(const Interval& p, const Interval& q) {
  const double least = std::min(p.lower(), q.lower());
  if (least <= 0.0) return endless;
  if (least >= 1.0) return 0.0;
  // The terms change sign once and sum to 0, so the sum of magnitudes is twice the largest partial
  // sum, |(1-p)^K - (1-q)^K| <= |p-q| * K*x^(K-1) with 1-x between p and q; over all K that is
  // below 1/(e*(1-x)*x), which is largest for the smaller of the two.
  const Interval slow(least);
  const Interval gain =
      Interval(2.0) * boost::numeric::abs(p - q) / (euler * slow * (Interval(1.0) - slow));
  return std::min(2.0, gain.upper());
}

double high_passed_gain(const Interval& p, const Interval& q) {
  if (p.upper() < 0.0 || magnitude(p) >= 1.0 || magnitude(q) >= 1.0) return endless;
  constexpr long most_terms = 4'000'000;
  constexpr double loose = 1e-6;
  const Interval a = Interval(1.0) - p;
  const Interval memory = one_pole_gain(q);
  Interval power(1.0), h(1.0), sum(1.0);  // p^k, h_k, sum of |h|
  Interval tail(endless);
  for (long k = 1; k <= most_terms; ++k) {
    h = q * h - a * power;
    power *= p;
    sum += boost::numeric::abs(h);
    if (k % 1024 != 0) continue;
    // What is still to come of the source, sum of a*p^j from j = k on, is p^k.
    tail = (boost::numeric::abs(q * h) + power) * memory;
    if (tail.upper() < loose * sum.upper()) break;
  }
  return (sum + tail).upper();
}

// Error bounds as fields and as text.

std::vector<std::pair<std::string, double>> bound_fields(const ErrorBounds& b) {
  return {{"bound_velocity_rad_s", b.velocity_rad_s.against_reference},
          {"bound_tau_hat_nm", b.tau_hat_nm.against_reference},
          {"bound_tau_ref_nm", b.tau_ref_nm.against_reference},
          {"bound_current_a", b.current_a.against_reference},
          {"bound_torque_nm", b.torque_nm.against_reference}};
}

std::string bound_table(const ErrorBounds& b) {
  std::string out;
  const auto add = [&](const char* format, const auto&... values) {
    out += fmt::format(fmt::runtime(format), values...);
  };
  const bool one_scene = !b.region.scene.empty();
  add("proven bounds on |core - real|, velocity up to {:.6g} rad/s, {}\n", b.region.velocity_rad_s,
      one_scene ? b.region.scene.c_str() : "any scene");
  add("{:<22} {:>18} {:>18} {:>18}\n", "", "core's own", "exact", "exact, and gain");
  add("{:<22} {:>18} {:>18} {:>18}\n", "against coefficients", "coefficients", "coefficients",
      "2 pi/(Er Tp m1)");
  const auto row = [&](const char* name, const ErrorBound& e) {
    add("{:<22} {:18.4g} {:18.4g} {:18.4g}\n", name, e.against_quantised, e.against_reference,
        e.against_exact);
  };
  row("velocity, rad/s", b.velocity_rad_s);
  row("tau_hat, Nm", b.tau_hat_nm);
  row("tau_ref, Nm", b.tau_ref_nm);
  row("current reference, A", b.current_a);
  row("torque Ktn*I, Nm", b.torque_nm);
  row("tau_hat, no limit, Nm", b.unlimited_tau_hat_nm);
  row("current, no limit, A", b.unlimited_current_a);
  add("nothing saturates while |velocity| <= {:.6g} rad/s ({} counts in m1 ticks),\n",
      b.free.velocity_rad_s, b.free.counts_per_window);
  add("|position| <= {:.0f} counts; tau_hat cannot below {:.6g} rad/s whatever the motion,\n",
      b.free.position_counts, b.free.tau_hat_rad_s);
  if (b.free.current_rad_s > 0) {
    add("and the current limit cannot act below {:.6g} rad/s\n", b.free.current_rad_s);
  } else {
    out += "and the current limit may act; the bounds hold with it, except those of \"no limit\"\n";
  }
  return out;
}

std::string source_table(const std::vector<SourceBound>& sources) {
  const auto row = [](const auto& name, const auto&... values) {
    return fmt::format("{:<17}", name) + (fmt::format(" {:>15}", values) + ...) + "\n";
  };
  const auto number = [](double x) { return std::isfinite(x) ? fmt::format("{:.3g}", x) : "none"; };
  std::string out =
      row("bound, by source", "velocity rad/s", "tau_hat Nm", "tau_ref Nm", "current A");
  for (const SourceBound& s : sources) {
    out += row(s.name == "gain" ? "2^n (not in it)" : s.name, number(s.velocity_rad_s),
               number(s.tau_hat_nm), number(s.tau_ref_nm), number(s.current_a));
  }
  return out;
}

}  // namespace feltgate::bounds
