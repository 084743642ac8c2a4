// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The bounds, put together from the gains of the sections; letters as in docs/error-bounds.md.
#include "studies/bounds/error_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "studies/bounds/sections.hpp"

namespace feltgate::bounds {

namespace detail {

Pair pair_of(const Number& n, Level level) {
  const Interval used(n.used());
  const Interval exact(n.si);
  if (level == Level::gain) return {exact, exact};
  return {used, level == Level::quantised ? used : exact};
}

Interval rounding_error(const ChainNumbers& c, Format f) {
  const double step = std::ldexp(1.0, -f.fraction);
  return c.rounding == Round::truncate ? Interval(-step, 0.0) : Interval(-step / 2, step / 2);
}

Interval truncation_error(int fraction, Format f) {
  return fraction > f.fraction ? Interval(-std::ldexp(1.0, -f.fraction), 0.0) : Interval(0.0);
}

}  // namespace detail

namespace {

using boost::numeric::abs;
using detail::Level;
using detail::Pair;
using detail::Rounding;

Interval from_above(double x) { return Interval(x); }

/// Cache of high-pass gains; computing one takes some milliseconds.
class Gains {
 public:
  Interval operator()(const Interval& p, const Interval& q) {
    const auto key = std::pair{p.lower(), q.lower()};
    const auto it = known_.find(key);
    if (it != known_.end()) return from_above(it->second);
    return from_above(known_[key] = high_passed_gain(p, q));
  }

 private:
  std::map<std::pair<double, double>, double> known_;
};

/// Bounds of all signals against one reference.
struct Parts {
  double velocity = 0, tau_hat = 0, tau_ref = 0, current = 0;
  double unlimited_tau_hat = 0, unlimited_current = 0;
  double observed_gain = 0, observed_offset = 0;  ///< |tau_hat of the reference| <= gain*V + offset
};

class Chain {
 public:
  Chain(const ChainNumbers& c, const InputRegion& region, Level level, Rounding rounds,
        Gains* gains)
      : c_(c),
        region_(region),
        level_(level),
        rounds_(rounds),
        gains_(*gains),
        a_(of("velocity_a1")),
        g_(of("inertia_gain")),
        k_(of("torque_constant")),
        alpha_(of("observer_a1")),
        limit_(of("current_limit")) {
    const double gain = level == Level::quantised   ? c.used_gain
                        : level == Level::reference ? c.reference_gain
                                                    : c.exact_gain;
    // 2*pi has no double: one step on either side.
    real_gain_ =
        gain == c.exact_gain ? Interval(Outward::down(gain), Outward::up(gain)) : Interval(gain);
    used_gain_ = Interval(level == Level::gain ? c.reference_gain : c.used_gain);
    counts_ = Interval(region.velocity_rad_s) / Interval(c.used_gain);
    real_velocity_ = from_above((counts_ * real_gain_).upper());
  }

  Parts parts() {
    Parts p;
    p.velocity = velocity().upper();
    velocity_error_ = from_above(p.velocity);
    p.tau_ref = detail::scene_error(c_, region_, level_, rounds_.scenes, p.velocity,
                                    real_velocity_.upper());
    const Interval one(1.0);
    const Interval observed_gain =
        g_.real * (one - alpha_.real) * a_.real * gains_(one - a_.real, one - alpha_.real);
    observed_ = observed_gain * real_velocity_ + k_.real * limit_.real;
    p.observed_gain = (observed_gain * real_gain_ / Interval(c_.used_gain)).upper();
    p.observed_offset = (k_.real * limit_.real).upper();
    through_limit(p);
    unlimited(p);
    return p;
  }

 private:
  Pair of(const char* name) const { return detail::pair_of(c_.at(name), level_); }
  int fraction_of(const char* name) const { return c_.at(name).format.fraction; }

  /// The error of rounding or truncation if the block rounds, otherwise 0.
  static Interval only(bool rounds, const Interval& error) {
    return rounds ? error : Interval(0.0);
  }

  /// Error of the raw velocity (counts times gain, truncated) against the reference's.
  Interval raw_error() const {
    const Interval dropped = c_.quantised_gain
                                 ? detail::truncation_error(c_.gain_fraction, c_.formats.velocity)
                                 : Interval(0.0);
    return dropped + within(abs(used_gain_ - real_gain_) * counts_);
  }
  /// Error that one tick of a low-pass adds to its state: rounding, and the operand's dropped bits.
  Interval filter_error(bool rounds, const Interval& a, Format state, Format operand) const {
    return only(rounds, detail::rounding_error(c_, state) +
                            a * detail::truncation_error(state.fraction, operand));
  }
  Interval velocity_filter() const {
    return filter_error(rounds_.velocity_n, a_.used, c_.formats.velocity,
                        c_.formats.velocity_difference);
  }
  Interval tau_hat_rounding() const {
    return from_above(magnitude(only(rounds_.dob, detail::rounding_error(c_, c_.formats.torque))));
  }

