// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registers the Verilated board; linked into the program that has it. Documentation: docs/board.md
#include <fmt/format.h>

#include <stdexcept>

#include "host/board/core.hpp"

namespace feltgate::board {

/// Only one design, since each takes a minute to compile.
std::unique_ptr<Core> make_lever_rtl(const BoardOptions&);

namespace {

std::unique_ptr<Core> make(const std::string& design, const BoardOptions& options) {
  if (design == "lever") return make_lever_rtl(options);
  throw std::invalid_argument(fmt::format(
      "--rtl: built of the design lever alone; leave --rtl out, and the twin runs {}", design));
}

[[maybe_unused]] const bool provided = (provide_rtl_cores(make), true);

}  // namespace

}  // namespace feltgate::board
