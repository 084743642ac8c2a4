// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of rtl/designs/NAME.toml. Documentation: docs/designs.md
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "design/design.hpp"
#include "design/generate.hpp"
#include "feltgate/generated/engine.hpp"
#include "feltgate/generated/map.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr config::Range kCutoff{1e-12, 1e6};

Design design_of(const toml::table& root, const std::string& path);

/// The design's name from its path; it must fit C++ types and file names.
std::string name_of(const std::string& path) {
  std::string name = std::filesystem::path(path).stem().string();
  const auto bad = [](char c) {
    return !(c == '_' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'));
  };
  if (name.empty() || std::any_of(name.begin(), name.end(), bad) || name[0] < 'a') {
    throw config::ConfigError(fmt::format(
        "{}:0: a design cannot be called \"{}\"; use a to z, 0 to 9 and _, a letter first", path,
        name));
  }
  return name;
}

std::map<std::string, int> lines_of(const toml::table& root) {
  std::map<std::string, int> lines;
  for (const auto& [section, node] : root) {
    const std::string name(section.str());
    lines[name] = static_cast<int>(node.source().begin.line);
    const toml::table* table = node.as_table();
    if (table == nullptr) continue;
    for (const auto& [key, value] : *table) {
      lines[name + "." + std::string(key.str())] = static_cast<int>(value.source().begin.line);
    }
  }
  return lines;
}

Format read_format(config::TomlReader& r, const std::string& key) {
  const auto v = r.integers(key, -64, 64);
  if (v.size() != 3 || v[0] != 1) {
    r.fail(key, fmt::format("\"{}\" is no format of a signed signal", key), "write [1, I, F]");
  }
  const Format f{1, static_cast<int>(v[1]), static_cast<int>(v[2])};
  if (f.width() < 2) {
    r.fail(key, fmt::format("\"{}\" has less than two bits", key), "raise I or F");
  }
  return f;
}

void read_control(config::TomlReader& r, Design& d) {
  // Kp = 1/Jn is a choice of the law and not a number: it makes the observer's gain zero.
  if (r.has("kp")) {
    (void)r.choice("kp", {"1/inertia"});
    if (r.has("kp_1_kg_m2")) {
      r.fail("kp_1_kg_m2", "Kp is given twice", "keep one of kp and kp_1_kg_m2");
    }
    d.kp_1_kg_m2 = 1.0 / d.inertia_kg_m2;
  } else {
    d.kp_1_kg_m2 = r.number("kp_1_kg_m2", {0.0, 1e6});
  }
  d.torque_limit_nm = r.number("torque_limit_nm", {0.0, 15.0});
  d.current_limit_a = r.number("current_limit_a", {0.0, 1000.0});
  d.ramp_nm_s = r.number("ramp_nm_s", {1e-3, 1e5});
}

void read_voltage(config::TomlReader& r, Design& d) {
  const std::vector<std::string> laws{"regions", "motor_model"};
  d.voltage_law = laws[r.choice("law", laws)];
  d.dead_voltage_linear_nm = r.number("dead_voltage_linear_nm", {1e-4, 1.0});
  if (r.has("ramp_v_s")) d.voltage_ramp_v_s = r.number("ramp_v_s", {1.0, 1e6});
  if (d.voltage_law == "regions") {
    d.kv_low = r.number("kv_low", {0.0, 100.0});
    d.kv_high = r.number("kv_high", {0.0, 100.0});
    d.region_nm = r.number("region_nm", {0.0, 15.0});
  } else {
    d.dead_voltage_v = r.number("dead_voltage_v", {0.0, 24.0});
  }
}

void read_scenes(config::TomlReader& r, Design& d) {
  d.scenes = r.texts("include");
  d.setpoint_nm = r.number("setpoint_nm", {-15.0, 15.0});
  d.membrane_lower_rad = r.number("membrane_lower_rad", {-200.0, 200.0});
  d.membrane_upper_rad = r.number("membrane_upper_rad", {d.membrane_lower_rad, 200.0});
  d.membrane_nm = r.number("membrane_nm", {0.0, 15.0});
  d.compression_contact_rad = r.number("compression_contact_rad", {-200.0, 200.0});
  d.compression_nm_rad = r.number("compression_nm_rad", {0.0, 1000.0});
  d.tension_rest_rad = r.number("tension_rest_rad", {-200.0, 200.0});
  d.tension_nm_rad = r.number("tension_nm_rad", {0.0, 1000.0});
  d.damper_nm_s_rad = r.number("damper_nm_s_rad", {0.0, 100.0});
  d.charge_centre_rad = r.number("charge_centre_rad", {-200.0, 200.0});
  d.charge_nm_rad2 = r.number("charge_nm_rad2", {0.0, 0.15});
  d.charge_core_rad = r.number("charge_core_rad", {0.0, 10.0});
  d.wall_contact_rad = r.number("wall_contact_rad", {-200.0, 200.0});
  d.wall_nm_rad = r.number("wall_nm_rad", {0.0, 1000.0});
  d.wall_nm_s_rad = r.number("wall_nm_s_rad", {0.0, 100.0});
}

void read_supervisor(config::TomlReader& r, Design& d) {
  d.overspeed_rad_s = r.number("overspeed_rad_s", {1.0, 1e5});
  d.nominal_current_a = r.number("nominal_current_a", {0.01, 1000.0});
  d.i2t_budget_a2_s = r.number("i2t_budget_a2_s", {1e-3, 1e6});
  d.polarity_speed_rad_s = r.number("polarity_speed_rad_s", {0.1, 1e4});
  d.polarity_current_a = r.number("polarity_current_a", {0.0, 1000.0});
  d.polarity_time_s = r.number("polarity_time_s", {1e-6, 0.06});
  d.watchdog_s = r.number("watchdog_s", {1e-4, 10.0});
  // The defaults are half and a quarter of the torque limit.
  const auto or_else = [&r](const char* key, config::Range range, double without) {
    return r.has(key) ? r.number(key, range) : without;
  };
  d.hold_torque_nm = or_else("hold_torque_nm", {0.0, 15.0}, d.torque_limit_nm / 2);
  d.hold_limit_nm = or_else("hold_limit_nm", {0.0, 15.0}, d.hold_torque_nm / 2);
  d.hold_s = or_else("hold_s", {1e-3, 1e3}, 5.0);
  d.require_watchdog = r.flag_or("require_watchdog", false);
}

/// Reads [self_test]. The pulse must move the lever's own inertia by the counts of the expected
/// answer.
void read_self_test(config::TomlReader& r, Design& d) {
  d.self_test = r.choice("mode", {"off", "on"}) == 1;
  d.self_test_nm = r.number("torque_nm", {1e-4, 15.0});
  d.self_test_pulse_s = 1e-3 * r.number("pulse_ms", {0.1, 1000.0});
  d.self_test_quiet_s = 1e-3 * r.number("quiet_ms", {0.1, 1000.0});
  d.arm_when_held = r.flag("arm_when_held");
  d.arm_when_moving = r.flag("arm_when_moving");
  const auto fits = [&r, &d](const char* key, double seconds) {
    constexpr double most = (1 << Map::self_test_count_bits) - 1;
    const double units = d.self_test_units(seconds);
    // Without a test, a time may be too short for the ticks of the design.
    if (units <= most && (units >= 0.5 || !d.self_test)) return;
    r.fail(key,
           fmt::format("\"{}\" is {:.3g} units of {} ticks", key, units,
                       1 << Map::self_test_unit_bits),
           fmt::format("choose {:.3g} to {:.3g} ms", 1e3 / d.self_test_units(1.0),
                       1e3 * most / d.self_test_units(1.0)));
  };
  fits("pulse_ms", d.self_test_pulse_s);
  fits("quiet_ms", d.self_test_quiet_s);
  if (d.self_test_nm > d.torque_limit_nm) {
    r.fail("torque_nm",
           fmt::format("the self-test's {:g} Nm are more than the torque limit of {:g} Nm",
                       d.self_test_nm, d.torque_limit_nm),
           "lower it");
  }
  const double pulse_s =
      d.self_test ? std::round(d.self_test_units(d.self_test_pulse_s)) / d.self_test_units(1.0)
                  : d.self_test_pulse_s;
  const double counts =
      0.5 * d.self_test_nm / d.inertia_kg_m2 * pulse_s * pulse_s / d.self_test_count_rad();
  if (counts < Map::self_test_counts) {
    r.fail("torque_nm",
           fmt::format("the self-test's pulse moves the inertia of {:.3g} kg m^2 by {:.3g} counts, "
                       "less than the {} that its answer takes",
                       d.inertia_kg_m2, counts, Map::self_test_counts),
           "raise torque_nm or pulse_ms");
  }
}

/// Reads [velocity]: the N-method, or M/T.
void read_velocity(config::TomlReader& r, Design& d) {
  d.mt = r.has("estimator") && r.choice("estimator", {"n_method", "mt"}) == 1;
  const char* const others[] = {"m1", "n", "gain", "window_s", "cycles"};
  for (const char* key : others) {
    const bool of_mt = key == others[3] || key == others[4];
    if (of_mt == d.mt || !r.has(key)) continue;
    r.fail(
        key, fmt::format("velocity.{} is of the {}", key, of_mt ? "estimator mt" : "N-method"),
        d.mt ? "leave it out, or estimator = \"mt\"" : "leave it out, or write estimator = \"mt\"");
  }
  if (d.mt) {
    if (r.has("window_s")) d.mt_window_s = r.number("window_s", {0.0, 0.02});
    if (r.has("cycles")) d.mt_cycles = static_cast<int>(r.integer("cycles", 1, 128));
    if ((d.mt_cycles & (d.mt_cycles - 1)) != 0) {
      r.fail("cycles", fmt::format("{} cycles are no power of two", d.mt_cycles),
             "write 1, 2, 4 and so on, up to 128");
    }
    // Bounds of options/mt/span_meter.sv: its time stamps have 26 bits.
    if (d.mt_window_clocks() >= 1 << 21) {
      r.fail("window_s", "the window is 2^21 clocks or longer", "shorten it");
    }
  } else {
    d.m1 = static_cast<int>(r.integer("m1", 1, 1534));
    // If the tick rate is not near 1 MHz, no power of two is near the exact factor.
    d.exact_gain = r.has("gain");
    if (d.exact_gain) {
      if (r.has("n")) r.fail("n", "velocity.n and velocity.gain exclude each other", "keep one");
      if (r.text("gain") != "exact")
        r.fail("gain", "velocity.gain takes only \"exact\"", "write gain = \"exact\", or n");
    } else {
      d.n = static_cast<int>(r.integer("n", 0, 12));
    }
  }
  d.velocity_cutoff_rad_s = r.number("cutoff_rad_s", kCutoff);
}

/// Reads [engine]: programs that compute the torque of the scene law.
void read_engine(config::TomlReader& r, Design& d) {
  d.engine = true;
  d.engine_max_age_s = 1e-3 * (r.has("max_age_ms") ? r.number("max_age_ms", {1e-3, 1e5}) : 1.0);
  constexpr int most = (1 << EngineMap::age_bits) - 1;
  if (d.engine_max_age_ticks() > most) {
    r.fail("max_age_ms",
           fmt::format("\"max_age_ms\" is {} ticks, more than {}", d.engine_max_age_ticks(), most),
           fmt::format("choose up to {:g} ms", 1e3 * most * d.tick_s()));
  }
  if (std::find(d.scenes.begin(), d.scenes.end(), "law") == d.scenes.end()) {
    d.fail("scenes.include", "no scene takes the torque of the engine",
           "add \"law\", or leave [engine] out");
  }
}

}  // namespace