  Interval velocity() {
    const Interval error = velocity_filter() * one_pole_gain(Interval(1.0) - a_.used) + raw_error();
    Interval sum = from_above(magnitude(error));
    if (a_.change().upper() > 0) {
      sum += from_above(lowpass_change_gain(a_.used, a_.real)) * real_velocity_;
    }
    return sum;
  }

  /// Part of the inertia torque's error that remains in tau_hat, for the observer's pole rho.
  Interval inertia_error(const Interval& rho) {
    const Interval one(1.0);
    const Interval rest = one - alpha_.used;
    const Interval source = velocity_filter() + a_.used * raw_error() +
                            within(a_.change() * Interval(2.0) * real_velocity_);
    const Interval centre = from_above(std::abs(boost::numeric::median(source)));
    const Interval radius = from_above(boost::numeric::width(source) / 2);
    const Interval variation = gains_(one - a_.used, rho);
    const Interval by_velocity = g_.used * rest * variation * (radius + centre / Interval(2.0));
    const Interval dropped =
        only(rounds_.dob,
             detail::truncation_error(c_.formats.velocity.fraction + fraction_of("inertia_gain"),
                                      c_.formats.inertia_torque));
    const Interval by_gain =
        g_.change() * rest * a_.real * gains_(one - a_.real, rho) * real_velocity_;
    return by_velocity + rest * from_above(boost::numeric::width(dropped)) + by_gain;
  }
  /// Error that the observer's filter adds per tick.
  Interval observer_filter() const {
    return filter_error(rounds_.dob, alpha_.used, c_.formats.observer,
                        c_.formats.observer_difference);
  }
  Interval drive_dropped() const {
    return detail::truncation_error(c_.formats.current.fraction + fraction_of("torque_constant"),
                                    c_.formats.drive_torque);
  }
  /// The inertia torque's part of (observer input - state), per unit of velocity.
  Interval inertia_step() {
    const Interval one(1.0);
    return g_.real * a_.real * gains_(one - a_.real, one - alpha_.real);
  }

  /// Everything in the current before its limit except what tau_hat's error does.
  Interval current_sources(const Interval& tau_ref, Interval* feedback) const {
    const int fraction = c_.formats.torque.fraction;
    *feedback = Interval(0.0);
    if (region_.mode == 2) {
      const Pair by = of("voltage_to_current");
      const double half =
          level_ == Level::quantised ? 0.0 : std::ldexp(0.5, -c_.formats.voltage.fraction);
      const Interval dropped = detail::truncation_error(
          c_.formats.voltage.fraction + fraction_of("voltage_to_current"), c_.formats.current);
      // The ramped set-point, or an end of the window around the back-EMF: no step grows either.
      const Pair ke = of("emf_constant");
      const Interval end =
          ke.used * velocity_error_ + ke.change() * real_velocity_ + of("voltage_window").change() +
          from_above(magnitude(only(
              rounds_.torque_control,
              detail::truncation_error(c_.formats.velocity.fraction + fraction_of("emf_constant"),
                                       c_.formats.voltage))));
      return by.used * Interval(std::max(half, end.upper())) +
             by.change() * Interval(std::ldexp(1.0, c_.formats.voltage.integer)) +
             from_above(magnitude(only(rounds_.torque_control, dropped)));
    }
    const Pair gain = of("torque_gain");
    const Pair limit = of("torque_limit");
    Interval dropped =
        detail::truncation_error(fraction + fraction_of("torque_gain"), c_.formats.current);
    Interval sum = gain.used * tau_ref + gain.change() * limit.real;
    const Pair back = of("observer_gain");
    if (region_.mode == 0 && (back.used.lower() != 0 || back.real.lower() != 0)) {
      *feedback = abs(back.used);
      sum += back.change() * observed_;
      dropped +=
          detail::truncation_error(fraction + fraction_of("observer_gain"), c_.formats.current);
    }
    return sum + from_above(magnitude(only(rounds_.torque_control, dropped)));
  }

