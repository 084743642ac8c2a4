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

namespace {

std::unique_ptr<Core> make(const std::string& design, const BoardOptions& options) {
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_rtl(options);
#include "designs.inc"
#undef FELTGATE_DESIGN
  throw std::invalid_argument(fmt::format("design \"{}\" is not in this program", design));
}

[[maybe_unused]] const bool provided = (provide_rtl_cores(make), true);

}  // namespace

}  // namespace feltgate::board
