// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shapes as laws, for tests. Documentation: docs/devices/shapes.md
#pragma once

#include <string>

#include "law/compile.hpp"
#include "law/read_law.hpp"
#include "studies/shape/pen_force.hpp"
#include "studies/shape/shape_law.hpp"

namespace feltgate::shape {

inline std::string vector_file(const std::string& name) {
  return std::string(FELTGATE_ROOT) + "/vectors/shapes/" + name + ".svg";
}

inline Curve curve_of(const std::string& name, double radius_m = 5e-3, Placing placing = {}) {
  return rounded(placed(read_svg(vector_file(name)), placing), radius_m);
}

inline std::string text_of(const Curve& curve, int vertices) {
  LawRequest request;
  request.summary = "a test's shape";
  return law_text(sampled(curve, vertices), request);
}

inline law::Law law_of(const Curve& curve, int vertices) {
  return law::read_law_text(text_of(curve, vertices), "shape.law", 50e3);
}

}  // namespace feltgate::shape
