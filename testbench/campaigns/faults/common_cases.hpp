// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the cases of several designs have in common; and a sensor that is plugged in after the
// request to arm: nobody asks again, so no gate may open.
// Documentation: docs/testing.md
#pragma once

#include <fmt/format.h>

#include "campaigns/faults/option_rig.hpp"
#include "campaigns/faults/pin_faults.hpp"

namespace feltgate::faults {

inline double share(test::Random* r) { return 1e-6 * (1 + static_cast<double>(r->below(999998))); }
inline double sign(test::Random* r) { return r->coin() ? 1 : -1; }

/// A torque of 0.3 to 1 of the limit, and a hand that moves up to so fast.
inline Case asked(test::Random* r, double limit_nm, double most_rad_s, double least_rad_s = 0) {
  Case c;
  c.torque_nm = sign(r) * limit_nm * (0.3 + 0.7 * share(r));
  c.rad_s = sign(r) * (least_rad_s + (most_rad_s - least_rad_s) * share(r));
  c.from_rad = share(r);
  return c;
}

/// The last kind of each design, so that the others keep their seeds.
inline constexpr PinKind late_sensor{
    "late sensor", "pins", "none until 0.1 to 30 ms after the request to arm", 1, Promise::refused};

/// One of the sensors of design D.
template <class D>
Case late_case(test::Random* r) {
  Case c = asked(r, Rig<D>::info().find("torque_limit")->si, 0);
  Harm& h = c.harm;
  if (D::current_loop != 0 && (D::absolute_encoder == 0 || r->coin())) {
    h.modulator = r->coin() ? Harm::Line::low : Harm::Line::high;
    h.shunts = D::phases == 3 ? 1 + static_cast<unsigned>(r->below(2)) : 1;
  } else {
    h.sensor = AbsoluteSensor::Defect::cut;
    h.hall_high = 7;
  }
  h.late_s = 1e-4 + 0.03 * share(r);
  c.seconds = h.late_s + 0.013;  // the offset of a current takes 512 PWM periods
  c.what = fmt::format("{:.1f} ms, ", 1e3 * h.late_s);
  return c;
}

}  // namespace feltgate::faults
