// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The benchmark. Documentation: docs/speed-for-accuracy.md
#include "studies/bench/measure.hpp"

#include <time.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "feltgate/device.hpp"
#include "feltgate/generated/lever.hpp"

namespace feltgate::bench {

// Measures CPU time of this process, so other programs on the machine do not count.

/// CPU time of the action, seconds.
template <class Do>
double cpu_seconds(Do&& action) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double begin = now();
  action();
  return now() - begin;
}

// Measures TwinDevice::tick_to, the call by which a program of one's own moves a lever.

/// CPU time of a tick, ns: an armed lever in the scene wall, angle by angle, 0.02 rad to and fro at
/// up to 2 rad/s, a third of the way in the wall.
double device_ns_per_tick(std::size_t ticks);

namespace {

/// FNV-1a, a word at a time.
void add_to_hash(std::uint64_t* hash, const RawTick& raw) {
  for (const std::int64_t v : raw) {
    *hash = (*hash ^ static_cast<std::uint64_t>(v)) * 0x100000001b3u;
  }
}

Spread scaled_inverse(const Spread& s, double numerator) {
  return {numerator / s.median, numerator / s.high, numerator / s.low};
}

class Measurement {
 public:
  Measurement(const std::vector<std::unique_ptr<Runner>>& runners, const std::vector<Work>& works,
              const std::vector<Scene>& closed_loops, const Options& options)
      : runners_(runners), works_(works), closed_loops_(closed_loops), options_(options) {}

  Result run() {
    for (const auto& runner : runners_) {
      BackendResult e;
      e.name = runner->name();
      e.integer = runner->integer();
      e.hash = 0xcbf29ce484222325u;
      result_.engines.push_back(e);
    }
    for (const Work& work : works_) {
      result_.simulated_s += work.simulated_s;
      result_.ticks += work.ticks.size();
      inspect(work);
    }
    estimate_length();
    for (int k = 0; k < options_.repetitions; ++k) repeat();
    conclude();
    return std::move(result_);
  }

 private:
  /// Errors of every back-end against quad, and every integer back-end against the first one.
  void inspect(const Work& work) {
    std::vector<TickResult> exact;
    std::vector<RawTick> integers;
    std::string integers_of;
    exact.reserve(work.ticks.size());
    for (const auto& runner : runners_) {
      if (runner->name() == "quad") {
        runner->inspect(work, [&exact](const TickResult& r) { exact.push_back(r); });
      }
    }
    for (std::size_t i = 0; i < runners_.size(); ++i) {
      Runner& runner = *runners_[i];
      BackendResult& e = result_.engines[i];
      if (e.name == "quad") continue;
      const bool first = e.integer && integers_of.empty();
      if (first) integers_of = e.name;
      std::size_t tick = 0;
      inspect_s_[e.name] += cpu_seconds([&] {
        runner.inspect(work, [&](const TickResult& r) {
          if (tick < exact.size()) {
            e.compared = true;
            e.velocity_rad_s.add(r.velocity_rad_s - exact[tick].velocity_rad_s);
            e.tau_hat_nm.add(r.tau_hat_nm - exact[tick].tau_hat_nm);
            e.torque_nm.add(r.torque_nm - exact[tick].torque_nm);
          }
          if (e.integer) add_to_hash(&e.hash, r.raw);
          if (first) integers.push_back(r.raw);
          if (e.integer && !first) compare(work, tick, integers_of, integers, e.name, r.raw);
          ++tick;
        });
      });
      if (e.integer && tick != integers.size() && result_.divergence.empty()) {
        result_.divergence = fmt::format("{}: {} shows {} ticks, {} {}", work.name, e.name, tick,
                                         integers_of, integers.size());
      }
    }
  }

  void compare(const Work& work, std::size_t tick, const std::string& a,
               const std::vector<RawTick>& expected, const std::string& b, const RawTick& raw) {
    if (!result_.divergence.empty() || tick >= expected.size() || expected[tick] == raw) return;
    for (std::size_t s = 0; s < raw_signals; ++s) {
      if (expected[tick][s] == raw[s]) continue;
      result_.divergence = fmt::format("{}, tick {}, {}: {} {}, {} {}", work.name, tick,
                                       raw_names[s], a, expected[tick][s], b, raw[s]);
      return;
    }
  }

  bool fast(const BackendResult& e) const {
    return e.name != "quad" && inspect_s_.at(e.name) < 0.3e-6 * static_cast<double>(result_.ticks);
  }

  void estimate_length() {
    inspect_s_["quad"] = 0.5e-6 * static_cast<double>(result_.ticks);
    for (const BackendResult& e : result_.engines) {
      total_s_ += inspect_s_.at(e.name) * (fast(e) ? options_.passes : 1);
    }
    for (const Scene& s : closed_loops_) total_s_ += 0.1 * s.scenario.duration_s;
    total_s_ *= options_.repetitions;
  }

