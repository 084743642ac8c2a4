// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design point in SI units, as read from rtl/designs/NAME.toml, and the quantised parameters and
// formats derived from it. Documentation: docs/designs.md
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "design/registers.hpp"
#include "feltgate/absolute_encoder.hpp"
#include "feltgate/chain_formats.hpp"
#include "feltgate/current_check.hpp"
#include "feltgate/current_control.hpp"
#include "feltgate/fixed.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate::config {
class TomlReader;
}

namespace feltgate::design {

/// The numbers of a design file; units are in the names.
struct Design {
  std::string name, path, description;
  std::int64_t clock_hz = 0, tick_hz = 0;
  int lines = 0, filter_samples = 0, encoder_polarity = 0;
  bool has_index = false;
  int m1 = 0, n = 0;        ///< of the N-method; 0 with M/T
  bool exact_gain = false;  ///< the quantised exact factor replaces 2^n
  bool mt = false;          ///< velocity by M/T over whole cycles
  double mt_window_s = 0;   ///< of a shorter span twice the cycles are taken
  int mt_cycles = 1;        ///< at most; a power of two
  double velocity_cutoff_rad_s = 0;
  double observer_cutoff_rad_s = 0, torque_constant_nm_a = 0, inertia_kg_m2 = 0;
  double kp_1_kg_m2 = 0, torque_limit_nm = 0, current_limit_a = 0, ramp_nm_s = 0;
  std::string voltage_law;  ///< "regions" or "motor_model"
  double kv_low = 0, kv_high = 0, region_nm = 0;
  double dead_voltage_v = 0, dead_voltage_linear_nm = 0;
  double resistance_ohm = 0, emf_constant_v_s_rad = 0;
  double motor_current_limit_a =
      0;                           ///< of the window around the back-EMF; 0: what the law asks for
  double voltage_ramp_v_s = 2400;  ///< of direct voltage mode
  std::int64_t pwm_hz = 0;
  int pwm_mode = 0, motor_polarity = 0;
  double dead_time_s = 0, shortest_pulse_s = 0.2e-6, supply_v = 0;
  double diode_drop_v = 0;
  bool compensate_dead_time = false;
  double overspeed_rad_s = 0, nominal_current_a = 0, i2t_budget_a2_s = 0;
  double polarity_speed_rad_s = 0, polarity_current_a = 0, polarity_time_s = 0, watchdog_s = 0;
  double hold_torque_nm = 0, hold_s = 0, hold_limit_nm = 0;
  bool require_watchdog = false;  ///< arming waits for the first kick
  // [self_test], optional: without it there is no test, and the words disable it.
  bool self_test = false, arm_when_held = true, arm_when_moving = true;
  double self_test_nm = 0, self_test_pulse_s = 0, self_test_quiet_s = 0;
  std::vector<std::string> scenes;
  double setpoint_nm = 0, membrane_lower_rad = 0, membrane_upper_rad = 0, membrane_nm = 0;
  double compression_contact_rad = 0, compression_nm_rad = 0;
  double tension_rest_rad = 0, tension_nm_rad = 0, damper_nm_s_rad = 0;
  double charge_centre_rad = 0, charge_nm_rad2 = 0, charge_core_rad = 0;
  double wall_contact_rad = 0, wall_nm_rad = 0, wall_nm_s_rad = 0;
  Format velocity{}, torque{}, current{}, voltage{};
  int observer_fraction = 0;
  Round rounding = Round::half_up;  ///< where the chain rounds
  int axes = 1;                     ///< motors, each with an encoder; they share tick and port
  bool engine = false;              ///< programs compute the torque of the scene law
  double engine_max_age_s = 0;      ///< largest age of a torque; beyond: fault `engine`
  // [current_loop], optional: the measured current is controlled, by a voltage for each PWM period.
  bool current_loop = false;
  double current_full_scale_a = 0;  ///< at which the modulator clips; a power of two
  double current_bandwidth_hz = 0, inductance_h = 0, overcurrent_a = 0;
  bool driver_fault = false, heartbeat = false;  ///< pins of the core
  // [absolute_encoder], optional: it takes the place of A, B and Z.
  bool absolute = false;
  int absolute_framing = 0, absolute_bits = 0, absolute_diagnosis = 0;
  double absolute_serial_hz = 0, absolute_gap_s = 0, absolute_period_s = 0;
  // [commutation], with [pwm] phases = 3: three legs turn the voltage with the motor.
  int phases = 2;  ///< legs of the bridge
  int pole_pairs = 0;
  double commutation_offset_rad = 0;  ///< electrical
  bool hall = false;          ///< three Hall lines give the angle at which the encoder begins
  bool allow_coarse = false;  ///< not in the file: accept a resolution coarser than promised
  std::map<std::string, int> lines_of;  ///< line of each "section.key" in the file, for errors

