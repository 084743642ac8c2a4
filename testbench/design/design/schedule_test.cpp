// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A schedule that cannot work is refused with the reason; a valid schedule has its clocks in all
// places. Documentation: docs/architecture.md
#include "design/schedule.hpp"

#include <regex>

#include "design_fixture.hpp"

using namespace feltgate;
using namespace feltgate::design;

namespace {

struct Texts {
  std::string registers = file_text(root_path("rtl/registers.toml"));
  std::string schedule = file_text(root_path("rtl/schedule.toml"));

  /// The word with another slot.
  Texts& move(const std::string& word, int slot) {
    const std::string entry = "name = \"" + word + "\"";
    const auto at = registers.find("slot = ", registers.find(entry));
    REQUIRE(at != std::string::npos);
    const auto end = registers.find('\n', at);
    registers.replace(at, end - at, "slot = " + std::to_string(slot));
    return *this;
  }
  Texts& in_schedule(const std::string& from, const std::string& to) {
    schedule = replaced(schedule, from, to);
    return *this;
  }
  Texts& in_registers(const std::string& from, const std::string& to) {
    registers = replaced(registers, from, to);
    return *this;
  }
  /// The schedule's error without the folder, or "no error".
  std::string error() const {
    try {
      const RegisterMap map = read_registers(written("moved_registers.toml", registers));
      (void)read_schedule(written("moved_schedule.toml", schedule), map);
    } catch (const config::ConfigError& error) {
      return std::regex_replace(std::string(error.what()),
                                std::regex(std::string(FELTGATE_TEST_FOLDER) + "/"), "");
    }
    return "no error";
  }
};

void refused(const Texts& texts, const std::string& expression) {
  const std::string error = texts.error();
  INFO("error:    " << error);
  INFO("expected: " << expression);
  CHECK(std::regex_search(error, std::regex(expression)));
}

}  // namespace

TEST_CASE("the shipped schedule and moves that it can bear are let pass", "[schedule]") {
  CHECK(Texts().error() == "no error");
  CHECK(Texts().move("watchdog_ticks", 44).error() == "no error");
  CHECK(Texts().move("emf_constant", 21).move("polarity_ticks", 22).error() == "no error");
  CHECK(Texts().move("overspeed", 42).error() == "no error");
}

TEST_CASE("a result that comes late is refused", "[schedule]") {
  refused(Texts().move("observer_gain", 16).move("overspeed", 23),
          "schedule.toml:[0-9]+: tau_hat comes late for the product observer_gain: it is there "
          "from clock 23 on \\(step .*schedule.toml:[0-9]+\\) and needed in clock 16; move");
  refused(Texts()
              .move("torque_constant", 9)
              .move("inertia_gain", 8)
              .in_registers("slot = 14\n", "slot = 12\n"),
          "velocity comes late for the product inertia_gain: .* clock 9 on .* clock 8");
  refused(Texts().move("voltage_step", 42),
          "set_error passes: it is there from clock 32 to 32 .* set_step needs it in clock 42");
  refused(Texts().move("current_limit", 42),
          "current_limited comes late for the product voltage_gain: .* clock 43 on .* clock 34");
}

TEST_CASE("a result that passes must be taken in its clocks", "[schedule]") {
  refused(
      Texts().move("dead_voltage", 42),
      "dead_early passes: it is there from clock 35 to 35 .* dead_voltage needs it in clock 42");
  refused(Texts().move("observer_a1", 16).move("overspeed", 15),
          "observer_difference passes: it is there from clock 15 to 15 .* observer_a1 needs it in "
          "clock 16");
  refused(Texts().move("duty_limit", 47), "the step duty lies in clock 48, outside");
}

TEST_CASE("the value of the tick before is gone once the new one is there", "[schedule]") {
  refused(Texts().move("emf_over_resistance", 21).move("polarity_ticks", 7),
          "is to see the velocity of the tick before, but the new one is there from clock 9 on");
  refused(Texts().move("inverse_resistance", 42),
          "voltage of the tick before, but the new one is there from clock 41 on");
  // The divider's quotient is on its way to the limiter.
  refused(Texts().move("attract_core", 10).move("repel_core", 10),
          "charge_width_limited in clock 10 is to see the charge_quotient of the tick before");
}

