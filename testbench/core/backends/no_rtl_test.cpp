// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A program without the Verilated core: the twin is there, the RTL says why it is not.
#include <string>

#include "catch.hpp"
#include "sim/backends/backend.hpp"

using namespace feltgate;

namespace {

std::string refusal(const std::string& design, const std::string& kind) {
  try {
    make_backend(design, kind);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "made";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("without the Verilated core an engine is the twin, or says what is missing") {
  CHECK(refusal("lever", "twin") == "made");
  for (const std::string kind : {"rtl", "lockstep"}) {
    const std::string told = refusal("lever", kind);
    CAPTURE(told);
    CHECK(has(told, "engine \"" + kind + "\" of design lever: its RTL is not in this program"));
    CHECK(has(told, "choose the engine twin"));
  }
  CHECK(has(refusal("lever", "rlt"), "engine \"rlt\" is unknown"));
  CHECK(has(refusal("levre", "rtl"), "design \"levre\" is unknown; did you mean \"lever\"?"));
}
