// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a device of several axes shows beside its joints, by name. Documentation: docs/scenes.md
#pragma once

#include <string>
#include <vector>

#include "plant/pantograph/pantograph.hpp"
#include "plant/two_levers/two_levers.hpp"

namespace feltgate {

template <class Plant>
struct DeviceSignals;

template <>
struct DeviceSignals<plant::Pantograph> {
  static std::vector<std::string> names() { return {"pen_x_m", "pen_y_m", "hand_x_n", "hand_y_n"}; }
  static void add(const plant::Pantograph& p, std::vector<double>& to) {
    const plant::PantographSeen& s = p.seen();
    to.insert(to.end(), {s.pen_m.x, s.pen_m.y, s.hand_n.x, s.hand_n.y});
  }
};

template <>
struct DeviceSignals<plant::TwoLevers> {
  static std::vector<std::string> names() { return {"hand_nm", "met_nm", "met_work_j"}; }
  static void add(const plant::TwoLevers& p, std::vector<double>& to) {
    const plant::TwoLeversSeen& s = p.seen();
    to.insert(to.end(), {s.hand_nm[0], s.hand_nm[1], s.met_work_j});
  }
};

}  // namespace feltgate
