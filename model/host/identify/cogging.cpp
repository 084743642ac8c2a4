// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Fits the harmonics of a motor's cogging to the observed torque of a slow turn both ways: all of
// them at once, then those that stand out of their neighbours. Documentation: docs/calibration.md
#include "host/identify/cogging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "host/identify/recording.hpp"

namespace feltgate::host {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRevolution_rad = 2 * 3.14159265358979323846;
constexpr double kReversalRad = 0.1;  ///< back by so much: the direction has changed
constexpr double kSettleRad = 0.05;   ///< left out at both ends of a way
constexpr double kSpeed_s = 0.05;     ///< over which a speed is measured
constexpr double kSlow = 0.5;         ///< of the median: slower at an end is starting or stopping
constexpr double kFarthestStep = kRevolution_rad / 64;
constexpr std::size_t kRowsPerHarmonic = 8, kFewestPerTurn = 256, kMeansPerTurn = 2048;
constexpr int kMostHarmonics = 128, kNeighbours = 16;
constexpr double kStandsOut =
    5;  ///< standard deviations of a cosine: exp(-25/2), one of 270 000, without
constexpr double kShareOfLargest = 0.01, kShareOfNominal = 1e-3;
constexpr std::size_t kMostTerms = 8;
/// Phase by which the observer may be late: for the largest harmonic, and for one that is looked
/// for.
constexpr double kMostLag = 0.12, kSearchedLag = 0.3, kFastest_rad_s = 2.5;

struct Pass {
  std::size_t first = 0, last = 0;  ///< rows
  double turns = 0, rad_s = 0;
};

/// The columns, with the torque as the motor gave it.
struct Turn {
  Recording at;
  std::vector<double> load_nm;  ///< positive against the motor
  std::vector<double> seen_nm;  ///< as it is in the file
};

Turn read_turn(const ColumnTable& table, const design::Elaborated& e) {
  Turn turn;
  turn.at = recording_of(table, e.design.count_rad(), e.design.tick_s(), false);
  const SmallTorque small = small_torque_of(e);
  const std::size_t seen = table.need({"tau_hat_nm", "tau_hat"}, "the observed torque");
  std::size_t asked = seen;
  if (!small.exact()) asked = table.need({"tau_ref_nm", "tau_ref"}, "the torque reference");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double hat = table.at(row, seen), ref = table.at(row, asked);
    if (!std::isfinite(hat) || !std::isfinite(ref)) {
      table.fail(row, "a field is empty", "take the row out");
    }
    turn.seen_nm.push_back(hat);
    turn.load_nm.push_back(small.exact() ? hat
                                         : hat + small.torque(ref, turn.at.angle_rad[row]) - ref);
  }
  return turn;
}

double speed_at(const Recording& r, std::size_t row) {
  std::size_t from = row, to = row;
  while (from > 0 && r.time_s[row] - r.time_s[from] < kSpeed_s / 2) --from;
  while (to + 1 < r.rows() && r.time_s[to] - r.time_s[row] < kSpeed_s / 2) ++to;
  return (r.angle_rad[to] - r.angle_rad[from]) / (r.time_s[to] - r.time_s[from]);
}

/// Without starting and stopping.
Pass trimmed(const Recording& r, Pass way) {
  const double span_s = r.time_s[way.last] - r.time_s[way.first];
  std::vector<double> speeds;
  for (std::size_t row = way.first; row <= way.last; ++row) {
    speeds.push_back(std::abs(speed_at(r, row)));
  }
  std::vector<double> sorted = speeds;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  // Where it stood for most of the time the median says nothing.
  const double way_rad = std::abs(r.angle_rad[way.last] - r.angle_rad[way.first]);
  const double pace = std::max(sorted[sorted.size() / 2], span_s > 0 ? way_rad / span_s : 0);
  std::size_t first = way.first, last = way.last;
  while (first < last && speeds[first - way.first] < kSlow * pace) ++first;
  while (last > first && speeds[last - way.first] < kSlow * pace) --last;
  const auto near = [&](std::size_t a, std::size_t b) {
    return std::abs(r.angle_rad[a] - r.angle_rad[b]) < kSettleRad;
  };
  Pass w{first, last, 0, 0};
  while (w.first < last && near(w.first, first)) ++w.first;
  while (w.last > w.first && near(w.last, last)) --w.last;
  const double rad = std::abs(r.angle_rad[w.last] - r.angle_rad[w.first]);
  const double seconds = r.time_s[w.last] - r.time_s[w.first];
  w.turns = rad / kRevolution_rad;
  w.rad_s = seconds > 0 ? rad / seconds : 0;
  return w;
}

