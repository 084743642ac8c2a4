// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Designs as run-time information. Documentation: docs/designs.md
#include "design/info.hpp"

#include <set>
#include <string>
#include <utility>

#include "design/generate_cfg.hpp"

namespace feltgate::design {

namespace {

/// A text that lives as long as the program: a design may be gone when its parameters are read.
const char* kept(const std::string& text) {
  static std::set<std::string> all;
  return all.insert(text).first->c_str();
}

}  // namespace

DesignInfo info_of(const Elaborated& e) {
  std::vector<ParameterInfo> parameters;
  for (const Word& w : e.words) {
    parameters.push_back({kept(w.parameter.name), kept(w.parameter.unit), w.parameter.address,
                          w.format, w.si, w.raw, w.field()});
  }
  const Design& d = e.design;
  return design_info(d.name, as_data(e), std::move(parameters),
                     {d.count_rad(), d.exact_gain ? d.velocity_gain_rad_s() : 0, d.full_duty_v()});
}

}  // namespace feltgate::design
