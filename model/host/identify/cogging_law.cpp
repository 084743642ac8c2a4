// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law files about a motor's cogging: one that turns the lever slowly, one that takes the cogging
// away, and what both do about a torque near zero. Documentation: docs/calibration.md
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "host/identify/cogging.hpp"
#include "law/read_law.hpp"

namespace feltgate::host {

namespace {

/// Of the edge, up to here; found by trial with the simulated motor.
constexpr double kCap = 0.64, kRise_nm = 0.5e-3;
constexpr double kThreeRise = 0.05;  ///< of linear_nm, with three phases
constexpr double kPi = 3.14159265358979323846;
/// What three legs that conduct take at most along the current, and what two take of the voltage
/// between them, over the mean that the voltage law gives back: 4/3 and 2/sqrt(3) over 4/pi.
constexpr double kThree = kPi / 3, kTwo = kPi / 2 / 1.7320508075688772;
/// The slow turn's spring, damping and largest torque: those of lever_law, by its inertia and its
/// limit.
constexpr double kTurnInertia_kg_m2 = 1.22e-4, kTurnShare = 0.2;

/// With three phases that conduct: cosine of the angle from the current to the axis of the leg that
/// carries most. With two: cosine of the angle to the axis between them.
std::pair<double, double> legs_at(const SmallTorque& s, double angle_rad) {
  const double e = s.pole_pairs * (angle_rad - s.zero_rad), sixth = e * 3 / kPi;
  const double y = kPi / 3 * (sixth - std::floor(sixth));
  return {std::max(std::cos(y), std::cos(y - kPi / 3)), std::cos(y - kPi / 6)};
}

/// The output, from `wanted` at `position`; a name of its own for what a law may have too.
std::string output(const SmallTorque& small, const std::string& wanted,
                   const std::string& position) {
  if (small.exact()) return fmt::format("out torque = {}\n", wanted);
  if (small.pole_pairs != 0) {
    const double part = small.linear_nm / (small.linear_nm + small.lost_nm);
    return fmt::format(
        "# What the dead times of three legs take depends on the angle, six times per electrical\n"
        "# turn, and on whether two phases conduct or three. The voltage law gives the mean back,\n"
        "# and below {1:g} mNm a part of it.\n"
        "table cogging_three(x) periodic on [0, 1 turn / {2}] =\n"
        "  {3:.6g} mNm * max(cos({4} * x), cos({4} * x - pi / 3))\n"
        "table cogging_two(x) periodic on [0, 1 turn / {2}] = 1 / cos({4} * x - pi / 6)\n"
        "let cogging_angle = {5}{6}\n"
        "let cogging_size = abs({0})\n"
        "let cogging_legs = cogging_two(cogging_angle)\n"
        "let cogging_asked = min(cogging_size + cogging_three(cogging_angle),\n"
        "                        cogging_legs * (cogging_legs * cogging_size + {7:.6g} mNm))\n"
        "let cogging_command = max(cogging_asked - {8:.6g} mNm, {9:.6g} * cogging_asked)\n"
        "out torque = clamp({0} / ({10:g} mNm), -1, 1) * cogging_command\n",
        wanted, 1e3 * small.linear_nm, 6 * small.pole_pairs, 1e3 * small.lost_nm * kThree,
        small.pole_pairs, position,
        small.zero_rad == 0 ? "" : fmt::format(" - ({:.6f} rad)", small.zero_rad),
        1e3 * small.lost_nm * kTwo, 1e3 * small.lost_nm, part, 1e3 * small.rise_nm);
  }
  return fmt::format(
      "# The voltage law gives the dead voltage back in proportion to the torque below {0:g} mNm,\n"
      "# so the motor gives nothing below {1:g} mNm. What is missing is added.\n"
      "let cogging_edge = clamp({1:g} mNm * (1 - abs({3}) / ({0:g} mNm)), 0, {4:g} mNm)\n"
      "out torque = {3} + clamp({2:.6g} * {3}, -cogging_edge, cogging_edge)\n",
      1e3 * small.linear_nm, 1e3 * small.edge_nm, small.cap_nm / small.rise_nm, wanted,
      1e3 * small.cap_nm);
}

bool letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Where the word begins at or behind `from`, outside of comments; npos: nowhere.
std::size_t word(const std::string& text, const std::string& of, std::size_t from = 0) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '#') {
      k = text.find('\n', k);
      if (k == std::string::npos) break;
    } else if (k >= from && text.compare(k, of.size(), of) == 0 &&
               (k == 0 || !letter(text[k - 1])) &&
               (k + of.size() == text.size() || !letter(text[k + of.size()]))) {
      return k;
    }
  }
  return std::string::npos;
}

/// The law with its torque under another name.
std::string renamed(std::string text, const std::string& name) {
  const law::Law law = law::read_law_text(text, name);  // says what is wrong with it
  if (text.find("cogging") != std::string::npos) {
    throw std::invalid_argument(
        name + ":1: it names a cogging already; give the law that it had been before, --into LAW");
  }
  const std::size_t out = word(text, "out");
  const std::size_t equals = out == std::string::npos ? out : text.find('=', out);
  if (law.outputs.size() != 1 || equals == std::string::npos ||
      word(text, "out", equals) != std::string::npos) {
    throw std::invalid_argument(fmt::format(
        "{}:1: it has {} torques; give a law of one axis, --into LAW", name, law.outputs.size()));
  }
  text.replace(out, equals - out, "let cogging_felt ");
  return text + (text.empty() || text.back() == '\n' ? "" : "\n");
}

}  // namespace