int Design::engine_max_age_ticks() const {
  if (!engine) return 0;
  return std::max(1,
                  static_cast<int>(std::lround(engine_max_age_s * static_cast<double>(tick_hz))));
}

double Design::self_test_units(double seconds) const {
  return seconds * static_cast<double>(tick_hz) / (1 << Map::self_test_unit_bits);
}

double Design::counts_per_tick() const { return overspeed_rad_s * tick_s() / count_rad(); }

bool Design::fast_edges() const {
  constexpr double slow = 0.5;  // edges of both channels are then 2 ticks apart
  return !absolute && counts_per_tick() > slow;
}

int Design::edge_unit_bits() const {
  constexpr int of_lever = 6;
  if (absolute) return of_lever;
  // With one live channel an edge comes every two counts. From 2.5 rad/s on they are to be a row,
  // whatever the counts; but a hand that trembles over an edge makes one every 40 ms.
  constexpr double of_counts = 4096, of_tick_hz = 1e6, trembles_s = 0.04;
  const double coarser = of_counts / (4.0 * lines) * static_cast<double>(tick_hz) / of_tick_hz;
  const double bits = std::ceil(of_lever + std::log2(coarser) - 1e-3);
  const double most = std::floor(std::log2(trembles_s / (tick_s() * Map::edge_units)));
  return static_cast<int>(std::max(1.0, std::min(bits, most)));
}

