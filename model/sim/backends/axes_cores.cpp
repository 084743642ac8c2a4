// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes back-ends of designs with several axes. Documentation: docs/architecture.md
#include "sim/backends/axes_cores.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "sim/backends/twin_axes.hpp"

namespace feltgate {

namespace {

struct Rtl {
  std::uint32_t design_crc;
  RtlAxesMaker maker;
};
std::map<std::string, Rtl>& rtl() {
  static std::map<std::string, Rtl> axes;
  return axes;
}

}  // namespace

bool add_rtl_axes(const std::string& design, std::uint32_t design_crc, RtlAxesMaker maker) {
  rtl()[design] = {design_crc, maker};
  return true;
}

std::unique_ptr<AxesCores> make_axes_cores(const std::string& name, const std::string& kind) {
  const DesignInfo& design = design_named(name);
  if (design.axes < 2 || !design.engine) {
    throw std::invalid_argument(
        fmt::format("design {} is not one of several axes; give that of the scene's device", name));
  }
  if (kind == "twin") {
    if (design.axes == 2) return std::make_unique<TwinAxes<2>>(design);
    return std::make_unique<TwinAxes<3>>(design);
  }
  const auto axes = rtl().find(design.name);
  if (kind != "lockstep" || axes == rtl().end()) {
    throw std::invalid_argument(
        fmt::format("engine \"{}\" of {} is not in this program; choose twin, or start ./feltgate "
                    "with this scene alone",
                    kind, name));
  }
  require_rtl_of(design, axes->second.design_crc);
  return axes->second.maker(design);
}

}  // namespace feltgate
