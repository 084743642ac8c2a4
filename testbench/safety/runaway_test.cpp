// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The check for a wrong polarity in simulation: it must trip with swapped motors and encoders, and
// must not trip with scenes, recordings, fast dampers, end stops and hands: the figures of
// docs/blocks/safety.md. Scenes and recordings are hidden test cases, so that a usual run does
// not report them as tried.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "catch.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "mismatch.hpp"
#include "random.hpp"
#include "rig.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/replay.hpp"
#include "sim/traces/open.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::test;
using plant::Hand;
using plant::HandPhase;
using plant::Segment;

/// The core's check beside a core whose own is off: when the shipped limits would have tripped.
template <class D>
class Watcher {
 public:
  Watcher() {
    const axis::WordFormats formats(design_of<D>());
    for (const axis::Word& w : design_of<D>().words) formats.load(words_, w.address, w.reset);
  }
  void tick(std::int64_t velocity, std::int64_t current_ref, bool live) {
    const auto judged = law_.tick(state_, words_, live, velocity, before_);
    state_ = judged.next;
    if (judged.trip && tripped_ < 0) tripped_ = ticks_seen_;
    before_ = current_ref;
    ++ticks_seen_;
  }
  void row(const Row& r) {
    tick(std::llround(std::ldexp(r.velocity_rad_s, D::f.velocity.fraction)),
         std::llround(std::ldexp(r.current_a, D::f.current.fraction)), true);
  }
  /// The tick (from 0) in which it tripped, or -1.
  std::int64_t tripped() const { return tripped_; }

 private:
  axis::Polarity<axis::Fixed> law_{design_of<D>()};
  axis::Polarity<axis::Fixed>::State state_;
  axis::Words<std::int64_t> words_;
  std::int64_t tripped_ = -1, before_ = 0, ticks_seen_ = 0;
};

struct Count {
  std::int64_t runs = 0, trips = 0;
  double travel_rad = 0;  ///< the longest to a trip
  template <class D>
  void add(const Watcher<D>& w, double travel = 0) {
    ++runs;
    if (w.tripped() < 0) return;
    ++trips;
    travel_rad = std::max(travel_rad, travel);
  }
};

/// Commands a torque without a ramp, with the core's own check and the heat limit disabled.
template <class D>
void ask(Rig<D>& rig, const char* scene, double torque_nm = 0.0) {
  rig.device.select(scene);
  rig.device.set("setpoint_torque", torque_nm);
  rig.device.set("ramp_step", 1.0);
  rig.device.set("polarity_current", rig.device.parameter("polarity_current").high);
  rig.device.set("i2t_budget", rig.device.parameter("i2t_budget").high);
  for (int k = 0; k < 20; ++k) rig.tick();
  rig.device.arm();
}

template <class D>
Watcher<D> watched(Rig<D>& rig, double duration_s) {
  Watcher<D> w;
  for (std::int64_t k = 0; k < std::llround(duration_s * static_cast<double>(D::tick_hz)); ++k) {
    rig.tick();
    w.tick(rig.out().velocity, rig.out().current_ref, rig.out().gates_enable);
  }
  REQUIRE(rig.out().faults == 0);
  return w;
}

template <class D>
void run_away(Count& found, double torque_nm, Wiring wiring, SplitMix64& random) {
  plant::Parameters motor = motor_of("p24");
  motor.effects.encoder_imperfect = true;
  motor.encoder.seed = static_cast<std::uint64_t>(random.below(1000));
  motor.lever.inertia_kg_m2 *= random.between(0.9, 1.1);
  const double friction = random.between(0.5, 2.0);
  motor.lugre.coulomb_nm *= friction;
  motor.lugre.static_nm *= friction;
  Hand hand;
  hand.start_rad = random.between(-1.0, 1.0);
  Rig<D> rig(motor, hand, wiring);
  ask(rig, "setpoint");
  for (std::int64_t k = 100 + random.below(2000); k > 0; --k) rig.tick();
  const double sign = random.below(2) == 0 ? 1.0 : -1.0;
  rig.device.set("setpoint_torque", sign * torque_nm);
  rig.tick();
  Watcher<D> w;
  const double start = rig.lever().theta_rad;
  double travel = 0;
  for (int k = 0; k < 60000 && std::fabs(rig.lever().theta_rad - start) < 0.7; ++k) {
    rig.tick();
    w.tick(rig.out().velocity, rig.out().current_ref, rig.out().gates_enable);
    if (w.tripped() < 0 || w.tripped() == k) travel = std::fabs(rig.lever().theta_rad - start);
  }
  found.add(w, travel);
}

HandPhase moves(std::vector<Segment> way, double duration_s) {
  HandPhase phase;
  phase.kind = HandPhase::Kind::kPrescribed;
  phase.profile = std::move(way);
  phase.duration_s = duration_s;
  return phase;
}
Segment ramp(double to, double duration_s) {
  Segment s;
  s.kind = Segment::Kind::kRamp;
  s.to = to;
  s.duration_s = duration_s;
  return s;
}

