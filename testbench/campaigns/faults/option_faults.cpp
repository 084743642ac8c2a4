// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Faults at the pins that lever does not have. Documentation: docs/testing.md
#include "campaigns/faults/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "campaigns/faults/option_rig.hpp"

namespace feltgate::faults {

namespace {

using test::Random;
using Defect = AbsoluteSensor::Defect;

/// A torque of 0.3 to 1 of the limit, and a hand that moves up to so fast.
Case asked(Random* r, double limit_nm, double most_rad_s, double least_rad_s = 0) {
  Case c;
  c.torque_nm = sign(r) * limit_nm * (0.3 + 0.7 * share(r));
  c.rad_s = sign(r) * (least_rad_s + (most_rad_s - least_rad_s) * share(r));
  c.from_rad = share(r);
  return c;
}

/// A sensor that is plugged in after the request to arm: nobody asks again, so no gate may open.
/// The last kind of each design, so that the others keep their seeds.
constexpr PinKind late_sensor{"late sensor", "pins", 1, Promise::refused};

/// One of the sensors of design D.
template <class D>
Case late_case(Random* r) {
  Case c = asked(r, Rig<D>::info().find("torque_limit")->si, 0);
  Harm& h = c.harm;
  if (D::current_loop != 0 && (D::absolute_encoder == 0 || r->coin())) {
    h.modulator = r->coin() ? Harm::Line::low : Harm::Line::high;
    h.shunts = D::phases == 3 ? 1 + static_cast<unsigned>(r->below(2)) : 1;
  } else {
    h.sensor = AbsoluteSensor::Defect::cut;
    h.hall_high = 7;
  }
  h.late_s = 1e-4 + 0.03 * share(r);
  c.seconds = h.late_s + 0.013;  // the offset of a current takes 512 PWM periods
  c.what = fmt::format("{:.1f} ms, ", 1e3 * h.late_s);
  return c;
}

const std::vector<PinKind> current_kinds{
    {"modulator's line stands", "pins", 1, Promise::flagged, 22},
    {"modulator's line is noise", "pins", 1, Promise::flagged, 500},
    {"shunt's wires swapped", "pins", 1, Promise::flagged},
    {"shunt's wires off", "pins", 1, Promise::flagged, 500},
    {"shunt or modulator off by a factor", "pins", 1, Promise::unseen},
    {"shunt's offset", "pins", 1, Promise::unseen},
    {"motor's terminals shorted", "pins", 1, Promise::flagged},
    {"nFAULT", "pins", 1, Promise::flagged, 1},
    {"a gate stays off", "pins", 1, Promise::none},
    {"a lead is loose", "pins", 1, Promise::flagged, 500},
    {"cable cut, moving", "pins", 1, Promise::unseen},
    {"stop", "pins", 1, Promise::flagged, 1},
    {"shunt's wires off at arming", "pins", 1, Promise::flagged, 25000},
    late_sensor,
};

Case current_case(std::string_view name, Random* r, double limit_nm = 0.5, double most_rad_s = 30) {
  using Line = Harm::Line;
  Case c = asked(r, limit_nm, most_rad_s);
  Harm& h = c.harm;
  c.seconds = 0.02;
  if (name == "modulator's line stands") {
    constexpr std::array lines{Line::low, Line::high, Line::held};
    const auto n = r->below(lines.size());
    h.modulator = lines[n];
    c.what = n == 0 ? "low, " : n == 1 ? "high, " : "held, ";
  } else if (name == "modulator's line is noise") {
    h.modulator = Line::noise;
  } else if (name == "shunt's wires swapped") {
    h.reads = -1;
  } else if (name == "shunt's wires off") {
    h.reads = 0;
    c.free = r->coin();
    c.seconds = 0.1;
  } else if (name == "shunt's wires off at arming") {
    h.reads = 0;
    c.at_arming = c.free = true;
    c.seconds = 0.05;
  } else if (name == "shunt or modulator off by a factor") {
    h.reads = std::pow(2.0, 2 * share(r) - 1);
    c.what = fmt::format("{:.2f}, ", h.reads);
  } else if (name == "shunt's offset") {
    h.offset_a = sign(r) * (0.3 + 2.7 * share(r));
    c.what = fmt::format("{:.2f} A, ", h.offset_a);
  } else if (name == "motor's terminals shorted") {
    h.shorted = true;
    c.seconds = 0.005;
  } else if (name == "nFAULT") {
    h.driver_fault = true;
    c.seconds = 0.001;
  } else if (name == "a gate stays off") {
    const auto n = r->below(4);
    h.dead_gates = 1U << n;
    c.what = fmt::format("gate {}, ", n);
  } else if (name == "a lead is loose") {
    h.dead_gates = 0xf;
    h.loose_s = 0.001 + 0.009 * share(r);
    c.what = fmt::format("{:.1f} ms, ", 1e3 * h.loose_s);
  } else if (name == "cable cut, moving") {
    c = asked(r, 0.5, 99, 3);
    c.harm.channels_held = true;
    c.seconds = 0.06;
  } else if (name == "stop") {
    h.stop = true;
    c.seconds = 0.001;
  } else {
    throw std::logic_error(fmt::format("no fault is made for the kind \"{}\"", name));
  }
  return c;
}

const std::vector<PinKind> sensor_kinds{
    {"encoder's wire cut", "pins", 1, Promise::flagged, 600},
    {"encoder's data at ground", "pins", 1, Promise::flagged, 2000},
    {"a bit of each frame wrong", "pins", 1, Promise::flagged, 400},
    {"noise on the encoder's data", "pins", 1, Promise::none},
    {"magnet lost", "pins", 1, Promise::flagged, 400},
    {"angle off by half a turn", "pins", 1, Promise::flagged, 400},
    {"magnet slips", "pins", 1, Promise::unseen},
    {"angle freezes", "pins", 1, Promise::flagged, 2000},
    {"angle freezes, slower", "pins", 1, Promise::unseen},
};

std::vector<PinKind> with_sensor(std::vector<PinKind> others) {
  others.insert(others.begin(), sensor_kinds.begin(), sensor_kinds.end());
  return others;
}

const std::vector<PinKind> gimbal_kinds = with_sensor({
    {"a phase opens", "pins", 1, Promise::unseen},
    {"a gate stays off", "pins", 1, Promise::none},
    {"wrong offset at arming", "pins", 1, Promise::flagged, 30500},
    {"a lesser wrong offset", "pins", 1, Promise::unseen},
    {"phases swapped at arming", "pins", 1, Promise::none},
    {"stop", "pins", 1, Promise::flagged, 1},
    late_sensor,
});

const std::vector<PinKind> absolute_kinds = [] {
  std::vector<PinKind> all = with_sensor({
      {"wrong angle from power-up", "pins", 1, Promise::unseen},
      {"a bit of the angle stuck", "pins", 1, Promise::unseen},
      {"stop", "pins", 1, Promise::flagged, 1},
      {"magnet slips with the torque", "pins", 1, Promise::none},
      late_sensor,
  });
  for (PinKind& k : all) {  // of SPI, whose diagnosis comes once in 16 readings
    if (std::string_view("magnet lost") == k.name) k.within_us = 2000;
    if (std::string_view("angle off by half a turn") == k.name) k.within_us = 600;
  }
  return all;
}();

constexpr double degree = 0.017453292519943295;

Case gimbal_case(std::string_view name, Random* r, double limit_nm = 0.05) {
  Case c = asked(r, limit_nm, 20);
  Harm& h = c.harm;
  const auto at_arming = [&](double degrees) {
    c.at_arming = c.free = true;
    c.offset_rad = sign(r) * degrees * degree;
    c.seconds = 0.05;
    c.what = fmt::format("{:.0f} degrees, ", c.offset_rad / degree);
  };
  if (name == "encoder's wire cut") {
    const auto wire = r->below(3);
    if (wire == 0) h.sensor = Defect::cut;
    if (wire > 0) h.cut_lines = wire;
    c.what = wire == 0 ? "data, " : wire == 1 ? "select, " : "clock, ";
  } else if (name == "encoder's data at ground") {
    h.sensor = Defect::grounded;
  } else if (name == "a bit of each frame wrong") {
    h.sensor = Defect::wrong_bit;
  } else if (name == "noise on the encoder's data") {
    h.flips = std::pow(10.0, -2 - 2 * share(r));
    c.seconds = 0.05;
    c.what = fmt::format("{:.1e}, ", h.flips);
  } else if (name == "magnet lost") {
    h.sensor = Defect::magnet_lost;
  } else if (name == "angle off by half a turn") {
    h.sensor = Defect::half_a_turn_off;
  } else if (name == "magnet slips") {
    h.slipped_rad = sign(r) * (1 + 29 * share(r)) * degree;
    c.free = r->coin();
    c.seconds = 0.05;
    c.what = fmt::format("{:.1f} degrees, ", h.slipped_rad / degree);
  } else if (name == "angle freezes") {
    c = asked(r, limit_nm, 70, 18);
    c.harm.sensor = Defect::held;
  } else if (name == "angle freezes, slower") {
    c = asked(r, limit_nm, 14, 0.5);
    c.harm.sensor = Defect::held;
    c.seconds = 0.1;
  } else if (name == "a phase opens") {
    h.open_phase = r->below(3);
    c.free = r->coin();
    c.seconds = 0.05;
  } else if (name == "a gate stays off") {
    const auto n = r->below(6);
    h.dead_gates = 1U << n;
    c.what = fmt::format("gate {}, ", n);
    c.seconds = 0.05;
  } else if (name == "wrong offset at arming") {
    at_arming(100 + 160 * share(r));
  } else if (name == "a lesser wrong offset") {
    at_arming(10 + 70 * share(r));
  } else if (name == "phases swapped at arming") {
    at_arming(0);
    h.swapped_phases = true;
    c.what.clear();
  } else if (name == "stop") {
    h.stop = true;
    c.seconds = 0.001;
  } else {
    throw std::logic_error(fmt::format("no fault is made for the kind \"{}\"", name));
  }
  return c;
}

/// Of the lever's: a position that is wrong is felt in a wall, so half of these act in one.
Case absolute_case(std::string_view name, Random* r) {
  const bool stuck = name == "a bit of the angle stuck", from_start = name.substr(0, 5) == "wrong";
  if (name == "magnet slips with the torque") {  // the back-EMF of the step adds to it
    Case c = asked(r, 0.5, 2);
    c.torque_nm = std::copysign(0.5, c.torque_nm);
    c.harm.slipped_rad = std::copysign((3 + 8 * share(r)) * degree, c.torque_nm);
    c.what = fmt::format("{:.1f} degrees, ", c.harm.slipped_rad / degree);
    return c;
  }
  Case c = gimbal_case(stuck || from_start ? "magnet slips" : name, r, 0.5);
  Harm& h = c.harm;
  if (h.slipped_rad == 0) return c;
  if (stuck) {
    h.slipped_rad = 0;
    h.stuck_bit = static_cast<int>(r->below(14));
    h.stuck_high = r->coin();
    c.what = fmt::format("bit {} is {}, ", h.stuck_bit, h.stuck_high ? 1 : 0);
  }
  c.from_start = from_start;
  c.wall = r->coin();
  if (!c.wall) return c;
  // 0.08 to 0.4 Nm of the wall's 4 Nm/rad.
  c.free = false;
  c.from_rad = 0.02 + 0.08 * share(r);
  c.rad_s *= 0.05;
  c.torque_nm = 0;
  c.what += "wall, ";
  return c;
}

/// Of two shunts: what one can have, or both, and all that gimbal_motor has.
const std::vector<PinKind> field_kinds = [] {
  std::vector<PinKind> all{
      {"modulator's line stands", "pins", 1, Promise::flagged, 22},
      {"modulator's line is noise", "pins", 1, Promise::none},
      {"shunt's wires swapped", "pins", 1, Promise::flagged},
      {"shunts exchanged", "pins", 1, Promise::flagged},
      {"shunt's wires off", "pins", 1, Promise::none},
      {"shunt or modulator off by a factor", "pins", 1, Promise::unseen},
      {"shunt's offset", "pins", 1, Promise::unseen},
      {"motor's terminals shorted", "pins", 1, Promise::flagged},
      {"nFAULT", "pins", 1, Promise::flagged, 1},
      {"shunt's wires off at arming", "pins", 1, Promise::none},
  };
  all.insert(all.end(), gimbal_kinds.begin(), gimbal_kinds.end());
  for (PinKind& k : all) {
    if (std::string_view("a phase opens") == k.name) k.promise = Promise::none;  // seen, mostly
  }
  return all;
}();

Case field_case(std::string_view name, Random* r) {
  constexpr double limit_nm = 0.05, most_rad_s = 20;
  const auto is_its_own = [&](const PinKind& k) { return name == k.name; };
  if (std::any_of(gimbal_kinds.begin(), gimbal_kinds.end(), is_its_own)) {
    return gimbal_case(name, r);
  }
  if (name == "shunts exchanged") {
    Case c = asked(r, limit_nm, most_rad_s);
    c.harm.exchanged = true;
    c.seconds = 0.02;
    return c;
  }
  Case c = current_case(name, r, limit_nm, most_rad_s);
  Harm& h = c.harm;
  h.offset_a *= 0.05;
  if (h.offset_a != 0) c.what = fmt::format("{:.3f} A, ", h.offset_a);
  const bool line = h.modulator != Harm::Line::sound;
  h.shunts = 1 + static_cast<unsigned>(r->below(line ? 2 : 3));
  const bool of_shunt = line || h.reads != 1 || h.offset_a != 0;
  if (of_shunt) c.what += h.shunts == 1 ? "A, " : h.shunts == 2 ? "B, " : "A and B, ";
  return c;
}

/// Of Hall lines beside an encoder with A and B, and of three phases; a hand turns the shaft.
const std::vector<PinKind> hall_kinds = [] {
  std::vector<PinKind> all{
      {"a Hall line stands", "pins", 1, Promise::flagged},
      {"a Hall line stands, held", "pins", 1, Promise::unseen},
      {"Hall plug off", "pins", 1, Promise::flagged, 3},
      // Until an edge tells, torque and back-EMF may have the other sign.
      {"two Hall lines exchanged", "pins", 1, Promise::unseen},
      {"Hall lines exchanged at arming", "pins", 1, Promise::none},
      {"encoder slips", "pins", 1, Promise::flagged},
      {"cable cut, moving", "pins", 1, Promise::flagged},
  };
  std::copy_if(
      gimbal_kinds.begin(), gimbal_kinds.end(), std::back_inserter(all), [](const auto& k) {
        return std::none_of(sensor_kinds.begin(), sensor_kinds.end(),
                            [&](const PinKind& s) { return std::string_view(s.name) == k.name; });
      });
  return all;
}();

Case hall_case(std::string_view name, Random* r) {
  constexpr double limit_nm = 0.2;
  if (std::none_of(hall_kinds.begin(), hall_kinds.begin() + 7,
                   [&](const PinKind& k) { return name == k.name; })) {
    return gimbal_case(name, r, limit_nm);
  }
  Case c = asked(r, limit_nm, 100, 10);
  Harm& h = c.harm;
  double rad = 1;
  if (name.substr(0, 11) == "a Hall line") {
    const auto line = static_cast<unsigned>(r->below(3));
    const bool high = r->coin();
    (high ? h.hall_high : h.hall_low) = 1U << line;
    c.what = fmt::format("line {} {}, ", line, high ? "high" : "low");
    if (name != "a Hall line stands") c.rad_s = 0;
  } else if (name == "Hall plug off") {
    h.hall_high = 7;
  } else if (name == "encoder slips") {
    h.slips = 0.1 + 0.4 * share(r);
    rad = 0.25 / h.slips;
    c.what = fmt::format("{:.0f} %, ", 100 * h.slips);
  } else if (name == "cable cut, moving") {
    h.channels_held = true;
  } else {
    h.hall_exchanged = static_cast<int>(r->below(3));
    c.from_start = true;
    if (name != "two Hall lines exchanged") c.at_arming = c.free = true;
    c.what = fmt::format("{} and {}, ", h.hall_exchanged, (h.hall_exchanged + 1) % 3);
  }
  c.seconds = c.rad_s == 0 || c.free ? 0.05 : rad / std::abs(c.rad_s);
  return c;
}

/// Kinds of faults of a design, and what makes one of them.
struct Faults {
  const std::vector<PinKind>* kinds;
  Case (*made)(std::string_view, Random*);
};
Faults faults_of(const Option<LeverCurrent>&) {
  return {&current_kinds, [](std::string_view n, Random* r) { return current_case(n, r); }};
}
Faults faults_of(const Option<LeverAbsolute>&) { return {&absolute_kinds, absolute_case}; }
Faults faults_of(const Option<GimbalMotor>&) {
  return {&gimbal_kinds, [](std::string_view n, Random* r) { return gimbal_case(n, r); }};
}
Faults faults_of(const Option<GimbalCurrent>&) { return {&field_kinds, field_case}; }
Faults faults_of(const Option<HallMotor>&) { return {&hall_kinds, hall_case}; }

}  // namespace

std::vector<std::string> option_designs() {
  return std::apply(
      [](const auto&... all) {
        return std::vector<std::string>{std::decay_t<decltype(all)>::Design::name...};
      },
      options);
}

const std::vector<PinKind>& option_kinds(const std::string& design) {
  static const std::vector<PinKind> none;
  const std::vector<PinKind>* kinds = &none;
  with_option(design, [&](const auto& o) { kinds = faults_of(o).kinds; });
  return *kinds;
}

PinResult run_option_fault(const std::string& root, const std::string& design, std::size_t kind,
                           std::uint64_t seed) {
  Random random(seed * 64 + kind);
  PinResult result{kind, seed, {}, {}, design};
  with_option(design, [&](const auto& o) {
    const Faults faults = faults_of(o);
    using D = typename std::decay_t<decltype(o)>::Design;
    const std::string_view name = (*faults.kinds)[kind].name;
    const Case c = name == late_sensor.name ? late_case<D>(&random) : faults.made(name, &random);
    result.what = c.what + (c.free ? fmt::format("{:.3f} Nm, free", c.torque_nm)
                                   : fmt::format("{:.3f} Nm, {:.3g} rad/s", c.torque_nm, c.rad_s));
    result.outcome = run_case<D>(root, c, o.plant, o.arm_s, random.bits());
  });
  return result;
}

}  // namespace feltgate::faults
