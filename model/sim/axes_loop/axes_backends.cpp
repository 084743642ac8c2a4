// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Selection of the back-ends of several axes. Documentation: docs/devices.md
#include "sim/axes_loop/axes_backends.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace feltgate {

BackendChoice choose_axes_backends(const std::string& engines) {
  const BackendChoice all = choose_backends(engines);
  if (all.rider_drives) {
    throw std::invalid_argument("--engine " + engines +
                                ": the motors of several axes are driven by the core; add twin or "
                                "rtl");
  }
  BackendChoice c{all.lead == "twin" ? "twin" : "lockstep", {}, false};
  for (const std::string& rider : all.riders) {
    if (rider == "float" && engines == "all") continue;
    if (rider == "float") {
      throw std::invalid_argument(
          "--engine float: beside several axes runs the law in double and quad; choose these");
    }
    c.riders.push_back(rider);
  }
  return c;
}

std::unique_ptr<AxesCores> make_axes_cores(const std::string& design, const std::string& lead,
                                           const std::string& device, std::size_t axes) {
  const AxesDesignMakers* d = find_axes_design(design);
  if (d == nullptr) {
    throw std::invalid_argument(fmt::format(
        "design {} is not one of {} axes that this program has; ./feltgate builds it with "
        "--design {}_law",
        design, axes, device));
  }
  auto made = d->cores(lead);
  if (made->axes() != static_cast<int>(axes)) {
    throw std::invalid_argument(
        fmt::format("design {} has {} axes and the device {}; take one with as many", design,
                    made->axes(), axes));
  }
  return made;
}

}  // namespace feltgate
