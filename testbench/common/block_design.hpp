// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design of a block's test, for its twin. docs/testing.md
#pragma once

#include <fstream>

#include "feltgate/axis/words.hpp"

namespace feltgate::test {

using namespace feltgate::axis;
using feltgate::Map;

inline const Design& design() {
  static const Design d = [] {
    std::ifstream file(FELTGATE_DESIGN_FILE);
    return Design::read(file);
  }();
  return d;
}
inline const WordFormats& formats() {
  static const WordFormats f(design());
  return f;
}

}  // namespace feltgate::test
