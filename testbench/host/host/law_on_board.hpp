// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board with an engine in this process, the host's library on its wire, and laws for it.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "board_in_process.hpp"
#include "design/law_target.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "host/capture.hpp"
#include "host/law_engine.hpp"
#include "law/compile.hpp"

namespace feltgate::test {

using host::LawEngine;

template <class D>
const design::Elaborated& design_of() {
  static const host::KnownDesign known = host::read_known_design(
      FELTGATE_ROOT, std::string(FELTGATE_ROOT "/rtl/designs/") + D::name + ".toml");
  return known.design;
}

inline law::Image compiled(const std::string& text, const std::string& name = "test") {
  return law::compile_text(text, name, design::law_target(design_of<LeverLaw>())).image;
}

inline const law::Image& spring() {
  static const law::Image image = compiled(
      "param stiffness = 0.25 Nm/rad in 0 .. 1 Nm/rad\n"
      "param rest = 0 rad in -1 .. 1 rad\n"
      "event beyond(position) when position > 0.01\n"
      "event below(velocity) when position < -0.01\n"
      "out torque = -stiffness * (position - rest)\n",
      "spring");
  return image;
}
inline const law::Image& damper() {
  static const law::Image image = compiled(
      "param damping = 0.01 Nm s/rad in 0 .. 0.1 Nm s/rad\n"
      "out torque = -damping * velocity\n",
      "damper");
  return image;
}

template <class D>
struct OnWire {
  std::unique_ptr<BoardInProcess<D>> wire = std::make_unique<BoardInProcess<D>>();
  host::Link link{*wire};
  host::Device device{link, host::read_board(link), design_of<D>()};
};
struct OnBoard : OnWire<LeverLaw> {
  LawEngine engine{device};

  void arm() {
    device.set("self_test_pulse", 0);
    device.set("watchdog_ticks", 100000000);
    device.arm("law", false);
  }
  bool armed() { return wire->board.out().core.armed; }
  double torque() {
    return std::ldexp(wire->board.out().core.tau_ref, -LeverLaw::f.torque.fraction);
  }
  /// Runs until a ramp has ended.
  void settle() { wire->run(10'000 * std::int64_t{LeverLaw::clocks_per_tick}); }
};

inline std::string told(const std::function<void()>& run) {
  try {
    run();
    return "nothing";
  } catch (const std::exception& e) {
    return e.what();
  }
}

constexpr double count_rad = 2 * 3.14159265358979 / 4096;

}  // namespace feltgate::test
