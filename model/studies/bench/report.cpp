// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The benchmark's result as JSON and as text. Documentation: docs/speed-for-accuracy.md
#include "studies/bench/report.hpp"

#include <fmt/format.h>
#include <time.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "files/json_text.hpp"

namespace feltgate::bench {

using Json = nlohmann::ordered_json;

namespace {

Json spread_json(const Spread& s) {
  return {{"median", s.median}, {"min", s.low}, {"max", s.high}};
}
Json error_json(const ErrorFigure& e) { return {{"max", e.max()}, {"rms", e.rms()}}; }

std::string hex(std::uint64_t v) { return fmt::format("{:016x}", v); }

template <class... Values>
void print(std::string* out, const char* format, const Values&... values) {
  *out += fmt::format(fmt::runtime(format), values...);
}

}  // namespace

Circumstances circumstances() {
  Circumstances c;
  c.version = FELTGATE_VERSION;
  std::ifstream cpu("/proc/cpuinfo");
  for (std::string line; std::getline(cpu, line);) {
    if (line.rfind("model name", 0) == 0) {
      c.machine = line.substr(line.find(':') + 2);
      break;
    }
  }
  if (c.machine.empty()) c.machine = "unknown processor";
  c.machine += fmt::format(", {} cores", std::thread::hardware_concurrency());
#ifdef __clang__
  c.compiler = "clang " __clang_version__;
#else
  c.compiler = "g++ " __VERSION__;
#endif
  char date[20];
  const time_t now = time(nullptr);
  tm utc{};
  strftime(date, sizeof date, "%Y-%m-%d", gmtime_r(&now, &utc));
  c.date = date;
  return c;
}

std::string json(const Result& r, const std::vector<Work>& works, const Circumstances& c) {
  Json j{{"schema", "feltgate-bench/1"}, {"version", c.version}, {"machine", c.machine},
         {"compiler", c.compiler},       {"date", c.date},       {"design", "lever"}};
  for (const Work& w : works) {
    j["scenes"].push_back(
        {{"name", w.name}, {"simulated_s", w.simulated_s}, {"ticks", w.ticks.size()}});
  }
  for (const BackendResult& e : r.engines) {
    Json& o = j["engines"][e.name];
    o = {{"arithmetic", e.integer ? "integer" : "real"},
         {"ns_per_tick", spread_json(e.ns_per_tick)},
         {"simulated_s_per_s", spread_json(e.speed)}};
    if (e.clocks_per_s) o["clocks_per_s"] = spread_json(*e.clocks_per_s);
    if (e.updates_per_s) o["updates_per_s"] = spread_json(*e.updates_per_s);
    if (e.compared) {
      o["velocity_error_rad_s"] = error_json(e.velocity_rad_s);
      o["tau_hat_error_nm"] = error_json(e.tau_hat_nm);
      o["torque_error_nm"] = error_json(e.torque_nm);
    }
    if (e.integer) o["hash"] = hex(e.hash);
    o["samples_ns_per_tick"] = e.samples;
  }
  if (r.bounds) {
    j["bounds_of_integer_engines"] = {{"velocity_error_rad_s", r.bounds->velocity_rad_s},
                                      {"tau_hat_error_nm", r.bounds->tau_hat_nm},
                                      {"torque_error_nm", r.bounds->torque_nm}};
  }
  j["integer_engines_agree"] = r.divergence.empty();
  if (!r.divergence.empty()) j["first_divergence"] = r.divergence;
  for (const LoopResult& l : r.loops) {
    j["closed_loop"][l.scene] = {{"simulated_s", l.simulated_s},
                                 {"simulated_s_per_s", spread_json(l.speed)}};
  }
  j["device"] = {{"tick_to_ns", spread_json(r.device_ns)}};
  for (const Goal& g : r.goals) {
    Json& o = j["goals"][g.key];
    o = spread_json(g.value);
    o[g.at_most ? "at_most" : "at_least"] = g.goal;
    o["met"] = g.met();
  }
  return files::json_text(j);
}

std::string text(const Result& r, const std::vector<Work>& works, const Circumstances& c) {
  std::string s;
  print(&s, "{}, {}, {}, design lever\nscenes:", c.machine.c_str(), c.compiler.c_str(),
        c.date.c_str());
  for (const Work& w : works) print(&s, " {} ({:g} s)", w.name.c_str(), w.simulated_s);
  print(&s, "; {} ticks in all\n\n{:<11} {:>10} {:>21} {:>12} {:>21} {:>21} {:>21}\n", r.ticks,
        "engine", "ns/tick", "min .. max", "x real time", "velocity error rad/s",
        "tau_hat error Nm", "torque error Nm");
  print(&s, "{:<11} {:>10} {:>21} {:>12} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "", "", "",
        "", "max", "rms", "max", "rms", "max", "rms");
  for (const BackendResult& e : r.engines) {
    print(&s, "{:<11} {:10.4g} {:10.4g} {:10.4g} {:12.4g}", e.name.c_str(), e.ns_per_tick.median,
          e.ns_per_tick.low, e.ns_per_tick.high, e.speed.median);
    if (e.compared) {
      for (const ErrorFigure* f : {&e.velocity_rad_s, &e.tau_hat_nm, &e.torque_nm}) {
        print(&s, " {:10.3g} {:10.3g}", f->max(), f->rms());
      }
      s += "\n";
    } else {
      s += e.name == "quad" ? "   the reference\n" : "\n";
    }
  }
  if (r.bounds) {
    print(&s, "{:<57} {:10.3g} {:>10} {:10.3g} {:>10} {:10.3g}\n",
          "proven bound of the integers, no limit or ramp at work", r.bounds->velocity_rad_s, "",
          r.bounds->tau_hat_nm, "", r.bounds->torque_nm);
  }
  s += "\n";
  if (r.divergence.empty()) {
    std::string names;
    std::uint64_t hash = 0;
    for (const BackendResult& e : r.engines) {
      if (!e.integer) continue;
      names += (names.empty() ? "" : ", ") + e.name;
      hash = e.hash;
    }
    print(&s, "equal in every bit of every tick: {} (hash {})\n", names.c_str(), hex(hash).c_str());
  } else {
    print(&s, "DIFFERENT: {}\n", r.divergence.c_str());
  }
  for (const BackendResult& e : r.engines) {
    if (!e.updates_per_s) continue;
    const Spread& u = *e.updates_per_s;
    print(&s, "million control updates simulated per second, {}: {:.3g} ({:.3g} .. {:.3g})\n",
          e.name.c_str(), 1e-6 * u.median, 1e-6 * u.low, 1e-6 * u.high);
  }
  for (const LoopResult& l : r.loops) {
    print(&s, "closed loop, {}: {:.3g} times real time ({:.3g} .. {:.3g})\n", l.scene.c_str(),
          l.speed.median, l.speed.low, l.speed.high);
  }
  print(&s, "TwinDevice::tick_to, ns/tick: {:.4g} ({:.4g} .. {:.4g})\n", r.device_ns.median,
        r.device_ns.low, r.device_ns.high);
  s += "\n";
  for (const Goal& g : r.goals) {
    print(&s, "{:<6} {}: {:.3g} ({:.3g} .. {:.3g}), goal {} {:g}\n", g.met() ? "met" : "MISSED",
          g.text.c_str(), g.value.median, g.value.low, g.value.high,
          g.at_most ? "at most" : "at least", g.goal);
  }
  return s;
}

}  // namespace feltgate::bench