int Design::self_test_drop() const {
  constexpr double finest = 16384;
  return std::max(0, std::ilogb(4.0 * lines / finest));
}

double Design::self_test_count_rad() const { return std::ldexp(count_rad(), self_test_drop()); }

int Design::dead_clocks() const {
  return static_cast<int>(std::lround(dead_time_s * static_cast<double>(clock_hz)));
}

int Design::shortest_clocks() const {
  // Rounds up, with a tolerance for the rounding of the product.
  const double clocks = std::ceil(shortest_pulse_s * static_cast<double>(clock_hz) - 1e-6);
  return std::max(1, static_cast<int>(clocks));
}

void Design::fail(const std::string& key, const std::string& what, const std::string& mend) const {
  auto at = lines_of.find(key);
  if (at == lines_of.end()) at = lines_of.find(key.substr(0, key.find('.')));
  const int line = at == lines_of.end() ? 0 : at->second;
  throw config::ConfigError(fmt::format("{}:{}: {}; {}", path, line, what, mend));
}

double Design::velocity_gain_rad_s() const {
  return count_rad() * static_cast<double>(tick_hz) / m1;
}

int Design::mt_window_clocks() const {
  return static_cast<int>(std::lround(mt_window_s * static_cast<double>(clock_hz)));
}

void Design::needs_n_method(const std::string& what) const {
  if (!mt) return;
  fail("velocity.estimator", what + " knows the N-method alone",
       "take estimator = \"n_method\" for it");
}

