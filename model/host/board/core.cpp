// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registry of the boards' cores, by design and kind. Documentation: docs/board.md
#include "host/board/core.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace feltgate::board {

#define FELTGATE_DESIGN(name) std::unique_ptr<Core> make_##name##_twin(const BoardOptions&);
#include "board_designs.inc"
#undef FELTGATE_DESIGN

namespace {

RtlCoreMaker rtl_maker = nullptr;

}  // namespace

void provide_rtl_cores(RtlCoreMaker maker) { rtl_maker = maker; }

bool has_design(const std::string& design) {
  const char* const names[] = {
#define FELTGATE_DESIGN(name) #name,
#include "board_designs.inc"
#undef FELTGATE_DESIGN
  };
  return std::find(std::begin(names), std::end(names), design) != std::end(names);
}

std::unique_ptr<Core> make_core(const std::string& design, const std::string& kind,
                                const BoardOptions& options) {
  if (kind == "rtl") {
    if (rtl_maker == nullptr) {
      throw std::invalid_argument(
          "--rtl: this program has the twin alone; ./feltgate board --rtl builds and starts the "
          "one with the RTL");
    }
    return rtl_maker(design, options);
  }
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_twin(options);
#include "board_designs.inc"
#undef FELTGATE_DESIGN
  throw std::invalid_argument(fmt::format("design \"{}\" is not in this program", design));
}

}  // namespace feltgate::board
