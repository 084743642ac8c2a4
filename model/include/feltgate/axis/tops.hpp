// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twins of the shipped designs' tops: which sockets each has. docs/architecture.md
#pragma once

#include "feltgate/axis/absolute.hpp"
#include "feltgate/axis/h_bridge.hpp"
#include "feltgate/axis/h_bridge_current.hpp"
#include "feltgate/axis/quadrature.hpp"
#include "feltgate/axis/quadrature_hall.hpp"
#include "feltgate/axis/three_phase.hpp"
#include "feltgate/axis/three_phase_current.hpp"
#include "feltgate/axis/top.hpp"

namespace feltgate::axis {

using LeverTop = Top<Quadrature, HBridge>;
using LeverAbsoluteTop = Top<Absolute, HBridge>;
using LeverCurrentTop = Top<Quadrature, HBridgeCurrent>;
using HallMotorTop = Top<QuadratureHall, ThreePhase>;
using GimbalMotorTop = Top<Absolute, ThreePhase>;
using GimbalCurrentTop = Top<Absolute, ThreePhaseCurrent>;

}  // namespace feltgate::axis
