// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// From a design to its integers: coefficient formats, quantisation, refused designs, generated
// files. Documentation: docs/designs.md
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "catch.hpp"
#include "design/design.hpp"
#include "design_fixture.hpp"
#include "feltgate/absolute_encoder.hpp"

using namespace feltgate;
using namespace feltgate::design;

namespace {

void check_refused(const std::string& name, const std::string& from, const std::string& to,
                   const std::string& at, const std::string& message) {
  const std::string bad = replaced(file_text(design_path(name)), from, to);
  INFO("change: " << to);
  CHECK(design_error(bad) == "changed.toml:" + std::to_string(line_of(bad, at)) + ": " + message);
}

/// Raw mantissa of a value in its own coefficient format.
std::int64_t mantissa(double value) {
  return std::llround(std::ldexp(value, coefficient_format(value, false).fraction));
}

double gain_error(const std::string& name) {
  const std::string table = design_table(shipped(name));
  const auto at = table.find("velocity gain error");
  REQUIRE(at != std::string::npos);
  return std::stod(table.substr(table.find(':', at) + 1));
}

}  // namespace

TEST_CASE("a coefficient uses the top bit of its mantissa", "[coefficient]") {
  CHECK(coefficient_format(1.0, false) == Format{0, 1, 16});
  CHECK(coefficient_format(0.5, false) == Format{0, 0, 17});
  CHECK(coefficient_format(2.0, false) == Format{0, 2, 15});
  CHECK(coefficient_format(3.999, false) == Format{0, 2, 15});
  CHECK(coefficient_format(-0.75, true) == Format{1, 0, 17});
  CHECK(coefficient_format(-1.0, true) == Format{1, 1, 16});
  CHECK(coefficient_format(5e-4, false) == Format{0, -10, 27});
  CHECK(coefficient_format(104.1, false) == Format{0, 7, 10});
  for (int i = 0; i < 100; ++i) {
    const double v = 1e-9 * std::pow(1.37, i);
    INFO(v);
    CHECK(mantissa(v) >= 1 << 16);
    CHECK(mantissa(v) < 1 << 17);
  }
}

TEST_CASE("a coefficient just below a power of two may need that power's place", "[coefficient]") {
  // 17 bits below 1: all ones is 1 - 2^-17. Half an LSB higher it would round up to 1.
  CHECK(coefficient_format(1 - std::ldexp(1.0, -17), false) == Format{0, 0, 17});
  CHECK(coefficient_format(1 - 0.51 * std::ldexp(1.0, -17), false) == Format{0, 0, 17});
  CHECK(coefficient_format(1 - 0.5 * std::ldexp(1.0, -17), false) == Format{0, 1, 16});
  CHECK(mantissa(1 - 0.49 * std::ldexp(1.0, -17)) == 1 << 16);
  CHECK(coefficient_format(-(1 - 0.4 * std::ldexp(1.0, -17)), true) == Format{1, 1, 16});
}

TEST_CASE("zero and tiny coefficients", "[coefficient]") {
  CHECK(coefficient_format(0.0, false) == Format{0, 0, 17});
  CHECK(coefficient_format(0.0, true) == Format{1, 0, 17});
  // The point stops at 48 fraction bits; from there the mantissa shrinks until nothing is left.
  CHECK(coefficient_format(std::ldexp(1.0, -32), false) == Format{0, -31, 48});
  CHECK(coefficient_format(std::ldexp(1.0, -40), false) == Format{0, -31, 48});
  CHECK(mantissa(std::ldexp(1.0, -40)) == 256);
  CHECK(mantissa(std::ldexp(1.0, -49)) == 1);
  CHECK(mantissa(std::ldexp(0.99, -49)) == 0);
  CHECK(mantissa(1e-300) == 0);
}

TEST_CASE("shipped designs quantise to better than 2^-16", "[design]") {
  for (const char* name : {"paper", "lever"}) {
    const Elaborated e = shipped(name);
    int coefficients = 0;
    for (const Word& w : e.words) {
      const bool coefficient = w.parameter.kind == "coefficient" || w.parameter.kind == "signed";
      if (!coefficient || w.si == 0 || !w.parameter.same_format_as.empty()) continue;
      INFO(name << " " << w.parameter.name);
      CHECK(std::abs(w.relative_error()) < std::ldexp(1.0, w.parameter.headroom_bits - 16));
      ++coefficients;
    }
    CHECK(coefficients >= 15);
    // It borrows the format of voltage_gain, which is at most one bit too wide for it.
    CHECK(std::abs(e.word("voltage_gain_high").relative_error()) < std::ldexp(1.0, -15));
    CHECK(e.formats.torque.fraction >= 16);
    CHECK(e.formats.velocity.fraction >= 10);
  }
}

