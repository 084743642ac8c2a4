// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design `wide`: its Verilated core and its twin. Documentation: docs/extremes.md
#include <Vextremes_wide.h>

#include "campaigns/extremes/closed_loop.hpp"
#include "sim/backends/make_backends.hpp"
#include "wide.hpp"

namespace feltgate::extremes {

void use_wide_design() {
  add_design({"wide", make_design_backend<Vextremes_wide, Wide>, make_design_chain<Wide>,
              design_info<Wide>});
}

}  // namespace feltgate::extremes