/// The longest way up and the longest way down.
std::pair<Pass, Pass> ways_of(const Recording& r) {
  Pass up, down;
  double longest_up = 0, longest_down = 0;
  std::size_t begin = 0, extreme = 0;
  int direction = 0;
  const auto end = [&](std::size_t from, std::size_t to) {
    const double rad = r.angle_rad[to] - r.angle_rad[from];
    double& longest = rad > 0 ? longest_up : longest_down;
    if (std::abs(rad) <= longest) return;
    longest = std::abs(rad);
    (rad > 0 ? up : down) = {from, to, 0, 0};
  };
  for (std::size_t row = 1; row < r.rows(); ++row) {
    const double gone = r.angle_rad[row] - r.angle_rad[extreme];
    if (direction == 0) {
      if (std::abs(gone) <= kReversalRad) continue;
      direction = gone > 0 ? 1 : -1;
      extreme = row;
    } else if (gone * direction >= 0) {
      if (gone != 0) extreme = row;
    } else if (-gone * direction > kReversalRad) {
      end(begin, extreme);
      begin = extreme;
      extreme = row;
      direction = -direction;
    }
  }
  end(begin, extreme);
  if (longest_up > 0) up = trimmed(r, up);
  if (longest_down > 0) down = trimmed(r, down);
  return {up, down};
}

/// Refuses a way that does not determine the harmonics; returns its rows per turn.
std::size_t judged(const ColumnTable& table, const Turn& turn, const Pass& way, const char* name,
                   const char* other) {
  const Recording& r = turn.at;
  if (way.turns < 0.1) {
    table.fail(r.rows() - 1, fmt::format("the shaft turns one way only, never {}", name),
               fmt::format("turn it {} too, over the turn that it made {}: friction is what "
                           "differs",
                           name, other));
  }
  if (way.turns < 1) {
    table.fail(way.last, fmt::format("{:.2g} of a turn {} is too short", way.turns, name),
               "turn by a whole turn both ways, better by 1.2, for both ends are left out");
  }
  if (way.rad_s > kFastest_rad_s) {
    table.fail(way.first, fmt::format("{:.2g} rad/s {} is too fast", way.rad_s, name),
               "turn at 0.5 rad/s: the observer is late, and the inertia smooths the cogging");
  }
  const auto rows =
      static_cast<std::size_t>(static_cast<double>(way.last - way.first + 1) / way.turns);
  if (rows < kFewestPerTurn) {
    table.fail(
        way.first, fmt::format("{} rows per turn {} are too few samples", rows, name),
        fmt::format("record at least {} per turn, better one per millisecond", kFewestPerTurn));
  }
  bool seen = false;
  for (std::size_t row = way.first; row <= way.last; ++row) {
    seen = seen || turn.seen_nm[row] != 0;
    if (row > way.first && std::abs(r.angle_rad[row] - r.angle_rad[row - 1]) > kFarthestStep) {
      table.fail(row, "the position jumps, rows are missing", "record it again without a gap");
    }
  }
  if (!seen) {
    table.fail(way.first, fmt::format("the observed torque is 0 all the way {}", name),
               "arm the motor and let it turn the shaft: the observer sees only what the motor "
               "drives");
  }
  return rows;
}

/// Constant, cosine 1, sine 1, cosine 2, ... of the load over the angle.
VectorXd harmonics(const Turn& turn, const Pass& way, int most) {
  const Recording& r = turn.at;
  const std::size_t rows = way.last - way.first + 1;
  const auto means =
      static_cast<std::size_t>(std::ceil(way.turns * static_cast<double>(kMeansPerTurn)));
  const std::size_t of = std::max<std::size_t>(1, rows / means), n = rows / of;
  MatrixXd x(static_cast<Index>(n), 1 + 2 * most);
  VectorXd y(static_cast<Index>(n));
  for (std::size_t k = 0; k < n; ++k) {
    double angle = 0, load = 0;
    for (std::size_t row = way.first + k * of; row < way.first + (k + 1) * of; ++row) {
      angle += r.angle_rad[row] / static_cast<double>(of);
      load += turn.load_nm[row] / static_cast<double>(of);
    }
    const auto at = static_cast<Index>(k);
    y[at] = load;
    x(at, 0) = 1;
    for (int order = 1; order <= most; ++order) {
      x(at, 2 * order - 1) = std::cos(order * angle);
      x(at, 2 * order) = std::sin(order * angle);
    }
  }
  return (x.transpose() * x).ldlt().solve(x.transpose() * y);
}

double amplitude(const VectorXd& c, int order) {
  return std::hypot(c[2 * order - 1], c[2 * order]);
}