/// Accelerates from rest to a speed and keeps it. The motion is split into short ramps that gain
/// less than 4 rad/s each.
std::vector<Segment> gather(double rad_s, double rise_s, double keep_s) {
  const int parts = 200;
  std::vector<Segment> way;
  double angle = 0.0;
  for (int k = 1; k <= parts; ++k) {
    angle += rad_s * k / parts * rise_s / parts;
    way.push_back(ramp(angle, rise_s / parts));
  }
  way.push_back(ramp(angle + rad_s * keep_s, keep_s));
  return way;
}

/// A usual run tries one of so many parts of the runs in which nothing is wrong.
constexpr std::uint64_t kShares = 5;

/// The hand moves the lever at a speed against the damper, or the damper is armed at that speed;
/// then the hand lets go.
void fast_dampers(Count& count) {
  std::uint64_t k = 0;
  for (const double rad_s : {30.0, 65.0, 100.0, 200.0, 300.0, 400.0, 500.0, 600.0, -65.0, -600.0}) {
    for (const double arm_s : {0.0, 0.8}) {
      if (!tried(k++, kShares)) continue;
      Hand hand;
      hand.phases = {moves(gather(rad_s, 0.7, 0.2), 0.9), HandPhase{}};
      Rig<Lever> rig(motor_of("p24"), hand);
      for (double t = 0.0; t < arm_s; t += 1e-6) rig.tick();
      ask(rig, "damper");
      count.add(watched(rig, 1.1 - arm_s));
    }
  }
}

/// A correctly wired lever hits its end stop and bounces.
void rebounds(Count& count) {
  std::uint64_t k = 0;
  for (const double stiffness : {20.0, 50.0, 100.0, 300.0, 1000.0}) {
    for (const double restitution : {0.3, 0.6, 0.9}) {
      for (const double torque : {0.2, 0.35, -0.5}) {
        for (const double way : {0.2, 0.5, 1.0, 2.0}) {
          // 5 shares: each has all four ways.
          if (!tried(k++, kShares)) continue;
          plant::Parameters motor = motor_of("p24");
          motor.end_stops = plant::EndStops{-way, way, stiffness, restitution};
          Rig<Lever> rig(motor, Hand{});
          ask(rig, "setpoint", torque);
          count.add(watched(rig, 0.25));
        }
      }
    }
  }
}

/// A hand moves the lever at up to 5 rad/s against 0.5 Nm: as a mass behind a grip, or as an
/// imposed motion.
void hands(Count& count) {
  std::uint64_t k = 0;
  for (const double radius : {0.1, 0.2}) {
    for (const double sign : {1.0, -1.0}) {
      for (const bool own_mass : {true, false}) {
        for (const double rise_s : {0.003, 0.01, 0.03, 0.1}) {
          if (!tried(k++, kShares)) continue;
          Hand hand;
          hand.radius_m = radius;
          HandPhase hold;
          hold.kind = HandPhase::Kind::kLocked;
          hold.duration_s = 0.05;
          HandPhase carry = moves({}, 0.4);
          if (own_mass) carry.kind = HandPhase::Kind::kImpedance;
          carry.profile = gather(sign * 5.0, rise_s, 0.3);
          hand.phases = {hold, carry};
          Rig<Lever> rig(motor_of("p24"), hand);
          ask(rig, "setpoint", -sign * 0.5);
          count.add(watched(rig, 0.35));
        }
      }
    }
  }
}

/// Runs every scene that the core itself computes. Returns the number of scenes left out.
template <class D>
std::int64_t scenes(Count& count, const std::string& design) {
  std::int64_t left_out = 0;
  const std::filesystem::path folder = std::string(FELTGATE_ROOT) + "/vectors/scenes";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    // Scenes with several axes or with a law need an engine, those with three phases their legs.
    if (names_device(entry.path().string()) || !read_scenario(entry.path().string()).law.empty()) {
      ++left_out;
      continue;
    }
    Scenario scene = read_scenario(entry.path().string());
    const plant::Parameters motor = motor_of(scene.plant);
    if (motor.phases) {
      ++left_out;
      continue;
    }
    resolve_effects(scene, motor.effects);
    Watcher<D> w;
    RunOptions options;
    options.design = design;
    options.engine = "twin";
    options.row = [&w](const Row& r) { w.row(r); };
    run_scenario(scene, motor, options);
    count.add(w);
  }
  return left_out;
}

struct Recording {
  std::string file;
  traces::Options how;
};

std::filesystem::path place_of(const Recording& r) {
  const char* folder = std::getenv("FELTGATE_TRACES");
  return (folder != nullptr ? std::filesystem::path(folder)
                            : std::filesystem::path(FELTGATE_ROOT) / "../shared/traces") /
         r.file;
}

void render(Count& count, const Recording& r) {
  const auto source = traces::open(place_of(r), r.how);
  Watcher<Lever> w;
  ReplayOptions options;
  options.engine = "twin";
  options.row = [&w](const Row& r) { w.row(r); };
  run_replay(*source, r.file, options);
  count.add(w);
}

