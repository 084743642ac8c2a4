// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A simple hand that pushes with a constant torque. Documentation: docs/plant.md
#pragma once

#include "hand.hpp"

namespace feltgate::plant {

/// A hand that raises its torque to `torque_nm` within `ramp_s` and keeps it.
inline Hand pushing_hand(double torque_nm, double ramp_s = 0.01) {
  Segment ramp;
  ramp.kind = Segment::Kind::kRamp;
  ramp.duration_s = ramp_s;
  ramp.to = torque_nm;
  HandPhase push;
  push.kind = HandPhase::Kind::kTorque;
  push.profile = {ramp};
  Hand hand;
  hand.phases = {push};
  return hand;
}

}  // namespace feltgate::plant
