// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The velocity by an absolute encoder, whose angle is read, rounded and late, beside that by A and
// B: every estimator in its bits on the same motions, and closed forms of what a count over a
// window makes. Documentation: docs/blocks/absolute_encoder.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "catch.hpp"
#include "feltgate/absolute_position.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/lever_absolute.hpp"
#include "figures_record.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/reference/chain.hpp"
#include "studies/controllers/controllers.hpp"

using namespace feltgate;

namespace {

constexpr double kTick_s = 1e-6, kTurn = 6.283185307179586, kPole_rad_s = 500;
constexpr double kRamp_rad_s2 = 200, kSettled_s = 0.15;
constexpr std::array<double, 4> speeds_rad_s{0.107, 1.07, 10.7, 107};

/// The same sensor without a diagnosis between its angles.
struct BySsi : LeverAbsolute {
  static constexpr int absolute_framing = 1;
};
template <class Of, int M1, int Shift>
struct ByWindow : Of {
  static constexpr int m1 = M1, velocity_shift = Shift;
};

/// A steady speed, or one that grows from 0.
struct Motion {
  double rad_s = 0, rad_s2 = 0, seconds = 0;
  double at(double s) const { return 0.0123 + rad_s * s + rad_s2 * s * s / 2; }
  double speed(double s) const { return rad_s + rad_s2 * s; }
  int ticks() const { return static_cast<int>(seconds / kTick_s); }
};
Motion steady(double rad_s) { return {rad_s, 0, rad_s < 1 ? 0.6 : 0.3}; }
constexpr Motion ramp{0, kRamp_rad_s2, 0.4};

/// What the core's decoder has as travel at the sample of each tick, clock by clock of its lines.
template <class D>
std::vector<std::int16_t> read_by(const Motion& motion) {
  constexpr int sample = Map::first_wave_clock + Map::T::sample;
  AbsolutePosition<D> position;
  AbsoluteSensor sensor(absolute_parameters<D>());
  std::vector<std::int16_t> out;
  Clock now = 0;
  for (int k = 0; k < motion.ticks(); ++k) {
    sensor.turn(motion.at(k * kTick_s), motion.at((k + 1) * kTick_s), now, D::clocks_per_tick);
    for (int c = 0; c < D::clocks_per_tick; ++c, ++now) {
      typename AbsolutePosition<D>::In in;
      in.data = sensor.pin(now, position.serial());
      in.sample = c == sample;
      if (in.sample) out.push_back(static_cast<std::int16_t>(position.out().travel));
      position.clock(in);
    }
  }
  return out;
}

struct Seen {
  double rms = 0, worst = 0, mean = 0;  ///< of the velocity less the true one, rad/s
};
class Spread {
 public:
  void add(double error) {
    sum_ += error, squares_ += error * error, worst_ = std::max(worst_, std::abs(error)), ++n_;
  }
  Seen seen() const { return {std::sqrt(squares_ / n_), worst_, sum_ / n_}; }