/// Standard deviation of cosine and sine where there is noise alone: from the median of the
/// neighbours, since few of them are cogging.
double deviation(const VectorXd& c, int order, int most) {
  const int first = std::max(1, std::min(order - kNeighbours, most - 2 * kNeighbours));
  std::vector<double> near;
  for (int n = first; n <= std::min(most, first + 2 * kNeighbours); ++n) {
    near.push_back(amplitude(c, n));
  }
  const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
  std::nth_element(near.begin(), middle, near.end());
  return *middle / std::sqrt(2 * std::log(2.0));  // of Rayleigh's distribution
}

void select(const VectorXd& even, const VectorXd& odd, double confidence, Cogging* c) {
  const int most = c->searched;
  double largest = 0;
  for (int n = 1; n <= most; ++n) largest = std::max(largest, amplitude(even, n));
  for (int n = 1; n <= most; ++n) {
    const double sigma = deviation(even, n, most), a = amplitude(even, n);
    c->noise_nm = std::max(c->noise_nm, sigma);
    if (a < std::max({kStandsOut * sigma, kShareOfLargest * largest, c->least_nm})) continue;
    const double half = student_t(confidence, 1000000) * sigma;
    c->terms.push_back(
        {n, -even[2 * n - 1], -even[2 * n], {a, a - half, a + half}, amplitude(odd, n)});
  }
  std::sort(c->terms.begin(), c->terms.end(), [](const CoggingTerm& a, const CoggingTerm& b) {
    return a.amplitude_nm.value > b.amplitude_nm.value;
  });
  if (c->terms.size() > kMostTerms) {
    c->warnings.push_back(
        fmt::format("{} harmonics stand out, and the {} largest are taken: is something else than "
                    "cogging in the way?",
                    c->terms.size(), kMostTerms));
    c->terms.resize(kMostTerms);
  }
  int period = 0;
  for (const CoggingTerm& t : c->terms) period = std::gcd(period, t.per_turn);
  c->period = std::max(1, period);
}

}  // namespace

double Cogging::at(double angle_rad) const {
  double sum = 0;
  for (const CoggingTerm& t : terms) {
    sum += t.cosine_nm * std::cos(t.per_turn * angle_rad) +
           t.sine_nm * std::sin(t.per_turn * angle_rad);
  }
  return sum;
}

Cogging identify_cogging(const ColumnTable& table, const design::Elaborated& e, double confidence) {
  const Turn turn = read_turn(table, e);
  const auto [up, down] = ways_of(turn.at);
  const std::size_t rows_up = judged(table, turn, up, "up", "down");
  const std::size_t rows = std::min(rows_up, judged(table, turn, down, "down", "up"));
  Cogging c;
  // The observer is late by its own low-pass and by the velocity's.
  const double late_s = 1 / e.design.observer_cutoff_rad_s + 1 / e.design.velocity_cutoff_rad_s;
  c.searched =
      std::min({kMostHarmonics, static_cast<int>(rows / kRowsPerHarmonic),
                static_cast<int>(kSearchedLag / (std::max(up.rad_s, down.rad_s) * late_s))});
  c.least_nm = kShareOfNominal * e.design.nominal_current_a * e.design.torque_constant_nm_a;
  c.turns_up = up.turns;
  c.turns_down = down.turns;
  c.rad_s_up = up.rad_s;
  c.rad_s_down = down.rad_s;
  const VectorXd upward = harmonics(turn, up, c.searched);
  const VectorXd downward = harmonics(turn, down, c.searched);
  const VectorXd even = (upward + downward) / 2, odd = (upward - downward) / 2;
  c.friction_nm = odd[0];
  c.steady_nm = -even[0];
  select(even, odd, confidence, &c);
  for (int k = 0; k < 4096; ++k) {
    c.largest_nm = std::max(c.largest_nm, std::abs(c.at(k * kRevolution_rad / 4096)));
  }
  if (c.terms.empty()) return c;
  const CoggingTerm& t = c.terms.front();
  const double most_rad_s = kMostLag / (t.per_turn * late_s);
  for (const auto& [way, name] : {std::pair<Pass, const char*>{up, "up"}, {down, "down"}}) {
    if (way.rad_s <= most_rad_s) continue;
    table.fail(way.first,
               fmt::format("{:.3g} rad/s {} is too fast for a cogging of {} per turn", way.rad_s,
                           name, t.per_turn),
               fmt::format("turn at {:.2g} rad/s at most: the observer is late by {:.2g} ms",
                           most_rad_s, 1e3 * late_s));
  }
  if (t.odd_nm > t.amplitude_nm.value / 2) {
    c.warnings.push_back(fmt::format(
        "{:.2g} mNm of harmonic {} differ from way to way: the friction depends on the angle, or "
        "the turn was uneven; it is not in the table",
        1e3 * t.odd_nm, t.per_turn));
  }
  return c;
}

}  // namespace feltgate::host
