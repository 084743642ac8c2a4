// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The alignment of a motor with three phases. Documentation: docs/calibration.md
#include "host/calibrate/align.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "host/calibrate/report.hpp"

namespace feltgate::host {

namespace {

constexpr double kTurn_rad = 6.283185307179586;
/// The rotor rests where the torque of the voltage crosses zero and falls: so far ahead of it.
constexpr double kQuarter = 0.25;

/// The angle nearest to `before` that differs from `turns` by whole turns.
double unwrapped(double turns, double before) { return turns - std::round(turns - before); }

}  // namespace

std::vector<AlignReading> take_readings(const std::function<bool(double turns)>& turn,
                                        const std::function<double()>& position_counts) {
  constexpr int steps = 8;  // of a turn
  std::vector<AlignReading> readings;
  for (int k = -steps; k <= steps; ++k) {
    const double turns = static_cast<double>((steps - std::abs(k)) % steps) / steps;
    if (!turn(turns)) break;
    readings.push_back({turns, position_counts()});
  }
  return readings;
}

std::string readings_csv(const std::vector<AlignReading>& readings) {
  std::string text = "commutation_offset,position\n";
  for (const AlignReading& r : readings) {
    text += fmt::format("{},{}\n", r.offset_turns, r.position_counts);
  }
  return text;
}

std::vector<AlignReading> align_readings(const ColumnTable& table) {
  const std::size_t angle = table.need({"commutation_offset"}, "the angle of the voltage, turn");
  const std::size_t position = table.need({"position"}, "where the rotor stood, counts");
  std::vector<AlignReading> readings;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const AlignReading r{table.at(k, angle), table.at(k, position)};
    if (!std::isfinite(r.offset_turns + r.position_counts)) {
      table.fail(k, "a value is missing", "fill it in, or leave out the line");
    }
    readings.push_back(r);
  }
  return readings;
}

Alignment fit_alignment(const std::vector<AlignReading>& readings, double counts_per_turn,
                        double confidence) {
  constexpr std::size_t least = 5;
  constexpr double least_turns = 0.9, most_rest_turns = 0.04, most_part = 0.2;
  if (readings.size() < least) {
    throw MeasurementError(
        fmt::format("{} readings do not tell pole pairs, offset and what is "
                    "left over; take {}, over an electrical turn and back",
                    readings.size(), 2 * 8 + 1));
  }
  const auto rows = static_cast<Eigen::Index>(readings.size());
  Eigen::MatrixXd of_rotor(rows, 2), constant = Eigen::MatrixXd::Ones(rows, 1);
  Eigen::VectorXd angle(rows), turned(rows);
  double before = readings.front().offset_turns, low = before, high = before;
  for (Eigen::Index k = 0; k < rows; ++k) {
    const AlignReading& r = readings[static_cast<std::size_t>(k)];
    before = unwrapped(r.offset_turns, before);
    low = std::min(low, before);
    high = std::max(high, before);
    angle[k] = before + kQuarter;
    turned[k] = r.position_counts / counts_per_turn;
    of_rotor.row(k) << 1, turned[k];
  }
  if (high - low < least_turns) {
    throw MeasurementError(
        fmt::format("the voltage turned by {:.2g} of an electrical turn; let it turn by a whole "
                    "one, in steps of an eighth, so that an open phase shows",
                    high - low));
  }
  if (turned.maxCoeff() == turned.minCoeff()) {
    throw MeasurementError("the rotor never moved; free it, or raise the amplitude");
  }
  const Regression line(of_rotor, angle, confidence);
  Alignment found;
  found.confidence = confidence;
  found.pole_pairs = line.coefficient(1);
  found.rest_turns = line.sigma();
  found.freedom = line.freedom();
  if (found.rest_turns > most_rest_turns) {
    throw MeasurementError(fmt::format(
        "the rotor does not follow the voltage: {:.0f} degrees of an electrical turn are left "
        "over; look for a phase that is open, free the rotor, or raise the amplitude",
        360 * found.rest_turns));
  }
  const double size = std::abs(found.pole_pairs.value);
  found.whole = static_cast<int>(std::lround(size));
  if (found.whole < 1 || std::abs(size - found.whole) > most_part) {
    throw MeasurementError(
        fmt::format("{:.3g} pole pairs are no whole number; let the voltage turn further, and the "
                    "rotor come to rest at each angle",
                    size));
  }
  const double pairs = std::copysign(found.whole, found.pole_pairs.value);
  const Regression mean(constant, angle - pairs * turned, confidence);
  const Interval at_zero = mean.coefficient(0);
  found.offset_turns = at_zero.plus(-std::floor(at_zero.value));
  if (found.against()) {
    found.warnings.emplace_back(
        "the rotor turns against the voltage: change the motor's polarity and take the readings "
        "again");
  }
  return found;
}

std::vector<Change> changes_of(const Alignment& found, const design::Elaborated& e) {
  const design::Design& d = e.design;
  if (found.against()) {
    return {{"pwm", "polarity", 1.0 - d.motor_polarity, "the rotor turned against the voltage"}};
  }
  const std::string confidence = fmt::format("measured, {:g} %", 100 * found.confidence);
  const double offset = found.offset_turns.value;
  return {{"commutation", "pole_pairs", static_cast<double>(found.whole),
           fmt::format("{} {}", confidence, text_of(found.pole_pairs))},
          {"commutation", "offset_rad", kTurn_rad * offset,
           fmt::format("{} {}", confidence, text_of(found.offset_turns.times(kTurn_rad)))}};
}

std::string report_text(const Alignment& a) {
  std::string text = fmt::format("pole pairs   {}\n", text_of(a.pole_pairs));
  if (!a.against()) {
    text += fmt::format("offset       {} turn at count 0\n", text_of(a.offset_turns));
  }
  text += fmt::format("left over    {:.2g} degrees of an electrical turn, {} degrees of freedom\n",
                      360 * a.rest_turns, a.freedom);
  return text + notes_text(a.warnings);
}

nlohmann::ordered_json report_json(const Alignment& a) {
  return {{"schema", "feltgate-calibrate/1"},
          {"procedure", "align"},
          {"confidence", a.confidence},
          {"pole_pairs", report_json(a.pole_pairs)},
          {"whole_pole_pairs", a.whole},
          {"offset_turns", report_json(a.offset_turns)},
          {"rest_turns", a.rest_turns},
          {"freedom", a.freedom},
          {"warnings", a.warnings}};
}

}  // namespace feltgate::host
