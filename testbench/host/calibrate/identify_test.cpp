// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of a simulated motor from its voltage and its count. Documentation: docs/identify.md
#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <sstream>

#include "bench.hpp"
#include "catch.hpp"
#include "design/design.hpp"
#include "host/identify/cogging.hpp"
#include "host/identify/identify.hpp"
#include "host/identify/report.hpp"

using namespace feltgate;
using namespace feltgate::host;
using namespace feltgate::test;

namespace {

/// Both signs, several sizes, each for a quarter of a second.
const std::vector<Held> kSteps{{4, 0.25}, {-4, 0.25}, {2.5, 0.25}, {-2.5, 0.25},
                               {6, 0.25}, {-6, 0.25}, {3, 0.25},   {-5, 0.25},
                               {8, 0.25}, {-8, 0.25}, {7, 0.25},   {-3, 0.25}};
const std::vector<Held> kRunDown{{8, 0.5}, {0, 6, true}};
constexpr double kCoulomb_nm = 3.5e-3;  // of the shipped plants

struct Truth {
  plant::Parameters p;
  double kt, r, j, b, dead_v, electrical_s;
};

Truth truth_of(const std::string& name, bool viscous) {
  Truth t{shipped(name), 0, 0, 0, 0, 0, 0};
  t.p.effects.viscous = viscous;
  t.kt = t.p.motor.torque_constant_nm_a;
  t.r = t.p.motor.resistance_ohm;
  t.j = t.p.lever.inertia_kg_m2;
  t.b = (viscous ? t.p.lever.viscous_nm_s_rad : 0) + t.p.lugre.viscous_nm_s_rad;
  t.dead_v = t.p.motor.dead_voltage_v + 0.635;  // and the dead time
  t.electrical_s = t.p.motor.inductance_h / t.r;
  return t;
}

void within(const Interval& i, double truth, double share) {
  INFO(text_of(i) << ", truth " << truth);
  CHECK(std::abs(i.value / truth - 1) < share);
}

std::string refused(const std::function<void()>& what) {
  try {
    what();
  } catch (const MeasurementError& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("identify: combinations and constants of the plant within 2 %", "[identify]") {
  for (const char* name : {"p24", "p48"}) {
    for (const bool viscous : {false, true}) {
      CAPTURE(name, viscous);
      const Truth t = truth_of(name, viscous);
      const Drive d = identify_drive(drive(t.p, kSteps), t.electrical_s, 0.99);
      within(d.inertia_v_s2, t.j * t.r / t.kt, 0.02);
      within(d.speed_v_s, t.kt + t.b * t.r / t.kt, 0.02);
      within(d.both_v, kCoulomb_nm * t.r / t.kt + t.dead_v, 0.02);
      CHECK(d.inertia_v_s2.contains(t.j * t.r / t.kt));
      CHECK(d.speed_v_s.contains(t.kt + t.b * t.r / t.kt));
      if (d.friction_v) CHECK(d.friction_v->contains(kCoulomb_nm * t.r / t.kt));

      const Coast c = identify_coast(drive(t.p, kRunDown), 0.99);
      within(c.damping_1_s, t.b / t.j, 0.005);
      within(c.friction_rad_s2, kCoulomb_nm / t.j, 0.005);
      // The noise that is left is that of a count: 1/sqrt(12) of it.
      CHECK(c.noise_rad == Approx(2 * M_PI / 4096 / std::sqrt(12)).epsilon(0.1));

      Separation ohmmeter;
      ohmmeter.resistance_ohm = t.r;
      const Constants k = separate(d, c, ohmmeter, 0.99);
      within(*k.emf_v_s_rad, t.kt, 0.02);
      within(*k.inertia_kg_m2, t.j, 0.02);
      within(*k.damping_nm_s_rad, t.b, 0.02);
      within(*k.friction_nm, kCoulomb_nm, 0.02);
      within(*k.dead_voltage_v, t.dead_v, 0.02);
      CHECK(k.inertia_kg_m2->contains(t.j));
      CHECK(k.friction_nm->contains(kCoulomb_nm));
      CHECK(k.next.empty());
    }
  }
}

TEST_CASE("identify: a known inertia more gives R without an ohmmeter", "[identify]") {
  Truth t = truth_of("p24", true);
  const Drive d = identify_drive(drive(t.p, kSteps), t.electrical_s, 0.95);
  const Coast c = identify_coast(drive(t.p, kRunDown), 0.95);
  Separation known;
  known.added_kg_m2 = 2e-4;
  t.p.lever.inertia_kg_m2 += known.added_kg_m2;
  known.loaded = identify_drive(drive(t.p, kSteps), t.electrical_s, 0.95);
  const Constants k = separate(d, c, known, 0.95);
  within(*k.resistance_ohm, t.r, 0.02);
  within(*k.inertia_kg_m2, t.j, 0.02);
  within(*k.damping_nm_s_rad, t.b, 0.02);
  within(*k.friction_nm, kCoulomb_nm, 0.02);
  CHECK(k.resistance_ohm->contains(t.r));
  // The recordings exchanged.
  known.loaded->inertia_v_s2.value = d.inertia_v_s2.value / 2;
  CHECK(refused([&] { (void)separate(d, c, known, 0.95); }).find("are the two recordings") !=
        std::string::npos);
}

TEST_CASE("identify: a weight on a lying shaft gives R", "[identify]") {
  // The plant has no gravity: a lever with dry friction and a weight, integrated here.
  const double kt = 0.0302, r = 0.42, j = 1.22e-4, mass = 0.05, radius = 0.1, level = 0.3;
  const double torque_nm = mass * 9.80665 * radius, whole_j = j + mass * radius * radius;
  Recording rec;
  rec.name = "weighed";
  double angle = 0, speed = 0, t = 0;
  const double count = 2 * M_PI / 4096, dt = 1e-5;
  for (const Held& h : std::vector<Held>{{6, 0.5}, {-6, 0.5}, {8, 0.5}, {-8, 0.5}, {5, 0.5}}) {
    for (int k = 0; k < static_cast<int>(std::lround(h.seconds / dt)); ++k, t += dt) {
      if (k % 100 == 0) {
        rec.time_s.push_back(t);
        rec.voltage_v.push_back(h.volts);
        rec.angle_rad.push_back(std::floor(angle / count) * count);
      }
      const double current = (h.volts - kt * speed) / r;
      const double friction = speed == 0 ? 0 : std::copysign(kCoulomb_nm, speed);
      speed += dt * (kt * current - friction - torque_nm * std::cos(angle - level)) / whole_j;
      angle += dt * speed;
    }
  }
  const Weighed w = identify_weight(rec, mass, radius, level, 0, 0.95);
  within(w.volts_per_nm, r / kt, 0.02);
  const Truth truth = truth_of("p24", false);
  const Drive d = identify_drive(drive(truth.p, kSteps), truth.electrical_s, 0.95);
  const Coast c = identify_coast(drive(truth.p, kRunDown), 0.95);
  Separation known;
  known.weighed = w;
  const Constants k = separate(d, c, known, 0.95);
  within(*k.resistance_ohm, r, 0.02);
  within(*k.inertia_kg_m2, j, 0.02);
  // A lever that hardly turns says nothing.
  Recording narrow = rec;
  for (double& a : narrow.angle_rad) a *= 1e-3;
  CHECK(refused([&] { (void)identify_weight(narrow, mass, radius, level, 0, 0.95); }) !=
        "accepted");
}

TEST_CASE("identify: what is not separated is not given, and what to do is said", "[identify]") {
  const Truth t = truth_of("p24", false);
  const Drive d = identify_drive(drive(t.p, kSteps), 0, 0.95);
  const Constants nothing = separate(d, {}, {}, 0.95);
  CHECK_FALSE(nothing.emf_v_s_rad);
  CHECK_FALSE(nothing.resistance_ohm);
  CHECK_FALSE(nothing.inertia_kg_m2);
  const std::string text = report_text(d, {}, nothing, 0.95);
  CHECK(text.find("none yet: these recordings give products") != std::string::npos);
  CHECK(text.find("next: a coast-down separates") != std::string::npos);
  CHECK(text.find("next: nothing here tells J from R") != std::string::npos);
  Separation ohmmeter;
  ohmmeter.resistance_ohm = t.r;
  CHECK_FALSE(separate(d, {}, ohmmeter, 0.95).inertia_kg_m2);
  // Ke of the data sheet instead of a coast-down: B is a small difference, and its interval says
  // so.
  ohmmeter.emf_constant_v_s_rad = t.kt;
  const Constants sheet = separate(d, {}, ohmmeter, 0.95);
  within(*sheet.inertia_kg_m2, t.j, 0.02);
  CHECK(sheet.damping_nm_s_rad->contains(t.b));
  CHECK(sheet.damping_nm_s_rad->half() > t.b);
  // An ohmmeter's error is part of the intervals.
  Separation rough = ohmmeter;
  rough.resistance_error_ohm = 0.02;
  CHECK(separate(d, {}, rough, 0.95).inertia_kg_m2->half() > 0.04 * t.j);
}

TEST_CASE("identify: the current's delay is known or shows", "[identify]") {
  // L/R over the time constant of a start, J R/(Kt Ke) = 56 ms.
  const Truth t = truth_of("linear", false);
  const double a = t.j * t.r / t.kt;
  const auto r = drive(t.p, kSteps);
  const double without = identify_drive(r, 0, 0.95).inertia_v_s2.value / a - 1;
  const double with = identify_drive(r, t.electrical_s, 0.95).inertia_v_s2.value / a - 1;
  CHECK(without - with == Approx(-t.electrical_s / 0.0562).epsilon(0.1));
}

TEST_CASE("identify: intervals hold the truth as often as they say", "[identify]") {
  const Truth t = truth_of("linear", true);
  int inertias = 0, speeds = 0;
  constexpr int sets = 30;
  SplitMix64 random(5);
  for (int set = 0; set < sets; ++set) {
    std::vector<Held> plan;
    for (int k = 0; k < 10; ++k) {
      plan.push_back({(k % 2 == 0 ? 1 : -1) * random.between(2, 7), random.between(0.15, 0.3)});
    }
    const Drive d = identify_drive(drive(t.p, plan), t.electrical_s, 0.95);
    inertias += d.inertia_v_s2.contains(t.j * t.r / t.kt) ? 1 : 0;
    speeds += d.speed_v_s.contains(t.kt + t.p.lever.viscous_nm_s_rad * t.r / t.kt) ? 1 : 0;
  }
  INFO(inertias << " and " << speeds << " of " << sets);
  CHECK(inertias >= 24);
  CHECK(speeds >= 24);
}

TEST_CASE("identify: columns in every form", "[recording]") {
  const auto read = [](const std::string& text, bool voltage = true) {
    std::istringstream in(text);
    return recording_of(ColumnTable(in, "r.csv"), 2 * M_PI / 4096, 1e-6, voltage);
  };
  std::string ticks = "tick,position,voltage_v\n", seconds = "time_s;theta_rad;voltage\n";
  for (int k = 0; k < 100; ++k) {
    // The tick counter wraps at row 50.
    ticks += fmt::format("{},{},2\n", static_cast<std::uint32_t>(4294917296U + 1000U * k), 8 * k);
    seconds += fmt::format("{:.6f};{:.9f};2\n", 1e-3 * k, 8 * k * 2 * M_PI / 4096);
  }
  const Recording a = read(ticks), b = read(seconds);
  REQUIRE(a.rows() == 100);
  CHECK(a.length_s() == Approx(0.099));
  CHECK(b.length_s() == Approx(0.099));
  CHECK(a.angle_rad[99] == Approx(b.angle_rad[99]));
  const auto message = [&read](const std::string& text) {
    return refused([&] { (void)read(text); });
  };
  CHECK(message("tick,position\n1,2\n").find("no column of the voltage") != std::string::npos);
  CHECK(message("tick,voltage\n1,2\n").find("no column of the position") != std::string::npos);
  CHECK(message("position,voltage\n1,2\n").find("no column of time") != std::string::npos);
  CHECK(message("t,position,voltage\n0,1,2\n").find("1 rows; record at least 64") !=
        std::string::npos);
  CHECK(message("t,position,voltage\n1,1,2\n1,1,2\n").find("r.csv:3: time does not go on") == 0);
}

TEST_CASE("identify: recordings that say nothing are refused with the mend", "[identify]") {
  const Truth t = truth_of("p24", false);
  const auto message = [&](const std::vector<Held>& plan, double every_s = 1e-3) {
    return refused([&] { (void)identify_drive(drive(t.p, plan, every_s), 0, 0.95); });
  };
  CHECK(message({{0, 1}}).find("windows in which the lever turns") != std::string::npos);
  CHECK(message({{4, 0.06}}).find("are too short") != std::string::npos);
  CHECK(message({{4, 1}, {-4, 1}}, 0.01).find("a row every 10 ms") != std::string::npos);
  std::vector<Held> hectic;
  for (int k = 0; k < 200; ++k) hectic.push_back({k % 2 == 0 ? 4.0 : -4.0, 0.01});
  CHECK(message(hectic).find("hold each voltage for 0.1 s or more") != std::string::npos);
  // One long run at one voltage: speed alone, no start that tells the inertia.
  CHECK(message({{0.5, 2}}).find("record longer, or at larger voltages") != std::string::npos);
  Recording turned = drive(t.p, kSteps);
  for (double& a : turned.angle_rad) a = -a;
  CHECK(refused([&] { (void)identify_drive(turned, 0, 0.95); }) != "accepted");
  CHECK(refused([&] {
          (void)identify_coast(drive(t.p, {{3, 0.5}}), 0.95);
        }).find("the lever runs down in") != std::string::npos);
}

TEST_CASE("identify: table for docs/calibration.md", "[.][table]") {
  for (const char* name : {"p24", "p48"}) {
    for (const bool viscous : {false, true}) {
      const Truth t = truth_of(name, viscous);
      const Drive d = identify_drive(drive(t.p, kSteps), t.electrical_s, 0.95);
      const Coast c = identify_coast(drive(t.p, kRunDown), 0.95);
      Separation ohmmeter;
      ohmmeter.resistance_ohm = t.r;
      const Constants k = separate(d, c, ohmmeter, 0.95);
      const auto off = [](const Interval& i, double truth) {
        return fmt::format("{:+.2f} ± {:.2f}", 100 * (i.value / truth - 1), 100 * i.half() / truth);
      };
      std::printf("| %s, B = %.3g | %s | %s | %s | %s | %s | %s | %s |\n", name, t.b,
                  off(d.inertia_v_s2, t.j * t.r / t.kt).c_str(),
                  off(d.speed_v_s, t.kt + t.b * t.r / t.kt).c_str(),
                  off(d.both_v, kCoulomb_nm * t.r / t.kt + t.dead_v).c_str(),
                  off(*k.emf_v_s_rad, t.kt).c_str(), off(*k.inertia_kg_m2, t.j).c_str(),
                  off(*k.damping_nm_s_rad, t.b).c_str(), off(*k.friction_nm, kCoulomb_nm).c_str());
    }
  }
}

TEST_CASE("cogging: the command for a small torque and the torque of a command", "[cogging]") {
  const auto registers = design::read_registers(FELTGATE_ROOT "/rtl/registers.toml");
  const auto of = [&](const std::string& name) {
    return small_torque_of(
        elaborate(design::read_design(FELTGATE_ROOT "/rtl/designs/" + name + ".toml"), registers));
  };
  const SmallTorque small = of("lever_law");
  // 10 mNm are 0.331 A; the voltage law asks for R I and a share of 0.34 V + 0.635 V.
  CHECK(small.edge_nm == Approx(0.975 / (0.42 / 0.0302 + 97.5)).epsilon(1e-3));
  double before = -1;
  for (int k = -200; k <= 200; ++k) {
    const double torque = k * 1e-4, command = small.command(torque, 0);
    CHECK(small.torque(command, 0) == Approx(torque).margin(1e-12));
    CHECK(command > before);
    before = command;
    if (std::abs(torque) >= small.linear_nm) CHECK(command == torque);
    // Above the cap the law's voltage is the one that it has far from zero.
    if (std::abs(torque) < 5e-3 || std::abs(torque) >= small.linear_nm) continue;
    const double volts = (0.42 / 0.0302 + 97.5) * std::abs(command);
    CHECK(volts == Approx(0.42 / 0.0302 * std::abs(torque) + 0.975).epsilon(1e-3));
  }
  for (const char* name : {"paper", "lever_current"}) CHECK(of(name).exact());
}

/// Volts along the current of a motor in a star whose legs lose `lost` against each current, for an
/// amplitude at an electrical angle: the neutral that makes the currents' sum 0 is searched for.
double volts_along(double amplitude, double e, double lost) {
  const auto axis = [&](int k) { return std::cos(e - 2.0943951023931953 * k); };
  const auto left = [&](int k, double neutral) {
    const double v = amplitude * axis(k) - neutral;
    return std::copysign(std::max(0.0, std::abs(v) - lost), v);
  };
  double low = -amplitude, high = amplitude, along = 0;
  for (int n = 0; n < 60; ++n) {
    const double neutral = (low + high) / 2;
    (left(0, neutral) + left(1, neutral) + left(2, neutral) > 0 ? low : high) = neutral;
  }
  for (int k = 0; k < 3; ++k) along += 2.0 / 3 * left(k, low) * axis(k);
  return along;
}

TEST_CASE("cogging: a small torque of three phases", "[cogging]") {
  const auto registers = design::read_registers(FELTGATE_ROOT "/rtl/registers.toml");
  for (const double offset_rad : {0.0, 0.9}) {
    design::Design d = design::read_design(FELTGATE_ROOT "/rtl/designs/knob_law.toml");
    d.commutation_offset_rad = offset_rad;
    const SmallTorque small = small_torque_of(elaborate(d, registers));
    // A leg loses 0.5 us of 20 us of 5 V and two diodes; the voltage law gives 4/pi of it back.
    const double leg_v = 0.025 * 6.4, v_nm = 2.9 / 0.0585;
    double largest = 0;
    for (int angle = 0; angle < 360; ++angle) {
      const double rad = angle * 1.75e-3, e = 11 * rad + offset_rad;
      for (int k = 1; k <= 60; ++k) {
        const double torque = k * 1e-4, command = small.command(torque, rad);
        const double volts =
            v_nm * command + leg_v * 4 / 3.14159265358979 * std::min(1.0, command / 2e-3);
        largest = std::max(largest, std::abs(volts_along(volts, e, leg_v) / v_nm - torque));
        CHECK(small.command(-torque, rad) == -command);
        CHECK(small.torque(command, rad) == Approx(torque).margin(1e-9));
        CHECK(small.torque(-command, rad) == Approx(-torque).margin(1e-9));
      }
      CHECK(small.torque(small.command(0.03e-3, rad), rad) == 0);
    }
    CHECK(largest < 1e-7);
  }
}
