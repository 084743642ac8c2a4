// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Velocity estimators around the lever: the N-method and M/T, all else equal. Documentation:
// docs/blocks/velocity.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <stdexcept>

#include "feltgate/generated/paper.hpp"
#include "feltgate/velocity_mt.hpp"
#include "files/table.hpp"
#include "sim/loop/rest.hpp"
#include "sim/reference/chain.hpp"
#include "studies/controllers/controllers.hpp"
#include "studies/controllers/fed_lever.hpp"

namespace feltgate::controllers {

using files::Columns;
using files::Json;

namespace {

/// A low-pass of up to 2^-A1Below times the tick rate.
template <int A1Below>
struct WithCutoff : FedLever {
  static constexpr Format a1{0, -A1Below, 17 + A1Below};
  struct P : FedLever::P {
    static constexpr Format velocity_a1 = a1;
  };
  static constexpr Parameters parameters = with_format(FedLever::parameters, A::velocity_a1, a1);
};
constexpr int kTo977 = 10, kTo3906 = 8;  // rad/s

/// The N-method with the window and the gain of another design.
template <class Of, int A1Below>
struct ByCounts : WithCutoff<A1Below> {
  static constexpr int m1 = Of::m1, velocity_shift = Of::velocity_shift;
};

template <int WindowUs, int Doublings, int A1Below>
struct BySpans : WithCutoff<A1Below> {
  static constexpr int m1 = 0, mt_counts = Lever::index_counts, mt_doublings = Doublings;
  static constexpr int mt_window = static_cast<int>(WindowUs * (Lever::clock_hz / 1'000'000));
};

/// The chain with M/T, which gets the clocks of the edges from its loop. A tick takes what the
/// edges up to the sample before have told, as the core does. Of several edges in a tick the last
/// one is exact, and the others are a clock apart.
template <class D, class N>
class SpanChain : public ChainTick<D, N> {
 public:
  void reset() {
    ChainTick<D, N>::reset();
    this->words().reset();
    meter_ = {};
    travel_ = 0;
    begun_ = false;
  }
  void tick(const ChainIn& in) {
    if (in.restart) this->restart();
    if (!begun_) start_ = in.travel;  // the decoder counts from 0 at power-up
    begun_ = true;
    const std::int16_t travel = travel_difference(in.travel, start_);
    const int way = travel_difference(travel, travel_), edges = std::abs(way);
    int at = 0;
    for (int k = 1; k <= edges; ++k) {
      const int edge = std::max(at, in.edge_clock - (edges - k));
      advance(at, edge);
      at = edge;
      travel_ = static_cast<std::int16_t>(travel_ + (way < 0 ? -1 : 1));
    }
    advance(at, D::clocks_per_tick);
    this->estimate_from(meter_);
    this->observe(in.armed);
    this->render(in.armed, in.scene, in.position, in.relief);
    this->drive(in.armed, static_cast<Mode>(in.mode));
  }

 private:
  void advance(int from, int to) {
    constexpr int clocks = D::clocks_per_tick;
    constexpr int begin = Map::first_wave_clock + Map::T::velocity_raw + 1;
    const int a = from + begin, b = to + begin;
    meter_.pass(a, std::min(b, clocks), travel_);
    meter_.pass(std::max(a, clocks) - clocks, b - clocks, travel_);
  }

