// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design of a block's test: FELTGATE_DESIGN of FELTGATE_DESIGN_HEADER. docs/testing.md
#pragma once

#include "feltgate/axis/words.hpp"
#include FELTGATE_DESIGN_HEADER

namespace feltgate::test {

using namespace feltgate::axis;
using feltgate::Map;

inline const Design& design() {
  static const Design d = Design::of<FELTGATE_DESIGN>();
  return d;
}
inline const WordFormats& formats() {
  static const WordFormats f(design());
  return f;
}

}  // namespace feltgate::test
