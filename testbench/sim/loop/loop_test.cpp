// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the host of a scene writes, and when, on an engine that only notes it.
// Documentation: docs/architecture.md
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "feltgate/axes_ports.hpp"
#include "feltgate/largest.hpp"
#include "loop_fixture.hpp"
#include "sim/loop/columns.hpp"
#include "sim/loop/session.hpp"
#include "sim/loop/step_plan.hpp"
#include "sim/plant/plant.hpp"

namespace {

using namespace feltgate;

using Writes = std::vector<std::pair<int, std::uint32_t>>;

class Notes : public AnyBackend {
 public:
  explicit Notes(int axes) : axes_(axes) {}
  const char* name() const override { return "notes"; }
  const DesignInfo& design() const override { return design_; }
  int axes() const override { return axes_; }
  void write(int address, std::uint32_t data) override { writes.emplace_back(address, data); }
  void stop(bool pressed) override { stopped = pressed; }
  Clock now() const override { return 0; }

  Writes writes;
  bool stopped = false;

 private:
  int axes_;
  DesignInfo design_ = design_named("lever");
};

struct Stand {
  explicit Stand(const Scenario& of, int axes = 1)
      : scenario(of), host(std::make_unique<Notes>(axes)), session(scenario, host, options) {
    session.begin();
  }
  Notes& notes() { return static_cast<Notes&>(host.backend()); }
  /// The writes of the host up to a time, each with the clock at which it came.
  std::vector<std::pair<Clock, std::uint32_t>> until(double seconds) {
    std::vector<std::pair<Clock, std::uint32_t>> all;
    while (session.next() <= session.clock_of(seconds)) {
      const Clock now = session.next();
      notes().writes.clear();
      session.act(now, 0, 0, [](const Event&) {});
      for (const auto& w : notes().writes) all.emplace_back(now, w.second);
    }
    return all;
  }

  Scenario scenario;
  SessionOptions options;
  RunHost host;
  Session session;
};

Scenario scene() {
  Scenario s;
  s.duration_s = 1;
  s.arm_s = 0.25;
  return s;
}

Event at(double seconds) {
  Event e;
  e.at_s = seconds;
  return e;
}

}  // namespace

TEST_CASE("a host arms at arm_s and applies events in order") {
  Scenario s = scene();
  s.events = {at(0.125), at(0.5), at(0.5)};
  s.events[0].stop = true;
  s.events[1].scene = "wall";
  s.events[2].mode = 1;
  Stand stand(s);
  const DesignInfo& d = stand.host.design();
  const int free = d.scene_number("free"), wall = d.scene_number("wall");
  CHECK(stand.notes().writes == Writes{{d.control_address, control_word(d, free, 0, false)}});
  CHECK(stand.until(0.2).empty());
  CHECK(stand.notes().stopped);
  const Clock quarter = d.clock_hz / 4;
  CHECK(stand.until(1) == std::vector<std::pair<Clock, std::uint32_t>>{
                              {quarter, control_word(d, free, 0, true)},
                              {2 * quarter, control_word(d, wall, 0, true)},
                              {2 * quarter, control_word(d, wall, 1, true)}});
}

TEST_CASE("a scene that an event arms before arm_s is not armed again") {
  Scenario s = scene();
  s.events = {at(0.125), at(0.5)};
  s.events[0].arm = true;
  s.events[1].arm = false;
  Stand stand(s);
  const DesignInfo& d = stand.host.design();
  const int free = d.scene_number("free");
  CHECK(stand.until(1) == std::vector<std::pair<Clock, std::uint32_t>>{
                              {d.clock_hz / 8, control_word(d, free, 0, true)},
                              {d.clock_hz / 2, control_word(d, free, 0, false)}});
}

TEST_CASE("a host writes the words of a core to every axis") {
  Stand stand(scene(), 3);
  const int address = stand.host.design().control_address;
  REQUIRE(stand.notes().writes.size() == 3);
  for (int n = 0; n < 3; ++n) {
    CHECK(stand.notes().writes[static_cast<std::size_t>(n)].first == n * axes_stride + address);
  }
}

