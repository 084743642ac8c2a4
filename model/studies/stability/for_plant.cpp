// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes the design of a plant step by step: every value of the base is scaled by what the plant has
// in its place. Documentation: docs/designs.md
#include "studies/stability/for_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "design/text_edit.hpp"
#include "feltgate/absolute_encoder.hpp"
#include "feltgate/generated/map.hpp"
#include "files/toml/toml_reader.hpp"
#include "studies/stability/loop_poles.hpp"

namespace feltgate::stability {

using namespace design;
using plant::Parameters;

namespace {

using plant::Effects;

/// A number as TOML: a float keeps its point.
std::string toml_number(double value) {
  std::string text = fmt::format("{:.12g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

constexpr double pi = 3.14159265358979323846;
/// Shorter numbers for what is derived: three digits, up or down.
double three_digits(double value, double (*direction)(double)) {
  if (value == 0) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  const double digits = direction(value / unit * (1 + (direction(0.5) > 0 ? -1e-9 : 1e-9)));
  return std::strtod(fmt::format("{:.3g}", digits * unit).c_str(), nullptr);
}
double up(double value) { return three_digits(value, std::ceil); }
double down(double value) { return three_digits(value, std::floor); }

/// Integer bits that hold `value`.
int bits_of(double value) { return std::ilogb(value) + 1; }

/// What a section of scenes' keys begins with, and the scenes that have it.
struct SceneKeys {
  const char* prefix;
  std::vector<std::string> scenes;
};
const SceneKeys scene_keys[] = {{"membrane_", {"membrane"}},
                                {"compression_", {"spring_compression"}},
                                {"tension_", {"spring_tension"}},
                                {"damper_", {"damper"}},
                                {"charge_", {"charge_attract", "charge_repel"}},
                                {"wall_", {"wall"}}};

/// Edits the base step by step; later steps use what earlier ones found.
class Maker {
 public:
  Maker(const std::string& base, const Design& d, const Parameters& p, double nominal_a,
        const std::string& plant_name)
      : d_(d), m_(d), p_(p), nominal_a_(nominal_a), edit_(base, "of the plant " + plant_name) {
    edit_.set_description(fmt::format("{} with the constants of the plant {}", d.name, plant_name));
    constants();
    encoder();
    edit_.because("follows from the plant");
    clock();
    limits();
    heat();
    polarity();
    self_test();
    scenes();
    current_loop();
    formats();
    tell();
  }

  void set_emf(double emf) { set("motor", "emf_constant_v_s_rad", emf); }
  /// Leaves out the scenes of a key of [scenes]; false where it is not one's.
  bool drop(const std::string& key);
  std::string text() const { return edit_.text(); }
  std::vector<std::string> notes;

 private:
  void set(const char* section, const char* key, double value) {
    if (edit_.text_of(section, key)) edit_.set(section, key, toml_number(value));
  }
  template <class... Args>
  void note(fmt::format_string<Args...> text, Args&&... args) {
    notes.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void constants();
  void encoder();
  void clock();
  void limits();
  void heat();
  void polarity();
  void self_test();
  void scenes();
  void current_loop();
  void formats();
  void tell();

  double speed_without_load(const Design& d) const {
    return d.full_duty_v() / d.emf_constant_v_s_rad;
  }
  /// The largest step of the estimated speed that one count makes.
  double grain_rad_s() const { return m_.count_rad() * m_.velocity_cutoff_rad_s; }
  /// The current that dead time and brushes count for in the estimate.
  double dead_a() const {
    return design::parameter_values(m_).at("dead_voltage").si / m_.resistance_ohm;
  }

  const Design d_;  ///< the base
  Design m_;        ///< what is made, as far as it goes
  const Parameters& p_;
  double nominal_a_;
  TextEdit edit_;
  int slower_ = 1;  ///< ticks are so much longer than the base's
};

void Maker::constants() {
  m_.torque_constant_nm_a = p_.motor.torque_constant_nm_a;
  m_.inertia_kg_m2 = p_.lever.inertia_kg_m2;
  m_.resistance_ohm = p_.motor.resistance_ohm;
  m_.emf_constant_v_s_rad = p_.motor.back_emf_constant_v_s_rad;
  m_.dead_voltage_v = p_.effects.dead_voltage ? p_.motor.dead_voltage_v : 0;
  m_.supply_v = p_.supply.voltage_v;
  m_.diode_drop_v = p_.supply.diode_drop_v;
  set("observer", "torque_constant_nm_a", m_.torque_constant_nm_a);
  set("observer", "inertia_kg_m2", m_.inertia_kg_m2);
  set("motor", "resistance_ohm", m_.resistance_ohm);
  set("voltage", "dead_voltage_v", m_.dead_voltage_v);
  set("pwm", "supply_v", m_.supply_v);
  set("pwm", "diode_drop_v", m_.diode_drop_v);
  if (!p_.phases) return;
  edit_.set("commutation", "pole_pairs", fmt::format("{}", p_.phases->pole_pairs));
  set("commutation", "offset_rad", d_.hall ? p_.phases->hall->begin_rad : p_.phases->offset_rad);
}

/// An absolute encoder's counts are a power of two; SPI has 14 bits.
void Maker::encoder() {
  const int counts = 4 * p_.encoder.lines;
  if (!d_.absolute) {
    m_.lines = p_.encoder.lines;
    edit_.set("encoder", "lines", fmt::format("{}", m_.lines));
    const bool power_of_two = (m_.lines & (m_.lines - 1)) == 0;
    if (d_.has_index && (!power_of_two || m_.lines < 16)) {
      edit_.set("encoder", "index", "0");
      note("encoder.index is 0: the count at the index cannot be checked against {} lines",
           m_.lines);
    }
    return;
  }
  const int bits = std::ilogb(counts);
  const bool fits = d_.absolute_framing != AbsoluteEncoder::kSpi && counts == 1 << bits &&
                    bits >= 12 && bits <= 22;
  if (fits) {
    m_.absolute_bits = bits;
    m_.lines = p_.encoder.lines;
    edit_.set("absolute_encoder", "bits", fmt::format("{}", bits));
  } else if (counts != 1 << d_.absolute_bits) {
    note("absolute_encoder.bits is still {}: the plant's {} counts are no such encoder's",
         d_.absolute_bits, counts);
  }
}

/// With few counts in a turn all times of the estimates are longer: one count makes a smaller step
/// of the speed then. In ticks, and so in bits, they stay as they are.
void Maker::clock() {
  while (slower_ < 8 && d_.count_rad() * 4 * slower_ * slower_ <= m_.count_rad() * (1 + 1e-9)) {
    slower_ *= 2;
  }
  m_.tick_hz = d_.tick_hz / slower_;
  m_.velocity_cutoff_rad_s = d_.velocity_cutoff_rad_s / slower_;
  m_.observer_cutoff_rad_s = d_.observer_cutoff_rad_s / slower_;
  if (slower_ > 1) {
    edit_.set("clock", "tick_hz", fmt::format("{}", m_.tick_hz));
    set("velocity", "cutoff_rad_s", m_.velocity_cutoff_rad_s);
    set("observer", "cutoff_rad_s", m_.observer_cutoff_rad_s);
    note(
        "clock.tick_hz is {}: with {} counts in a turn one count is a step of {:.2g} rad/s of the "
        "estimated speed; in ticks of {} Hz it would be {:.2g}",
        m_.tick_hz, 4 * m_.lines, grain_rad_s(), d_.tick_hz, grain_rad_s() * slower_);
  }
  if (!d_.mt && !d_.exact_gain && m_.lines * slower_ != d_.lines) {
    // A power of two moves the binary point; any other number needs the exact factor.
    const double shift = std::log2(m_.count_rad() / d_.count_rad() / slower_);
    if (shift == std::floor(shift) && d_.n + shift >= 0 && d_.n + shift <= 12) {
      edit_.set("velocity", "n", fmt::format("{:.0f}", d_.n + shift));
    } else {
      edit_.replace("velocity", "n", "gain", "\"exact\"");
    }
  }
  // As far from the speed without load as in the base, and within what the encoder's checks follow.
  constexpr double of_a_hand_rad_s = 40, counts_in_a_tick = 16;
  double fastest = d_.overspeed_rad_s * speed_without_load(m_) / speed_without_load(d_);
  fastest = std::min(std::max(fastest, of_a_hand_rad_s), d_.overspeed_rad_s);
  const double follows =
      d_.absolute
          ? std::min(
                {pi / 4 / d_.absolute_period_s,
                 pi / 4 / d_.absolute_period_s / std::max(1, p_.phases ? p_.phases->pole_pairs : 1),
                 0x7fff * m_.count_rad() / (m_.tick_s() * (d_.m1 + d_.absolute_period_ticks()))})
          : counts_in_a_tick * m_.count_rad() * static_cast<double>(m_.tick_hz);
  fastest = std::min(fastest, follows);
  m_.overspeed_rad_s = fastest == d_.overspeed_rad_s ? fastest : down(fastest);
  set("supervisor", "overspeed_rad_s", m_.overspeed_rad_s);
}

/// The base's multiple of the nominal current, as far as the supply gives it.
void Maker::limits() {
  constexpr double most_nm = 15;
  const double ratio =
      m_.torque_constant_nm_a * nominal_a_ / (d_.torque_constant_nm_a * d_.nominal_current_a);
  double torque = d_.torque_limit_nm * ratio;
  const auto words = parameter_values(m_);
  const double volts = words.at("duty_limit").si / m_.pwm_period_clocks() * m_.full_duty_v() -
                       words.at("dead_voltage").si;
  const double supply_nm = volts / m_.resistance_ohm * m_.torque_constant_nm_a;
  if (supply_nm <= 0.1 * m_.torque_constant_nm_a * nominal_a_) {
    throw std::invalid_argument(fmt::format(
        "no design: of the supply's {:g} V the motor gets {:.2g} V beyond brushes and dead time, "
        "which is less than a tenth of the nominal {:g} A through {:g} ohm",
        p_.supply.voltage_v, std::max(volts, 0.0), nominal_a_, m_.resistance_ohm));
  }
  const auto capped = [&](double most, const std::string& why) {
    if (torque <= most) return;
    note("control.torque_limit_nm is {:.3g} instead of {:.3g}: {}", down(most), torque, why);
    torque = most;
  };
  capped(supply_nm, "the supply gives no more at standstill");
  capped(most_nm, "no design has more");
  m_.torque_limit_nm = ratio == 1 ? d_.torque_limit_nm : down(torque);
  if (p_.effects.lugre && p_.lugre.static_nm >= 0.8 * m_.torque_limit_nm) {
    throw std::invalid_argument(fmt::format(
        "no design: the friction of {:g} Nm holds the lever against the {:.3g} Nm that the motor "
        "gives at the limit of its current",
        p_.lugre.static_nm, m_.torque_limit_nm));
  }
  m_.current_limit_a = up(m_.torque_limit_nm / m_.torque_constant_nm_a);
  // A base without the key has current_limit_a there.
  const double motor_a = std::max(d_.motor_current_limit_a, d_.current_limit_a);
  m_.motor_current_limit_a = up(motor_a / d_.current_limit_a * m_.current_limit_a);
  set("control", "torque_limit_nm", m_.torque_limit_nm);
  set("control", "current_limit_a", m_.current_limit_a);
  set("motor", "motor_current_limit_a", m_.motor_current_limit_a);
  set("control", "kp_1_kg_m2", d_.kp_1_kg_m2 * d_.inertia_kg_m2 / m_.inertia_kg_m2);
  const double more = m_.torque_limit_nm / d_.torque_limit_nm;
  set("control", "ramp_nm_s", std::max(1e-3, down(d_.ramp_nm_s * more)));
  m_.dead_voltage_linear_nm = std::clamp(down(d_.dead_voltage_linear_nm * more), 1e-4, 1.0);
  set("voltage", "dead_voltage_linear_nm", m_.dead_voltage_linear_nm);
  set("supervisor", "hold_torque_nm", down(d_.hold_torque_nm * more));
  set("supervisor", "hold_limit_nm", down(d_.hold_limit_nm * more));
}

/// The largest current for as long as in the base. Dead time and brushes count as current; where
/// they would leave less than 30 % of the nominal one, what is beyond is no heat.
void Maker::heat() {
  constexpr double most_share = 0.7;
  const double beyond = std::max(0.0, dead_a() - most_share * nominal_a_);
  m_.nominal_current_a = beyond > 0 ? down(nominal_a_ + beyond) : nominal_a_;
  if (beyond > 0) {
    note(
        "supervisor.nominal_current_a is {:g} instead of {:g}: dead time and brushes count as "
        "{:.2g} "
        "A in the estimated current",
        m_.nominal_current_a, nominal_a_, dead_a());
  }
  const auto squares = [](double limit, double nominal) {
    return limit * limit - nominal * nominal;
  };
  const double seconds = d_.i2t_budget_a2_s / squares(d_.current_limit_a, d_.nominal_current_a);
  const double counted_a = m_.current_limit_a + beyond;
  const double square = std::max(squares(counted_a, m_.nominal_current_a),
                                 0.1 * m_.nominal_current_a * m_.nominal_current_a);
  const bool as_base =
      m_.nominal_current_a == d_.nominal_current_a && m_.current_limit_a == d_.current_limit_a;
  m_.i2t_budget_a2_s = as_base ? d_.i2t_budget_a2_s : up(square * seconds);
  set("supervisor", "nominal_current_a", m_.nominal_current_a);
  set("supervisor", "i2t_budget_a2_s", m_.i2t_budget_a2_s);
}

/// The growth of speed that the torque of the base's share of the limit makes in a window. It must
/// stand out from the steps that counts make, and the reversed back-EMF must leave it.
void Maker::polarity() {
  constexpr double longest_s = 0.06, above_grain = 1.5;
  const double share = d_.polarity_current_a / d_.current_limit_a;
  const auto acceleration = [share](const Design& d) {
    return share * d.torque_limit_nm / d.inertia_kg_m2;
  };
  const double of_base = d_.polarity_speed_rad_s / d_.polarity_time_s / acceleration(d_);
  const double growth = of_base * acceleration(m_);  // rad/s^2
  const double wanted = above_grain * grain_rad_s() / growth;
  const double window =
      std::min(std::max(d_.polarity_time_s * slower_, three_digits(wanted, std::ceil)), longest_s);
  const double braking = 2 * m_.torque_constant_nm_a * m_.emf_constant_v_s_rad /
                         (m_.resistance_ohm * m_.inertia_kg_m2);  // 1/s, of swapped leads
  const double left = std::exp(-braking * window) / share / of_base;
  const double speed = growth * window;
  m_.polarity_current_a = up(share * m_.current_limit_a);
  const double most = 0.5 * m_.overspeed_rad_s;
  const char* why = window * growth < above_grain * grain_rad_s()
                        ? "a count's step of the speed hides it"
                    : left < 1.1   ? "the reversed back-EMF lets the speed grow too little"
                    : speed > most ? "the speed that it needs is near overspeed_rad_s"
                                   : nullptr;
  if (why != nullptr) {
    m_.polarity_current_a = up(1.05 * m_.motor_current_limit_a);
    note(
        "the check of the growing speed (fault polarity) is off, for {}: polarity_current_a is "
        "above the limit; the self-test, if on, and overspeed_rad_s protect",
        why);
  } else {
    const double exact = d_.polarity_speed_rad_s;
    m_.polarity_speed_rad_s =
        std::abs(speed / exact - 1) < 1e-9 ? exact : std::max(0.1, down(speed));
    m_.polarity_time_s = window;
    note(
        "fault polarity: the speed grows by {:g} rad/s in each of two windows of {:g} ms against "
        "{:g} A or more",
        m_.polarity_speed_rad_s, 1e3 * window, m_.polarity_current_a);
  }
  set("supervisor", "polarity_speed_rad_s", m_.polarity_speed_rad_s);
  set("supervisor", "polarity_current_a", m_.polarity_current_a);
  set("supervisor", "polarity_time_s", m_.polarity_time_s);
}

/// The same counts of answer as in the base, by a pulse that overcomes the friction. Without
/// friction it turns the lever by torque*time^2/inertia, at torque*time/inertia at most.
void Maker::self_test() {
  if (!edit_.text_of("self_test", "torque_nm")) return;
  constexpr double most_rad = 0.25, most_rad_s = 10, of_static = 2.2;
  constexpr double most_units = (1 << Map::self_test_count_bits) - 1;
  const double unit_s = 1 / m_.self_test_units(1);
  const double longest_s = std::floor(most_units * unit_s * 1e4) * 1e-4;
  const auto counts = [](const Design& d, double torque, double seconds) {
    return 0.5 * torque / d.inertia_kg_m2 * seconds * seconds / d.self_test_count_rad();
  };
  const double wanted = counts(d_, d_.self_test_nm, d_.self_test_pulse_s);
  const double friction = p_.effects.lugre ? p_.lugre.static_nm : 0;
  // Gentle, but clear of the friction; a heavy lever gets a longer pulse, then a stronger one.
  double torque = d_.self_test_nm * m_.torque_limit_nm / d_.torque_limit_nm;
  const bool by_friction = torque < of_static * friction;
  if (by_friction) torque = of_static * friction;
  const auto seconds_for = [&](double nm) {
    return std::sqrt(2 * m_.inertia_kg_m2 * wanted * m_.self_test_count_rad() / nm);
  };
  const double lost = by_friction ? friction : 0;
  double seconds = std::max(seconds_for(torque - lost), unit_s);
  // As slow as the bounds ask for, where the friction lets it.
  const double reading_rad_s =
      d_.absolute ? 0.9 * m_.self_test_count_rad() / d_.absolute_period_s : most_rad_s;
  const double speed = std::min(most_rad_s, reading_rad_s);
  if (torque * seconds / m_.inertia_kg_m2 > speed && !by_friction) {
    seconds = std::min(2 * wanted * m_.self_test_count_rad() / speed, longest_s);
    torque =
        std::max(2 * m_.inertia_kg_m2 * wanted * m_.self_test_count_rad() / (seconds * seconds),
                 of_static * friction);
    seconds = seconds_for(torque);
  }
  if (seconds > longest_s) {
    seconds = longest_s;
    torque =
        2 * m_.inertia_kg_m2 * wanted * m_.self_test_count_rad() / (seconds * seconds) + friction;
  }
  const bool as_base = std::abs(torque / d_.self_test_nm - 1) <= noticeable &&
                       std::abs(seconds / d_.self_test_pulse_s - 1) <= noticeable;
  torque = as_base ? d_.self_test_nm : up(torque);
  seconds = as_base ? d_.self_test_pulse_s : 1e-4 * std::ceil(1e4 * seconds - 1e-6);
  seconds = std::min(seconds, longest_s);
  const double turn = torque * seconds * seconds / m_.inertia_kg_m2;
  const double fastest = torque * seconds / m_.inertia_kg_m2;
  std::string why;
  if (torque > m_.torque_limit_nm) {
    why = fmt::format("it would take {:.3g} Nm to move {:.3g} kg m^2 by {:.2g} counts in {:.3g} ms",
                      torque, m_.inertia_kg_m2, wanted, 1e3 * longest_s);
  } else if (turn > most_rad || fastest > 1.05 * speed) {
    why = fmt::format(
        "{:.2g} counts of {:.3g} rad would turn the lever by up to {:.2g} rad, at up "
        "to {:.3g} rad/s",
        wanted, m_.self_test_count_rad(), turn, fastest);
  }
  if (!why.empty()) {
    edit_.leave_out("self_test", why);
    m_.self_test = false;
    m_.self_test_nm = 0;
    note(
        "the self-test is off: {}; nothing but overspeed_rad_s and the check of the growing "
        "speed, if on, sees swapped leads",
        why);
    return;
  }
  set("self_test", "torque_nm", torque);
  if (edit_.text_of("self_test", "pulse_ms")) {
    edit_.set("self_test", "pulse_ms", toml_number(std::round(1e4 * seconds) / 10));
  }
  note(
      "self_test: a pulse of {:g} Nm for {:.4g} ms each way turns a free lever by {:.2g} rad at "
      "most, at {:.2g} rad/s at most",
      torque, 1e3 * seconds, turn, fastest);
}

/// Torques with the limit; stiffness and damping no stiffer for this inertia and these filters than
/// in the base.
void Maker::scenes() {
  const double torque = m_.torque_limit_nm / d_.torque_limit_nm;
  const double inertia = m_.inertia_kg_m2 / d_.inertia_kg_m2;
  const double cutoff = m_.velocity_cutoff_rad_s / d_.velocity_cutoff_rad_s;
  const double stiffness = std::min(torque, inertia * cutoff * cutoff);
  const double damping = std::min(torque, inertia * cutoff);
  const auto scaled = [this](const char* key, double value, double by) {
    set("scenes", key, by == 1 ? value : down(value * by));
  };
  scaled("setpoint_nm", d_.setpoint_nm, torque);
  scaled("membrane_nm", d_.membrane_nm, torque);
  scaled("compression_nm_rad", d_.compression_nm_rad, stiffness);
  scaled("tension_nm_rad", d_.tension_nm_rad, stiffness);
  scaled("damper_nm_s_rad", d_.damper_nm_s_rad, damping);
  scaled("charge_nm_rad2", d_.charge_nm_rad2, torque);
  scaled("wall_nm_s_rad", d_.wall_nm_s_rad, damping);
  // The stiffest wall that friction still quietens is 2*friction/count
  // (docs/speed-for-accuracy.md).
  constexpr double margin = 0.875;  // 4 of 4.56, as in lever
  const bool rough = p_.effects.lugre && p_.lugre.coulomb_nm > 0;
  const double quiet = margin * 2 * p_.lugre.coulomb_nm / m_.count_rad();
  const double wall = stiffness == 1 ? d_.wall_nm_rad : down(d_.wall_nm_rad * stiffness);
  const bool buzzes = rough && wall * (1 - noticeable) > quiet;
  set("scenes", "wall_nm_rad", buzzes ? down(quiet) : wall);
  if (buzzes) {
    note("scenes.wall_nm_rad is {:g}: a stiffer wall would buzz with this friction and encoder",
         down(quiet));
  }
}

void Maker::current_loop() {
  if (!d_.current_loop) return;
  const double overcurrent = up(d_.overcurrent_a / d_.current_limit_a * m_.current_limit_a);
  m_.current_full_scale_a =
      std::ldexp(1.0, std::max(-1, bits_of(d_.current_full_scale_a / d_.current_limit_a *
                                           m_.current_limit_a * 0.75)));
  if (m_.current_limit_a == d_.current_limit_a) m_.current_full_scale_a = d_.current_full_scale_a;
  set("current_loop", "full_scale_a", m_.current_full_scale_a);
  set("current_loop", "overcurrent_a", std::min(overcurrent, 0.9 * m_.current_full_scale_a));
  set("current_loop", "inductance_h", p_.phases ? p_.phases->inductance_h : p_.motor.inductance_h);
}

void Maker::formats() {
  const auto shift = [](Format f, int by) { return Format{1, f.integer + by, f.fraction - by}; };
  // As much room above the limit as in the base; a step of 2^-16 Nm or finer.
  Format torque =
      shift(d_.torque,
            static_cast<int>(std::ceil(std::log2(m_.torque_limit_nm / d_.torque_limit_nm) - 1e-9)));
  torque.integer = std::clamp(torque.integer, std::max(0, bits_of(1.05 * m_.torque_limit_nm)), 5);
  torque.fraction = std::clamp(torque.fraction, 16, 20);
  Format voltage = shift(d_.voltage, bits_of(m_.supply_v) - bits_of(d_.supply_v));
  const int guard =
      static_cast<int>(std::ceil(-std::log2(-std::expm1(-m_.observer_cutoff_rad_s * m_.tick_s()))));
  const int observer = std::max(d_.observer_fraction, torque.fraction + guard);

  // The estimated current, whose square makes the heat, has a range for the largest current and
  // for the budget (chain_formats.hpp).
  const auto coefficient = [](double value) { return coefficient_format(value, false); };
  const Format by_v = growth::product(voltage, coefficient(1 / m_.resistance_ohm));
  const Format emf = coefficient(m_.emf_constant_v_s_rad / m_.resistance_ohm);
  Format by_w = growth::product(d_.velocity, emf);
  // A slow motor needs no velocity as large as the base's; where that would make the heat's step
  // coarse, its words get finer.
  constexpr double enough_steps = 32;
  const auto steps = [this](int integer) {  // of the nominal current's square
    return m_.nominal_current_a * m_.nominal_current_a * std::ldexp(1, 16 - 2 * integer);
  };
  const double raw_rad_s = m_.mt ? 0 : m_.velocity_gain_rad_s();
  const int needed = bits_of(1.5 * m_.overspeed_rad_s + 4 * raw_rad_s);
  Format velocity = d_.velocity;
  while (velocity.integer > needed && by_w.integer > by_v.integer &&
         steps(by_w.integer) < enough_steps) {
    velocity = shift(velocity, -1);
    by_w = growth::product(velocity, emf);
  }
  const double ticks = m_.i2t_budget_a2_s * static_cast<double>(m_.tick_hz);
  const int for_heat = static_cast<int>(std::ceil((std::log2(ticks * 1.01) - 14) / 2)) - 1;
  const bool room = std::max(by_v.integer, by_w.integer) >= for_heat;
  const double most_a = std::max(m_.motor_current_limit_a, m_.polarity_current_a);
  const double base_a = std::max(d_.motor_current_limit_a, d_.current_limit_a);
  Format current = shift(d_.current, bits_of(most_a) - bits_of(base_a));
  if (d_.current_loop) {  // whose full scale bounds the current's range
    current.integer = std::min(current.integer, std::ilogb(m_.current_full_scale_a));
    if (!room) voltage = shift(voltage, for_heat - by_v.integer);
  } else if (!room) {
    current = shift(current, std::max(0, for_heat - current.integer));
  }
  const int wanted = observer - coefficient(m_.torque_constant_nm_a).fraction;
  const int width = std::max(torque.width(), voltage.width());
  current.fraction = std::max({current.fraction, wanted, width - 1 - current.integer});

  const auto put = [this](const char* key, Format was, Format f) {
    if (f == was) return;
    edit_.set("formats", key, fmt::format("[1, {}, {}]", f.integer, f.fraction));
  };
  put("velocity", d_.velocity, velocity);
  put("torque", d_.torque, torque);
  put("current", d_.current, current);
  put("voltage", d_.voltage, voltage);
  if (observer != d_.observer_fraction) {
    edit_.set("formats", "observer_fraction", fmt::format("{}", observer));
  }
}

/// What follows from several of these.
void Maker::tell() {
  const double most_a = m_.current_limit_a + dead_a();
  const double over = most_a * most_a - m_.nominal_current_a * m_.nominal_current_a;
  if (m_.current_limit_a > nominal_a_ && over > 0) {
    note(
        "the motor carries {:g} A without limit in time and {:g} A for {:.2g} s from cold, half "
        "of it after power-up (supervisor.nominal_current_a, i2t_budget_a2_s)",
        nominal_a_, m_.current_limit_a, m_.i2t_budget_a2_s / over);
  } else {
    note("the motor carries {:g} A without limit in time, and the supply gives {:g} A at most",
         nominal_a_, m_.current_limit_a);
  }
  if (d_.absolute) return;
  const double q = m_.count_rad();
  const double slowest_s = std::ldexp(Map::edge_units - 1, m_.edge_unit_bits()) * m_.tick_s();
  if (m_.lines != d_.lines) {
    note(
        "a dead channel of the encoder is a fault within {} counts of travel, {:.2g} rad, from "
        "{:.2g} rad/s on",
        2 * Map::dead_channel_edges + 2, (2 * Map::dead_channel_edges + 2) * q, 2 * q / slowest_s);
  }
  const double reach = (1 << 17) * q;
  if (reach < pi) {
    note("scenes see an angle within {:.2g} rad of 0: 2^17 counts each way", reach);
  }
}

bool Maker::drop(const std::string& key) {
  for (const SceneKeys& group : scene_keys) {
    const std::string prefix = group.prefix;
    if (key.compare(0, prefix.size(), prefix) != 0) continue;
    const toml::table root = toml::parse(edit_.text());
    std::string kept;
    for (const toml::node& node : *root["scenes"]["include"].as_array()) {
      const std::string scene = node.value_or("");
      const auto& gone = group.scenes;
      if (std::find(gone.begin(), gone.end(), scene) != gone.end()) continue;
      kept += (kept.empty() ? "\"" : ", \"") + scene + "\"";
    }
    edit_.because("does not fit its word for this plant, or its scene is left out");
    edit_.set("scenes", "include", "[" + kept + "]");
    for (const auto& [name, node] : *root["scenes"].as_table()) {
      const std::string own(name.str());
      if (own.compare(0, prefix.size(), prefix) == 0) edit_.set("scenes", own, "0.0");
    }
    note("without {}: scenes.{} does not fit its word for this plant",
         fmt::join(group.scenes, ", "), key);
    return true;
  }
  return false;
}

/// A name that can stand in a comment and between quotes.
std::string plain(std::string name) {
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte >= 127 || c == '"' || c == '\\') c = '_';
  }
  return name;
}

/// The key in the line that an error names, "" where it names none.
std::string key_of(const std::string& error, const std::string& path, const std::string& text) {
  if (error.compare(0, path.size() + 1, path + ":") != 0) return {};
  long line = std::strtol(error.c_str() + path.size() + 1, nullptr, 10);
  std::size_t at = 0;
  for (; line > 1 && at != std::string::npos; --line) at = text.find('\n', at) + 1;
  const std::string row = text.substr(at, text.find('\n', at) - at);
  return row.substr(0, row.find(' '));
}

}  // namespace

PlantDesign design_for_plant(const std::string& base, const Parameters& p, double nominal_a,
                             const std::string& as_named, const std::string& path,
                             const RegisterMap& registers) {
  const std::string plant_name = plain(as_named);
  const Design d = read_design(base);
  if (d.voltage_law != "motor_model") {
    d.fail("voltage.law",
           "the gains of the law \"" + d.voltage_law + "\" are not a plant's constants",
           "take a base with law = \"motor_model\", such as lever");
  }
  if (p.phases.has_value() != (d.phases == 3)) {
    d.fail("pwm.phases",
           fmt::format("the motor of plant {} has {}", plant_name,
                       p.phases ? "three phases" : "brushes"),
           p.phases ? "take a base that drives such a motor, gimbal_motor or hall_motor"
                    : "take a base that drives such a motor, lever or lever_absolute");
  }
  if (d.hall && !p.phases->hall) {
    d.fail("commutation.hall", fmt::format("the motor of plant {} has no Hall lines", plant_name),
           "take a base with an absolute encoder, such as gimbal_motor");
  }
  Maker maker(base, d, p, nominal_a, plant_name);
  const std::string head =
      fmt::format("# Written by: feltgate design {} --for-plant {} --nominal-current {:g}\n",
                  d.name, plant_name, nominal_a);
  PlantDesign made;
  // Where the quantised compensation of the back-EMF would exceed it, the lever speeds up by
  // itself.
  for (const double share : {1.0, 0.999, 0.99, 0.97}) {
    maker.set_emf(share * p.motor.back_emf_constant_v_s_rad);
    for (bool whole = false; !whole;) {
      made.text = head + maker.text();
      try {
        made.design = elaborate(design_from_text(made.text, path), registers);
        whole = true;
      } catch (const config::ConfigError& e) {
        if (maker.drop(key_of(e.what(), path, made.text))) continue;
        // The file of these lines is not written.
        const std::string told = e.what();
        const std::size_t place = told.find(": ");
        throw std::invalid_argument(
            fmt::format("{} with the constants of the plant {} is no design: {}", d.name,
                        plant_name, place == std::string::npos ? told : told.substr(place + 2)));
      }
    }
    if (closed_loop(made.design, p).stable()) {
      if (share < 1) {
        maker.notes.push_back(fmt::format(
            "motor.emf_constant_v_s_rad is {} of the plant's: with all of it the loop is unstable",
            share));
      }
      break;
    }
  }
  refuse_unstable(made.design, p);
  made.notes = maker.notes;
  Effects all;
  made.changed = shared_constants(d, p, all);
  const auto same = [](const Constant& c) { return std::abs(c.excess()) < 1e-9; };
  made.changed.erase(std::remove_if(made.changed.begin(), made.changed.end(), same),
                     made.changed.end());
  return made;
}

}  // namespace feltgate::stability