 private:
  double sum_ = 0, squares_ = 0, worst_ = 0, n_ = 0;
};
struct Errors {
  Seen filtered, raw;
};

/// What an estimator shows of a steady speed on average, over it.
template <class D>
double gain(double count_rad) {
  return std::ldexp(D::m1 * kTick_s / count_rad, D::velocity_shift);
}

/// An estimator by counts, fed with a travel of each tick; less its error of gain.
template <class D>
Errors errors_of(const std::vector<std::int16_t>& travel, const Motion& motion, double count_rad) {
  Chain<D, Fixed> chain("N");
  chain.set_parameter(D::A::velocity_a1, -std::expm1(-kPole_rad_s * kTick_s));
  Spread filtered, raw;
  for (int k = 0; k < motion.ticks(); ++k) {
    const auto t = travel[static_cast<std::size_t>(k)];
    const double input =
        std::ldexp(static_cast<double>(chain.control().velocity_input(t)), -D::f.velocity.fraction);
    ChainIn in;
    in.position = in.travel = t;
    chain.tick(in);
    if (k * kTick_s < kSettled_s) continue;
    raw.add(input / gain<D>(count_rad) - motion.speed(k * kTick_s));
    filtered.add(chain.out().velocity_rad_s / gain<D>(count_rad) - motion.speed(k * kTick_s));
  }
  return {filtered.seen(), raw.seen()};
}

/// A and B of `lever`: counts as they are at a tick, and the clocks of the edges.
Errors errors_by_edges(RealChain* chain, const Motion& motion) {
  const auto p24 = plant::read_plant_file(FELTGATE_SOURCE_DIR "/vectors/plants/p24.toml");
  plant::Encoder encoder(p24.encoder, false, motion.at(0));
  std::vector<EncoderEvent> edges;
  Spread filtered;
  for (int k = 0; k < motion.ticks(); ++k) {
    ChainIn in;
    edges.clear();
    encoder.advance(motion.at(k * kTick_s), 0, Lever::clocks_per_tick, edges);
    in.edge_clock = edges.empty() ? 0 : static_cast<int>(edges.back().clock) - 1;
    in.position = static_cast<std::int32_t>(encoder.count());
    in.travel = static_cast<std::int16_t>(in.position);
    chain->tick(in);
    if (k * kTick_s >= kSettled_s) {
      filtered.add(chain->out().velocity_rad_s - motion.speed(k * kTick_s));
    }
  }
  return {filtered.seen(), {}};
}
std::vector<std::int16_t> counted(const Motion& motion) {
  std::vector<std::int16_t> out;
  for (int k = 0; k < motion.ticks(); ++k) {
    out.push_back(static_cast<std::int16_t>(std::floor(motion.at(k * kTick_s) / (kTurn / 4096))));
  }
  return out;
}

/// Of whole counts in a window at a steady speed: so many or one more, in their shares. Readings
/// each `every` ticks: so many of them or one more, where the window is no multiple.
struct Closed {
  double rms = 0, worst = 0;
};
Closed of_counts(double rad_s, int m1, double count_rad, int every) {
  const double counts = rad_s * m1 * kTick_s / count_rad, down = std::floor(counts);
  const double step = rad_s / counts, share = counts - down;
  const double below = step * down - rad_s, above = below + step;
  const double readings = static_cast<double>(m1) / every, part = readings - std::floor(readings);
  Closed c{std::sqrt((1 - share) * below * below + share * above * above),
           std::max(std::abs(below), std::abs(above))};
  if (part > 0) {
    c.rms = std::hypot(c.rms, rad_s * std::sqrt(part * (1 - part)) / readings);
    c.worst = step + rad_s * std::max(part, 1 - part) / readings;
  }
  return c;
}

constexpr double count_14_rad = kTurn / 16384;
constexpr int period_ticks = LeverAbsolute::absolute_period;

}  // namespace

