// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Stability of walls: published numbers, eigenvalues two ways, borders in the chain's own bits, and
// what counts and noise do; and what a study refuses: not a number would never end. Documentation:
// docs/speed-for-accuracy.md
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "catch.hpp"
#include "feltgate/generated/lever_absolute.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/bit_loop.hpp"
#include "studies/stability/linear_loop.hpp"
#include "studies/stability/study.hpp"

using namespace feltgate;
using namespace feltgate::stability;

namespace {

const std::string kRoot = FELTGATE_ROOT;

design::Elaborated lever() {
  return elaborate(design::read_design(kRoot + "/rtl/designs/lever.toml"),
                   design::read_registers(kRoot + "/rtl/registers.toml"));
}

plant::Parameters plant_named(const std::string& name) {
  return plant::read_plant_file(kRoot + "/vectors/plants/" + name + ".toml");
}

void within(double value, double of, double share) {
  INFO(value << " against " << of);
  CHECK(std::abs(value / of - 1) < share);
}

}  // namespace

TEST_CASE("stability: the textbook loop gives the published numbers") {
  const auto known = known_numbers();
  REQUIRE(known.size() == 19);
  for (const KnownNumber& k : known) {
    CAPTURE(k.what, k.published, k.computed);
    // Some are published with two digits.
    CHECK(std::abs(k.computed - k.published) < std::max(0.005, 0.0005 * k.published));
  }
}

TEST_CASE("stability: the textbook loop at its own borders") {
  // Ideal actuator, lever's inertia: 2 B/T for BT/J much below 1, a quarter less at BT/J = 0.28.
  const auto loop = [](double hz) { return MassLoop{1.22e-4, 0, 1 / hz, 0.005, 0, 0}; };
  within(stiffest(loop(40e3)), 400, 0.002);
  within(stiffest(loop(1e3)), 9.60, 0.002);
  within(stiffest(loop(144)), 1.08, 0.002);
  // A dead time of whole periods and one of a fraction meet.
  MassLoop delayed{1.22e-4, 1e-3, 1e-3, 0, 0, 2e-3};
  const double whole = stiffest(delayed);
  delayed.dead_time_s = 2.000001e-3;
  within(stiffest(delayed), whole, 1e-5);
  within(whole, closed_form(delayed), 0.05);
  // Damping so large that it shakes by itself: no stiffness is stable.
  CHECK(stiffest(MassLoop{1.22e-4, 0, 1e-2, 0.05, 0, 0}) == 0);
}

