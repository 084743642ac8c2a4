// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Margins of laws with states: against the wall's, a filter's closed form, and the core's bits.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "feltgate/largest.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/rates/margin.hpp"
#include "studies/rates/rates.hpp"

using namespace feltgate;
using namespace feltgate::rates;

namespace {

const std::string root = FELTGATE_ROOT, built = FELTGATE_BUILD_DIR;

design::Elaborated law_core() {
  return design::elaborate(design::read_design(root + "/rtl/designs/lever_law.toml"),
                           design::read_registers(root + "/rtl/registers.toml"));
}

plant::Parameters lever() {
  plant::Parameters p = plant::read_plant_file(root + "/vectors/plants/linear.toml");
  p.effects.viscous = true;
  return p;
}

/// A spring on the filtered angle; `more`: a statement that no torque shows.
LawSource filtered(const std::string& frequency, const std::string& more = "") {
  return {"filtered.law", "rate = 40 kHz\nparam stiffness = 0.1 Nm in 0.01 .. 2 Nm\n" + more +
                              "out torque = -stiffness * lowpass(position, " + frequency + ")\n"};
}

Place at(double stiffness_nm) { return {0.01, 0, 0, {0.01}, {stiffness_nm}, stiffness_nm}; }

/// The margins that `feltgate rates` gives for this law where a hand turns the lever to 0.3 rad.
Report measured(const std::string& law) {
  const std::string path = built + "/places_margin.toml";
  std::ofstream(path)
      << "title = \"places\"\nabout = \"-\"\nduration_s = 0.2\nplant = \"linear\"\n[core]\n"
         "scene = \"law\"\nlaw = \"x\"\narm_s = 0.01\n[effects]\nviscous = true\n"
         "[[hand.phase]]\nkind = \"prescribed\"\nmotion = [{ kind = \"hold\", duration_s = 0.02 "
         "}, { kind = \"minimum_jerk\", duration_s = 0.15, to_rad = 0.3 }]\n";
  Scenario scene = read_scenario(path);
  std::remove(path.c_str());
  const plant::Parameters p = plant::read_plant_file(root + "/vectors/plants/linear.toml");
  resolve_effects(scene, p.effects);
  Options options;
  options.rates_hz = {};
  return measure(scene, {"x.law", law}, p, law_core(), options);
}

double margin_of(const std::string& law) {
  const Report r = measured(law);
  return r.rows.back().margin.of == Margin::Of::none ? -1 : r.rows.back().margin.ratio;
}

/// Growth of the swing of a lever that a hand lets go at 0.05 rad: last tenths over the first.
double swing_growth(const LawSource& source, double stiffness_nm) {
  const std::string path = built + "/states_margin.toml";
  std::ofstream(path)
      << "title = \"a filtered spring\"\nabout = \"-\"\nduration_s = 1.2\nplant = "
         "\"linear\"\n[core]\nscene = \"law\"\n"
         "law = \"filtered\"\narm_s = 0.13\n[parameters]\nstiffness = "
      << stiffness_nm
      << "\ndead_voltage = 0\ndead_voltage_slope = 0\n[effects]\nviscous = true\n[[hand.phase]]\n"
      << "kind = \"prescribed\"\nduration_s = 0.15\nmotion = [{ kind = "
         "\"minimum_jerk\", duration_s = 0.1, to_rad = 0.05 }]\n"
         "[[hand.phase]]\nkind = \"free\"\n";
  Scenario scene = read_scenario(path);
  std::remove(path.c_str());
  const plant::Parameters p = plant::read_plant_file(root + "/vectors/plants/linear.toml");
  resolve_effects(scene, p.effects);
  const DesignInfo& design = design_named("lever_law");
  const auto law = make_scene_law(fastest(source, law::target_of(design)), design);
  double first = 0, last = 0;
  RunOptions options;
  options.design = "lever_law";
  options.engine = "twin";
  options.law = law.get();
  options.row_every = 100;
  options.row = [&](const Row& r) {
    if (r.time_s > 0.3 && r.time_s < 0.6) first = larger(first, std::fabs(r.theta_rad));
    if (r.time_s > 0.9) last = larger(last, std::fabs(r.theta_rad));
  };
  run_scenario(scene, p, options);
  return last / first;
}

}  // namespace

TEST_CASE("a law without states has the poles of a wall") {
  const stability::LoopModel m = stability::make_model(law_core(), lever());
  stability::LinearLaw law{Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 3), Eigen::RowVectorXd(0)};
  law.d << -4, -0.005, 0;
  for (const auto& [ticks, delay] : {std::pair{1, 0}, {100, 2}, {1000, 3}}) {
    const auto wall = stability::poles(m, stability::Wall{4, 0.005, ticks, delay}).front();
    const auto own = stability::poles(m, law, 1, 0, ticks, delay).front();
    CAPTURE(ticks);
    CHECK(std::abs(own - wall) < 1e-6 * std::abs(wall));
    CHECK(std::abs(stability::poles(m, law, 2, 0, ticks, delay).front() - wall) >
          1e-3 * std::abs(wall));
  }
}