// Columns of a run: fixed beside float and double, nothing where there is none, and the table of
// the documentation.

namespace {

using Table = std::map<std::string, std::vector<double>>;

Table table_of(const std::string& engines, int every) {
  Scenario scene = shipped_scene("wall");
  scene.duration_s = 0.6;
  scene.expectations.clear();
  RunOptions options;
  options.engine = engines;
  options.row_every = every;
  Table table;
  const std::vector<Column> columns = row_columns(true, choose_backends(engines).names());
  options.row = [&](const Row& r) {
    for (const Column& c : columns) table[c.name].push_back(c.value(r));
  };
  run_on_p24(scene, options);
  return table;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = feltgate::larger(worst, std::abs(a[i] - b[i]));
  return worst;
}

}  // namespace

TEST_CASE("twin, double and float side by side: each as it computes") {
  const Table t = table_of("twin,double,float", 100);
  REQUIRE(t.at("time_s").size() == 6000);
  CHECK(t.at("time_s")[1] == 1e-4);
  CHECK(t.count("quad_velocity_rad_s") == 0);
  CHECK(t.count("rtl_velocity_rad_s") == 0);
  CHECK(t.at("velocity_rad_s") == t.at("twin_velocity_rad_s"));
  for (const char* signal : {"velocity_rad_s", "tau_ref_nm", "tau_hat_nm", "torque_nm", "current_a",
                             "voltage_v", "duty"}) {
    CAPTURE(signal);
    const auto& twin = t.at(std::string("twin_") + signal);
    const auto& exact = t.at(std::string("double_") + signal);
    const auto& single = t.at(std::string("float_") + signal);
    const double peak = largest_difference(exact, std::vector<double>(exact.size(), 0.0));
    CHECK(peak > 0.01);
    // Fixed point is off by units of its last place, binary32 by less than 2^-11 of the signal.
    CHECK(largest_difference(twin, exact) > 0);
    CHECK(largest_difference(twin, exact) < 0.02 * peak);
    CHECK(largest_difference(single, exact) > 0);
    CHECK(largest_difference(single, exact) < std::ldexp(peak, -11));
  }
  const auto is_binary32 = [](double v) { return static_cast<double>(static_cast<float>(v)) == v; };
  const auto all_binary32 = [&](const std::vector<double>& v) {
    return std::all_of(v.begin(), v.end(), is_binary32);
  };
  CHECK(all_binary32(t.at("float_velocity_rad_s")));
  CHECK(!all_binary32(t.at("double_velocity_rad_s")));
}

TEST_CASE("every n-th row is one of all rows") {
  const Table all = table_of("twin", 1), some = table_of("twin", 7);
  REQUIRE(some.at("theta_rad").size() == (all.at("theta_rad").size() + 6) / 7);
  for (std::size_t i = 0; i < some.at("theta_rad").size(); ++i) {
    REQUIRE(some.at("theta_rad")[i] == all.at("theta_rad")[7 * i]);
    REQUIRE(some.at("hand_torque_nm")[i] == all.at("hand_torque_nm")[7 * i]);
  }
}

TEST_CASE("docs/json.md has the table of columns; `feltgate run --columns` prints it") {
  std::ifstream file(std::string(FELTGATE_ROOT) + "/docs/json.md");
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  CHECK(page.find("\n\n" + columns_markdown() + "\n") != std::string::npos);
}

// The ends of the plant's steps; long steps do not change the results.

namespace {

constexpr Clock never = Clock{1} << 62;

struct Run {
  RunResult result;
  RunInputs inputs;
  std::vector<Clock> steps;
  Clock first_current = -1;  ///< begin of the first step with a current in the motor
};

/// `step` 0: from event to event.
Run run(Scenario scene, int step) {
  scene.step_given = step > 0;
  if (step > 0) scene.step_clocks = step;
  Run r;
  RunOptions options;
  options.engine = "twin";
  options.inputs = &r.inputs;
  Clock now = 0;
  options.plant_step = [&](Clock clocks, const plant::Observables& o) {
    r.steps.push_back(clocks);
    if (o.motor_current_a != 0.0 && r.first_current < 0) r.first_current = now;
    now += clocks;
  };
  r.result = run_on_p24(scene, options);
  return r;
}

}  // namespace

