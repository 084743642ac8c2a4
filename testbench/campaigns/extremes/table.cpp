// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Verdicts, the list of all cases, and their table. Documentation: docs/extremes.md
#include "campaigns/extremes/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "files/table.hpp"

namespace feltgate::extremes {

namespace {

using Json = nlohmann::ordered_json;

std::string cell(const std::optional<double>& v) { return v ? number(*v) : "-"; }

std::string verdict(const Finding& f) { return f.holds() ? "ok" : "FAIL"; }

std::string row(const Finding& f) {
  const std::string unit = f.unit.empty() ? "" : " [" + f.unit + "]";
  return "| " + f.what + unit + " | " + f.expected.text + " | " + cell(f.rtl) + " | " +
         cell(f.twin) + " | " + cell(f.real) + " | " + verdict(f) + " |";
}

std::string ran(const Outcome& o) {
  std::string line;
  if (o.rtl_s > 0 || o.twin_s > 0) {
    line = "Device time: RTL " + number(o.rtl_s) + " s, twin " + number(o.twin_s) + " s.";
  }
  if (!o.note.empty()) line += (line.empty() ? "" : " ") + o.note;
  return line;
}

/// Cells of a table row, without the outer bars.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::size_t from = line.find('|');
  while (from != std::string::npos) {
    const std::size_t to = line.find('|', from + 1);
    if (to == std::string::npos) break;
    std::string c = line.substr(from + 1, to - from - 1);
    c.erase(0, c.find_first_not_of(' '));
    c.erase(c.find_last_not_of(' ') + 1);
    out.push_back(c);
    from = to;
  }
  return out;
}

bool same_cell(const std::string& a, const std::string& b) {
  if (a == b) return true;
  char *end_a = nullptr, *end_b = nullptr;
  const double x = std::strtod(a.c_str(), &end_a), y = std::strtod(b.c_str(), &end_b);
  if (end_a == a.c_str() || end_b == b.c_str() || *end_a != '\0' || *end_b != '\0') return false;
  return std::abs(x - y) <= 0.01 * std::max(std::abs(x), std::abs(y));
}

/// The section of one case in a page, with its heading; empty if the page has none.
std::string section_of(const std::string& page, const std::string& name) {
  const std::string place = "### " + name + "\n";
  const std::size_t begin = page.find(place);
  if (begin == std::string::npos) return {};
  const std::size_t end = page.find("\n\n##", begin + place.size());
  return end == std::string::npos ? page.substr(begin) : page.substr(begin, end - begin) + "\n";
}

constexpr const char* head =
    "| what | expected | RTL | twin | double | verdict |\n|---|---|---|---|---|---|\n";

}  // namespace

Expected exactly(double value) { return {value, value, number(value)}; }

Expected near(double value, double tolerance) {
  return {value - tolerance, value + tolerance, number(value) + " ± " + number(tolerance)};
}

Expected between(double low, double high) {
  return {low, high, number(low) + " to " + number(high)};
}

Expected at_most(double value) {
  return {-std::numeric_limits<double>::infinity(), value, "≤ " + number(value)};
}

Expected at_least(double value) {
  return {value, std::numeric_limits<double>::infinity(), "≥ " + number(value)};
}

bool Finding::holds() const {
  const auto inside = [this](const std::optional<double>& v) {
    return !v || (*v >= expected.low && *v <= expected.high);
  };
  if (!rtl && !twin && !real) return false;
  return inside(rtl) && inside(twin) && (real_may_differ || inside(real));
}

bool Outcome::holds() const {
  if (mismatches != 0 || findings.empty()) return false;
  for (const Finding& f : findings) {
    if (!f.holds()) return false;
  }
  return true;
}

Finding& Outcome::add(const std::string& what, const std::string& unit, const Expected& expected,
                      std::optional<double> rtl, std::optional<double> twin,
                      std::optional<double> real) {
  findings.push_back({what, unit, expected, rtl, twin, real});
  return findings.back();
}

Finding& Outcome::add(Cores cores, const std::string& what, const std::string& unit,
                      const Expected& expected, std::optional<double> core,
                      std::optional<double> real) {
  return add(what, unit, expected, cores == Cores::lock_step ? core : std::nullopt, core, real);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto group : {encoder_cases, velocity_cases, filter_cases, observer_cases, scene_cases,
                           loop_cases, engine_cases, axes_cases, day_cases}) {
    for (const Case& c : group()) all.push_back(c);
  }
  return all;
}