double Design::count_rad() const { return 2.0 * pi / (4.0 * lines); }

Design read_design(const std::string& path) {
  return design_of(config::parse_toml_file(path), path);
}

Design design_from_text(const std::string& text, const std::string& path) {
  return design_of(config::parse_toml_text(text, path), path);
}

namespace {

Design design_of(const toml::table& root, const std::string& path) {
  config::TomlReader top(root, path, "the design");
  Design d;
  d.path = path;
  d.name = name_of(path);
  d.lines_of = lines_of(root);
  d.description = top.text("description");
  const auto section = [&](const char* key, auto&& use) {
    config::TomlReader r = top.section(key);
    use(r);
    r.finish();
  };
  const auto option = [&](const char* key, auto&& use) {
    if (top.has(key)) section(key, use);
  };
  section("clock", [&](config::TomlReader& r) {
    d.clock_hz = r.integer("clock_hz", 1'000'000, 400'000'000);
    d.tick_hz = r.integer("tick_hz", 1'000, 2'000'000);
    if (d.clock_hz % d.tick_hz != 0) {
      r.fail("tick_hz", "clock_hz is not a multiple of tick_hz", "choose a divisor of the clock");
    }
  });
  option("absolute_encoder", [&](config::TomlReader& r) { read_absolute_encoder(r, d); });
  section("encoder", [&](config::TomlReader& r) {
    d.encoder_polarity = static_cast<int>(r.integer("polarity", 0, 1));
    if (d.absolute) return;
    d.lines = static_cast<int>(r.integer("lines", 1, 1'000'000));
    d.filter_samples = static_cast<int>(r.integer("filter_samples", 0, 15));
    d.has_index = r.has("index") && r.integer("index", 0, 1) == 1;
    if (d.has_index && (d.lines < 16 || (d.lines & (d.lines - 1)) != 0)) {
      r.fail("index", fmt::format("an index cannot be checked against {} lines", d.lines),
             "leave index out, or take an encoder of 2^n lines, 16 or more");
    }
  });
  section("velocity", [&](config::TomlReader& r) { read_velocity(r, d); });
  section("observer", [&](config::TomlReader& r) {
    d.observer_cutoff_rad_s = r.number("cutoff_rad_s", kCutoff);
    d.torque_constant_nm_a = r.number("torque_constant_nm_a", {1e-5, 10.0});
    d.inertia_kg_m2 = r.number("inertia_kg_m2", {1e-9, 10.0});
  });
  section("control", [&](config::TomlReader& r) { read_control(r, d); });
  section("voltage", [&](config::TomlReader& r) { read_voltage(r, d); });
  section("motor", [&](config::TomlReader& r) {
    d.resistance_ohm = r.number("resistance_ohm", {1e-3, 1e3});
    d.emf_constant_v_s_rad = r.number("emf_constant_v_s_rad", {0.0, 10.0});
    if (r.has("motor_current_limit_a")) {
      d.motor_current_limit_a = r.number("motor_current_limit_a", {1e-3, 1000.0});
    }
  });
  section("pwm", [&](config::TomlReader& r) {
    d.pwm_hz = r.integer("frequency_hz", 1'000, 1'000'000);
    if (d.clock_hz % d.pwm_hz != 0 || d.clock_hz / d.pwm_hz > 4095) {
      r.fail("frequency_hz", "the PWM period is not a whole number of clocks up to 4095",
             "choose another frequency");
    }
    if (r.has("phases")) d.phases = static_cast<int>(r.integer("phases", 2, 3));
    d.pwm_mode = static_cast<int>(r.choice("mode", {"sign_magnitude", "locked_antiphase"}));
    d.motor_polarity = static_cast<int>(r.integer("polarity", 0, 1));
    d.dead_time_s = r.number("dead_time_s", {0.0, 1e-5});
    const bool given = r.has("shortest_pulse_s");
    if (given) d.shortest_pulse_s = r.number("shortest_pulse_s", {0.0, 5e-6});
    if (d.shortest_clocks() > 255 ||
        (d.shortest_clocks() > 1 &&
         2 * (d.dead_clocks() + d.shortest_clocks()) > d.pwm_period_clocks())) {
      r.fail(given ? "shortest_pulse_s" : "frequency_hz",
             fmt::format("the shortest pulse of {:g} s is longer than 255 clocks, or with the dead "
                         "time than half a period",
                         d.shortest_pulse_s),
             given ? "shorten it, or choose a lower frequency_hz"
                   : "lower frequency_hz, or write a shortest_pulse_s that your driver can follow");
    }
    d.diode_drop_v = r.number("diode_drop_v", {0.0, 5.0});
    d.compensate_dead_time = r.integer("compensate_dead_time", 0, 1) == 1;
    d.supply_v = r.number("supply_v", {1.0, 100.0});
  });
  option("commutation", [&](config::TomlReader& r) { read_commutation(r, d); });
  section("supervisor", [&](config::TomlReader& r) { read_supervisor(r, d); });
  option("self_test", [&](config::TomlReader& r) { read_self_test(r, d); });
  section("scenes", [&](config::TomlReader& r) { read_scenes(r, d); });
  section("formats", [&](config::TomlReader& r) {
    d.velocity = read_format(r, "velocity");
    d.torque = read_format(r, "torque");
    d.current = read_format(r, "current");
    d.voltage = read_format(r, "voltage");
    d.observer_fraction = static_cast<int>(r.integer("observer_fraction", 0, 48));
    const Round modes[] = {Round::half_up, Round::truncate, Round::convergent};
    if (r.has("rounding"))
      d.rounding = modes[r.choice("rounding", {"half_up", "floor", "convergent"})];
  });
  option("engine", [&](config::TomlReader& r) { read_engine(r, d); });
  option("axes",
         [&](config::TomlReader& r) { d.axes = static_cast<int>(r.integer("count", 1, 3)); });
  option("current_loop", [&](config::TomlReader& r) { read_current_loop(r, d); });
  top.finish();
  return d;
}

}  // namespace

}  // namespace feltgate::design
