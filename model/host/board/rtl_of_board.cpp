// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Adds the Verilated board of a design to the boards' cores; compiled once for each of them by
// scripts/cmake/board.cmake. Documentation: docs/host.md
#include FELTGATE_RTL_HEADER
#include FELTGATE_DESIGN_HEADER
#include "host/board/pin_rtl.hpp"

namespace feltgate::board {
namespace {

/// Linked is known: before main().
[[maybe_unused]] const bool known = add_rtl_core(
    FELTGATE_DESIGN::name, FELTGATE_DESIGN::design_crc,
    [](const DesignInfo& design, const BoardOptions& options) -> std::unique_ptr<Core> {
      return std::make_unique<PinRtl<FELTGATE_RTL>>(design, options);
    });

}  // namespace
}  // namespace feltgate::board