TEST_CASE("sampled velocity: an absolute encoder beside A and B, with closed forms") {
  std::array<std::vector<std::int16_t>, 5> ab, spi, ssi;
  std::array<Motion, 5> motions;
  for (std::size_t k = 0; k < 5; ++k) {
    motions[k] = k < 4 ? steady(speeds_rad_s[k]) : ramp;
    ab[k] = counted(motions[k]);
    spi[k] = read_by<LeverAbsolute>(motions[k]);
    ssi[k] = read_by<BySsi>(motions[k]);
  }
  std::string figures = "| source | estimator |", raws, rule = "|---|---|";
  for (const double rad_s : speeds_rad_s)
    figures += fmt::format(" {:g} rad/s |", rad_s), rule += "---|";
  raws = figures + "\n" + rule + "\n";
  figures += " lag, ms |\n" + rule + "---|\n";
  const auto row = [&](const std::string& what, const std::array<Errors, 5>& of) {
    figures += "| " + what + " |";
    for (std::size_t k = 0; k < 4; ++k) {
      figures += fmt::format(" {:.3f}, {:.3f} |", of[k].filtered.rms, of[k].filtered.worst);
    }
    figures += fmt::format(" {:.2f} |\n", -1e3 * of[4].filtered.mean / kRamp_rad_s2);
  };
  const auto by_counts = [&](auto design, const std::string& what, const auto& travel,
                             double count_rad, double age_s, bool diagnosis = false) {
    using D = decltype(design);
    std::array<Errors, 5> of;
    for (std::size_t k = 0; k < 5; ++k) of[k] = errors_of<D>(travel[k], motions[k], count_rad);
    row(what, of);
    raws += "| " + what + " |";
    const bool edges = count_rad > count_14_rad, on_grid = edges || D::m1 % period_ticks == 0;
    for (std::size_t k = 0; k < 4; ++k) {
      Closed c = of_counts(speeds_rad_s[k], D::m1, count_rad, edges ? 1 : period_ticks);
      if (diagnosis) {
        // In 2 of 16 readings a window of four has 3 or 5.
        const double miss = speeds_rad_s[k] / 4;
        c.rms = std::hypot(c.rms, miss * std::sqrt(2.0 / 16)), c.worst += miss;
      }
      raws += fmt::format(" {:.2f} ({:.2f}), {:.2f} ({:.2f}) |", of[k].raw.rms, c.rms,
                          of[k].raw.worst, c.worst);
      CAPTURE(what, speeds_rad_s[k], of[k].raw.rms, c.rms, of[k].raw.worst, c.worst);
      // A count and a reading more do not come independently.
      const double margin = on_grid && !diagnosis ? 0.01 : 0.2;
      CHECK(std::abs(of[k].raw.rms / c.rms - 1) < (speeds_rad_s[k] > 100 ? 0.01 : margin));
      CHECK(of[k].raw.worst < 1.01 * c.worst);
      if (!diagnosis && on_grid) CHECK(of[k].raw.worst > 0.99 * c.worst);
      CHECK(of[k].filtered.rms < of[k].raw.rms);
    }
    raws += "\n";
    const double lag_s = D::m1 * kTick_s / 2 + age_s + 1 / kPole_rad_s;
    CAPTURE(what, of[4].filtered.mean, lag_s);
    CHECK(std::abs(-of[4].filtered.mean / kRamp_rad_s2 / lag_s - 1) < 0.02);
    return of;
  };
  // From the angle to the tick that has it, and until the next one.
  const auto age_s = [](const AbsoluteEncoder::Parameters& p, double held_ticks) {
    return (std::ceil(p.reading_clocks() / 50.0) + (held_ticks - 1) / 2) * kTick_s;
  };
  const double of_ssi = age_s(absolute_parameters<BySsi>(), period_ticks);
  // One reading in 16 is held twice as long.
  const double of_spi = age_s(absolute_parameters<LeverAbsolute>(), period_ticks * 18.0 / 16);

  by_counts(Lever{}, "A and B, 4096 | N, 767 ticks, n = 1 (`lever`)", ab, kTurn / 4096, 0);
  controllers::Tuning tuning;
  tuning.tick_s = kTick_s;
  for (const auto& [kind, name] :
       {std::pair{3, "M/T, one cycle"}, {5, "M/T, 386 µs, 2000 rad/s"}}) {
    std::array<Errors, 5> of;
    for (std::size_t k = 0; k < 5; ++k) {
      of[k] =
          errors_by_edges(controllers::make_estimator_chain(kind, false, tuning).get(), motions[k]);
    }
    row(fmt::format("A and B, 4096 | {}", name), of);
    CHECK(of[2].filtered.worst < 0.02);
  }
  by_counts(LeverAbsolute{}, "SPI, 14 bits | N, 384 ticks, n = 0 (`lever_absolute`)", spi,
            count_14_rad, of_spi, true);
  const auto four = by_counts(ByWindow<BySsi, 384, 0>{}, "SSI, 14 bits | N, 384 ticks, n = 0", ssi,
                              count_14_rad, of_ssi);
  by_counts(ByWindow<BySsi, 192, 1>{}, "SSI, 14 bits | N, 192 ticks, n = 1", ssi, count_14_rad,
            of_ssi);
  by_counts(ByWindow<BySsi, 96, 2>{}, "SSI, 14 bits | N, 96 ticks, n = 2", ssi, count_14_rad,
            of_ssi);
  const auto off = by_counts(ByWindow<BySsi, 432, 0>{}, "SSI, 14 bits | N, 432 ticks, off the grid",
                             ssi, count_14_rad, of_ssi);
  CHECK(off[3].raw.rms > 5 * four[3].raw.rms);
  figures += "\nBefore the low-pass, with the closed form in brackets:\n\n" + raws;
  test::check_figures("sampled_velocity", figures);
}