double SmallTorque::command(double torque_nm, double angle_rad) const {
  if (exact()) return torque_nm;
  const double t = std::abs(torque_nm);
  if (pole_pairs != 0) {
    const auto [three, two] = legs_at(*this, angle_rad);
    const double asked = std::min(t + lost_nm * kThree * three, (t / two + lost_nm * kTwo) / two);
    return std::clamp(torque_nm / rise_nm, -1.0, 1.0) *
           std::max(asked - lost_nm, asked * linear_nm / (linear_nm + lost_nm));
  }
  const double missing = std::clamp(edge_nm * (1 - t / linear_nm), 0.0, cap_nm);
  return torque_nm + std::clamp(torque_nm * cap_nm / rise_nm, -missing, missing);
}

double SmallTorque::torque(double command_nm, double angle_rad) const {
  const double c = std::abs(command_nm);
  if (exact()) return command_nm;
  if (pole_pairs != 0) {
    const auto [three, two] = legs_at(*this, angle_rad);
    const double asked = c + lost_nm * std::min(1.0, c / linear_nm);
    return std::copysign(
        std::max({0.0, asked - lost_nm * kThree * three, two * (asked * two - lost_nm * kTwo)}),
        command_nm);
  }
  if (c >= linear_nm) return command_nm;
  // command() is the least of three lines.
  const double t =
      std::max({c / (1 + cap_nm / rise_nm), c - cap_nm, (c - edge_nm) / (1 - edge_nm / linear_nm)});
  return std::copysign(t, command_nm);
}

SmallTorque small_torque_of(const design::Elaborated& e) {
  SmallTorque s;
  const design::Design& d = e.design;
  if (d.current_loop || !d.emf_in_law()) return s;
  const double dead_v = e.word("dead_voltage").si;
  const double volts_per_nm = e.word("voltage_gain").si * e.word("torque_gain").si;
  if (!(dead_v > 0)) return s;
  s.linear_nm = d.dead_voltage_linear_nm;
  s.edge_nm = dead_v / (volts_per_nm + dead_v / s.linear_nm);
  s.cap_nm = kCap * s.edge_nm;
  s.rise_nm = std::min(kRise_nm, s.linear_nm * (1 - kCap) / 2);
  if (d.phases == 3) {
    s.pole_pairs = d.pole_pairs;
    s.zero_rad = -d.commutation_offset_rad / d.pole_pairs;
    s.lost_nm = dead_v / volts_per_nm;
    s.rise_nm = kThreeRise * s.linear_nm;
  }
  return s;
}

std::string slow_turn_law(const design::Elaborated& e) {
  const double most_nm = kTurnShare * e.design.torque_limit_nm;
  const double inertia = e.design.inertia_kg_m2 / kTurnInertia_kg_m2;
  return fmt::format(
             "# turns the lever slowly up and down again, for feltgate host - calibrate cogging\n"
             "rate = 40 kHz\n"
             "param speed = 0.5 rad/s in 0.1 .. 2 rad/s\n"
             "param far = 7.6 rad in 6.5 .. 31 rad             # the way up, and the way down\n"
             "bool back = false\n"
             "state gone = 0 rad in 0 .. 32 rad\n"
             "let step = if back then -speed else speed\n"
             "next back = back or gone >= far\n"
             "next gone = clamp(gone + step * dt, 0, 32)\n"
             "let pace = if back and gone <= 0 then 0 else step\n"
             "# The lever follows a point on a spring, from where it stands when the motor is "
             "armed.\n"
             "state goal = 0 rad in -100 .. 100 rad\n"
             "next goal = clamp(clamp(goal + pace * dt, position - 0.1, position + 0.1), -100, "
             "100)\n"
             "let slower = clamp(pace - velocity, -5 rad/s, 5 rad/s)\n"
             "let wanted = clamp({0:.3g} Nm/rad * clamp(goal - position, -0.2, 0.2)\n"
             "                   + {1:.3g} Nm s/rad * slower, -{2:.3g} Nm, {2:.3g} Nm)\n",
             inertia, 0.02 * inertia, most_nm) +
         output(small_torque_of(e), "wanted", "position");
}

std::string compensating_law(const Cogging& c, const SmallTorque& small, const std::string& from,
                             const std::string& into, const std::string& name) {
  const bool alone = name.empty();
  std::string text = alone ? "" : renamed(into, name);
  text = fmt::format("{}# The cogging on the lever, measured: {}\n", text, from) +
         "param cogging_share = 1 in 0 .. 1.1              # of it that is taken away\n"
         "param cogging_zero = 0 rad in -7 .. 7 rad        # where the recording's position 0 is\n";
  std::string sum;
  for (const CoggingTerm& t : c.terms) {
    for (const auto& [value, function] :
         {std::pair<double, const char*>{t.cosine_nm, "cos"}, {t.sine_nm, "sin"}}) {
      sum += fmt::format("{}{:.4f} mNm * {}({} * x)",
                         value < 0 ? (sum.empty() ? "-" : "\n  - ") : (sum.empty() ? "" : "\n  + "),
                         std::abs(1e3 * value), function, t.per_turn);
    }
  }
  const std::string end = c.period == 1 ? "1 turn" : fmt::format("1 turn / {}", c.period);
  text += fmt::format("table cogging(x) periodic on [0, {}] =\n  {}\n", end, sum);
  text += fmt::format("let cogging_wanted = {}cogging_share * cogging(position - cogging_zero)\n",
                      alone ? "-" : "cogging_felt - ");
  return text + output(small, "cogging_wanted", "position - cogging_zero");
}

}  // namespace feltgate::host