TEST_CASE("words that meet on a bus are refused", "[schedule]") {
  refused(Texts().move("overspeed", 17), "overspeed|nominal_current_squared");
  refused(Texts().move("damper_damping", 11),
          "damper_damping comes by in slot 11|wall_damping in slot");
  refused(Texts().in_schedule("slot = 13\n", "slot = 15\n"),
          "two products are wanted of slot 15 of the multiplier: current_square .* observer_a1");
  refused(Texts().in_schedule("slot = 2\nscenes = [\"charge_attract\", \"charge_repel\"]",
                              "slot = 2\nscenes = [\"charge_attract\", \"wall\"]"),
          "two products are wanted of slot 2 of the multiplier: scene_stiffness .* charge_square");
  refused(Texts().in_registers("slot = 11\n", "slot = 15\n"),
          "two words meet on the operand bus in slot 15: index of the snapshot and the operand of "
          "observer_a1");
  refused(Texts().in_registers("slot = 11\n", "slot = 14\n"),
          "two words of the snapshot meet in slot 14: encoder .* and index");
  refused(Texts().in_registers("slot = 11\n", "slot = 36\n"),
          "two words meet on the operand bus in slot 36: index of the snapshot and dead_voltage");
}

TEST_CASE("where a step needs a product of 0 nothing is multiplied", "[schedule]") {
  refused(Texts().move("emf_constant", 16).move("overspeed", 22),
          "the operand of emf_constant in slot 16 makes a product in clock 20, where the step "
          "observed .* needs a product of 0; move");
  refused(Texts().in_registers("slot = 11\n", "slot = 17\n"),
          "index of the snapshot in slot 17 makes a product in clock 21");
}

TEST_CASE("a word of the snapshot stays where the RTL can select it", "[schedule]") {
  refused(
      Texts().in_registers("slot = 0\ndoc = \"what the core", "slot = 12\ndoc = \"what the core"),
      "status of the snapshot is in slot 12, but the step status_word .* reads it in clock 0");
  refused(Texts()
              .in_registers("slot = 0\ndoc = \"what the core", "slot = 12\ndoc = \"what the core")
              .in_schedule("clock = 0\nreads = [\"status\"]", "clock = 12\nreads = [\"status\"]"),
          "the step status_word in clock 12 is to see the velocity_raw of the tick before");
  refused(Texts().in_registers("slot = 11\n", "slot = 0\n"),
          "two words of the snapshot meet in slot 0");
}

TEST_CASE("a word in the wrong bank is refused", "[schedule]") {
  refused(Texts().move("membrane_torque", 8),
          "two words meet on the parameter bus in slot 8: membrane_torque lies in the bank of a "
          "scene, torque_constant .* in the common one");
  refused(Texts().move("watchdog_ticks", 6), "slot 6: attract_core lies in the bank of a scene");
  refused(Texts().move("membrane_torque", 0), "slot 0 cannot be a scene's");
  for (const char* word : {"overspeed", "membrane_torque"}) {
    refused(Texts().move(word, 12),
            "two words meet on the parameter bus in slot 12: " + std::string(word) +
                " and hold_limit, which the step least_hold .* fetches");
  }
  refused(Texts().in_schedule("fetches = \"hold_limit\"", "fetches = \"hold\""),
          "there is no word hold to fetch");
}

TEST_CASE("what lies outside the wave is refused", "[schedule]") {
  refused(Texts().move("watchdog_ticks", 47),
          "the step watchdog lies in clock 48, outside the clocks 0 to 47 of a tick of 50 clocks");
  refused(Texts().in_registers("slot = 11\n", "slot = 47\n"),
          "storing index of the snapshot lies in clock 48, outside the clocks 0 to 47");
  refused(Texts().in_schedule("clocks = 50 ", "clocks = 48 "), "outside the clocks 0 to 45");
}

TEST_CASE("a schedule that says nonsense is refused where it stands", "[schedule]") {
  refused(Texts().in_schedule("after = \"EVENT_AT_SAMPLE\"", "after = \"EVENT_AT_SIMPLE\""),
          "schedule.toml:[0-9]+: there is no clock EVENT_AT_SIMPLE; name ");
  refused(Texts().in_schedule("needs = [\"travel\"]", "needs = [\"gravel\"]"),
          "the step velocity_raw needs \"gravel\", which no step gives");
  refused(Texts().in_schedule("factor = [\"observer_a1\"]", "factor = [\"overspeed\"]"),
          "\"overspeed\" is no coefficient");
  refused(Texts().in_schedule("name = \"travel\"", "name = \"sample\""),
          "\"sample\" is listed twice");
  refused(Texts().in_registers("with = \"duty_gain\"", "with = \"duty_limit\""),
          "voltage passes by with duty_limit, which is no product");
  refused(Texts().in_registers("bit = 3\ndoc = \"voltage at", "bit = 4\ndoc = \"voltage at"),
          "4 follows 2; list them in order; this one is 3");
}