  /// Bounds with the current limit, which never increases a difference: a loop of gain K*Og < 1.
  void through_limit(Parts& p) {
    const Interval one(1.0);
    Interval back;
    const Interval sources = current_sources(from_above(p.tau_ref), &back);
    const Interval own = observer_filter() / alpha_.used + drive_dropped();
    Interval open =
        inertia_error(one - alpha_.used) + from_above(magnitude(own)) + k_.change() * limit_.real;
    if (alpha_.change().upper() > 0) {
      open += from_above(lowpass_change_gain(alpha_.used, alpha_.real)) * k_.real * limit_.real +
              alpha_.change() / alpha_.used * inertia_step() * real_velocity_;
    }
    const Interval rounding = tau_hat_rounding();
    const Interval loop = one - k_.used * back;
    if (loop.lower() <= 0) {
      p.tau_hat = p.current = endless;
      return;
    }
    // The limits differ by their quantisation; that difference comes back as a current.
    const Interval limits = limit_.change();
    const Interval observed =
        (open + k_.used * (sources + back * rounding + limits)) / loop + rounding;
    p.tau_hat = observed.upper();
    p.current = std::max((sources + back * observed).upper(), limits.upper());
  }

  /// Bounds of the closed loop while the limit does not act: one pole, 1 - alpha*(1 - K*Og).
  void unlimited(Parts& p) {
    const Interval one(1.0);
    Interval back;
    const Interval sources = current_sources(from_above(p.tau_ref), &back);
    const Interval signed_back = back.upper() > 0 ? of("observer_gain").used : Interval(0.0);
    const Interval rho = one - alpha_.used * (one - k_.used * signed_back);
    if (rho.lower() < 0 || rho.upper() >= 1) {
      p.unlimited_tau_hat = p.unlimited_current = endless;
      return;
    }
    const Interval rounding = tau_hat_rounding();
    Interval per_tick =
        from_above(magnitude(observer_filter() + alpha_.used * drive_dropped())) +
        alpha_.used * (k_.used * (sources + back * rounding) + k_.change() * limit_.real);
    if (alpha_.change().upper() > 0) {
      per_tick += alpha_.change() *
                  (Interval(2.0) * k_.real * limit_.real + inertia_step() * real_velocity_);
    }
    const Interval observed = inertia_error(rho) + per_tick / (one - rho) + rounding;
    p.unlimited_tau_hat = observed.upper();
    p.unlimited_current = (sources + back * observed).upper();
  }

