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

#include "host/identify/cogging.hpp"
#include "law/read_law.hpp"

namespace feltgate::host {

namespace {

/// Of the edge, up to here; found by trial with the simulated motor.
constexpr double kCap = 0.64, kRise_nm = 0.5e-3;

/// The output, from `wanted`; a name of its own for what a law may have too.
std::string output(const SmallTorque& small, const std::string& wanted) {
  if (small.exact()) return fmt::format("out torque = {}\n", wanted);
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

double SmallTorque::command(double torque_nm) const {
  if (exact()) return torque_nm;
  const double missing = std::clamp(edge_nm * (1 - std::abs(torque_nm) / linear_nm), 0.0, cap_nm);
  return torque_nm + std::clamp(torque_nm * cap_nm / rise_nm, -missing, missing);
}

double SmallTorque::torque(double command_nm) const {
  const double c = std::abs(command_nm);
  if (exact() || c >= linear_nm) return command_nm;
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
  return s;
}

std::string slow_turn_law(const SmallTorque& small) {
  return "# turns the lever slowly up and down again, for feltgate host - calibrate cogging\n"
         "rate = 40 kHz\n"
         "param speed = 0.5 rad/s in 0.1 .. 2 rad/s\n"
         "param far = 7.6 rad in 6.5 .. 31 rad             # the way up, and the way down\n"
         "bool back = false\n"
         "state gone = 0 rad in 0 .. 32 rad\n"
         "let step = if back then -speed else speed\n"
         "next back = back or gone >= far\n"
         "next gone = clamp(gone + step * dt, 0, 32)\n"
         "let pace = if back and gone <= 0 then 0 else step\n"
         "# The lever follows a point on a spring, from where it stands when the motor is armed.\n"
         "state goal = 0 rad in -100 .. 100 rad\n"
         "next goal = clamp(clamp(goal + pace * dt, position - 0.1, position + 0.1), -100, 100)\n"
         "let slower = clamp(pace - velocity, -5 rad/s, 5 rad/s)\n"
         "let wanted = clamp(1 Nm/rad * clamp(goal - position, -0.2, 0.2)\n"
         "                   + 0.02 Nm s/rad * slower, -0.1 Nm, 0.1 Nm)\n" +
         output(small, "wanted");
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
  return text + output(small, "cogging_wanted");
}

}  // namespace feltgate::host
