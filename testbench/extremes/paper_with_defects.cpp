// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// In the program that links this, the RTL of `paper` is the one that FELTGATE_DEFECT names.
// Documentation: docs/testing.md
#include <Vpaper_with_defects.h>

#include "engines/make_engines.hpp"
#include "feltgate/generated/paper.hpp"

namespace feltgate {
namespace {

[[maybe_unused]] const bool known = [] {
  add_design({"paper", make_design_engine<Vpaper_with_defects, Paper>, make_design_chain<Paper>,
              design_info<Paper>});
  return true;
}();

}  // namespace
}  // namespace feltgate