  const ChainNumbers& c_;
  const InputRegion& region_;
  Level level_;
  Rounding rounds_;
  Gains& gains_;
  Pair a_, g_, k_, alpha_, limit_;
  Interval used_gain_, real_gain_, counts_, real_velocity_, observed_, velocity_error_;
};

SaturationFree saturation_free(const ChainNumbers& c) {
  SaturationFree s;
  const Format v = c.formats.velocity;
  const double largest = std::ldexp(1.0, v.integer) - std::ldexp(1.0, -v.fraction);
  const double counts = std::floor((Interval(largest) / Interval(c.used_gain)).lower());
  s.counts_per_window =
      static_cast<int>(std::min(counts, std::ldexp(1.0, c.formats.travel_difference.integer) - 1));
  s.velocity_rad_s = s.counts_per_window * c.used_gain;
  s.position_counts = std::ldexp(1.0, c.formats.scene_position.integer) - 1;
  return s;
}

/// The velocities up to which neither tau_hat nor the current can reach their limits.
void fill_torques(const ChainNumbers& c, const InputRegion& region, const Parts& p,
                  SaturationFree* s) {
  const auto up_to = [&](double room) {
    const double v = p.observed_gain > 0 ? room / p.observed_gain : endless;
    return std::clamp(v, 0.0, s->velocity_rad_s);
  };
  const Format t = c.formats.torque;
  s->tau_hat_rad_s = up_to(std::ldexp(1.0, t.integer) - std::ldexp(2.0, -t.fraction) -
                           p.observed_offset - p.tau_hat);
  const double back = std::abs(c.at("observer_gain").used());
  const double limit = c.at("current_limit").used();
  const double by_ref = c.at("torque_gain").used() * c.at("torque_limit").used() + p.current;
  if (region.mode == 2) return;
  if (back == 0 || region.mode == 1) {
    s->current_rad_s = by_ref <= limit ? s->velocity_rad_s : 0.0;
  } else {
    s->current_rad_s = up_to((limit - by_ref) / back - p.observed_offset);
  }
}

/// Replaces a tiny bound by 0: outward rounding makes the 0 of an absent source slightly positive.
double shown(double bound) { return bound < 1e-200 ? 0.0 : bound; }

/// The region with its velocity filled in, at most the largest one that the format holds.
InputRegion filled(InputRegion region, const SaturationFree& free) {
  if (region.velocity_rad_s <= 0 || region.velocity_rad_s > free.velocity_rad_s) {
    region.velocity_rad_s = free.velocity_rad_s;
  }
  return region;
}

}  // namespace

ErrorBounds error_bounds(const ChainNumbers& numbers, const InputRegion& asked) {
  ErrorBounds b;
  b.free = saturation_free(numbers);
  b.region = filled(asked, b.free);
  Gains gains;
  const auto at = [&](Level level) {
    return Chain(numbers, b.region, level, Rounding{}, &gains).parts();
  };
  const Parts q = at(Level::quantised), r = at(Level::reference), x = at(Level::exact);
  fill_torques(numbers, b.region, q, &b.free);
  const auto bound = [&](double Parts::*m) { return ErrorBound{q.*m, r.*m, x.*m}; };
  b.velocity_rad_s = bound(&Parts::velocity);
  b.tau_hat_nm = bound(&Parts::tau_hat);
  b.tau_ref_nm = bound(&Parts::tau_ref);
  b.current_a = bound(&Parts::current);
  b.unlimited_tau_hat_nm = bound(&Parts::unlimited_tau_hat);
  b.unlimited_current_a = bound(&Parts::unlimited_current);
  const Interval ktn(numbers.at("torque_constant").si);
  const auto torque = [&](double current) { return (ktn * Interval(current)).upper(); };
  b.torque_nm = {torque(q.current), torque(r.current), torque(x.current)};
  return b;
}

std::vector<SourceBound> source_bounds(const ChainNumbers& numbers, const InputRegion& asked) {
  const InputRegion region = filled(asked, saturation_free(numbers));
  constexpr Rounding none{false, false, false, false};
  const struct {
    const char* name;
    Level level;
    Rounding rounds;
  } sources[] = {{"velocity_n", Level::quantised, {true, false, false, false}},
                 {"dob", Level::quantised, {false, true, false, false}},
                 {"scenes", Level::quantised, {false, false, true, false}},
                 {"torque_control", Level::quantised, {false, false, false, true}},
                 {"coefficients", Level::reference, none},
                 {"gain", Level::gain, none}};
  Gains gains;
  std::vector<SourceBound> out;
  for (const auto& s : sources) {
    const Parts p = Chain(numbers, region, s.level, s.rounds, &gains).parts();
    out.push_back(
        {s.name, shown(p.velocity), shown(p.tau_hat), shown(p.tau_ref), shown(p.current)});
  }
  return out;
}

ErrorBounds error_bounds(const design::Elaborated& e, const InputRegion& region) {
  return error_bounds(chain_numbers(e), region);
}

// Extracts the numbers of a design for an error bound.

double Number::used() const { return std::ldexp(static_cast<double>(raw), -format.fraction); }

const Number& ChainNumbers::at(const std::string& name) const {
  for (const Number& n : numbers) {
    if (n.name == name) return n;
  }
  throw std::out_of_range("the design has no parameter " + name);
}

void ChainNumbers::set(const std::string& name, double value) {
  (void)at(name);
  for (Number& n : numbers) {
    if (n.name != name) continue;
    n.si = value;
    n.raw = std::llround(std::ldexp(value, n.format.fraction));
  }
}

bool ChainNumbers::built(const std::string& scene) const {
  return std::find(scenes.begin(), scenes.end(), scene) != scenes.end();
}

ChainNumbers chain_numbers(const design::Elaborated& e) {
  e.design.needs_n_method("the error bound");
  ChainNumbers c;
  c.design = e.design.name;
  c.formats = e.formats;
  c.rounding = e.design.rounding;
  c.used_gain = e.rad_s_per_count();
  c.exact_gain = e.design.velocity_gain_rad_s();
  c.quantised_gain = e.velocity_gain != 0;
  c.reference_gain = c.quantised_gain ? c.exact_gain : c.used_gain;
  c.gain_fraction = e.base.velocity_gain.fraction;
  for (const design::Word& w : e.words) {
    c.numbers.push_back({w.parameter.name, w.format, w.si, w.raw});
  }
  c.scenes = e.design.scenes;
  return c;
}

}  // namespace feltgate::bounds
