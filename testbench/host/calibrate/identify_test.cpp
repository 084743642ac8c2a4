// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of a simulated motor from its voltage and its count. Documentation: docs/calibration.md
#include <functional>

#include "bench.hpp"
#include "catch.hpp"
#include "host/identify/identify.hpp"
#include "mismatch.hpp"

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
  for (const auto& [name, viscous] : {std::pair("p24", true), std::pair("p48", false)}) {
    CAPTURE(name, viscous);
    plant::Parameters p = shipped(name);
    p.effects.viscous = viscous;
    const double kt = p.motor.torque_constant_nm_a, r = p.motor.resistance_ohm;
    const double j = p.lever.inertia_kg_m2;
    const double b = (viscous ? p.lever.viscous_nm_s_rad : 0) + p.lugre.viscous_nm_s_rad;
    const double dead_v = p.motor.dead_voltage_v + 0.635;  // and the dead time
    const Drive d = identify_drive(drive(p, kSteps), p.motor.inductance_h / r);
    within(d.inertia_v_s2, j * r / kt, 0.02);
    within(d.speed_v_s, kt + b * r / kt, 0.02);
    within(d.both_v, kCoulomb_nm * r / kt + dead_v, 0.02);
    const Coast c = identify_coast(drive(p, kRunDown));
    within(c.damping_1_s, b / j, 0.01);
    within(c.friction_rad_s2, kCoulomb_nm / j, 0.005);
    const Constants k = constants_of(d, c, r);
    within(*k.emf_v_s_rad, kt, 0.02);
    within(*k.inertia_kg_m2, j, 0.02);
    within(*k.damping_nm_s_rad, b, 0.02);
    within(*k.friction_nm, kCoulomb_nm, 0.02);
    within(*k.dead_voltage_v, dead_v, 0.02);
    CHECK(k.next.empty());
    // Without the ohmmeter, without the coast-down.
    const Constants no_scale = constants_of(d, c, 0), no_coast = constants_of(d, {}, r);
    CHECK((no_scale.emf_v_s_rad && !no_scale.inertia_kg_m2 && no_scale.next.size() == 1));
    CHECK((!no_coast.emf_v_s_rad && !no_coast.inertia_kg_m2 && no_coast.next.size() == 1));
  }
}

TEST_CASE("identify: intervals hold the truth as often as they say", "[identify]") {
  if (!whole_run()) return;
  plant::Parameters p = shipped("linear");
  p.effects.viscous = true;
  const double r_kt = p.motor.resistance_ohm / p.motor.torque_constant_nm_a;
  const double electrical_s = p.motor.inductance_h / p.motor.resistance_ohm;
  int inertias = 0, speeds = 0;
  constexpr int sets = 30;
  SplitMix64 random(5);
  for (int set = 0; set < sets; ++set) {
    std::vector<Held> plan;
    for (int k = 0; k < 10; ++k) {
      plan.push_back({(k % 2 == 0 ? 1 : -1) * random.between(2, 7), random.between(0.15, 0.3)});
    }
    const Drive d = identify_drive(drive(p, plan), electrical_s);
    inertias += d.inertia_v_s2.contains(p.lever.inertia_kg_m2 * r_kt) ? 1 : 0;
    speeds += d.speed_v_s.contains(p.motor.torque_constant_nm_a + p.lever.viscous_nm_s_rad * r_kt);
  }
  INFO(inertias << " and " << speeds << " of " << sets);
  CHECK(inertias >= 24);
  CHECK(speeds >= 24);
}

TEST_CASE("identify: recordings that say nothing are refused with the mend", "[identify]") {
  const plant::Parameters p = shipped("p24");
  const auto message = [&](const std::vector<Held>& plan, double every_s = 1e-3) {
    return refused([&] { (void)identify_drive(drive(p, plan, every_s), 0); });
  };
  CHECK(message({{0, 1}}).find("of 0 windows in which the lever turns") != std::string::npos);
  CHECK(message({{4, 1}, {-4, 1}}, 0.01).find("a row every 10 ms") != std::string::npos);
  std::vector<Held> hectic;
  for (int k = 0; k < 200; ++k) hectic.push_back({k % 2 == 0 ? 4.0 : -4.0, 0.01});
  CHECK(message(hectic).find("hold each voltage for 0.1 s or more") != std::string::npos);
  Recording turned = drive(p, kSteps);
  for (double& a : turned.angle_rad) a = -a;
  CHECK(refused([&] { (void)identify_drive(turned, 0); }) != "accepted");
  CHECK(refused([&] {
          (void)identify_coast(drive(p, {{3, 0.5}}));
        }).find("the lever runs down in") != std::string::npos);
}
