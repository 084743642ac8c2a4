// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Every row of docs/claims.md: its verdict, and each figure against a number that is written here
// by hand or by another formula; each comparison fails for a figure that is off.
// Documentation: docs/claims.md
#include "studies/claims/claims.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catch.hpp"

using namespace feltgate;
using namespace feltgate::claims;

namespace {

/// What a figure must be: its closed form to a thousandth, its simulation to `share` or `margin`.
struct Right {
  const char* what;
  double formula, simulated;
  double share = 0.01, margin = 1e-9;
};
struct Wanted {
  const char* name;
  const char* verdict;
  std::vector<Right> figures;
};

/// NaN stands for no value, and equals nothing else.
bool same(double value, double right, double share, double margin) {
  if (std::isnan(right) || std::isnan(value)) return std::isnan(right) && std::isnan(value);
  return std::abs(value - right) <= std::max(share * std::abs(right), margin);
}

bool right(const Figure& f, const Right& r) {
  return f.what == r.what && same(f.formula, r.formula, 1e-3, 1e-9) &&
         same(f.simulated, r.simulated, r.share, r.margin);
}

// The RE 40 with the 24 V winding at 0.5 Nm: 16.556 A; 6.954 V and 0.34 V of brushes.
const double kMotor_a = 0.5 / 0.0302, kMotor_v = 0.42 * kMotor_a + 0.34;
/// Torque at 0.1, 0.2, 0.3 Nm by V = Kv tau / 0.0605, 71.905 mNm/V behind 0.34 V.
double kv_pct(double kv, double tau) {
  return (kv * tau * 16.52893 - 0.34) * 0.0719048 * 100 / tau - 100;
}

const std::vector<Wanted>& expected() {
  static const std::vector<Wanted> all{
      {"dob_settling",
       "holds if",
       {{"pole", 391.68, 391.68, 0.002},
        {"observed torque settles", 3.912023 / 0.39168, 9.988, 0.002},
        {"motor torque settles", none, 7.0, 0.03}}},
      {"inertia",
       "holds if",
       {{"J", 4.88033e-4, none},
        {"J with Kt = 0.0302", 1.21605e-4, none},
        {"time constant, Table 3", 40.128, 40.128, 0.003},
        {"time constant, data sheet", 40.130, 40.130, 0.003},
        {"speed per volt, Table 3", 16.529, 16.529, 0.001},
        {"speed per volt, data sheet", 33.113, 33.113, 0.001}}},
      {"window",
       "cannot be had",
       {{"m1 Tp", 386, 386, 0.003},
        {"a count", 3.97404, none},
        {"a count in 100 µs", 15.3398, none},
        {"a count's peak behind the low-pass", 0.702, 0.702, 0.002}}},
      {"velocity_gain",
       "holds if",
       {{"gain error, m1 = 386, n = 2", 0.65320, 0.6532, 0.01},
        {"m1 = 767, n = 1", 0.0012521, 0.0013, 0, 0.006}}},
      {"cutoff_equal",
       "cannot be had",
       {{"wc/g with the least false load", 4, 4},
        {"wc/g with the least ripple", 0.25, 0.25},
        // The window's half and the winding delay what the observer sees: up to a tenth more.
        {"false load at wc = g, share of the step", 0.367879, 0.386, 0.05}}},
      {"alternative_to_pid",
       "holds if",
       {{"torque, R +20 %", -16.6667, -16.667, 0.01},
        {"torque, Kt -50 %", -50, -50, 0.01},
        {"observed torque, R +20 %", 0, 0, 0, 0.02},
        {"torque at 0.2 Nm, calibrated", kv_pct(0.95, 0.2), 0.8, 0.1}}},
      {"half_nm_of_7_a",
       "holds if",
       {{"torque of 7 A in the motor", 0.4235, none},
        {"torque from a source of 7 A", 0.5, 0.5, 0.002},
        {"largest over 1 ms, supply limited", none, 0.5003, 1e-4},
        {"largest over 1 ms, not limited", none, 0.5003, 1e-4},
        {"motor current", 16.5563, 16.556, 0.002},
        {"current from the source", kMotor_a * kMotor_v / 24, 5.03, 0.005},
        {"torque from a source of 4 A", 4 / (kMotor_v / 24) * 0.0302, 0.3975, 0.005}}},
      {"forces",
       "holds if",
       {{"largest force at 0.2 m over that at 0.1 m", 0.5, 0.5, 1e-6},
        // Friction holds up to 4.5 mNm more.
        {"at 0.1 m", 5, 5, 0.012},
        {"at 0.2 m", 2.5, 2.5, 0.012}}},
      {"kv_error",
       "holds if",
       {{"error at 0.1 Nm, Kv = 1.25", kv_pct(1.25, 0.1), 24.3, 0.01},
        {"at 0.3 Nm, Kv = 0.95", kv_pct(0.95, 0.3), 4.72, 0.01},
        {"at 0.1 Nm, Kv = 1", kv_pct(1, 0.1), -5.4, 0.02},
        {"at 0.3 Nm, Kv = 1", kv_pct(1, 0.3), 10.7, 0.01}}},
      {"kv_border",
       "cannot be had",
       // 3.0992 V falls to 2.3554 V.
       {{"change of the torque as the reference rises", -0.743802 * 71.90476, -53.48, 0.01}}},
      {"slopes",
       "cannot be had",
       {{"measured, 24 V winding", 0.0719048, 0.0719, 0.003},
        {"observed", 0.0605, 0.0605, 0.001},
        {"measured, 48 V winding", none, 0.0483, 0.005}}},
      {"transparency",
       "holds if",
       // 79 rad/s² of 1.22e-4 kg m²: 6.81 mNm rms, beside 3.5 mNm.
       {{"felt", std::sqrt(6.8112 * 6.8112 + 3.5 * 3.5), 7.74, 0.002},
        {"felt over what inertia and friction make", 1, 1.011, 0.002},
        {"as damping", 14 / (3.14159265 * 6.2831853), 0.713, 0.003}}},
      {"noise_not_rate",
       "holds if",
       {{"rms without noise", none, 0, 0, 1e-6},
        {"rms with noise", none, 10.4, 0.01},
        {"share left by smoothing", 0.57735, 5.4 / 10.4, 0.01},
        {"K T / 2", 11.45916 / 288, none}}},
      {"ceiling",
       "cannot be had",
       {{"stiffness at 700 N/m", 14 * 0.3, none},
        // 4.2 Nm/rad and 0.8727 mrad; a hand lets go of the wall at times.
        {"jitter at 700 N/m", 4.2 * 0.872665 * 0.57735, 2.5, 0.01},
        {"at 800 N/m", 4.8 * 0.872665 * 0.57735, 2.19, 0.01},
        {"at 800 N/m, half the noise", 4.8 * 0.436332 * 0.57735, 1.09, 0.01}}},
      {"encoder_wall",
       "holds if",
       {{"a count", 0.383495, none},
        {"torque of a count", 2 * 360 / 16.384, none},
        {"friction that it needs", 360 / 16.384, none},
        {"damping that it needs", 114.5916 / 980, none},
        {"presses at rest, 3.5 mNm", 0, 0},
        {"presses at rest, 30 mNm", 1, 1}}},
      {"recognition",
       "holds",
       {{"right", 74.2857, none},
        {"random guessing", 14.2857, none},
        {"always \"fish\"", 48.5714, none},
        {"52 above always \"fish\", standard deviations", 18 / std::sqrt(17.4857), none}}},
      {"walls_50",
       "holds if",
       {{"friction that 50 N/m needs", 0.141667, none},
        {"stiffest wall then", 50, 50, 0.01},
        {"without the filter", 283.333, 283.3, 0.01}}},
      {"two_controllers",
       "holds if",
       {{"delay", 1.347222, none}, {"stiffest wall", 141.667 / 4.180556, 33.9, 0.01}}},
      {"attraction", "cannot be had", {}},
      {"border",
       "holds",
       {{"bv 0 Ns/m at 1 kHz", 6, 6, 0.001},
        {"bv 0.05 Ns/m at 1 kHz", 106, 106, 0.002},
        {"bv 0.1 Ns/m at 1 kHz", 206, 205.55, 1e-4},
        {"bv 0.2 Ns/m at 1 kHz", 406, 406, 0.005},
        {"bv 0.1 Ns/m at 2 kHz", 412, 412, 0.002},
        {"bv 0.1 Ns/m at 5 kHz", 1030, 1030, 0.001},
        {"206 N/m with 10 g", none, 203.96, 1e-4},
        {"206 N/m with 1 kg", none, 205.98, 1e-4}}},
      {"margin",
       "cannot be had",
       {{"share of the bound that is left", 0, 100 * (1 - 206 / 205.55), 0.02},
        // In continuous time a swing goes as exp(-(b - K T/2) t / (2 m)).
        {"growth at 206 N/m", 0, 0, 0, 0.005},
        {"growth at 103 N/m", -(0.103 - 0.0515) / 0.09, -0.572, 0.01}}},
      {"z_width",
       "holds if",
       {{"at 1 kHz", 1092.85, 1090.4, 0.001},
        {"at 2 kHz", 2185.7, 2183.3, 0.001},
        {"at 5 kHz", 5464.26, 5462, 0.001}}},
      {"zeta",
       "cannot be had",
       // 67.66 rad/s; b / (2 m w).
       {{"zeta", 0.103 / (0.09 * 67.6593), 0.0169, 0.005}, {"mass for zeta = 1", 12.875, none}}},
      {"saturation",
       "holds if",
       {{"depth at 3.3 N", 16.0194, 16.02, 0.02},
        {"depth of the spring's share", 13.9806, 13.98, 0.02},
        {"spring at 14 mm", 2.884, none},
        {"left for the rest", 0.416, none}}},
      {"force_shading",
       "holds if",
       {{"reduction, 8 facets", 34.69, 41.4, 0.01}, {"16 facets", 66.06, 69.5, 0.01}}},
      {"mesh",
       "cannot be had",
       // E = 3/2 122 700 = 184 050, and 61 324 - 184 050 + 122 700.
       {{"V - F / 2", -26, none}, {"handles of one closed object", 14, none}}},
      {"preset",
       "holds if",
       {{"stiffness", 3.2, none},
        {"damping", 5, none},
        {"dynamic over static friction", 0.75, none}}},
      {"quaternion",
       "holds if",
       {{"its elements, Rz 90° and Rx 90°: w", 0.5, 0.5, 1e-9},
        {"x", -0.5, -0.5, 1e-9},
        {"y", -0.5, -0.5, 1e-9},
        {"z", 0.5, 0.5, 1e-9},
        {"torque at 90° over k", std::sqrt(2), none},
        {"angle left by qd qo^-1", 0, 0, 0, 0.01},
        {"left by qd^-1 qo", none, 180, 0.01}}},
      {"texture_stiffness",
       "holds",
       {{"k, texels of 1 mm, factor", 3 * std::sqrt(2), 4.2426, 1e-4},
        {"texels of 0.01 mm, factor", 300 * std::sqrt(2), 424.26, 1e-4},
        {"share with the split, 0.1 over 10 mm", 1, 0.997, 0.001},
        {"without, 0.1 over 10 mm", none, 0.180 / 0.934, 0.02}}},
      {"texture_force", "holds", {{"sideways", 0.48, 0.48, 1e-6}, {"upward", 1.14, 1.14, 1e-6}}},
      {"forty_khz",
       "holds if",
       {{"40 kHz over 1 kHz, `lever`", 3.206, 2.87, 0.01},
        {"ideal actuator", 40, 40, 0.001},
        {"`lever` at 1 kHz", 7.058, 5.72, 0.01},
        {"at 40 kHz", 22.63, 16.43, 0.01}}}};
  return all;
}

/// All rows, worked out once.
const std::vector<Answer>& answers() {
  static const std::vector<Answer> all = [] {
    std::vector<Answer> out;
    const Lab lab(FELTGATE_ROOT);
    for (const Source& s : sources()) out.push_back({s, s.work_out(lab)});
    return out;
  }();
  return all;
}

std::string text_of(const std::string& path) {
  std::ifstream in(FELTGATE_ROOT + path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The first word in which the two differ, by more than a percent where it is a number; "" if none:
/// another compiler rounds otherwise.
std::string stale(const std::string& committed, const std::string& now) {
  std::istringstream a(committed), b(now);
  for (std::string x, y;;) {
    const bool more_a = static_cast<bool>(a >> x), more_b = static_cast<bool>(b >> y);
    if (!more_a && !more_b) return "";
    if (!more_a || !more_b) return "(end): " + (more_a ? x : y);
    char *end_x = nullptr, *end_y = nullptr;
    const double n = std::strtod(x.c_str(), &end_x), m = std::strtod(y.c_str(), &end_y);
    const bool numbers = end_x != x.c_str() && end_y != y.c_str();
    if (numbers ? !same(n, m, 0.01, 1e-6) || std::string(end_x) != end_y : x != y) {
      return x + ": " + y;
    }
  }
}

}  // namespace

TEST_CASE("claims: each row has its verdict, and each of its figures the value written here") {
  REQUIRE(answers().size() == expected().size());
  for (std::size_t i = 0; i < answers().size(); ++i) {
    const Wanted& e = expected()[i];
    const Claim& c = answers()[i].claim;
    INFO(answers()[i].source.name);
    CHECK(answers()[i].source.name == std::string(e.name));
    CHECK(name_of(c.verdict()) == std::string(e.verdict));
    CHECK(c.figures.size() == e.figures.size());
    for (std::size_t f = 0; f < std::min(c.figures.size(), e.figures.size()); ++f) {
      INFO(c.figures[f].what << ": closed form " << c.figures[f].formula << ", simulated "
                             << c.figures[f].simulated);
      CHECK(right(c.figures[f], e.figures[f]));
      // A figure that is off is seen.
      for (double Figure::*column : {&Figure::formula, &Figure::simulated}) {
        Figure off = c.figures[f];
        if (std::isnan(off.*column)) continue;
        off.*column = off.*column == 0 ? 0.2 : off.*column * 1.2 + 0.01;
        CHECK_FALSE(right(off, e.figures[f]));
        off.*column = none;
        CHECK_FALSE(right(off, e.figures[f]));
      }
    }
  }
}

TEST_CASE("claims: the verdict follows from the figures") {
  Claim c{"", "", "", "", "", {}};
  CHECK(c.verdict() == Verdict::cannot_be_had);
  c.asks("a", "", 1, 1.05, near(1, 0.1));
  CHECK(c.verdict() == Verdict::holds);
  c.figures[0].simulated = 1.2;
  CHECK(c.verdict() == Verdict::cannot_be_had);
  c.asks_if("b", "", 2, none, at_most(2));
  CHECK(c.verdict() == Verdict::holds_if);
  c.asks_if("c", "", none, 3, at_least(3.1));
  CHECK(c.verdict() == Verdict::cannot_be_had);
  c.figures[2].simulated = 3.2;
  CHECK(c.verdict() == Verdict::holds_if);
  c.figures[1].formula = none;  // no value at all
  CHECK(c.verdict() == Verdict::cannot_be_had);
  // NaN is never as asked.
  for (const Asked& asked : {near(0, 1e9), at_most(1e9), at_least(-1e9), Asked{}}) {
    CHECK_FALSE(asked.met(none));
  }
}

TEST_CASE("claims: the record is up to date, and the JSON has every row") {
  // Written by: feltgate claims --markdown > claims.md && mv claims.md testbench/studies/claims/
  const std::string committed = text_of("/testbench/studies/claims/claims.md"), now = page(answers());
  CHECK(stale(committed, now) == "");
  CHECK(stale(committed + "x", now) == "(end): x");
  std::string off = now;
  off.replace(off.find("391.68"), 6, "396.68");
  CHECK(stale(off, now) == "396.68: 391.68");
  CHECK(summary(answers()) == "31 claims: 4 hold, 18 hold under a condition, 9 cannot be had.\n");
  const auto j = nlohmann::json::parse(json(answers()));
  CHECK(j["schema"] == "feltgate-claims/1");
  REQUIRE(j["claims"].size() == expected().size());
  for (std::size_t i = 0; i < expected().size(); ++i) {
    CHECK(j["claims"][i]["name"] == expected()[i].name);
    CHECK(j["claims"][i]["verdict"] == expected()[i].verdict);
    CHECK(j["claims"][i]["figures"].size() == expected()[i].figures.size());
  }
}
