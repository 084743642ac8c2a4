// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registers the Verilated cores of boards; linked into the program that has them. Documentation:
// docs/board.md
#include <fmt/format.h>

#include <stdexcept>

#include "board/core.hpp"

namespace feltgate::board {

#define FELTGATE_DESIGN(name) std::unique_ptr<Core> make_##name##_rtl(const BoardOptions&);
#include "designs.inc"
#undef FELTGATE_DESIGN

/// Of one design alone: each costs a minute to compile.
std::unique_ptr<Core> make_lever_pin_rtl(const BoardOptions&);

namespace {

std::unique_ptr<Core> make(const std::string& design, const BoardOptions& options) {
  if (options.pins) {
    if (design == "lever") return make_lever_pin_rtl(options);
    throw std::invalid_argument(
        "--rtl --pins: in this program of the design lever alone; take the twin for others");
  }
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_rtl(options);
#include "designs.inc"
#undef FELTGATE_DESIGN
  throw std::invalid_argument(fmt::format("design \"{}\" is not in this program", design));
}

[[maybe_unused]] const bool provided = (provide_rtl_cores(make), true);

}  // namespace

}  // namespace feltgate::board
