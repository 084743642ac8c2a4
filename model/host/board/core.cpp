// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes the chip of a simulated board. Documentation: docs/host.md
#include "host/board/core.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "host/board/pin_twin.hpp"

namespace feltgate::board {

namespace {

struct Rtl {
  std::uint32_t design_crc;
  RtlCoreMaker maker;
};
std::map<std::string, Rtl>& rtl() {
  static std::map<std::string, Rtl> boards;
  return boards;
}

std::unique_ptr<Core> twin(const DesignInfo& design, const BoardOptions& options) {
  if (design.axes == 3) return std::make_unique<PinTwin<3, true>>(design, options);
  if (design.axes == 2) return std::make_unique<PinTwin<2, true>>(design, options);
  if (design.engine) return std::make_unique<PinTwin<1, true>>(design, options);
  return std::make_unique<PinTwin<1, false>>(design, options);
}

}  // namespace

bool add_rtl_core(const std::string& design, std::uint32_t design_crc, RtlCoreMaker maker) {
  rtl()[design] = {design_crc, maker};
  return true;
}

std::unique_ptr<Core> make_core(const std::string& name, const std::string& kind,
                                const BoardOptions& options) {
  const DesignInfo& design = design_named(name);
  if (kind == "twin") return twin(design, options);
  const auto board = rtl().find(design.name);
  if (board == rtl().end()) {
    throw std::invalid_argument(fmt::format(
        "design {0}: its board as rtl is not in this program; ./feltgate board --design "
        "{0} --rtl builds it",
        name));
  }
  require_rtl_of(design, board->second.design_crc);
  return board->second.maker(design, options);
}

}  // namespace feltgate::board