  void tell(double spent_s) {
    done_s_ += spent_s;
    if (options_.progress) options_.progress(std::min(1.0, done_s_ / total_s_));
  }

  void repeat() {
    std::vector<std::vector<double>> spent(runners_.size());
    for (const Work& work : works_) {
      for (int pass = 0; pass < options_.passes; ++pass) {
        for (std::size_t i = 0; i < runners_.size(); ++i) {
          const BackendResult& e = result_.engines[i];
          if (pass > 0 && !fast(e)) continue;
          Runner& runner = *runners_[i];
          runner.prepare(work);
          const double s = cpu_seconds([&] { runner.run(work); });
          if (spent[i].size() <= static_cast<std::size_t>(pass)) spent[i].push_back(0);
          spent[i][static_cast<std::size_t>(pass)] += s;
          tell(inspect_s_.at(e.name) * work.simulated_s / result_.simulated_s);
        }
      }
    }
    for (std::size_t i = 0; i < runners_.size(); ++i) {
      for (const double s : spent[i]) {
        result_.engines[i].samples.push_back(1e9 * s / static_cast<double>(result_.ticks));
      }
    }
    device_ns_.push_back(device_ns_per_tick(100'000));
    for (const Scene& scene : closed_loops_) {
      RunOptions options;
      options.engine = "twin";
      const double s = cpu_seconds([&] { run_scenario(scene.scenario, scene.plant, options); });
      loop_samples_[scene.scenario.name].push_back(scene.scenario.duration_s / s);
      tell(0.1 * scene.scenario.duration_s);
    }
  }

  void conclude() {
    const double tick_ns = 1e9 * result_.simulated_s / static_cast<double>(result_.ticks);
    for (std::size_t i = 0; i < runners_.size(); ++i) {
      BackendResult& e = result_.engines[i];
      e.ns_per_tick = spread(e.samples);
      e.speed = scaled_inverse(e.ns_per_tick, tick_ns);
      if (runners_[i]->has_clocks()) {
        double clocks = 0;
        for (const Work& w : works_) clocks += static_cast<double>(w.inputs.clocks);
        e.clocks_per_s =
            scaled_inverse(e.ns_per_tick, 1e9 * clocks / static_cast<double>(result_.ticks));
        e.updates_per_s = scaled_inverse(e.ns_per_tick, 1e9);
      }
    }
    for (const Scene& s : closed_loops_) {
      result_.loops.push_back(
          {s.scenario.name, s.scenario.duration_s, spread(loop_samples_[s.scenario.name])});
    }
    result_.device_ns = spread(device_ns_);
  }

  const std::vector<std::unique_ptr<Runner>>& runners_;
  const std::vector<Work>& works_;
  const std::vector<Scene>& closed_loops_;
  const Options& options_;
  Result result_;
  std::map<std::string, double> inspect_s_;
  std::map<std::string, std::vector<double>> loop_samples_;
  std::vector<double> device_ns_;
  double total_s_ = 0, done_s_ = 0;
};

}  // namespace

Spread spread(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  const std::size_t n = samples.size();
  return {0.5 * (samples[(n - 1) / 2] + samples[n / 2]), samples.front(), samples.back()};
}

const BackendResult* Result::find(const std::string& name) const {
  for (const BackendResult& e : engines) {
    if (e.name == name) return &e;
  }
  return nullptr;
}

Result measure(const std::vector<std::unique_ptr<Runner>>& runners, const std::vector<Work>& works,
               const std::vector<Scene>& closed_loops, const Options& options) {
  return Measurement(runners, works, closed_loops, options).run();
}

// The time of TwinDevice::tick_to.

double device_ns_per_tick(std::size_t ticks) {
  TwinDevice device(design_info<Lever>());
  device.select("wall");
  device.set("self_test_pulse", 0);  // no self-test, for the lever does not rest
  device.set("wall_contact", device.counts(0.005));
  device.arm();
  std::vector<double> angles_rad(ticks);
  for (std::size_t k = 0; k < ticks; ++k)
    angles_rad[k] = 0.01 * std::sin(2e-4 * static_cast<double>(k));
  device.tick_to(0);
  double pushed = 0;
  const double s = cpu_seconds([&] {
    for (const double angle_rad : angles_rad) pushed += device.tick_to(angle_rad).torque_nm;
  });
  if (!device.armed() || pushed == 0) throw std::logic_error("the wall was not felt");
  return 1e9 * s / static_cast<double>(ticks);
}

}  // namespace feltgate::bench