  int clocks_per_tick() const { return static_cast<int>(clock_hz / tick_hz); }
  int pwm_period_clocks() const { return static_cast<int>(clock_hz / pwm_hz); }
  /// The voltage of a duty of a whole period: the supply, of three phases supply_v/sqrt(3).
  double full_duty_v() const;
  /// Whether the voltage law compensates the back-EMF.
  bool emf_in_law() const { return voltage_law == "motor_model"; }
  /// Of the monitor of dead channels: bits of the ticks in which the time between edges is counted,
  /// and whether several counts come in a tick.
  int edge_unit_bits() const;
  bool fast_edges() const;
  /// Counts in a tick at the fastest motion.
  double counts_per_tick() const;
  /// The self-test takes 2^n counts for one, so that its counts are no finer than 16384 in a turn.
  int self_test_drop() const;
  double self_test_count_rad() const;
  /// A time in the units of the self-test: 2^SELF_TEST_UNIT_BITS ticks.
  double self_test_units(double seconds) const;
  int dead_clocks() const;
  int shortest_clocks() const;  ///< shortest pulse at a gate
  /// engine_max_age_s in ticks, at least one; 0 without an engine.
  int engine_max_age_ticks() const;
  double tick_s() const { return 1.0 / static_cast<double>(tick_hz); }
  /// One count in radians.
  double count_rad() const;
  /// The exact factor of the N-method, 2*pi/(Er*Tp*m1) in rad/s per count.
  double velocity_gain_rad_s() const;
  int mt_window_clocks() const;
  AbsoluteEncoder::Parameters absolute_parameters() const;
  int absolute_period_ticks() const;  ///< from reading to reading
  int absolute_delay_ticks() const;   ///< from the angle to the tick that has it
  /// Clock of the PWM period in which the window of its current begins: the window's middle is that
  /// of the pulse at the terminals.
  int current_strobe_clock() const;
  /// Words of the controller and the check of a measured current; of a design without, meaningless.
  CurrentGains current_loop_gains() const;
  CurrentCheckWords current_loop_check() const;
  /// Refuses M/T for `what`, which knows the N-method alone.
  void needs_n_method(const std::string& what) const;
  /// Throws config::ConfigError at the line of "section.key".
  [[noreturn]] void fail(const std::string& key, const std::string& what,
                         const std::string& mend) const;
};

/// A parameter with its value in the design: in SI, quantised, and the format that relates them.
struct Word {
  Parameter parameter;
  std::string key;  ///< "section.key" of the design file that decides the value
  Format format{};
  double si = 0;         ///< exact value, in the parameter's unit
  std::int64_t raw = 0;  ///< the integer in the parameter RAM
  /// The format of its register in params_t: a limit has no sign, a coefficient a whole mantissa,
  /// an integer the bits of the register map.
  Format field() const;
  double quantised() const;
  double relative_error() const;  ///< (quantised-si)/si; 0 if si is 0
};

/// A design with all values derived from it.
struct Elaborated {
  Design design;
  RegisterMap registers;
  std::vector<Word> words;
  std::int64_t velocity_gain = 0;  ///< mantissa of the quantised gain; 0 if 2^n is used
  BaseFormats base{};
  Formats formats{};

  const Word& word(const std::string& name) const;
  /// The core's factor for one count in m1 ticks, rad/s.
  double rad_s_per_count() const;
};

/// Reads a design file. Throws config::ConfigError: unknown or missing key, wrong type, value out
/// of range.
Design read_design(const std::string& path);
/// The same for the text of a file that is not written yet; errors name it `path`.
Design design_from_text(const std::string& text, const std::string& path);

/// Reads [absolute_encoder], and refuses what of it cannot work.
void read_absolute_encoder(config::TomlReader& r, Design& d);
void check_absolute_encoder(const Design& d);
/// The same for [commutation] and [current_loop].
void read_commutation(config::TomlReader& r, Design& d);
void check_commutation(const Design& d);
void read_current_loop(config::TomlReader& r, Design& d);
void check_current_loop(const Design& d);

/// Quantises the design against a register map and checks it. Throws config::ConfigError when a
/// coefficient quantises to 0, a width exceeds the fabric, a parameter does not fit its word, the
/// latency exceeds the tick, or a resolution is coarser than promised; design.allow_coarse permits
/// the last one, for exploration.
Elaborated elaborate(const Design& design, const RegisterMap& registers);

/// Bits of a coefficient's mantissa, without its sign.
constexpr int coefficient_bits = fabric::multiplier_b_bits - 1;

/// The format of an unsigned (or signed) mantissa for `value`. The value uses the top bit, so a
/// register can raise it to just below the next power of two. Below 2^-32 the binary point stays
/// and the mantissa loses bits; 0 gets [S,0,17].
Format coefficient_format(double value, bool is_signed);

/// The most fraction bits that a coefficient may have.
constexpr int coefficient_fraction_max = 48;

/// Clocks from the sampled position to the duty register; of a charge, which divides, more.
constexpr int latency_clocks = 25, charge_latency_clocks = 43;
/// A tick is at least so long: two clocks before the sample, the chain of a charge, and the
/// snapshot's last words.
constexpr int least_tick_clocks = 50;

}  // namespace feltgate::design

// Reduces a design to the blocks that some scenes need.

namespace feltgate::design {

/// Text of the design file `path` with [scenes] include reduced to `laws` (names of scenes in the
/// register map) and "free", in the file's order. `comment` comes first, with # before each line.
/// Throws config::ConfigError when the design does not build one of the laws.
std::string text_for_scenes(const std::string& path, const std::set<std::string>& laws,
                            const std::string& comment);

}  // namespace feltgate::design

// Computes the value of every parameter from a design.

namespace feltgate::design {

/// A parameter's value in its unit and the key of the design file that decides it.
struct Value {
  double si;
  const char* key;
};

/// The values by the parameters' names in the register map.
std::map<std::string, Value> parameter_values(const Design& d);

}  // namespace feltgate::design
