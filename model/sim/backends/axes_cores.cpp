// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registry of designs with several axes. Documentation: docs/architecture.md
#include "sim/backends/axes_cores.hpp"

namespace feltgate {

namespace {

std::vector<AxesDesignMakers>& all() {
  static std::vector<AxesDesignMakers> list;
  return list;
}

}  // namespace

void add_axes_design(const AxesDesignMakers& design) { all().push_back(design); }

const AxesDesignMakers* find_axes_design(const std::string& design) {
  for (const AxesDesignMakers& d : all()) {
    if (d.name != design) continue;
    check_design(d.info());
    return &d;
  }
  return nullptr;
}

}  // namespace feltgate