TEST_CASE("the published numbers come out", "[design]") {
  const Elaborated paper = shipped("paper");
  CHECK(paper.design.inertia_kg_m2 * paper.design.kp_1_kg_m2 == Approx(0.78336).epsilon(1e-9));
  CHECK(paper.word("velocity_a1").si == Approx(4.998750208e-4).epsilon(1e-9));
  CHECK(paper.word("observer_a1").si == paper.word("velocity_a1").si);
  CHECK(paper.word("torque_gain").si == Approx(0.78336 / 0.0605).epsilon(1e-12));
  CHECK(paper.word("observer_gain").si == Approx((1 - 0.78336) / 0.0605).epsilon(1e-9));
  CHECK(paper.design.count_rad() == Approx(1.533981e-3).epsilon(1e-6));
  CHECK(gain_error("paper") == Approx(0.653).margin(5e-4));
  CHECK(gain_error("lever") == Approx(0.0013).margin(5e-5));
  // The border of the two gains: 0.15 Nm asks for 2.48 A.
  const double amperes = 0.15 / 0.0605;
  CHECK(1.25 * amperes == Approx(3.10).epsilon(1e-3));
  CHECK(0.95 * amperes == Approx(2.36).epsilon(2e-3));

  const Elaborated lever = shipped("lever");
  CHECK(lever.word("observer_gain").raw == 0);
  CHECK(lever.word("torque_gain").si == Approx(1 / 0.0302).epsilon(1e-12));
  CHECK(lever.word("voltage_gain").raw == lever.word("voltage_gain_high").raw);
}

TEST_CASE("every shipped design has a shortest pulse, and its largest duty leaves it", "[design]") {
  int designs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root_path("rtl/designs"))) {
    if (entry.path().extension() != ".toml") continue;
    const Elaborated e = shipped(entry.path().stem().string());
    const Design& d = e.design;
    INFO(d.name);
    CHECK(d.shortest_clocks() >= 0.2e-6 * static_cast<double>(d.clock_hz));
    CHECK(e.word("duty_limit").raw <=
          d.pwm_period_clocks() - d.dead_clocks() - d.shortest_clocks());
    ++designs;
  }
  CHECK(designs > 15);
  CHECK(changed("paper", "dead_time_s = 0.5e-6", "shortest_pulse_s = 0.0\ndead_time_s = 0.5e-6")
            .design.shortest_clocks() == 1);
}

TEST_CASE("the observer's gain is negative above 1/Jn", "[design]") {
  const Elaborated e = changed("paper", "kp_1_kg_m2 = 1600.0", "kp_1_kg_m2 = 4000.0");
  const Word& w = e.word("observer_gain");
  CHECK(w.si == Approx((1 - 4000 * 4.896e-4) / 0.0605));
  CHECK(w.raw < 0);
  CHECK(std::abs(w.relative_error()) < std::ldexp(1.0, -16));
}

TEST_CASE("dead-time compensation is part of the dead voltage", "[design]") {
  // 25 clocks of 2500; the diodes carry the current meanwhile.
  const double lost = (24.0 + 2 * 0.7) * 25 / 2500;
  CHECK(shipped("paper").word("dead_voltage").si == Approx(lost));
  CHECK(changed("paper", "compensate_dead_time = 1", "compensate_dead_time = 0")
            .word("dead_voltage")
            .si == 0.0);
  CHECK(changed("paper", "\"sign_magnitude\"", "\"locked_antiphase\"").word("dead_voltage").si ==
        Approx(2 * lost));
  const Elaborated lever = shipped("lever");
  CHECK(lever.word("dead_voltage").si == Approx(0.34 + (24.0 + 2 * 0.7) * 25 / 1000));
  CHECK(lever.word("dead_voltage_slope").si == Approx(lever.word("dead_voltage").si / 0.010));
}

TEST_CASE("a pole that quantises to 0 is refused", "[design]") {
  check_refused("paper", "cutoff_rad_s = 500.0\n\n[observer]", "cutoff_rad_s = 1e-9\n\n[observer]",
                "cutoff_rad_s = 1e-9",
                "velocity_a1 = 1e-15 quantises to 0 and the filter would stand still; raise the "
                "cut-off or lower tick_hz");
  check_refused("paper", "[observer]\ncutoff_rad_s = 500.0", "[observer]\ncutoff_rad_s = 1e-9",
                "cutoff_rad_s = 1e-9",
                "observer_a1 = 1e-15 quantises to 0 and the filter would stand still; raise the "
                "cut-off or lower tick_hz");
  check_refused("paper", "damper_nm_s_rad = 0.03", "damper_nm_s_rad = 1e-20", "damper_nm_s_rad",
                "damper_damping = 1e-20 quantises to 0; raise it, or set it to 0");
}