TEST_CASE("steps end where a duty takes effect, and are equal in between", "[step_plan]") {
  for (const Clock period : {1000, 2500, 1003, 40, 4}) {
    StepPlan plan(25, 250, period);
    const Clock phase = std::min<Clock>(25, period);
    CHECK(plan.phase() == phase);
    Clock now = 0, longest = 0, shortest = 250;
    for (Clock n = 0; n < 30; ++n) {
      const Clock duty = n * period + phase;
      while (now < duty) {
        const Clock end = plan.end_of_step(now, never, never);
        REQUIRE(end > now);
        if (n > 0) longest = std::max(longest, end - now);
        if (n > 0) shortest = std::min(shortest, end - now);
        now = end;
      }
      REQUIRE(now == duty);
    }
    CHECK(longest <= 250);
    CHECK(longest - shortest <= 1);
  }
}

TEST_CASE("a corner has fine steps before and after, and a stir has them all along",
          "[step_plan]") {
  for (const Clock corner : {500, 501, 524, 525, 526, 1025, 1026, 3333}) {
    StepPlan plan(25, 250, 1000);
    const Clock acts = (corner + 24) / 25 * 25;
    bool met = false;
    for (Clock now = 0; now < 5000;) {
      const Clock end = plan.end_of_step(now, now < corner ? corner : never, never);
      REQUIRE(end > now);
      if (now < acts && end >= acts) REQUIRE((now == acts - 25 && end == acts));
      if (now == acts) REQUIRE(end == acts + 25);
      met = met || end == acts;
      now = end;
    }
    CHECK(met);
  }
  StepPlan plan(25, 250, 1000);
  plan.stir(300, 100);
  for (Clock now = 300; now < 400; now += 25)
    REQUIRE(plan.end_of_step(now, never, never) == now + 25);
  CHECK(plan.end_of_step(400, never, never) == 525);
  CHECK(plan.end_of_step(525, never, 600) == 600);
}

TEST_CASE("what is stiff has shorter steps", "[step_plan]") {
  const plant::Parameters plant = p24();
  const auto longest = [&plant](double damping_nm_s_rad) {
    Scenario s;
    s.effects = plant.effects;
    plant::HandPhase cord;
    cord.kind = plant::HandPhase::Kind::kCord;
    cord.cord.damping_nm_s_rad = damping_nm_s_rad;
    s.hand.phases = {cord};
    return longest_step_clocks(s, plant, 50e6);
  };
  CHECK(longest(0.1) == 250);
  CHECK(longest(10.0) < 250);
  CHECK(longest(10.0) > 25);
  CHECK(longest(300.0) == 25);
}

TEST_CASE("long steps, the same run", "[step_plan]") {
  for (const char* name : {"torque_step_cord", "damper", "hold_and_release"}) {
    CAPTURE(name);
    const Scenario scene = shipped_scene(name);
    const Run usual = run(scene, 25), free = run(scene, 0);
    CHECK(6 * free.steps.size() < usual.steps.size());
    CHECK(free.result.felt.limits.at("gates_closed").seconds ==
          usual.result.felt.limits.at("gates_closed").seconds);
    // A gate that opens by what the scene says acts as soon as with short steps.
    CHECK(free.first_current == usual.first_current);
    CHECK(free.result.position.steps == usual.result.position.steps);
    for (const auto& [figure, value] : usual.result.figures) {
      if (figure.rfind("overshoot", 0) == 0 || figure.rfind("final_error_pct", 0) == 0) continue;
      CAPTURE(figure, value);
      // A permille, or what one tick, one microsecond and one step of the velocity make of it.
      const double least = figure.find("_ms") != std::string::npos     ? 2e-3
                           : figure.find("rad_s") != std::string::npos ? 2e-2
                                                                       : 1e-5;
      CHECK(std::abs(free.result.figures.at(figure) - value) <= 1e-3 * std::abs(value) + least);
    }
  }
}
