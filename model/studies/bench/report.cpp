// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The benchmark's result as JSON and as text. Documentation: docs/speed-for-accuracy.md
#include "studies/bench/measure.hpp"

#include <fmt/format.h>
#include <time.h>

#include <fstream>
#include <optional>
#include <thread>

#include "files/table.hpp"

namespace feltgate::bench {

namespace {

using files::Columns;
using files::Json;
using files::when;

Json spread_json(const Spread& s) {
  return {{"median", s.median}, {"min", s.low}, {"max", s.high}};
}
std::string spread_text(const Spread& s) {
  return fmt::format("{:.3g} ({:.3g} .. {:.3g})", s.median, s.low, s.high);
}
Json spread_if(const std::optional<Spread>& s) { return s ? spread_json(*s) : files::absent; }

Columns<BackendResult> columns() {
  using Engine = const BackendResult&;
  Columns<BackendResult> all{
      {"", &BackendResult::name, "<engine"},
      {"arithmetic", [](Engine e) { return e.integer ? "integer" : "real"; }},
      {"ns_per_tick/median", [](Engine e) { return e.ns_per_tick.median; }, "ns/tick", "{:.4g}"},
      {"ns_per_tick/min", [](Engine e) { return e.ns_per_tick.low; }, "min", "{:.4g}"},
      {"ns_per_tick/max", [](Engine e) { return e.ns_per_tick.high; }, "max", "{:.4g}"},
      {"", [](Engine e) { return e.speed.median; }, "x real time", "{:.4g}"},
      {"simulated_s_per_s", [](Engine e) { return spread_json(e.speed); }},
      {"clocks_per_s", [](Engine e) { return spread_if(e.clocks_per_s); }},
      {"updates_per_s", [](Engine e) { return spread_if(e.updates_per_s); }}};
  const auto error = [&](const std::string& key, const std::string& title,
                         ErrorFigure BackendResult::*of) {
    all.push_back({key + "/max", [of](Engine e) { return when(e.compared, (e.*of).max()); }, title,
                   "{:.3g}"});
    all.push_back({key + "/rms", [of](Engine e) { return when(e.compared, (e.*of).rms()); }, "rms",
                   "{:.3g}"});
  };
  error("velocity_error_rad_s", "velocity error\nrad/s, max", &BackendResult::velocity_rad_s);
  error("tau_hat_error_nm", "tau_hat error\nNm, max", &BackendResult::tau_hat_nm);
  error("torque_error_nm", "torque error\nNm, max", &BackendResult::torque_nm);
  all.push_back(
      {"hash", [](Engine e) { return when(e.integer, fmt::format("{:016x}", e.hash)); }, "hash"});
  all.push_back({"samples_ns_per_tick", &BackendResult::samples});
  return all;
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
  Json j{{"schema", "feltgate-bench/2"}, {"version", c.version}, {"machine", c.machine},
         {"compiler", c.compiler},       {"date", c.date},       {"design", "lever"}};
  for (const Work& w : works) {
    j["scenes"].push_back(
        {{"name", w.name}, {"simulated_s", w.simulated_s}, {"ticks", w.ticks.size()}});
  }
  for (const BackendResult& e : r.engines) j["engines"][e.name] = object_of(columns(), e);
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
  return files::json_text(j);
}

std::string text(const Result& r, const std::vector<Work>& works, const Circumstances& c) {
  std::string s = fmt::format("{}, {}, {}, design lever\nscenes:", c.machine, c.compiler, c.date);
  for (const Work& w : works) s += fmt::format(" {} ({:g} s)", w.name, w.simulated_s);
  s += fmt::format("; {} ticks in all\n\n{}", r.ticks, table(columns(), r.engines));
  if (r.bounds) {
    s += fmt::format(
        "proven bounds of the integers, no limit or ramp at work: velocity {:.3g} rad/s, tau_hat "
        "{:.3g} Nm, torque {:.3g} Nm\n",
        r.bounds->velocity_rad_s, r.bounds->tau_hat_nm, r.bounds->torque_nm);
  }
  s += r.divergence.empty() ? "\nthe integer engines are equal in every bit of every tick\n"
                            : fmt::format("\nDIFFERENT: {}\n", r.divergence);
  for (const LoopResult& l : r.loops) {
    s += fmt::format("closed loop, {}, times real time: {}\n", l.scene, spread_text(l.speed));
  }
  return s + fmt::format("TwinDevice::tick_to, ns/tick: {}\n", spread_text(r.device_ns));
}

}  // namespace feltgate::bench