TEST_CASE("guard bits below what the pole needs are refused", "[design]") {
  check_refused("paper", "velocity = [1, 10, 21]", "velocity = [1, 10, 20]", "velocity = [1, 10",
                "the filter's state has 20 fraction bits and its pole 0.000499875 needs 21; add "
                "fraction bits or raise velocity.cutoff_rad_s");
  check_refused("paper", "observer_fraction = 30", "observer_fraction = 26", "observer_fraction",
                "the filter's state has 26 fraction bits and its pole 0.000499875 needs 27; add "
                "fraction bits or raise observer.cutoff_rad_s");
  // 5 rad/s at 1 us: 18 guard bits over the torque's 16.
  check_refused("paper", "[observer]\ncutoff_rad_s = 500.0", "[observer]\ncutoff_rad_s = 5.0",
                "observer_fraction",
                "the filter's state has 30 fraction bits and its pole 4.99999e-06 needs 34; add "
                "fraction bits or raise observer.cutoff_rad_s");
}

TEST_CASE("resolution, width and latency beyond the limit are refused", "[design]") {
  check_refused("paper", "torque = [1, 4, 16]", "torque = [1, 5, 15]", "torque = [1, 5",
                "an LSB of 2^-15 Nm is too coarse; use at least 16 fraction bits");
  check_refused("paper", "velocity = [1, 10, 21]", "velocity = [1, 20, 9]", "velocity = [1, 20",
                "an LSB of 2^-9 rad/s is too coarse; use at least 10 fraction bits");
  check_refused("paper", "velocity = [1, 10, 21]", "velocity = [1, 10, 22]", "velocity = [1, 10",
                "the velocity takes 33 bits and the fabric has 32; use fewer integer or fraction "
                "bits");
  check_refused("paper", "torque = [1, 4, 16]", "torque = [1, 8, 16]", "torque = [1, 8",
                "the ramped torque takes 33 bits and the fabric has 32; use fewer integer or "
                "fraction bits");
  check_refused("paper", "current = [1, 5, 16]", "current = [1, 16, 16]", "current = [1, 16",
                "the current takes 33 bits and the fabric has 32; use fewer integer or fraction "
                "bits");
  check_refused("paper", "current = [1, 5, 16]", "current = [1, 4, 15]", "current = [1, 4",
                "the limiter is as wide as the current, 20 bits, and the torque has 21; add bits "
                "to the current");
  check_refused("paper", "observer_fraction = 30", "observer_fraction = 38", "observer_fraction",
                "the product with torque_constant has 37 fraction bits and its sum takes 38; lower "
                "this, or the value of observer.torque_constant_nm_a");
  check_refused("lever", "nominal_current_a = 5.77", "nominal_current_a = 0.77",
                "nominal_current_a",
                "the square of the nominal current is below 4 steps of 0.25 A^2, those of a motor "
                "with currents of up to 256 A; use fewer integer bits of the velocity or the "
                "current");
  check_refused("paper", "tick_hz = 1_000_000", "tick_hz = 1_250_000", "tick_hz",
                "the chain takes 50 clocks and a tick has 40; lower tick_hz or raise clock_hz");
}

TEST_CASE("a self-test that cannot be answered is refused", "[design]") {
  check_refused("lever", "torque_nm = 0.05 ", "torque_nm = 0.02 ", "torque_nm",
                "the self-test's pulse moves the inertia of 0.000122 kg m^2 by 1.33 counts, less "
                "than the 2 that its answer takes; raise torque_nm or pulse_ms");
  check_refused("paper", "torque_nm = 0.15 ", "torque_nm = 0.05 ", "torque_nm",
                "the self-test's pulse moves the inertia of 0.00049 kg m^2 by 0.832 counts, less "
                "than the 2 that its answer takes; raise torque_nm or pulse_ms");
  check_refused("lever", "torque_nm = 0.05 ", "torque_nm = 0.6 ", "torque_nm",
                "the self-test's 0.6 Nm are more than the torque limit of 0.5 Nm; lower it");
  check_refused("lever", "quiet_ms = 20.0", "quiet_ms = 40.0", "quiet_ms",
                "\"quiet_ms\" is 312 units of 128 ticks; choose 0.128 to 32.6 ms");
  for (const char* design : {"lever", "paper"}) {
    const std::string text = file_text(design_path(design));
    const bool on = text.find("mode = \"on\"") != std::string::npos;
    const std::string off_word = "mode = \"off\"", on_word = "mode = \"on\"";
    CHECK(design_error(text) == "no error");
    CHECK(design_error(on ? replaced(text, on_word, off_word)
                          : replaced(text, off_word, on_word)) == "no error");
  }
}