TEST_CASE("stability: eigenvalues and exponential of matrices that have a closed form") {
  // z^3 - 6 z^2 + 13 z - 20 = (z - 4)(z - 1 - 2i)(z - 1 + 2i), as a companion matrix.
  const Eigen::MatrixXd companion{{6, -13, 20}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Pole> found;
  for (const Pole& z : eigenvalues(companion)) found.push_back(z);
  REQUIRE(found.size() == 3);
  for (const Pole& root : {Pole{4, 0}, Pole{1, 2}, Pole{1, -2}}) {
    CHECK(std::any_of(found.begin(), found.end(),
                      [&](const Pole& z) { return std::abs(z - root) < 1e-12; }));
  }
  // A spiral: a turn by w*t that grows by exp(g*t); from less than a millionth to many turns.
  const double g = -0.3, w = 2.0;
  const Eigen::MatrixXd spiral{{g, -w}, {w, g}};
  for (const double t : {0.0, 1e-7, 0.01, 1.0, 30.0}) {
    const Eigen::MatrixXd is = matrix_exp_minus_one(spiral, t);
    const std::complex<double> exact = std::exp(std::complex<double>(g, w) * t) - 1.0;
    INFO(t);
    CHECK(std::abs(is(0, 0) - exact.real()) < 1e-12);
    CHECK(std::abs(is(1, 0) - exact.imag()) < 1e-12);
    CHECK(is(0, 0) == is(1, 1));
    CHECK(is(0, 1) == -is(1, 0));
  }
  // Small results keep their digits: where a is -1, expm1.
  const Eigen::MatrixXd decay{{-1.0}};
  const double small = matrix_exp_minus_one(decay, 1e-9)(0, 0);
  CHECK(std::abs(small / std::expm1(-1e-9) - 1) < 1e-14);
}

TEST_CASE("stability: Arnoldi finds the largest eigenvalues of the whole monodromy matrix") {
  LoopModel m = make_model(lever(), plant_named("linear"));
  m.raw_rad_s_rad *= static_cast<double>(m.m1) / 40;  // a short window keeps the matrix small
  m.m1 = 40;
  for (const Wall& wall : {Wall{10, 0.005, 1}, Wall{5, 0.005, 1000}, Wall{8, 0.01, 25}}) {
    int ticks = 0;
    const Eigen::VectorXcd dense = eigenvalues(monodromy(m, wall, &ticks));
    CHECK(ticks == (wall.scene_ticks == 1 ? 20 : wall.scene_ticks == 25 ? 100 : 1000));
    double radius = 0;
    for (const Pole& z : dense) radius = std::max(radius, std::abs(z));
    const double growth = std::log(radius) / (ticks * m.tick_s);
    INFO(wall.scene_ticks);
    CHECK(std::abs(poles(m, wall).front().real() - growth) < 1e-5 * std::abs(growth));
  }
}

TEST_CASE("stability: the closed form holds where theory says so") {
  const LoopModel m = make_model(lever(), plant_named("linear"));
  // Damping that replaces just what the back-EMF compensation takes: the estimator sees no net
  // damping and its lag drops out. BT/J is at most 0.018.
  const double b = m.motor_damping_nm_s_rad * m.compensated;
  for (const int ticks : {1, 25, 1000}) {
    within(closed_form(m, b, ticks), border(m, b, ticks).stiffness_nm_rad, 0.05);
  }
  within(closed_form(m, b, 1), border(m, b, 1).stiffness_nm_rad, 0.001);
  // Off that point the lag counts: the plain form misses by 20 to 40 %, the longer one does not.
  const double exact = border(m, 0.001, 1).stiffness_nm_rad;
  CHECK(closed_form(m, 0.001, 1) < 0.85 * exact);
  within(closed_form_with_estimator(m, 0.001, 1), exact, 0.03);
  CHECK(closed_form(m, 0.005, 1) > 1.3 * border(m, 0.005, 1).stiffness_nm_rad);
  // Without damping of its own the compensated motor holds no wall at all.
  CHECK(border(m, 0, 1).stiffness_nm_rad == 0);
  // A motor left its own damping, no estimator in the loop: the plain form again.
  LoopModel bare = m;
  bare.emf_constant = bare.compensated = 0;
  for (const int ticks : {1, 25}) {
    within(closed_form(bare, 0, ticks), border(bare, 0, ticks).stiffness_nm_rad, 0.05);
  }
}

TEST_CASE("stability: 0.95 of the border decays and 1.05 grows, in bits as in double") {
  const auto design = lever();
  const auto plant = plant_named("linear");
  const LoopModel m = make_model(design, plant);
  struct Place {
    double damping;
    int ticks;
  };
  for (const Place& p : {Place{0.005, 1}, Place{0.002, 25}, Place{0.005, 1000}}) {
    const Border b = border(m, p.damping, p.ticks);
    for (const double share : {0.95, 1.05}) {
      const Wall wall{share * b.stiffness_nm_rad, p.damping, p.ticks};
      const Pole s = poles(m, wall).front();
      const Growth bits = swing(design, plant, wall, "fixed", b.rad_s);
      const Growth real = swing(design, plant, wall, "double", b.rad_s);
      CAPTURE(p.damping, p.ticks, share, s.real(), bits.rate_1_s, real.rate_1_s, bits.swings);
      CHECK(bits.swings > 8);
      CHECK((bits.rate_1_s > 0) == (share > 1));
      CHECK(std::abs(bits.rate_1_s - s.real()) < 0.2 * std::abs(s.real()));
      CHECK(std::abs(bits.rate_1_s - real.rate_1_s) < 0.2 * std::abs(s.real()));
      within(bits.rad_s, std::abs(s.imag()), 0.01);
    }
  }
}

TEST_CASE("stability: bisection in bits meets the eigenvalues") {
  const auto design = lever();
  const auto plant = plant_named("linear");
  const LoopModel m = make_model(design, plant);
  for (const auto& [damping, ticks] : {std::pair{0.002, 1}, {0.01, 1000}}) {
    const Border b = border(m, damping, ticks);
    const double bits = measured_border(design, plant, damping, ticks, b);
    within(bits, b.stiffness_nm_rad, 0.02);
    // A fifth more damping is noticed.
    const double other = border(m, 1.2 * damping, ticks).stiffness_nm_rad;
    CHECK(other / bits > 1.08);
  }
}

TEST_CASE("stability: a wall is quiet under 2f/q and cycles by one count above it") {
  const auto design = lever();
  const auto plant = plant_named("p24");
  const double rule = encoder_rule_nm_rad(design, plant);
  CHECK(rule == Approx(4.563).epsilon(0.001));
  const Rest below = rest_in_wall(design, plant, {0.85 * rule, 0.005, 1}, 10.5, 4);
  CHECK(below.quiet == 4);
  CHECK(below.torque_rms_nm == 0);
  const Rest above = rest_in_wall(design, plant, {2 * rule, 0.005, 1}, 10.5, 4);
  CHECK(above.quiet == 0);
  CHECK(above.counts == 1);
  const double half_step = above.stiffness_nm_rad * design.design.count_rad() / 2;
  within(above.torque_rms_nm, half_step, 0.3);
  CHECK(above.motor_torque_rms_nm < above.torque_rms_nm);
}

TEST_CASE("stability: noise shakes a slow host's wall, smoothing calms it") {
  const auto design = lever();
  const auto plant = plant_named("p24");
  const double soft = 11.459, noise = 0.873e-3;
  const auto quiet = host_wall(design, plant, {144, soft, 0, 1});
  const auto noisy = host_wall(design, plant, {144, soft, noise, 1});
  const auto smooth = host_wall(design, plant, {144, soft, noise, 0.5});
  CHECK(quiet.torque_rms_nm < 1e-4);
  CHECK(noisy.torque_rms_nm > 5e-3);
  CHECK(smooth.torque_rms_nm < 0.8 * noisy.torque_rms_nm);
}

namespace {

/// Another way to a host's border with the hand: the swing of unquantised readings in plain steps,
/// a winding that lags by L/R, half a PWM period of 20 us, a register write, a reading of 96 us.
bool grows(double nm_rad, double period_s) {
  constexpr double dt = 2e-6, lag_s = 82.3e-6 / 0.42, inertia = 1.22e-4, hand_inertia = 5.54e-3;
  constexpr double grip = 30, grip_b = 0.1, own = 1.35, own_b = 0.0645;
  double torque = 0, speed = 0, angle = 1e-3, hand_speed = 0, hand = 0, asked = 0, next = 0;
  double reading = 0, under_way = 0, at_s = -1, early = 0, late = 0;
  constexpr int host_steps = 6;  // 12 us: half a PWM period and two ticks
  const auto every = std::llround(period_s / dt);
  const int steps = static_cast<int>(0.6 / dt);
  for (int n = 0; n < steps; ++n) {
    if (n % 48 == 2) reading = under_way;
    if (n % 48 == 0) under_way = angle;
    if (n % every == 0) next = -nm_rad * reading, at_s = n + host_steps;
    if (n == at_s) asked = next;
    const double held = grip * (hand - angle) + grip_b * (hand_speed - speed);
    torque += (asked - torque) * -std::expm1(-dt / lag_s);
    speed += (torque + held) / inertia * dt;
    hand_speed += (-held - own * hand - own_b * hand_speed) / hand_inertia * dt;
    angle += speed * dt;
    hand += hand_speed * dt;
    const double size = std::hypot(angle, speed / std::sqrt((nm_rad + grip) / inertia));
    if (n > steps / 3 && n < steps / 2) early = std::max(early, size);
    if (n > 5 * steps / 6) late = std::max(late, size);
  }
  return !(late < early);  // not a number grew
}

}  // namespace

TEST_CASE("stability: 2 Nm/deg with counts of 14 bits at 144 Hz, 490 Hz and 10 kHz") {
  const auto design = elaborate(design::read_design(kRoot + "/rtl/designs/lever_absolute.toml"),
                                design::read_registers(kRoot + "/rtl/registers.toml"));
  const auto linear = plant_named("linear"), full = plant_named("p24");
  const double stiff = 360 / 3.141592653589793;  // 2 Nm/deg
  const double count_rad = 2 * 3.141592653589793 / (1 << LeverAbsolute::absolute_bits);
  CHECK(design.design.count_rad() == Approx(count_rad).epsilon(1e-12));
  CHECK(1e3 * count_rad == Approx(0.3835).epsilon(1e-4));
  CHECK(1e3 * stiff * count_rad == Approx(43.9).epsilon(2e-3));
  const double step_nm = 45.0 / 1024;  // 360/pi of 2 pi/2^14
  for (const double hz : {144.0, 490.0, 10e3}) {
    const HeldWall w = held_wall(design, linear, full, hz, stiff);
    CAPTURE(hz, w.border_nm_rad, w.bits_nm_rad, w.leaning.counts, w.pressing.counts);
    // L/R, half a PWM period, half a tick, two of a host, and a reading of 4 to 99 us ago.
    const double late_s = 82.3e-6 / 0.42 + 10e-6 + 0.5e-6 + 2e-6 + 51.5e-6;
    CHECK(w.needed_nm_s_rad == Approx(stiff * (0.5 / w.rate_hz + late_s)).epsilon(1e-3));
    double low = 10, high = 1000;
    while (high - low > 1e-3 * high) {
      const double middle = std::sqrt(low * high);
      (grows(middle, 1 / w.rate_hz) ? high : low) = middle;
    }
    within(w.border_nm_rad, low, 0.05);
    if (hz < 1e3) within(w.bits_nm_rad, w.border_nm_rad, 0.08);
    if (hz > 1e3) CHECK(std::isnan(w.bits_nm_rad));
    // Whole counts of 43.9 mNm, but for the face of the wall and its limit.
    const double steps = w.leaning.torque_swing_nm / step_nm;
    CHECK(std::abs(steps - std::round(steps)) * step_nm < 4e-5);
    if (hz < 200) {  // three times the border: from the limit to nothing
      CHECK(w.border_nm_rad < 0.4 * stiff);
      CHECK(w.pressing.torque_swing_nm == Approx(0.5).epsilon(1e-3));
    } else {
      CHECK(w.border_nm_rad > stiff);
    }
    if (hz > 1e3) {  // one count: friction cannot hold it above 2f/q
      CHECK(stiff > 2 * full.lugre.coulomb_nm / count_rad);
      CHECK((w.leaning.counts == 1 && w.pressing.counts == 1));
      within(w.pressing.torque_rms_nm, step_nm / 2, 0.05);
    }
  }
}

TEST_CASE("stability: a study as text and JSON") {
  StudyOptions o;
  o.rates_hz = {1e6};
  o.damping_nm_s_rad = {0, 0.002};
  o.bits = o.experiments = false;
  const Study s = run_study(lever(), plant_named("linear"), plant_named("p24"), o);
  REQUIRE(s.borders.size() == 2);
  CHECK(s.borders[1].z_width > 10);
  CHECK(s.locus.size() > 40);
  const std::string text = study_text(s);
  CHECK(text.find("none: the loop grows at any stiffness") != std::string::npos);
  CHECK(study_json(s).find("\"bits_nm_rad\": null") != std::string::npos);
}

TEST_CASE("rates and dampings of a study are numbers of their range") {
  const auto design = lever();
  const auto plant = plant_named("linear");
  StudyOptions options;
  options.bits = options.experiments = false;
  options.rates_hz = {1000};
  for (const double damping : {std::nan(""), HUGE_VAL, -0.1, 1.1}) {
    options.damping_nm_s_rad = {0.001, damping};
    CHECK_THROWS_AS(run_study(design, plant, plant, options), std::invalid_argument);
  }
  options.damping_nm_s_rad = {0.001};
  for (const double rate : {std::nan(""), HUGE_VAL, 0.0, 2e6}) {
    options.rates_hz = {rate};
    CHECK_THROWS_AS(run_study(design, plant, plant, options), std::invalid_argument);
  }
}

// A wall on either side of its border in the whole core: RTL and twin in lock-step, from pins to
// pins.

namespace {

/// The lever is held off its resting depth until the core has armed, then let swing.
Growth swing_of_core(const design::Elaborated& design, const plant::Parameters& plant,
                     const Wall& wall, double duration_s, std::int64_t* mismatches) {
  const double q = design.design.count_rad();
  const double start = press_nm / wall.stiffness_nm_rad - swing_rad(wall.stiffness_nm_rad);
  Scenario s;
  s.name = "wall";
  s.duration_s = duration_s;
  s.scene = "wall";
  s.effects = plant.effects;
  // The core counts from where the lever is at reset.
  s.parameters = {{"wall_contact", -start / q},
                  {"wall_stiffness", wall.stiffness_nm_rad * q},
                  {"wall_damping", wall.damping_nm_s_rad},
                  {"dead_voltage", 0},
                  {"dead_voltage_slope", 0},
                  {"ramp_step", 1},
                  {"torque_limit", 0.95},
                  {"current_limit", 31.9},
                  {"voltage_window", 24}};
  s.hand.start_rad = start;
  plant::HandPhase held, press;
  held.kind = plant::HandPhase::Kind::kLocked;
  held.duration_s = 2e-3;
  press.kind = plant::HandPhase::Kind::kTorque;
  press.profile = {{plant::Segment::Kind::kStep, 1.0, press_nm}};
  s.hand.phases = {held, press};
  SwingMeter meter(start, 2.5 * q, 14);
  RunOptions o;
  o.design = design.design.name;
  o.row = [&](const Row& r) {
    if (r.time_s < held.duration_s) return;
    if (r.tau_ref_nm > -0.005) meter.leave();
    meter.add(r.time_s, r.theta_rad, r.omega_rad_s);
  };
  const RunResult result = run_scenario(s, plant, o);
  *mismatches = result.mismatches;
  CHECK(result.lock_step);
  CHECK(result.figures.at("faults") == 0);
  return meter.growth();
}

}  // namespace

TEST_CASE("stability: the core itself decays at 0.9 of the border and grows at 1.1") {
  const std::string root = FELTGATE_ROOT;
  const auto design = elaborate(design::read_design(root + "/rtl/designs/lever.toml"),
                                design::read_registers(root + "/rtl/registers.toml"));
  const auto plant = plant::read_plant_file(root + "/vectors/plants/linear.toml");
  const LoopModel m = make_model(design, plant);
  const Border b = border(m, 0.005, 1);
  for (const double share : {0.9, 1.1}) {
    const Wall wall{share * b.stiffness_nm_rad, 0.005, 1};
    std::int64_t mismatches = -1;
    const Growth core = swing_of_core(design, plant, wall, 0.15, &mismatches);
    const double rate = poles(m, wall).front().real();
    CAPTURE(share, rate, core.rate_1_s, core.swings, core.left);
    CHECK(mismatches == 0);
    CHECK(core.swings >= 8);
    CHECK((core.rate_1_s > 0) == (share > 1));
    CHECK(std::abs(core.rate_1_s - rate) < 0.25 * std::abs(rate));
  }
}
