// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The benchmark on short works: every back-end is there, the integer ones agree, errors stay
// within what the formats say, and an engine that is wrong by one bit is found.
// Documentation: docs/speed-for-accuracy.md
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "studies/bench/measure.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::bench;

std::vector<std::unique_ptr<Runner>> runners(const std::vector<std::string>& names) {
  std::vector<std::unique_ptr<Runner>> all;
  for (const std::string& name : names) all.push_back(make_runner(name));
  return all;
}

Options short_run() {
  Options o;
  o.repetitions = 2;
  o.passes = 2;
  return o;
}

/// An engine with one parameter word one too large.
class OneBitOff : public Runner {
 public:
  OneBitOff() : Runner("one_bit_off", Arithmetic::integer), right_(make_runner("twin_tick")) {}
  void prepare(const Work& work) override { right_->prepare(work); }
  void run(const Work& work) override { right_->run(wrong(work)); }
  void inspect(const Work& work, const Inspector& each) override {
    right_->inspect(wrong(work), each);
  }

 private:
  static Work wrong(Work work) {
    for (const ParameterInfo& p : Lever::parameters) {
      if (p.address != Lever::A::velocity_a1) continue;
      const auto word = static_cast<std::uint32_t>(p.raw + 1);
      work.writes.insert(work.writes.begin(), {0, p.address, word, p.si});
    }
    return work;
  }
  std::unique_ptr<Runner> right_;
};

}  // namespace

TEST_CASE("all back-ends, their bits, their errors, their JSON") {
  const std::vector<Work> works{slow_small_signals("lever", 0.06)};
  Options options = short_run();
  const Result r = measure(runners(runner_names()), works, {}, options);
  CHECK(r.divergence.empty());

  const auto j = nlohmann::json::parse(json(r, works, circumstances()));
  CHECK(j.at("schema") == "feltgate-bench/2");
  CHECK(j.at("integer_engines_agree") == true);
  for (const char* name :
       {"rtl", "twin_clock", "twin_event", "twin_tick", "double", "float", "quad"}) {
    INFO(name);
    REQUIRE(j.at("engines").contains(name));
    const auto& e = j["engines"][name];
    CHECK(e.at("ns_per_tick").at("median") > 0.0);
    CHECK(e.at("ns_per_tick").at("min") <= e.at("ns_per_tick").at("max"));
    if (e.at("arithmetic") == "integer") CHECK(e.at("hash") == j["engines"]["rtl"].at("hash"));
    if (std::string(name) != "quad") CHECK(e.contains("torque_error_nm"));
  }
  for (const char* name : {"rtl", "twin_clock", "twin_event"}) {
    const auto& e = j["engines"][name];
    const double updates = e.at("updates_per_s").at("median"), clocks = e["clocks_per_s"]["median"];
    CHECK(updates * Lever::clocks_per_tick == Approx(clocks));
    CHECK(updates * e["ns_per_tick"]["median"].get<double>() == Approx(1e9));
  }
  CHECK_FALSE(j["engines"]["twin_tick"].contains("updates_per_s"));
  CHECK(j.at("device").at("tick_to_ns").at("median") > 0.0);
  CHECK(text(r, works, circumstances()).find("TwinDevice::tick_to, ns/tick: ") !=
        std::string::npos);

  // Half a step over a1 is where the rounded low-pass stands still: counts that move this slowly
  // show it whole, and nothing more.
  const double dead_band_rad_s =
      0.5 * std::ldexp(1.0, -Lever::f.velocity.fraction) / 0.00049987502083072939;
  const ErrorFigure& velocity = r.find("twin_tick")->velocity_rad_s;
  CHECK(velocity.max() < 1.01 * dead_band_rad_s);
  CHECK(velocity.max() > 0.9 * dead_band_rad_s);
  // The damper's torque: that error, and a step for rounding and for what tau_ref gives up.
  CHECK(r.find("twin_tick")->torque_nm.max() <
        0.03 * dead_band_rad_s + 2 * std::ldexp(1.0, -Lever::f.torque.fraction));
  CHECK(r.find("double")->velocity_rad_s.max() < 1e-12);
  CHECK(r.find("float")->velocity_rad_s.max() > r.find("double")->velocity_rad_s.max());
}

TEST_CASE("one bit in one word is a divergence with tick and signal") {
  const std::vector<Work> works{slow_small_signals("lever", 0.02)};
  auto engines = runners({"twin_event", "twin_clock"});
  engines.push_back(std::make_unique<OneBitOff>());
  const Result r = measure(engines, works, {}, short_run());
  INFO(r.divergence);
  CHECK(r.divergence.find("slow_small, tick ") == 0);
  CHECK(r.divergence.find("velocity: twin_event ") != std::string::npos);
  CHECK(r.divergence.find("one_bit_off ") != std::string::npos);
  CHECK(r.find("one_bit_off")->hash != r.find("twin_event")->hash);
  CHECK(r.find("twin_clock")->hash == r.find("twin_event")->hash);
  const auto j = nlohmann::json::parse(json(r, works, circumstances()));
  CHECK(j.at("integer_engines_agree") == false);
  CHECK(text(r, works, circumstances()).find("DIFFERENT: slow_small") != std::string::npos);
}

TEST_CASE("a recorded scene replayed is the closed loop again") {
  const Scene scene = read_scene(FELTGATE_ROOT, "torque_step_cord");
  std::vector<double> velocity, tau_hat;
  RunOptions options;
  options.engine = "twin";
  options.row = [&](const Row& row) {
    velocity.push_back(row.velocity_rad_s);
    tau_hat.push_back(row.tau_hat_nm);
  };
  run_scenario(scene.scenario, scene.plant, options);

  const Work work = record_scene(scene, "lever");
  REQUIRE(work.ticks.size() == velocity.size());
  CHECK(work.writes.size() >= 5);  // the steps of the reference
  std::size_t tick = 0, different = 0;
  make_runner("twin_tick")->inspect(work, [&](const TickResult& r) {
    different += r.velocity_rad_s != velocity[tick] || r.tau_hat_nm != tau_hat[tick] ? 1 : 0;
    ++tick;
  });
  CHECK(tick == velocity.size());
  CHECK(different == 0);
}

TEST_CASE("median and ends") {
  CHECK(spread({3, 1, 2}).median == 2);
  CHECK(spread({4, 1, 2, 3}).median == 2.5);
  CHECK(spread({4, 1, 2, 3}).low == 1);
  CHECK(spread({4, 1, 2, 3}).high == 4);
}
