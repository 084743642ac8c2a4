// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every message about a design file or the register map has the file, the line, the error and a
// correction. Documentation: docs/designs.md
#include <set>
#include <vector>

#include "catch.hpp"
#include "design_fixture.hpp"
#include "feltgate/nearest.hpp"
#include "files/toml/toml_reader.hpp"

using namespace feltgate;
using namespace feltgate::design;

namespace {

/// One change of the text of paper.toml and the error that it must cause.
struct Case {
  std::string from, to;
  std::string at;       ///< the error names the line of this text in the changed file
  std::string message;  ///< "what; mend", from its beginning
};

void check_cases(const std::string& text, const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    const std::string bad = replaced(text, c.from, c.to);
    const std::string error = design_error(bad);
    const std::string expected =
        "changed.toml:" + std::to_string(line_of(bad, c.at)) + ": " + c.message;
    INFO("error:    " << error);
    INFO("expected: " << expected);
    CHECK(error.rfind(expected, 0) == 0);
    CHECK(error.find("; ") != std::string::npos);
  }
}

std::string read_error(const std::string& path) {
  try {
    (void)read_design(path);
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

std::string registers_error(const std::string& from, const std::string& to) {
  const std::string text = replaced(file_text(root_path("rtl/registers.toml")), from, to);
  try {
    const RegisterMap map = read_registers(written("registers.toml", text));
    (void)elaborate(shipped_design("paper"), map);
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("an unchanged design has no error", "[reader]") {
  CHECK(design_error(file_text(design_path("paper"))) == "no error");
  CHECK(design_error(file_text(design_path("lever"))) == "no error");
}

TEST_CASE("keys: missing, unknown, mistyped, out of range", "[reader]") {
  check_cases(
      file_text(design_path("paper")),
      {{"tick_hz = 1_000_000\n", "", "[clock]", "key \"tick_hz\" is missing in [clock]; add it"},
       {"n = 2 ", "gain = \"exact\"\nn = 2 ", "n = 2 ",
        "velocity.n and velocity.gain exclude each other; keep one"},
       {"m1 = 386", "m1 = 386\nm2 = 5", "m2 = 5",
        "key \"m2\" is unknown in [velocity]; remove it or use one of: cutoff_rad_s, cycles, "
        "estimator, gain, m1, n, window_s"},
       {"m1 = 386", "estimator = \"pll\"\nm1 = 386", "estimator",
        "\"estimator\" = \"pll\" is not known; it must be one of n_method, mt"},
       {"m1 = 386", "estimator = \"mt\"\nm1 = 386", "m1 = 386",
        "velocity.m1 is of the N-method; leave it out, or estimator = \"mt\""},
       {"m1 = 386", "m1 = 386\ncycles = 4", "cycles = 4",
        "velocity.cycles is of the estimator mt; leave it out, or write estimator = \"mt\""},
       {"[pwm]", "[pvm]", "#", "key \"pwm\" is missing in the design; add it"},
       {"[clock]", "speed = 1\n[clock]", "speed = 1",
        "key \"speed\" is unknown in the design; remove it or use one of: "},
       {"n = 2 ", "n = 2.0 ", "n = 2.0",
        "\"n\" is not an integer of its range; it must be from 0 to 12"},
       {"m1 = 386", "m1 = 1535", "m1 = 1535",
        "\"m1\" is not an integer of its range; it must be from 1 to 1534"},
       {"torque_limit_nm = 0.5", "torque_limit_nm = \"0.5\"", "torque_limit_nm = \"",
        "\"torque_limit_nm\" is not a number; write a number in the unit that the key names"},
       {"torque_limit_nm = 0.5", "torque_limit_nm = nan", "torque_limit_nm = nan",
        "\"torque_limit_nm\" = nan is out of range; it must be from 0 to 15"},
       {"supply_v = 24.0", "supply_v = 136.0", "supply_v = 136",
        "\"supply_v\" = 136 is out of range; it must be from 1 to 100"},
       {"membrane_upper_rad = 0.7", "membrane_upper_rad = 0.3", "membrane_upper_rad = 0.3",
        "\"membrane_upper_rad\" = 0.3 is out of range; it must be from 0.5 to 200"},
       {"mode = \"sign_magnitude\"", "mode = \"unipolar\"", "mode = \"unipolar\"",
        "\"mode\" = \"unipolar\" is not known; it must be one of sign_magnitude, "
        "locked_antiphase"},
       {"law = \"regions\"", "law = \"linear\"", "law = \"linear\"",
        "\"law\" = \"linear\" is not known; it must be one of regions, motor_model"},
       {"law = \"regions\"", "law = 5", "law = 5", "\"law\" is not a text; write it in quotes"},
       {"include = [", "include = [3, ", "include",
        "\"include\" is not a text; write it in quotes"},
       {"include = [\"free\",", "include = \"free\" #", "include",
        "\"include\" is not an array; write [a, b, ...]"},
       {"include = [\"free\",", "include = [\"fre\",", "include",
        "scene \"fre\" is unknown; did you mean \"free\"? choose among free, setpoint, "},
       {"[clock]\n", "clock = 5\n[clock2]\n", "clock = 5",
        "\"clock\" is not a table; write [clock]"}});
}

TEST_CASE("syntax, name and place of the file", "[reader]") {
  const std::string good = file_text(design_path("paper"));
  const std::string error = design_error(replaced(good, "m1 = 386", "m1 == 386"));
  CHECK(error.rfind("changed.toml:" + std::to_string(line_of(good, "m1 = 386")) + ": not TOML (",
                    0) == 0);
  CHECK(contains(error, "; correct the syntax of this line"));
  CHECK(read_error("/nonexistent/paper.toml") ==
        "/nonexistent/paper.toml:0: cannot be read; give the path of a readable TOML file");
  for (const char* name : {"Paper.toml", "2nd.toml", "my-design.toml", "_x.toml"}) {
    const std::string path = written(name, good);
    const std::string stem = std::string(name).substr(0, std::string(name).find('.'));
    const std::string what = ":0: a design cannot be called \"" + stem + "\"; use a to z, ";
    CHECK(read_error(path).rfind(path + what, 0) == 0);
  }
}

TEST_CASE("values that do not belong together", "[reader]") {
  check_cases(
      file_text(design_path("paper")),
      {{"tick_hz = 1_000_000", "tick_hz = 999_999", "tick_hz = 999_999",
        "clock_hz is not a multiple of tick_hz; choose a divisor of the clock"},
       {"frequency_hz = 20_000 ", "frequency_hz = 12_000 ", "frequency_hz = 12_000",
        "the PWM period is not a whole number of clocks up to 4095; choose another frequency"},
       {"frequency_hz = 20_000 ", "frequency_hz = 30_000 ", "frequency_hz = 30_000",
        "the PWM period is not a whole number of clocks up to 4095; choose another frequency"},
       {"frequency_hz = 20_000 ", "frequency_hz = 1_000_000 ", "frequency_hz = 1_000_000",
        "the shortest pulse of 2e-07 s is longer than 255 clocks, or with the dead time than half "
        "a period; lower frequency_hz, or write a shortest_pulse_s that your driver can follow"},
       {"kp_1_kg_m2 = 1600.0", "kp = \"1/inertia\"\nkp_1_kg_m2 = 1600.0", "kp_1_kg_m2 = 1600",
        "Kp is given twice; keep one of kp and kp_1_kg_m2"},
       {"kp_1_kg_m2 = 1600.0", "kp = \"2/inertia\"", "kp = ",
        "\"kp\" = \"2/inertia\" is not known; did you mean \"1/inertia\"? it must be one of "
        "1/inertia"},
       {"torque = [1, 4, 16]", "torque = [1, 4]", "torque = [1, 4]",
        "\"torque\" is no format of a signed signal; write [1, I, F]"},
       {"torque = [1, 4, 16]", "torque = [0, 5, 16]", "torque = [0, 5",
        "\"torque\" is no format of a signed signal; write [1, I, F]"},
       {"velocity = [1,", "velocity = [1, 40, 40] #", "velocity = [1,",
        "the velocity takes 81 bits and the fabric has 32; use fewer integer or fraction bits"},
       {"description = \"", "description = \"two\\nint lines; ", "description",
        "\"description\" holds a line break or another control character; write it in one line"},
       {"torque = [1, 4, 16]", "torque = [1, -20, 16]", "torque = [1, -20",
        "\"torque\" has less than two bits; raise I or F"},
       {"torque = [1, 4, 16]", "torque = [1, 4, 99]", "torque = [1, 4, 99",
        "\"torque\" is not an integer of its range; it must be from -64 to 64"}});
}

TEST_CASE("the M/T estimator: its keys, its constants, and what knows the N-method alone",
          "[reader]") {
  const std::string lever = file_text(design_path("lever"));
  const auto with = [&](const std::string& keys) {
    const auto from = lever.find("m1 = 767"), to = lever.find("cutoff_rad_s", from);
    return std::string(lever).replace(from, to - from, "estimator = \"mt\"\n" + keys);
  };
  CHECK(design_error(with("")) == "no error");
  CHECK(
      contains(design_error(with("cycles = 6\n")), "6 cycles are no power of two; write 1, 2, 4"));
  CHECK(contains(design_error(with("cycles = 256\n")), "it must be from 1 to 128"));
  CHECK(contains(design_error(with("window_s = 0.03\n")), "it must be from 0 to 0.02"));
  std::string narrow = replaced(with("cycles = 128\n"), "[1, 10, 21]", "[1, 3, 21]");
  narrow = replaced(replaced(narrow, "lines = 1024", "lines = 16"), "_rad_s = 613.6", "_rad_s = 7");
  narrow = replaced(narrow, "pulse_ms = 5.0", "pulse_ms = 32.0");
  CHECK(contains(design_error(narrow), "the quotient of M/T has more bits than the velocity"));

  const Elaborated e = elaborate(
      design_from_text(with("window_s = 386e-6\ncycles = 16\n"), "a.toml"), shipped_registers());
  const std::string package = cfg_package(e);
  for (const char* line : {"int MT_COUNTS = 4096;", "int MT_WINDOW = 19300;",
                           "int MT_DOUBLINGS = 4;", "int M1 = 0;"}) {
    CHECK(contains(package, line));
  }
  CHECK(contains(cfg_package(shipped("lever")), "int MT_COUNTS = 0;"));
  const Elaborated cycle = elaborate(design_from_text(with(""), "a.toml"), shipped_registers());
  CHECK(design_crc(e) != design_crc(cycle));
  CHECK(
      contains(design_table(e), "M/T over whole encoder cycles, 386 us or more, up to 16 cycles"));
  CHECK_THROWS_AS(e.design.needs_n_method("it"), config::ConfigError);
  CHECK_NOTHROW(shipped("lever").design.needs_n_method("it"));
}

TEST_CASE("a current loop: gains and strobe, and what it refuses", "[reader]") {
  const std::string good = file_text(design_path("lever_current"));
  const std::string package = cfg_package(shipped("lever_current"));
  for (const char* line :
       {"int CURRENT_LOOP = 1;", "int CURRENT_PROPORTIONAL = 11842;",
        "int CURRENT_INTEGRAL = 12762;", "int CURRENT_STROBE = 135;",
        "int CURRENT_OVERCURRENT = 192;", "int CURRENT_RESISTANCE = 4588;",
        "int CURRENT_MARGIN = 19038;", "int DRIVER_FAULT = 1;", "int HEARTBEAT = 512;"}) {
    CHECK(contains(package, line));
  }
  for (const char* line :
       {"int CURRENT_LOOP = 0;", "int DRIVER_FAULT = 0;", "int HEARTBEAT = 0;"}) {
    CHECK(contains(cfg_package(shipped("lever")), line));
  }
  const auto refused = [&](const char* from, const char* to, const char* message) {
    const std::string error = design_error(replaced(good, from, to));
    INFO(error);
    CHECK(contains(error, message));
  };
  refused("full_scale_a = 32.0", "full_scale_a = 30.0", "the full scale is no power of two");
  refused("full_scale_a = 32.0", "full_scale_a = 16.0",
          "formats.current does not fit the full scale; give it at most 4 integer bits");
  refused("overcurrent_a = 24.0", "overcurrent_a = 16.0", "is not between control.current_limit_a");
  refused("inductance_h = 82e-6", "inductance_h = 2e-3", "a gain of the current loop does not fit");
  refused("frequency_hz = 50_000", "frequency_hz = 100_000",
          "a current is measured and controlled");
  refused("[current_loop]", "[axes]\ncount = 2\n[current_loop]", "has no pins of a modulator");
  refused("heartbeat = 1", "heartbeat = 2", "heartbeat");
  refused("bandwidth_hz = 2000.0", "", "key \"bandwidth_hz\" is missing in [current_loop]");
}

TEST_CASE("an absolute encoder: its clocks, and what it refuses", "[reader]") {
  const std::string good = file_text(design_path("lever_absolute"));
  const std::string package = cfg_package(shipped("lever_absolute"));
  for (const char* line :
       {"int ABSOLUTE_ENCODER = 1;", "int ABSOLUTE_HALF_CLOCKS = 5;",
        "int ABSOLUTE_GAP_CLOCKS = 20;", "int ABSOLUTE_PERIOD = 96;", "int INDEX_COUNTS = 0;"}) {
    CHECK(contains(package, line));
  }
  CHECK(shipped("lever_absolute").design.count_rad() == 2 * 3.14159265358979323846 / 16384);
  // 613.6 and 100 rad/s in 96 us are 153.6 and 25.03 counts; 2 more for noise.
  CHECK(contains(package, "ABSOLUTE_JUMP_STEP = 156;"));
  CHECK(contains(cfg_package(shipped("gimbal_motor")), "ABSOLUTE_JUMP_STEP = 28;"));
  CHECK(contains(cfg_package(shipped("lever")), "int ABSOLUTE_ENCODER = 0;"));
  const auto refused = [&](const char* from, const char* to, const char* message) {
    const std::string error = design_error(replaced(good, from, to));
    INFO(error);
    CHECK(contains(error, message));
  };
  refused("bits = 14 ", "bits = 16 ", "an SPI frame has 14 bits of angle, not 16");
  refused("\"spi\"", "\"ssi\"", "only SPI asks for a register of the diagnosis");
  refused("serial_hz = 5_000_000", "serial_hz = 10_000_000", "half a serial clock is 2.5 clocks");
  refused("gap_s = 0.4e-6", "gap_s = 0.0", "the gap is 0 clocks, less than 4");
  refused("period_s = 96e-6", "period_s = 96.5e-6", "cannot follow each other in 96.5 ticks");
  refused("period_s = 96e-6", "period_s = 3e-6", "readings of 208 clocks cannot follow");
  refused("period_s = 96e-6", "period_s = 128e-6", "takes 18 readings, more than 2 ms");
  refused("m1 = 384", "m1 = 400", "400 ticks are no whole number of readings, one in 96");
  refused("torque_nm = 0.05 ", "torque_nm = 0.2 ", "a reading moves by more than a count");
  refused("[absolute_encoder]", "lines = 1024\n[absolute_encoder]", "\"lines\"");
  refused("[absolute_encoder]", "[axes]\ncount = 2\n[absolute_encoder]",
          "has no pins for its lines");
  const auto refused_alone = [&](const std::string& text, const char* message) {
    const Design d = design_from_text(text, "changed.toml");
    CHECK_THROWS_WITH(check_absolute_encoder(d), Catch::Contains(message));
  };
  refused_alone(replaced(replaced(good, "m1 = 384", "estimator = \"mt\""), "n = 0 ", "# n = 0"),
                "M/T needs the clocks of edges");
  std::string fine = replaced(replaced(good, "\"spi\"", "\"ssi\""), "bits = 14", "bits = 21");
  fine = replaced(fine, "diagnosis", "# diagnosis");
  refused_alone(fine, "the velocity's window by 32767 counts");
}

TEST_CASE("three phases: the words of the commutation, and what they refuse", "[reader]") {
  const std::string good = file_text(design_path("gimbal_motor"));
  const Elaborated e = shipped("gimbal_motor");
  const std::string package = cfg_package(e);
  CHECK(contains(package, "int PHASES = 3;"));
  CHECK(e.word("commutation_gain").raw == 11 << 18);  // 11 turns of 2^32 in 2^14 counts
  CHECK(e.word("commutation_offset").raw == 0);
  // A whole period is 5 V over the root of 3; the highest leg leaves two dead times and two
  // shortest pulses.
  CHECK(e.word("duty_gain").si == Approx(1000 / 2.8867513));
  CHECK(e.word("duty_limit").raw == 930);
  // The four thirds of a leg's loss, of which 3/pi turn with the current.
  CHECK(e.word("dead_voltage").si == Approx(4.0 / 3 * 3 / 3.14159265 * 6.4 * 0.025));
  const std::string two = cfg_package(shipped("lever"));
  CHECK(contains(two, "int PHASES = 2;"));
  CHECK_FALSE(contains(two, "commutation_gain"));
  CHECK_THROWS_WITH(shipped("lever").word("commutation_gain"), Catch::Contains("is missing"));
  const auto changed = [&](const char* from, const char* to) {
    return elaborate(design_from_text(replaced(good, from, to), "t.toml"), shipped_registers());
  };
  CHECK(changed("offset_rad = 0.0 ", "offset_rad = -1.5707963267948966 ")
            .word("commutation_offset")
            .raw == 3LL << 30);
  CHECK(design_crc(changed("pole_pairs = 11", "pole_pairs = 7")) != design_crc(e));
  const auto refused = [&](const char* from, const char* to, const char* message) {
    const std::string error = design_error(replaced(good, from, to));
    INFO(error);
    CHECK(contains(error, message));
  };
  refused("phases = 3", "phases = 4", "\"phases\"");
  refused("phases = 3", "", "only three phases are commutated");
  refused("pole_pairs = 11", "pole_pairs = 0", "\"pole_pairs\"");
  refused("\"sign_magnitude\"", "\"locked_antiphase\"", "three legs have one kind of pulses");
  refused("frequency_hz = 50_000", "frequency_hz = 625_000", "the commutation of one takes 87");
  const auto refused_alone = [&](const std::string& text, const char* message) {
    const Design d = design_from_text(text, "changed.toml");
    CHECK_THROWS_WITH(check_commutation(d), Catch::Contains(message));
  };
  refused_alone(replaced(replaced(good, "pole_pairs = 11", "pole_pairs = 100"),
                         "overspeed_rad_s = 100.0", "overspeed_rad_s = 600.0"),
                "an eighth of an electrical turn");
  refused_alone(replaced(good, "[commutation]", "[axes]\ncount = 2\n[commutation]"),
                "no pins of a third leg");
  std::string without = good;
  const auto from = without.find("[commutation]");
  without.erase(from, without.find("[velocity]") - from);
  CHECK(contains(design_error(without), "three phases need to know the motor"));
}

TEST_CASE("an engine and several axes", "[reader]") {
  const std::string good = file_text(design_path("lever_law"));
  CHECK(design_error(good) == "no error");
  CHECK(design_error(good + "[axes]\ncount = 3\n") == "no error");
  CHECK(design_error(replaced(good, "max_age_ms = 1.0", "")) == "no error");
  check_cases(
      good,
      {{"\"setpoint\", \"law\"]", "\"setpoint\"]", "include = ",
        "no scene takes the torque of the engine; add \"law\", or leave [engine] out"},
       {"max_age_ms = 1.0", "max_age_ms = 65.536",
        "max_age_ms = ", "\"max_age_ms\" is 65536 ticks, more than 65535; choose up to 65.535 ms"},
       {"max_age_ms = 1.0", "max_age_ms = 0",
        "max_age_ms = ", "\"max_age_ms\" = 0 is out of range; it must be from 0.001 to 100000"},
       {"max_age_ms = 1.0", "age_ms = 1.0", "age_ms = ", "key \"age_ms\" is unknown in [engine]; "},
       {"[engine]", "[axes]\ncount = 9\n[engine]", "count = 9",
        "\"count\" is not an integer of its range; it must be from 1 to 3"},
       {"[engine]", "[axes]\n[engine]", "[axes]", "key \"count\" is missing in [axes]; add it"}});
  // Designs without keep the number by which a host knows them.
  const auto crc = [](const std::string& text) {
    return design_crc(elaborate(design_from_text(text, "own.toml"), shipped_registers()));
  };
  const std::string lever = file_text(design_path("lever"));
  CHECK(crc(lever) == crc(lever + "[axes]\ncount = 1\n"));
  CHECK(crc(lever) != crc(lever + "[axes]\ncount = 2\n"));
}

TEST_CASE("the register map is read as strictly", "[reader]") {
  const auto place = [](const std::string& error) {
    const std::string path = std::string(FELTGATE_TEST_FOLDER) + "/registers.toml:";
    return error.rfind(path, 0) == 0 && error[path.size()] != '0' && contains(error, "; ");
  };
  const struct {
    const char *from, *to, *message;
  } cases[] = {
      {"kind = \"coefficient\"", "kind = \"fraction\"",
       "\"kind\" = \"fraction\" is not known; it must be one of coefficient, signed, signal"},
      {"slot = 5\n", "slot = 4\n",
       "inverse_resistance shares its address with another parameter; choose a free slot"},
      {"slot = 5\n", "slot = 64\n",
       "\"slot\" is not an integer of its range; it must be from 0 to"},
      {"slot = 5\n", "slot = 5\nspeed = 1\n", "key \"speed\" is unknown"},
      {"unit = \"1/ohm\"\n", "", "key \"unit\" is missing"},
      {"bits = 24\nsaturates = true\n", "", "key \"bits\" is missing"},
      {"kind = \"limit\"\n", "kind = \"limit\"\nsaturates = true\n",
       "key \"saturates\" is unknown"},
      {"scene = \"damper\"\nslot", "scene = \"dampr\"\nslot",
       "scene \"dampr\" has no bank; did you mean \"damper\"? list it under [[scene]]"},
      {"name = \"free\"", "name = \"Free\"",
       "\"name\" = \"Free\" is no name of a program's variable"},
      {"unit = \"rad/s\"", "unit = 'r\"d'", "cannot be written into a program"},
      {"doc = \"1/R", "doc = \"1\\n/R", "\"doc\" holds a line break"},
      {"name = \"free\"\nnumber = 0", "name = \"free\"\nnumber = 16",
       "\"number\" is not an integer of its range; it must be from 0 to 15"},
      {"bit = 2, width = 4", "bit = 30, width = 4",
       "the field ends beyond bit 31; make it narrower"},
      {"format = \"velocity\"", "format = \"speed\"",
       "signal format \"speed\" is unknown; use that of a signal of the chain"},
      {"name = \"watchdog_ticks\"", "name = \"watchdog\"",
       "no design gives a value to \"watchdog\"; add it to"},
      {"same_format_as = \"voltage_gain\"", "same_format_as = \"voltage_gein\"",
       "no design gives a value to \"voltage_gein\"; add it to"}};
  for (const auto& c : cases) {
    const std::string error = registers_error(c.from, c.to);
    INFO(error);
    CHECK(place(error));
    CHECK(contains(error, c.message));
  }
}

// The suggestion for a misspelt name, and the cases without a suggestion; letters beyond ASCII in a
// TOML file: welcome in strings and comments, refused elsewhere.

using namespace feltgate::config;

namespace {

const std::set<std::string> scenes{"charge_attract", "charge_repel",       "damper",
                                   "membrane",       "spring_compression", "spring_tension",
                                   "torque_step",    "torque_step_cord",   "wall"};

}  // namespace

TEST_CASE("the nearest name is suggested") {
  CHECK(nearest("membrnae", scenes) == "membrane");
  CHECK(nearest("Damper", scenes) == "damper");
  CHECK(nearest("wal", scenes) == "wall");
  CHECK(nearest("torque_stp", scenes) == "torque_step");
  CHECK(nearest("charge_repell", scenes) == "charge_repel");
  CHECK(nearest("torque-step-cord", scenes) == "torque_step_cord");
  CHECK(nearest("spring_comp", scenes) == "spring_compression");  // goes on to one name only
  CHECK(did_you_mean("membrnae", scenes) == "did you mean \"membrane\"? ");
}

TEST_CASE("what resembles nothing suggests nothing") {
  CHECK(nearest("", scenes).empty());
  CHECK(nearest("ox", scenes).empty());
  CHECK(nearest("spring", scenes).empty());  // two begin so, and neither is near
  CHECK(nearest("gravity", scenes).empty());
  CHECK(nearest("J", std::vector<std::string>{"K", "B"}).empty());
  CHECK(nearest(std::string(100000, 'm'), scenes).empty());
  CHECK(nearest("wall", std::vector<std::string>{}).empty());
  CHECK(did_you_mean("gravity", scenes).empty());
}

TEST_CASE("letters beyond ASCII may stand in strings and comments", "[toml]") {
  CHECK(stray_line("") == 0);
  CHECK(stray_line("# ω\na = \"ω²\" # τ̂\nb = 'ω'\n") == 0);
  CHECK(stray_line("\xef\xbb\xbf"
                   "a = 1\n") == 0);
  CHECK(stray_line("a = \"\\\"ω\"\nb = \"\"\"ω\n\"ω\"\n\\\"\"\"ω\"\"\"\n") == 0);
  CHECK(stray_line("a = '''ω\nω'''\n") == 0);
}

TEST_CASE("and nowhere else", "[toml]") {
  CHECK(stray_line("ω = 1\n") == 1);
  CHECK(stray_line("a = 1\nω = 1\n") == 2);
  CHECK(stray_line("a = \"x\"ω\n") == 1);
  CHECK(stray_line("a = 'x\\'ω\n") == 1);
  CHECK(stray_line("a = \"x\nω = 1\n") == 2);
  CHECK(stray_line("a = \"\"\"x\"\"\"\nb = ω") == 2);
  CHECK(stray_line("# c\n\n  ω") == 3);
}