TEST_CASE("a parameter that does not fit its word is refused", "[design]") {
  check_refused("paper", "current_limit_a = 8.264463", "current_limit_a = 32.0", "current_limit_a",
                "current_limit = 32 A does not fit its word [1,5,16]; choose a value that makes it "
                "smaller");
  check_refused("paper", "voltage = [1, 5, 14]", "voltage = [1, 4, 14]", "supply_v",
                "the supply of 24 V does not fit the voltage's format [1,4,14]; lower it, or "
                "use more integer bits");
  // 131072 counts are 32 turns of this encoder, 0.02 turns of that.
  check_refused("paper", "lines = 1024", "lines = 524_288", "membrane_lower_rad",
                "membrane_lower = 166886 count does not fit its word [1,17,8]; choose a value that "
                "makes it smaller");
  check_refused(
      "paper", "charge_core_rad = 0.0 ", "charge_core_rad = 1e-5 ", "charge_core_rad",
      "attract_core_slope = 3.06796e+10 Nm/count does not fit its word [0,35,-18]; choose "
      "a value that makes it smaller");
}

TEST_CASE("three phases with two shunts: the words of the loop, and what it refuses") {
  const std::string good = file_text(design_path("gimbal_motor"));
  // Two shunts: the window of the currents is around the begin of a period, and P/sqrt(3) is the
  // supply of the gains.
  const std::string shunts =
      replaced(replaced(good, "[commutation]",
                        "[current_loop]\nfull_scale_a = 2.0\nbandwidth_hz = 2000.0\n"
                        "inductance_h = 1e-3\novercurrent_a = 1.5\n[commutation]"),
               "current = [1, 3, 18]", "current = [1, 1, 20]");
  const std::string loop =
      cfg_package(elaborate(design_from_text(shunts, "shunts.toml"), shipped_registers()));
  for (const char* line :
       {"int CURRENT_STROBE = 635;", "int CURRENT_PROPORTIONAL = 73410;", "int FEED_GAIN = 355;"}) {
    CHECK_THAT(loop, Catch::Contains(line));
  }
  CHECK_THAT(design_error(replaced(shunts, "frequency_hz = 50_000", "frequency_hz = 80_000")),
             Catch::Contains("a current is measured and controlled"));
}

TEST_CASE("Hall lines: a constant and a CRC of their own, and no absolute encoder beside them") {
  const std::string sectioned =
      replaced(replaced(file_text(design_path("lever")), "[pwm]\n", "[pwm]\nphases = 3\n"),
               "[pwm]\n", "[commutation]\npole_pairs = 7\noffset_rad = 0.0\nhall = 0\n[pwm]\n");
  const auto made = [](const std::string& text) {
    return elaborate(design_from_text(text, "hall.toml"), shipped_registers());
  };
  const std::string with = replaced(sectioned, "hall = 0", "hall = 1");
  CHECK_THAT(cfg_package(made(with)), Catch::Contains("int HALL = 1;"));
  CHECK_THAT(cfg_package(made(sectioned)), Catch::Contains("int HALL = 0;"));
  CHECK(design_crc(made(sectioned)) == design_crc(made(replaced(sectioned, "hall = 0\n", ""))));
  CHECK(design_crc(made(with)) != design_crc(made(sectioned)));
  CHECK_THAT(design_error(replaced(sectioned, "hall = 0", "hall = 2")),
             Catch::Contains("\"hall\""));
  CHECK_THAT(design_error(replaced(file_text(design_path("gimbal_motor")), "pole_pairs = 11",
                                   "hall = 1\npole_pairs = 11")),
             Catch::Contains("an absolute encoder knows the angle at power-up"));
  std::string law = file_text(design_path("knob_law"));
  const auto from = law.find("[absolute_encoder]");
  law.erase(from, law.find("[commutation]") - from);
  law = replaced(law, "polarity = 0\n\n[",
                 "polarity = 0\nlines = 1024\nfilter_samples = 0\nindex = 1\n\n[");
  CHECK_THAT(design_error(replaced(law, "pole_pairs = 11", "hall = 1\npole_pairs = 11")),
             Catch::Contains("a core with an engine has no pins of Hall lines"));
}