std::string number(double value) {
  if (value == 0) return "0";
  const bool whole = value == std::floor(value) && std::abs(value) < 1e12;
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.5g}", value);
}

std::string json(const std::vector<Result>& results) {
  Json all = Json::array();
  bool holds = true;
  for (const Result& r : results) {
    Json findings = Json::array();
    for (const Finding& f : r.outcome.findings) {
      Json j{{"what", f.what}, {"unit", f.unit}, {"expected", f.expected.text}};
      if (std::isfinite(f.expected.low)) j["low"] = f.expected.low;
      if (std::isfinite(f.expected.high)) j["high"] = f.expected.high;
      if (f.rtl) j["rtl"] = *f.rtl;
      if (f.twin) j["twin"] = *f.twin;
      if (f.real) j["double"] = *f.real;
      j["holds"] = f.holds();
      findings.push_back(j);
    }
    all.push_back({{"group", r.which.group},
                   {"case", r.which.name},
                   {"about", r.which.about},
                   {"holds", r.outcome.holds()},
                   {"mismatches", r.outcome.mismatches},
                   {"rtl_s", r.outcome.rtl_s},
                   {"twin_s", r.outcome.twin_s},
                   {"note", r.outcome.note},
                   {"findings", findings}});
    holds = holds && r.outcome.holds();
  }
  return files::json_text(
      Json{{"schema", "feltgate-extremes/1"}, {"holds", holds}, {"cases", all}});
}

std::string markdown(const Result& result) {
  std::string out = std::string("### ") + result.which.name + "\n\n" + result.which.about + "\n\n";
  out += head;
  for (const Finding& f : result.outcome.findings) out += row(f) + "\n";
  if (result.outcome.mismatches > 0) {
    out += fmt::format("\nRTL and twin differ in {} clocks, first: {}\n", result.outcome.mismatches,
                       result.outcome.first_mismatch);
  }
  const std::string line = ran(result.outcome);
  if (!line.empty()) out += "\n" + line + "\n";
  return out;
}

std::string page(const std::vector<Result>& results, const std::string& before) {
  std::string out =
      "# Extremes\n\n"
      "Written by `./feltgate extremes --markdown`; a test fails when a row is out of date. "
      "RTL and twin run in lock-step where\n"
      "both have a value. *double* is the same chain in binary64 on the same sampled counts; in "
      "closed loop it drives the\n"
      "motor itself. A dash means: not measured there.\n";
  std::string group;
  for (const Case& c : cases()) {
    const auto it = std::find_if(results.begin(), results.end(), [&](const Result& r) {
      return std::string(r.which.name) == c.name;
    });
    const std::string section = it != results.end() ? markdown(*it) : section_of(before, c.name);
    if (section.empty()) continue;
    if (group != c.group) {
      group = c.group;
      out += "\n## " + group + "\n";
    }
    out += "\n" + section;
  }
  return out;
}

std::vector<std::string> stale_rows(const std::string& page, const Result& result) {
  std::vector<std::string> stale;
  const std::string old = section_of(page, result.which.name);
  if (old.empty()) return {std::string("no section ") + result.which.name};
  std::istringstream section(old);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(section, line);) {
    if (line.rfind("| ", 0) == 0 && line.rfind("| what", 0) != 0) rows.push_back(cells(line));
  }
  const auto& findings = result.outcome.findings;
  if (rows.size() != findings.size()) {
    stale.push_back(fmt::format("{} rows instead of {}", rows.size(), findings.size()));
    return stale;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<std::string> now = cells(row(findings[i]));
    for (std::size_t c = 0; c < now.size(); ++c) {
      const bool measured = c >= 2 && c <= 4;
      if (measured && findings[i].chaotic && (rows[i][c] == "-") == (now[c] == "-")) continue;
      if (c < rows[i].size() && same_cell(rows[i][c], now[c])) continue;
      stale.push_back(findings[i].what + ": the page says \"" +
                      (c < rows[i].size() ? rows[i][c] : "") + "\", now it is \"" + now[c] + "\"");
    }
  }
  return stale;
}

}  // namespace feltgate::extremes
