// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Engines of several axes. Documentation: docs/devices.md
#include "axes_loop/axes_engines.hpp"

#include <stdexcept>

#include "loop/engine_choice.hpp"

namespace feltgate {

AxesEngines choose_axes_engines(const std::string& engines) {
  const EngineChoice all = choose_engines(engines);
  if (all.rider_drives) {
    throw std::invalid_argument("--engine " + engines +
                                ": the motors of several axes are driven by the core; add twin or "
                                "rtl");
  }
  AxesEngines c{all.lead == "twin" ? "twin" : "lockstep", {}, {}};
  for (const std::string& rider : all.riders) {
    if (rider == "float" && engines == "all") continue;
    if (rider == "float") {
      throw std::invalid_argument(
          "--engine float: beside several axes runs the law in double and quad; choose these");
    }
    c.riders.push_back(rider);
    if (c.reference != "quad") c.reference = rider;
  }
  return c;
}

}  // namespace feltgate
