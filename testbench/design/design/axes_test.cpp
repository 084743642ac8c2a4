// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a design file can say beyond the shipped ones, what is refused, and what only exploration
// may have. Documentation: docs/designs.md
#include "design_fixture.hpp"

using namespace feltgate;
using namespace feltgate::design;

namespace {

const char* const fractions = "observer_fraction = 30";

/// lever, as an explored point has it: the self-test's pulse is made for the tick of the base.
std::string base_text() {
  return replaced(file_text(design_path("lever")), "mode = \"on\"", "mode = \"off\"");
}

std::string with(const std::string& keys) {
  return replaced(base_text(), fractions, std::string(fractions) + "\n" + keys + " #");
}

Elaborated good(const std::string& text, bool allow_coarse = false) {
  auto d = read_design(written("changed.toml", text));
  d.allow_coarse = allow_coarse;
  return elaborate(d, shipped_registers());
}

bool says(const std::string& text, const std::string& line) {
  return text.find(line) != std::string::npos;
}

/// The error of a design even where coarse ones pass.
std::string refusal(const std::string& text) {
  try {
    (void)good(text, true);
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("without the key a design rounds half up", "[axes]") {
  const Elaborated e = shipped("lever");
  CHECK(e.design.rounding == Round::half_up);
  CHECK(says(cfg_package(e), "localparam int ROUNDING = 0;"));
  CHECK(says(cpp_header(e), "Round rounding = Round::half_up;"));
}

TEST_CASE("rounding reaches package and header", "[axes]") {
  for (const auto& [word, number, name] : {std::tuple{"half_up", "0", "half_up"},
                                           {"floor", "1", "truncate"},
                                           {"convergent", "2", "convergent"}}) {
    const Elaborated e = good(with("rounding = \"" + std::string(word) + "\""));
    CHECK(says(cfg_package(e), "localparam int ROUNDING = " + std::string(number) + ";"));
    CHECK(says(cpp_header(e), "Round rounding = Round::" + std::string(name) + ";"));
  }
  CHECK(says(design_error(with("rounding = \"up\"")), "rounding"));
}

TEST_CASE("ticks from 10 kHz to 1 MHz with a quantised gain", "[axes]") {
  for (const int tick_hz : {10'000, 25'000, 100'000, 500'000, 1'000'000}) {
    std::string text = base_text();
    text = replaced(text, "tick_hz = 1_000_000", "tick_hz = " + std::to_string(tick_hz));
    text = replaced(text, "m1 = 767\nn = 1 ", "m1 = 16\ngain = \"exact\" ");
    const Elaborated e = good(text, true);
    INFO(tick_hz);
    CHECK(e.design.clocks_per_tick() == 50'000'000 / tick_hz);
    CHECK(e.rad_s_per_count() == Approx(e.design.velocity_gain_rad_s()).epsilon(1e-5));
    CHECK(e.word("watchdog_ticks").raw == tick_hz / 10);
    CHECK(e.word("ramp_step").quantised() == Approx(5.0 / tick_hz).epsilon(0.01));
  }
}

TEST_CASE("a coarse design is refused for use and let pass for exploration", "[axes]") {
  const std::string coarse =
      replaced(file_text(design_path("lever")), "torque = [1, 4, 16]", "torque = [1, 4, 12]");
  CHECK(says(design_error(coarse), "is too coarse"));
  CHECK(good(coarse, true).formats.torque.fraction == 12);
}

TEST_CASE("what cannot work is refused in exploration too", "[axes]") {
  const std::string lever = base_text();
  CHECK(says(refusal(replaced(lever, fractions, "observer_fraction = 16")), "add fraction bits"));
  CHECK(says(refusal(replaced(lever, "torque = [1, 4, 16]", "torque = [1, 4, 24]")),
             "ramp moves in steps"));
  CHECK(says(refusal(replaced(lever, "velocity = [1, 10, 21]", "velocity = [1, 17, 14]")),
             "no count reaches"));
  CHECK(says(refusal(replaced(lever, "current = [1, 5, 16]", "current = [1, 5, 8]")),
             "as wide as the current"));
}
