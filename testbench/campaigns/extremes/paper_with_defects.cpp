// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// In a program that links this file, FELTGATE_DEFECT selects the RTL of `paper`.
// Documentation: docs/testing.md
#include <Vpaper_with_defects.h>

#include "feltgate/generated/paper.hpp"
#include "sim/backends/make_backends.hpp"

namespace feltgate {
namespace {

[[maybe_unused]] const bool known = [] {
  add_design({"paper", make_design_backend<Vpaper_with_defects, Paper>, make_design_chain<Paper>,
              design_info<Paper>});
  return true;
}();

}  // namespace
}  // namespace feltgate
