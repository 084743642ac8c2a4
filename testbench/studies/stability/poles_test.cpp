// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Poles of the closed loop: against published and closed-form numbers, and what is refused.
// The numbers for voltage gain 1 were computed apart from this code, with the N-method's gain
// exactly 1 and without the tick of delay; hence the tolerances. Documentation: docs/designs.md
#include <algorithm>
#include <cmath>

#include "../../design/design/design_fixture.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/linear_loop.hpp"
#include "studies/stability/loop_poles.hpp"

using namespace feltgate;
using namespace feltgate::design;
using namespace feltgate::stability;

namespace {

plant::Parameters shipped_plant(const std::string& name) {
  return plant::read_plant_file(root_path("vectors/plants/" + name + ".toml"));
}

/// `paper` with one voltage gain, 1 ohm, in both regions.
Elaborated paper_at_gain_one(double kp_1_kg_m2) {
  Design d = shipped_design("paper");
  d.kv_low = d.kv_high = 1.0;
  d.kp_1_kg_m2 = kp_1_kg_m2;
  return elaborate(d, shipped_registers());
}

bool stable_at_ratio(const Elaborated& e, double ratio) {
  plant::Parameters p = shipped_plant("p24");
  p.lever.inertia_kg_m2 = e.design.inertia_kg_m2 / ratio;
  return closed_loop(e, p).stable();
}

/// First unstable Jn/J from 1 upwards. Jn, Kp and the gain from volts to torque stay, J shrinks.
double first_unstable_ratio(const Elaborated& e) {
  double stable = 1.0, unstable = 1.0;
  REQUIRE(stable_at_ratio(e, 1.0));
  while (stable_at_ratio(e, unstable)) {
    stable = unstable;
    unstable *= 1.05;
    REQUIRE(unstable < 100);
  }
  for (int i = 0; i < 10; ++i) {
    const double middle = (stable + unstable) / 2;
    (stable_at_ratio(e, middle) ? stable : unstable) = middle;
  }
  return unstable;
}

std::string refusal(const Elaborated& e, const plant::Parameters& p) {
  try {
    refuse_unstable(e, p);
  } catch (const config::ConfigError& error) {
    const std::string what = error.what();
    return what.substr(what.rfind('/', what.find(": ")) + 1);
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("zeros are counted and found", "[winding]") {
  // (s-3)(s+2)^2((s+1)^2+16)(s+40): one right of 0.
  const auto f = [](Complex s) {
    return (s - 3.0) * (s + 2.0) * (s + 2.0) * ((s + 1.0) * (s + 1.0) + 16.0) * (s + 40.0);
  };
  const auto zeros = zeros_in(f, {-10, -10}, {10, 10});
  REQUIRE(zeros.size() == 5);
  int at_3 = 0, at_minus_2 = 0, pair = 0;
  for (const Complex& z : zeros) {
    at_3 += std::abs(z - 3.0) < 1e-6 ? 1 : 0;
    at_minus_2 += std::abs(z + 2.0) < 1e-4 ? 1 : 0;  // double: half the digits
    pair += std::abs(z - Complex(-1, z.imag() > 0 ? 4 : -4)) < 1e-6 ? 1 : 0;
  }
  CHECK(at_3 == 1);
  CHECK(at_minus_2 == 2);
  CHECK(pair == 2);
  CHECK(zeros_in(f, {-10, 5}, {10, 10}).empty());

  // 1 - a*w with w = exp(-s): one zero at ln(a), again in every period.
  for (const double a : {0.5, 0.99, 1.01, 20.0}) {
    const auto g = [a](Complex s) { return 1.0 - a * std::exp(-s); };
    CHECK(zeros_right_of(g, 0.0, 3.141592653589793, 64) == (a > 1 ? 1 : 0));
  }
  // Many turns: w^50 = 1/2 lies inside, 2 outside.
  const auto h = [](Complex s) { return 1.0 - 2.0 * std::exp(-50.0 * s); };
  CHECK(zeros_right_of(h, 0.0, 3.141592653589793, 400) == 50);
  CHECK(zeros_right_of(h, 0.02, 3.141592653589793, 400) == 0);
}

TEST_CASE("the published loop around the 24 V plant", "[poles]") {
  const ClosedLoop loop = closed_loop(paper_at_gain_one(1600), shipped_plant("p24"));
  CHECK(loop.stable());
  CHECK(loop.inertia_ratio == Approx(4.013).epsilon(1e-3));
  CHECK(loop.feed_forward == Approx(0.78336));
  REQUIRE(loop.regions.size() == 1);
  const auto& poles = loop.regions[0].poles_rad_s;
  REQUIRE(poles.size() == 3);
  CHECK(poles[0].real() == Approx(-7.6).epsilon(0.02));
  CHECK(poles[0].imag() == 0.0);
  CHECK(poles[1].real() == Approx(-391).epsilon(0.01));
  CHECK(poles[1].imag() == Approx(547).epsilon(0.01));
  CHECK(poles[2].real() == Approx(-5243).epsilon(0.01));
}

TEST_CASE("both regions of the shipped paper design are stable", "[poles]") {
  const ClosedLoop loop = closed_loop(shipped("paper"), shipped_plant("p24"));
  REQUIRE(loop.regions.size() == 2);
  CHECK(loop.stable());
  CHECK(loop.regions[0].voltage_gain_ohm == Approx(1.25).epsilon(1e-4));
  CHECK(loop.regions[1].voltage_gain_ohm == Approx(0.95).epsilon(1e-4));
  // More gain, less damping.
  CHECK(loop.regions[0].poles_rad_s[0].real() > loop.regions[1].poles_rad_s[0].real());
}

TEST_CASE("blocked lever: the pole is g*Jn*Kp", "[poles]") {
  const double expected = -500 * 4.896e-4 * 1600;
  CHECK(expected == Approx(-391.68));
  const ClosedLoop paper = closed_loop(shipped("paper"), shipped_plant("p24"));
  CHECK(paper.stall_pole_rad_s == Approx(expected).epsilon(1e-4));
  CHECK(closed_loop(shipped("paper"), shipped_plant("p48")).stall_pole_rad_s ==
        paper.stall_pole_rad_s);
  CHECK(closed_loop(shipped("lever"), shipped_plant("p24")).stall_pole_rad_s ==
        Approx(-500).epsilon(1e-4));
}

TEST_CASE("first unstable ratio of nominal to true inertia", "[poles]") {
  const struct {
    double kp, ratio;
  } published[] = {{0, 4.78}, {800, 11.5}, {1600, 47.5}, {3000, 2.7}, {4000, 1.75}};
  for (const auto& p : published) {
    INFO("Kp = " << p.kp);
    CHECK(first_unstable_ratio(paper_at_gain_one(p.kp)) == Approx(p.ratio).epsilon(0.02));
  }
}

TEST_CASE("full compensation is nearly unstable at the published inertia", "[poles]") {
  const ClosedLoop loop = closed_loop(paper_at_gain_one(0), shipped_plant("p24"));
  CHECK(loop.stable());
  bool found = false;
  for (const auto& s : loop.regions[0].poles_rad_s) {
    found |= std::abs(s.real() + 35) < 1.5 && std::abs(s.imag() - 1041) < 10;
  }
  CHECK(found);
}

TEST_CASE("lever is stable whatever its observer believes", "[poles]") {
  for (const char* name : {"p24", "p48", "linear"}) {
    const plant::Parameters nominal = shipped_plant(name);
    for (const double inertia : {0.1, 0.3, 1.0, 3.0, 10.0, 100.0}) {
      for (const double resistance : {0.5, 1.0, 2.0}) {
        for (const double inductance : {0.2, 1.0, 5.0}) {
          plant::Parameters p = nominal;
          p.lever.inertia_kg_m2 *= inertia;
          p.motor.resistance_ohm *= resistance;
          p.motor.inductance_h *= inductance;
          INFO(name << " J*" << inertia << " R*" << resistance << " L*" << inductance);
          CHECK(closed_loop(shipped("lever"), p).stable());
        }
      }
    }
  }
  // The observer's numbers do not reach the poles, except that g is one of them.
  Design d = shipped_design("lever");
  d.inertia_kg_m2 *= 20;
  d.kp_1_kg_m2 = 1 / d.inertia_kg_m2;
  const auto other = closed_loop(elaborate(d, shipped_registers()), shipped_plant("p24"));
  const auto same = closed_loop(shipped("lever"), shipped_plant("p24"));
  REQUIRE(other.regions[0].poles_rad_s.size() == same.regions[0].poles_rad_s.size());
  for (std::size_t i = 0; i < same.regions[0].poles_rad_s.size(); ++i) {
    CHECK(std::abs(other.regions[0].poles_rad_s[i] - same.regions[0].poles_rad_s[i]) < 1e-3);
  }
}

TEST_CASE("back-EMF compensation must not exceed the motor's", "[poles]") {
  // Slow pole, closed form: (Kt/R)*(Ke_n*gain - Ke) = s*(J + Kt*Ke_n/R*delay), where the velocity
  // is late by half the boxcar and the low-pass.
  const plant::Parameters p = shipped_plant("linear");
  const double gain = 1 + 1.3e-5, delay = 767e-6 / 2 + 1 / 500.0 + 1e-6;
  for (const double factor : {0.9, 1.0, 1.02}) {
    Design d = shipped_design("lever");
    d.emf_constant_v_s_rad *= factor;
    const ClosedLoop loop = closed_loop(elaborate(d, shipped_registers()), p);
    const double kt_r = p.motor.torque_constant_nm_a / p.motor.resistance_ohm;
    const double expected = kt_r *
                            (d.emf_constant_v_s_rad * gain - p.motor.back_emf_constant_v_s_rad) /
                            (p.lever.inertia_kg_m2 + kt_r * d.emf_constant_v_s_rad * delay);
    INFO("factor " << factor);
    CHECK(loop.regions[0].poles_rad_s[0].real() == Approx(expected).epsilon(0.01).margin(2e-4));
    CHECK(loop.stable() == (factor < 1.01));
  }
}

TEST_CASE("plant effects: quasi-static current, no back-EMF, friction", "[poles]") {
  plant::Parameters p = shipped_plant("linear");
  p.effects.inductance = false;
  const auto quasi = closed_loop(paper_at_gain_one(1600), p).regions[0];
  p.effects.inductance = true;
  p.motor.inductance_h = 1e-9;  // all but gone
  const auto limit = closed_loop(paper_at_gain_one(1600), p).regions[0];
  REQUIRE(quasi.poles_rad_s.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(std::abs(quasi.poles_rad_s[i] - limit.poles_rad_s[i]) <
          1e-3 * std::abs(limit.poles_rad_s[i]));
  }
  // Of lever alone the compensation remains: what was the back-EMF's is negative damping now.
  p = shipped_plant("linear");
  p.effects.back_emf = false;
  CHECK_FALSE(closed_loop(shipped("lever"), p).stable());
  p.effects.viscous = true;
  p.lever.viscous_nm_s_rad = 3e-3;  // more than Kt*Ke/R = 2.2e-3
  const ClosedLoop damped = closed_loop(shipped("lever"), p);
  CHECK(damped.damping_nm_s_rad == 3e-3);
  CHECK(damped.stable());
}

TEST_CASE("an unstable loop is refused with reason and mend", "[poles]") {
  const plant::Parameters p24 = shipped_plant("p24");
  CHECK(refusal(shipped("paper"), p24) == "no error");
  CHECK(refusal(shipped("lever"), p24) == "no error");
  CHECK(refusal(shipped("lever"), shipped_plant("linear")) == "no error");

  const std::string text = file_text(design_path("paper"));
  const Elaborated inertia = changed("paper", "kp_1_kg_m2 = 1600.0", "kp_1_kg_m2 = 3000.0");
  const std::string error = refusal(inertia, p24);
  INFO(error);
  const std::string begin =
      "changed.toml:" + std::to_string(line_of(text, "inertia_kg_m2")) +
      ": the loop around plant \"p24\" is unstable (torque up to 0.15 Nm: pole at ";
  CHECK(error.rfind(begin, 0) == 0);
  CHECK(contains(error, "Jn/J = 4.01, Jn*Kp = 1.47); set "));
  CHECK(contains(error, "observer.inertia_kg_m2 = 0.000122, the plant's"));
  CHECK(contains(error, "or control.kp = \"1/inertia\""));

  const Elaborated emf =
      changed("lever", "emf_constant_v_s_rad = 0.0302", "emf_constant_v_s_rad = 0.04");
  const std::string other = refusal(emf, p24);
  INFO(other);
  CHECK(other.rfind("changed.toml:" +
                        std::to_string(line_of(file_text(design_path("lever")), "emf_constant")) +
                        ": ",
                    0) == 0);
  CHECK(contains(other, "; set motor.emf_constant_v_s_rad = 0.0302, the plant's"));
  CHECK_FALSE(contains(other, "inertia_kg_m2 ="));
}

TEST_CASE("the readings of an absolute encoder are a delay of the wall", "[poles]") {
  LoopModel m = make_model(shipped("lever_absolute"), shipped_plant("linear"));
  CHECK(m.reading_ticks == 96);
  CHECK(m.reading_delay_ticks == 4);
  const double with = border(m, 0.001, 1).stiffness_nm_rad;
  CHECK(std::abs(closed_form_with_estimator(m, 0.001, 1) / with - 1) < 0.03);
  LoopModel edges = m;
  edges.reading_ticks = 1;
  edges.reading_delay_ticks = 0;
  CHECK(with < 0.8 * border(edges, 0.001, 1).stiffness_nm_rad);
  // The whole matrix has its two states more.
  m.raw_rad_s_rad *= static_cast<double>(m.m1) / 40;
  m.m1 = 40;
  const Wall wall{5, 0.005, 1};
  int ticks = 0;
  const Eigen::MatrixXd all = monodromy(m, wall, &ticks);
  CHECK(all.rows() == m.m1 + 12);
  CHECK(ticks == 480);  // of 20 in a PWM period
  double radius = 0;
  for (const Pole& z : eigenvalues(all)) radius = std::max(radius, std::abs(z));
  const double growth = std::log(radius) / (ticks * m.tick_s);
  CHECK(std::abs(poles(m, wall).front().real() - growth) < 1e-5 * std::abs(growth));
}