  typename MeterOf<D>::type meter_;
  std::int16_t travel_ = 0, start_ = 0;
  bool begun_ = false;
};

template <class D>
std::unique_ptr<RealChain> tuned(double cutoff_rad_s, bool observer, const Tuning& t) {
  std::unique_ptr<RealChain> chain;
  if constexpr (measures_spans<D>) {
    chain = std::make_unique<Chain<D, Fixed, SpanChain<D, Fixed>>>("M/T");
  } else {
    chain = std::make_unique<Chain<D, Fixed>>("N-method");
  }
  chain->set_parameter(D::A::velocity_a1, -std::expm1(-cutoff_rad_s * t.tick_s));
  if (observer) {
    chain->set_parameter(D::A::torque_gain, t.share / t.torque_constant_nm_a);
    chain->set_parameter(D::A::observer_gain, (1 - t.share) / t.torque_constant_nm_a);
  }
  return chain;
}

struct Estimator {
  const char* name;
  double cutoff_rad_s;
  std::unique_ptr<RealChain> (*make)(double cutoff_rad_s, bool observer, const Tuning&);
};
constexpr Estimator kEstimators[] = {
    {"N-method, m1 = 386, n = 2 (`paper`), 500 rad/s", 500, tuned<ByCounts<Paper, kTo977>>},
    {"N-method, m1 = 767, n = 1 (`lever`), 500 rad/s", 500, tuned<ByCounts<Lever, kTo977>>},
    {"the same, 2000 rad/s", 2000, tuned<ByCounts<Lever, kTo3906>>},
    {"M/T, one cycle, 500 rad/s", 500, tuned<BySpans<0, 0, kTo977>>},
    {"M/T, 386 µs, 500 rad/s", 500, tuned<BySpans<386, 4, kTo977>>},
    {"M/T, 386 µs, 2000 rad/s", 2000, tuned<BySpans<386, 4, kTo3906>>}};

plant::Hand moved_by(plant::Segment segment) {
  segment.duration_s = 10;
  plant::HandPhase phase;
  phase.kind = plant::HandPhase::Kind::kPrescribed;
  phase.profile = {segment};
  plant::Hand hand;
  hand.phases = {phase};
  return hand;
}

plant::Segment sine(double amplitude_rad, double hz) {
  plant::Segment s;
  s.kind = plant::Segment::Kind::kSine;
  s.amplitude = amplitude_rad;
  s.frequency_hz = hz;
  return s;
}

plant::Segment ramp(double rad_s) {
  plant::Segment s;
  s.kind = plant::Segment::Kind::kRamp;
  s.to = 10 * rad_s;
  return s;
}

/// In softer walls the ripple of the N-method with a fast low-pass reaches the torque limit.
constexpr double softest_nm_rad = 4;

/// Runs a hand's motion with a torque reference; look(loop) after each tick from `from_s` on.
template <class Look>
void run_hand(const Bench& bench, stability::BitLoopSetting s, const plant::Hand& hand,
              double reference_nm, double from_s, double to_s, Look look) {
  const design::Design& d = bench.design.design;
  s.hand = hand;
  s.linear = false;
  s.wall.scene_ticks = d.pwm_period_clocks() / d.clocks_per_tick();
  stability::BitLoop loop(bench.design, s);
  loop.set_host([reference_nm](double, double) { return reference_nm; });
  const auto ticks = [&d](double seconds) {
    return std::llround(seconds * static_cast<double>(d.tick_hz));
  };
  while (loop.ticks() < ticks(to_s)) {
    loop.tick();
    if (loop.ticks() > ticks(from_s)) look(loop);
  }
}

Noise noise(const Bench& bench, int estimator, const plant::Parameters& plant,
            const plant::Segment& motion, double to_s) {
  const Tuning tuning = tuning_of(bench, bench.plant);
  feltgate::Spread hat, motor;
  for (const bool observer : {false, true}) {
    stability::BitLoopSetting s;
    s.encoder = true;
    s.plant = plant;
    s.made_chain = [&] { return make_estimator_chain(estimator, observer, tuning); };
    run_hand(bench, s, moved_by(motion), 0.1, 0.05, to_s, [&](const auto& loop) {
      observer ? motor.add(loop.motor_torque_nm()) : hat.add(loop.tau_hat_nm());
    });
  }
  return {hat.rms(), motor.rms()};
}

/// A hand swings the free lever by 0.5 rad at 2 Hz, for a period from turn to turn.
Drag drag_of(const Bench& bench, stability::BitLoopSetting s, const plant::Parameters& plant) {
  s.plant = plant;
  Drag drag;
  double before_rad_s = 0;
  run_hand(bench, s, moved_by(sine(0.5, 2)), 0, 0.125, 0.625, [&](const auto& loop) {
    const plant::Observables& now = loop.seen();
    drag.step(bench.design.design.tick_s(), now.hand_torque_nm, before_rad_s, now.omega_rad_s);
    before_rad_s = now.omega_rad_s;
  });
  return drag;
}

}  // namespace

int estimator_count() { return static_cast<int>(std::size(kEstimators)); }

std::unique_ptr<RealChain> make_estimator_chain(int estimator, bool observer, const Tuning& t) {
  if (estimator < 0 || estimator >= estimator_count()) {
    throw std::invalid_argument("controllers: no such estimator");
  }
  const Estimator& k = kEstimators[estimator];
  return k.make(k.cutoff_rad_s, observer, t);
}

EstimatorRow measure_estimator(const Bench& bench, int estimator) {
  EstimatorRow row;
  row.name = kEstimators[estimator].name;
  const Tuning tuning = tuning_of(bench, bench.plant);
  stability::BitLoopSetting s;
  s.encoder = true;
  s.plant = bench.linear;
  for (const bool observer : {false, true}) {
    s.made_chain = [&, observer] { return make_estimator_chain(estimator, observer, tuning); };
    (observer ? row.border_observer_nm_rad : row.border_nm_rad) =
        pressed_border(bench, s, softest_nm_rad);
  }
  plant::Parameters plant = bench.plant;
  for (const bool irregular : {false, true}) {
    plant.effects.encoder_imperfect = irregular;
    auto& of = irregular ? row.irregular : row.good;
    of[0] = noise(bench, estimator, plant, sine(tremor_rad, tremor_hz), 0.05 + 1 / tremor_hz);
    for (std::size_t k = 0; k < estimator_speeds_rad_s.size(); ++k) {
      of[k + 1] = noise(bench, estimator, plant, ramp(estimator_speeds_rad_s[k]), 0.35);
    }
  }
  s.made_chain = [&] { return make_estimator_chain(estimator, false, tuning); };
  std::map<std::string, double> figures;
  drag_of(bench, s, bench.plant).tell(figures);
  row.drag_rms_nm = figures["drag_rms_nm"];
  drag_of(bench, s, bench.linear).tell(figures);
  row.drag_nm_s_rad = figures["drag_damping_nm_s_rad"];
  row.drag_inertia = figures["drag_inertia_kg_m2"] / bench.linear.lever.inertia_kg_m2;
  return row;
}

std::vector<EstimatorRow> measure_estimators(const Bench& bench,
                                             const std::function<void(double)>& progress) {
  std::vector<EstimatorRow> rows;
  for (int k = 0; k < estimator_count(); ++k) {
    rows.push_back(measure_estimator(bench, k));
    if (progress) progress(static_cast<double>(k + 1) / estimator_count());
  }
  return rows;
}

std::string wall_text(double nm_rad) {
  return nm_rad >= stiffest_nm_rad ? fmt::format("over {:g}", stiffest_nm_rad)
                                   : fmt::format("{:.1f}", nm_rad);
}

namespace {

Columns<EstimatorRow> columns() {
  Columns<EstimatorRow> all{
      {"name", &EstimatorRow::name, " "},
      {"border_nm_rad", &EstimatorRow::border_nm_rad},
      {"", [](auto& r) { return wall_text(r.border_nm_rad); }, "largest wall, pressed, Nm/rad"},
      {"border_observer_nm_rad", &EstimatorRow::border_observer_nm_rad},
      {"", [](auto& r) { return wall_text(r.border_observer_nm_rad); },
       "the same, observer fed back"}};
  const auto noises = [&](const std::string& key, const char* what, double Noise::*figure) {
    const auto add = [&](const char* lines, auto EstimatorRow::*noise) {
      all.push_back({key + lines, [=](auto& r) {
                       Json of = Json::array();
                       for (const Noise& n : r.*noise) of.push_back(n.*figure);
                       return of;
                     }});
    };
    add("_good_nm", &EstimatorRow::good);
    add("_irregular_nm", &EstimatorRow::irregular);
    for (std::size_t k = 0; k <= estimator_speeds_rad_s.size(); ++k) {
      const std::string when =
          k == 0 ? "at rest" : fmt::format("at {:g} rad/s", estimator_speeds_rad_s[k - 1]);
      all.push_back({"",
                     [=](auto& r) {
                       return fmt::format("{:.2f} / {:.2f}", 1e3 * (r.good[k].*figure),
                                          1e3 * (r.irregular[k].*figure));
                     },
                     fmt::format("{}, {}, mNm rms", what, when)});
    }
  };
  noises("tau_hat", "tau_hat", &Noise::hat_nm);
  noises("motor", "motor torque, observer fed back", &Noise::motor_nm);
  const Columns<EstimatorRow> drag{
      {"drag_rms_nm", &EstimatorRow::drag_rms_nm, "drag of the free lever, mNm rms", "{:.2f}", 1e3},
      {"drag_nm_s_rad", &EstimatorRow::drag_nm_s_rad,
       "the same without friction and dead voltage: damping, mNm s/rad", "{:.3f}", 1e3},
      {"drag_inertia", &EstimatorRow::drag_inertia, "and inertia / J", "{:.3f}"}};
  all.insert(all.end(), drag.begin(), drag.end());
  return all;
}

}  // namespace

std::string estimators_text(const std::vector<EstimatorRow>& rows) {
  return markdown(columns(), rows);
}

std::string estimators_json(const std::vector<EstimatorRow>& rows) {
  return files::json_text({{"schema", "feltgate-estimators/1"},
                           {"version", FELTGATE_VERSION},
                           {"speeds_rad_s", estimator_speeds_rad_s},
                           {"estimators", array_of(columns(), rows)}});
}

}  // namespace feltgate::controllers