std::vector<Recording> recordings() {
  std::vector<Recording> all;
  const auto mouse = [&all](const std::string& file, const char* probes) {
    traces::Options how;
    how.probes = traces::split_names(probes);
    all.push_back({"sigrok-mouse/avago_adns_2051_" + file + ".sr", how});
  };
  mouse("move_mouse_fast", "YA,YB");
  mouse("move_mouse_fast", "XA,XB");
  mouse("move_mouse_up_down", "YA,YB");
  mouse("sleep_then_move", "YA,YB");
  mouse("remove_and_readd_usb", "XA,XB");
  mouse("remove_and_readd_usb", "YA,YB");
  traces::Options stepper;
  stepper.step = "5";
  stepper.dir = "6";
  all.push_back({"stepdir/smoothieware.sr", stepper});
  traces::Options qube;
  qube.time_column = "t";
  qube.count_column = "theta";
  qube.scale = 2048 / (2 * 3.14159265358979323846);
  all.push_back({"qube/qube_20230828T150615_434_696_394.csv", qube});
  return all;
}

/// A row of the table: the number of runs in which each limit tripped, and the longest travel to
/// the trip.
void print_row(const char* what, const Count& count) {
  std::printf("%s: %lld of %lld, %.2f rad\n", what, static_cast<long long>(count.trips),
              static_cast<long long>(count.runs), count.travel_rad);
}

void check_false(const char* what, const Count& count, std::int64_t at_least) {
  print_row(what, count);
  INFO(what);
  CHECK(count.runs >= at_least);
  CHECK(count.trips == 0);
}

bool all_of_it() { return std::getenv("FELTGATE_LONG") != nullptr; }

}  // namespace

TEST_CASE("runaway: the core's own check stops a swapped motor or encoder at 0.3 Nm and above") {
  for (const Wiring wiring : {Wiring::motor_swapped, Wiring::encoder_swapped}) {
    for (const double torque : {0.3, -0.3, 0.5, -0.5}) {
      Rig<Lever> rig(motor_of("p24"), Hand{}, wiring);
      rig.device.select("setpoint");
      rig.device.set("setpoint_torque", torque);
      rig.device.set("ramp_step", 1.0);
      for (int k = 0; k < 20; ++k) rig.tick();
      rig.device.arm();
      for (int k = 0; k < 40000 && rig.out().faults == 0; ++k) rig.tick();
      CHECK(rig.out().first_fault == static_cast<unsigned>(Fault::polarity));
      CHECK_FALSE(rig.out().gates_enable);
      CHECK(std::fabs(rig.lever().theta_rad) < 0.35);
    }
  }
}

TEST_CASE("runaway: a steady 65 rad/s on a damper is no wrong polarity") {
  Hand hand;
  hand.phases = {moves({ramp(65.0, 1.0)}, 1.0)};
  Rig<Lever> rig(motor_of("p24"), hand);
  rig.device.select("damper");
  for (int k = 0; k < 20; ++k) rig.tick();
  rig.device.arm();
  for (int k = 0; k < 500000; ++k) rig.tick();
  CHECK(rig.out().faults == 0);
  CHECK(rig.out().armed);
}

TEST_CASE("runaway: found against false") {
  SplitMix64 random(20);
  const int starts = all_of_it() ? 50 : whole_run() ? 8 : 1;
  Count lever, paper;
  for (const Wiring wiring : {Wiring::motor_swapped, Wiring::encoder_swapped}) {
    for (const double torque : {0.3, 0.35, 0.4, 0.5}) {
      for (int k = 0; k < starts; ++k) {
        run_away<Lever>(lever, torque, wiring, random);
        run_away<Paper>(paper, torque, wiring, random);
      }
    }
  }
  print_row("lever: found", lever);
  print_row("paper: found", paper);
  for (const Count* f : {&lever, &paper}) {
    CHECK(f->runs == 8 * starts);
    CHECK(f->trips == f->runs);
    CHECK(f->travel_rad < 0.35);
  }
  Count of_dampers, of_stops, of_hands;
  fast_dampers(of_dampers);
  rebounds(of_stops);
  hands(of_hands);
  const auto tried_of = [](std::int64_t runs) {
    return whole_run() ? runs : runs / static_cast<std::int64_t>(kShares);
  };
  check_false("dampers", of_dampers, tried_of(20));
  check_false("end stops", of_stops, tried_of(180));
  check_false("hands", of_hands, tried_of(32));
}

TEST_CASE("runaway: no shipped scene of the core itself is taken for one", "[.scenes]") {
  Count count;
  const std::int64_t left_out = scenes<Lever>(count, "lever") + scenes<Paper>(count, "paper");
  check_false("scenes", count, 28);
  std::printf("left out: %lld scenes with a law or a device of its own, which need an engine\n",
              static_cast<long long>(left_out / 2));
}

TEST_CASE("runaway: no recording is taken for one", "[.recordings]") {
  const std::vector<Recording> all = recordings();
  for (const Recording& r : all) {
    if (std::filesystem::exists(place_of(r))) continue;
    std::printf("SKIPPED: %s is not there; see docs/traces.md for where to get it\n",
                place_of(r).c_str());
    return;
  }
  Count count;
  for (const Recording& r : all) render(count, r);
  check_false("recordings", count, 8);
}
