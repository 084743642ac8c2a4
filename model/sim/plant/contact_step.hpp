// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A Runge-Kutta step that is split where an angle meets or leaves a stop.
// docs/devices/pantograph.md
#pragma once

#include <cmath>

#include "angle_stops.hpp"

namespace feltgate::plant {

/// The classic step of fourth order. `rate(state)` gives the rates of all parts as a state;
/// `add(state, k, rate)` adds k times a rate.
template <class State, class Rate>
State runge_kutta(const State& s, double dt_s, Rate&& rate) {
  const State k1 = rate(s);
  State at = s;
  add(at, 0.5 * dt_s, k1);
  const State k2 = rate(at);
  at = s;
  add(at, 0.5 * dt_s, k2);
  const State k3 = rate(at);
  at = s;
  add(at, dt_s, k3);
  const State k4 = rate(at);
  at = s;
  add(at, dt_s / 6.0, k1);
  add(at, dt_s / 3.0, k2);
  add(at, dt_s / 3.0, k3);
  add(at, dt_s / 6.0, k4);
  return at;
}

/// The time at which `beyond(state)` crosses 0 in a step of most_s, at whose end it is `at_b`;
/// regula falsi, Illinois variant.
template <class State, class Flow, class Beyond>
double cross_at(const State& s, double most_s, double at_b, Flow&& flow, Beyond&& beyond) {
  double a = 0.0, b = most_s, at_a = beyond(s), cut = 0.0;
  // A start on the border: begin instead at a point between start and end.
  for (int half = 0; half < 12 && std::abs(at_a) < AngleContact::kNear_rad; ++half) {
    a = 0.5 * (half == 0 ? b : a);
    at_a = beyond(flow(s, a));
    if (at_a * at_b < 0.0) break;
    at_a = 0.0;
  }
  for (int turn = 0; turn < 24; ++turn) {
    if (at_a * at_b >= 0.0) break;
    cut = (a * at_b - b * at_a) / (at_b - at_a);
    const double at_cut = beyond(flow(s, cut));
    if (std::abs(at_cut) < 1e-16) break;
    if (at_cut * at_b < 0.0) {
      a = b;
      at_a = at_b;
    } else {
      at_a *= 0.5;
    }
    b = cut;
    at_b = at_cut;
  }
  return cut;
}

/// Advances `s` by dt_s through the stops that limit angle(state), whose present speed is rad_s.
/// flow(state, zone, seconds) integrates inside one zone of the contact. Returns the energy that
/// the stops took, J.
template <class State, class Flow, class Angle>
double contact_step(AngleContact& contact, State& s, double dt_s, double rad_s, Flow&& flow,
                    Angle&& angle) {
  constexpr int most_cuts = 4;  // a trembling contact continues unsplit
  int zone = contact.zone(angle(s), rad_s);
  double left_s = dt_s;
  State next = flow(s, zone, left_s);
  for (int cuts = 0; cuts < most_cuts && !contact.within(zone, angle(next)); ++cuts) {
    if (std::isnan(angle(next))) break;
    const bool up = zone == 0 || (zone < 4 && angle(next) > contact.upper(zone));
    const double end = up ? contact.upper(zone) : contact.lower(zone);
    const double cut_s = cross_at(
        s, left_s, angle(next) - end,
        [&](const State& from, double t) { return flow(from, zone, t); },
        [&](const State& at) { return angle(at) - end; });
    s = flow(s, zone, cut_s);
    left_s -= cut_s;
    do zone += up ? 1 : -1;
    while (zone > 0 && zone < 4 && contact.upper(zone) <= contact.lower(zone));
    next = flow(s, zone, left_s);
  }
  s = next;
  return contact.settle(angle(s));
}

}  // namespace feltgate::plant