TEST_CASE("a law is linear at a place: by its filter, its formula and its signs") {
  const double share = 1 - std::exp(-2 * 3.14159265358979323846 * 30 / 40e3);
  const law::Law law = read(filtered("30 Hz"), 40e3);
  const auto linear = linearised(law, at(0.5), 2 * 3.14159265358979323846 / 4096);
  REQUIRE(linear);
  REQUIRE(linear->a.rows() == 1);
  CHECK(linear->a(0, 0) == Approx(1 - share));
  CHECK(linear->b(0, 0) == Approx(share));
  CHECK(linear->c[0] == Approx(-0.5 * (1 - share)));
  CHECK(linear->d[0] == Approx(-0.5 * share));
  // At 5 Hz the filter passes all but 1.4 %.
  CHECK(stability::steepness(*linear, 1 / 40e3).most_nm_rad == Approx(0.4931).epsilon(1e-3));
  // A damper of 0.002 Nms/rad has that times the angular frequency.
  stability::LinearLaw damper{Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 3), Eigen::RowVectorXd(0)};
  damper.d << 0, -0.002, 0;
  CHECK(stability::steepness(damper, 1e-6).most_nm_rad == Approx(0.002 * 2 * 3.14159265 * 500));
  // What no torque shows, and what turns by itself, is not in the loop.
  const std::string beside =
      "phase angle = 0 in 0 .. 1\nnext angle = angle + 100 Hz * dt\n"
      "event turned(lowpass(velocity, 10 Hz)) when angle < 0.5\n";
  const law::Law more = read(filtered("30 Hz", beside), 40e3);
  Place place = at(0.5);
  place.states.assign(more.states.size(), 0.01);
  const auto of_more = linearised(more, place, 2 * 3.14159265358979323846 / 4096);
  REQUIRE(of_more);
  CHECK(of_more->a.rows() == 1);
  // At a jump there is no slope.
  const LawSource jumps{"jumps.law",
                        "param stiffness = 0.1 Nm in 0.01 .. 2 Nm\nout torque = "
                        "if position < 0.01 then stiffness else 0 Nm\n"};
  CHECK_FALSE(linearised(read(jumps, 40e3), at(0.5), 2 * 3.14159265358979323846 / 4096));
}

TEST_CASE("a filtered spring ends where the closed form says, and where the bits swing") {
  const LawSource source = filtered("30 Hz");
  const stability::LoopModel m = stability::make_model(law_core(), lever());
  const auto linear = linearised(read(source, 40e3), at(0.1), 2 * 3.14159265358979323846 / 4096);
  REQUIRE(linear);
  const Margin found = margin(m, *linear, 0.1, 25, 25);
  CHECK(found.of == Margin::Of::torque);
  // J t s^3 + (J + B t) s^2 + B s + k of a filter with the time t: Routh, for what is left of B.
  const double t = 1 / (2 * 3.14159265358979323846 * 30), j = m.inertia_kg_m2;
  const double b = m.motor_damping_nm_s_rad * (1 - m.compensated) + m.damping_nm_s_rad;
  CHECK(found.border == Approx(b * (j + b * t) / (j * t)).epsilon(0.05));
  // Within 5 % of the core's bits.
  CHECK(swing_growth(source, 0.95 * found.border) < 1);
  CHECK(swing_growth(source, 1.05 * found.border) > 1);
}

TEST_CASE("the margin of a law with states is that of its worst place, however it is written") {
  // A damper before 0.15 rad has the most torque per angle, a wall beyond 0.28 the least margin.
  const double two_places = margin_of(
      "rate = 40 kHz\nlet x = lowpass(position, 1.5 kHz)\nlet v = lowpass(velocity, 1.5 kHz)\n"
      "out torque = if position < 0.15 then -0.02 Nm s * v else if position < 0.28 then 0 Nm "
      "else -15 Nm * (x - 0.28)\n");
  const double wall =
      margin_of("rate = 40 kHz\nout torque = -15 Nm * (lowpass(position, 1.5 kHz) - 0.28)\n");
  CHECK(two_places == Approx(wall).epsilon(0.01));
  CHECK(wall < 1);
  // A filter by hand, of the same share, in a state of any range.
  const double share = 1 - std::exp(-2 * 3.14159265358979323846 * 64 / 40e3);
  const auto by_hand = [&](const std::string& end) {
    return margin_of(
        fmt::format("rate = 40 kHz\nstate y = 0 in -{0} .. {0}\n"
                    "let z = y + {1:.15g} * (position - y)\nnext y = clamp(z, -{0}, {0})\n"
                    "out torque = -1 Nm * z\n",
                    end, share));
  };
  const double filter = margin_of("rate = 40 kHz\nout torque = -1 Nm * lowpass(position, 64 Hz)\n");
  CHECK(filter < 1);
  CHECK(by_hand("1") == Approx(filter).epsilon(0.02));
  CHECK(by_hand("1000") == Approx(filter).epsilon(0.02));
  // Where no torque is stable there is no border: a spring that pushes away.
  CHECK(margin_of("rate = 40 kHz\nout torque = 1 Nm * lowpass(position, 64 Hz)\n") == -1);
  // Filters of any frequency that the law's own rate allows.
  CHECK(margin_of("rate = 40 kHz\nout torque = -1 Nm * lowpass(position, 4 kHz)\n") > 0);
  // A delay line counts runs, with or without dt.
  const Report line = measured(
      "rate = 40 kHz\nline past[200] in -4 .. 4\nnext past = clamp(position, -4, 4)\n"
      "out torque = -1 Nm * past[200]\n");
  CHECK(line.rows.back().margin.of == Margin::Of::none);
  CHECK(std::count(line.notes.begin(), line.notes.end(), "no margin: the law has a delay line") ==
        1);
}
