// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The interactive closed loop of the page. Documentation: docs/page.md
#include "apps/page/live_loop.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/backends/fnv1a.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/drive.hpp"

namespace feltgate::page {

namespace {

constexpr double low_supply = 0.35;  ///< share of the supply that remains with Break::supply_low

/// Assumed: a finger that leans on the lever and leaves its swing alone.
constexpr plant::Impedance fingertip{0.01, 0.3, 135.0, 3000.0, 10.0};

/// Steps short enough for the plant held by a hand.
StepPlan plan_for(const plant::Parameters& plant, const DesignInfo& d) {
  plant::HandPhase held, light;
  held.kind = light.kind = plant::HandPhase::Kind::kImpedance;
  light.impedance = fingertip;
  plant::Hand hand;
  hand.phases = {held, light};
  return {scene_of(plant, hand), plant, d};
}

template <auto Member>
std::int64_t number(const Snapshot& s) {
  return static_cast<std::int64_t>(s.*Member);
}
template <auto Member>
int fraction(const DesignInfo& d) {
  return (d.*Member).fraction;
}
template <int bits>
int fixed(const DesignInfo& /*any*/) {
  return bits;
}

}  // namespace

const std::array<Word, 14> snapshot_words{{
    {"tick", "", number<&Snapshot::tick>, fixed<0>},
    {"position", "counts", number<&Snapshot::position>, fixed<0>},
    {"velocity", "rad/s", number<&Snapshot::velocity>, fraction<&DesignInfo::velocity>},
    {"tau_hat", "Nm", number<&Snapshot::tau_hat>, fraction<&DesignInfo::torque>},
    {"tau_ref", "Nm", number<&Snapshot::tau_ref>, fraction<&DesignInfo::torque>},
    {"current_ref", "A", number<&Snapshot::current_ref>, fraction<&DesignInfo::current>},
    {"voltage", "V", number<&Snapshot::voltage>, fraction<&DesignInfo::voltage>},
    {"duty", "clocks", number<&Snapshot::duty>, fixed<0>},
    {"current", "of full scale", number<&Snapshot::current>, fixed<17>},
    {"scene", "", number<&Snapshot::scene>, fixed<0>},
    {"limits", "", number<&Snapshot::limits>, fixed<0>},
    {"faults", "", number<&Snapshot::faults>, fixed<0>},
    {"first_fault", "", number<&Snapshot::first_fault>, fixed<0>},
    {"armed", "", number<&Snapshot::armed>, fixed<0>},
}};

LiveLoop::LiveLoop(const std::string& design, const plant::Parameters& plant)
    : plant_(plant, plant.effects, plant::drive_of(design_named(design)), plant::Hand{}),
      core_(design, BackendChoice{"twin", {"double"}, false}, 1, plant_.encoder().pins(),
            Waveform{}),
      clock_hz_(static_cast<double>(core_.design().clock_hz)),
      plan_(plan_for(plant, core_.design())),
      mean_(core_.design().pwm_period, plan_.phase()),
      motor_(core_.design(), plant.motor.torque_constant_nm_a),
      limit_nm_(motor_.limit_nm()),
      hand_nm_rad_(plant::Impedance{}.stiffness_n_m * plant.lever.radius_m * plant.lever.radius_m),
      pins_(plant_.encoder().pins()) {
  core_.skip_self_test();
  control();
}

void LiveLoop::control() {
  // A host's wall is a set-point that is written again and again.
  const bool by_host = scene_ == "wall" && host_ticks_ > 1;
  const bool let_go = scene_ == "setpoint" && !held();
  const std::string scene = by_host ? "setpoint" : let_go ? "free" : scene_;
  core_.set_control(design().scene_number(scene), 0, armed_);
}

void LiveLoop::select(const std::string& scene) {
  if (design().scene_number(scene) < 0) {
    throw std::invalid_argument(design().unknown_scene(scene));
  }
  scene_ = scene;
  control();
}

void LiveLoop::set(const std::string& parameter, double value) {
  core_.set_parameter(parameter, value);
}

void LiveLoop::run_law(std::unique_ptr<SceneLaw> law) {
  law_ = std::move(law);
  core_.run_law(*law_);
}

void LiveLoop::arm(bool wanted) {
  armed_ = wanted;
  control();
}

void LiveLoop::clear_faults() {
  arm(false);
  core_.command(1u << design().command.clear_faults);
}

void LiveLoop::stop(bool pressed) {
  core_.lead().stop(pressed);
  plan_.stir(core_.lead().now(), 2 * design().clocks_per_tick);
}

void LiveLoop::host_wall(int ticks, double contact_rad, double stiffness_nm_rad,
                         double damping_nm_s_rad) {
  const bool by_host = ticks > 1, was = host_ticks_ > 1;
  host_ticks_ = std::max(1, ticks);
  contact_rad_ = contact_rad;
  stiffness_nm_rad_ = stiffness_nm_rad;
  damping_nm_s_rad_ = damping_nm_s_rad;
  if (by_host == was) return;
  core_.set_parameter("setpoint_torque", 0);
  control();
}

void LiveLoop::hold(Grip grip) {
  if (grip == grip_) return;
  grip_ = grip;
  plant::HandPhase phase;
  phase.kind = held() ? plant::HandPhase::Kind::kImpedance : plant::HandPhase::Kind::kFree;
  if (grip == Grip::fingertip) phase.impedance = fingertip;
  plant_.take(phase);
  hand_rad_ = wanted_rad_ = plant_.observables().theta_rad;
  control();
  plan_.stir(core_.lead().now(), 2 * design().clocks_per_tick);
}

void LiveLoop::spare_motor() {
  const double limit = motor_.limit_nm();
  if (limit == limit_nm_) return;
  core_.set_parameter(WarmMotor::limit, limit);
  limit_nm_ = limit;
}

double LiveLoop::within_reach(double wanted_rad) const {
  if (grip_ == Grip::strong) return wanted_rad;
  const double at_rad = plant_.observables().theta_rad, reach_rad = gentle_nm() / hand_nm_rad_;
  return std::clamp(wanted_rad, at_rad - reach_rad, at_rad + reach_rad);
}

void LiveLoop::advance(std::int64_t ticks, int every) {
  samples_.clear();
  every_ = std::max(1, every);
  const Clock begin = core_.lead().now();
  const Clock end = begin + ticks * design().clocks_per_tick;
  const double span_s = static_cast<double>(end - begin) / clock_hz_;
  const double target_rad = held() ? within_reach(wanted_rad_) : hand_rad_;
  const double rate = span_s > 0 ? (target_rad - hand_rad_) / span_s : 0;
  spare_motor();
  bool steered = false;
  while (core_.lead().now() < end) {
    const Clock now = core_.lead().now();
    if (core_.writes_wait()) plan_.stir(now, 2 * design().clocks_per_tick);
    step(plan_.end_of_step(now, end, end) - now);
    if (!steered && held()) {  // the phase of a hand begins with a step
      const double passed_s = static_cast<double>(core_.lead().now() - begin) / clock_hz_;
      plant_.steer(hand_rad_ + rate * passed_s, rate);
      steered = true;
    }
  }
  hand_rad_ = target_rad;
}

const std::vector<EncoderEvent>& LiveLoop::through_the_wires(
    const std::vector<EncoderEvent>& events) {
  const bool dead = broken_ == Break::channel_dead, swapped = broken_ == Break::encoder_swapped;
  if (!dead) dead_level_ = pins_.a;
  if (!dead && !swapped && events.empty()) return events;
  wired_ = events;
  for (EncoderEvent& e : wired_) {
    if (swapped) std::swap(e.pins.a, e.pins.b);
    if (dead) e.pins.a = dead_level_;
  }
  if (!wired_.empty()) pins_ = wired_.back().pins;
  return wired_;
}

void LiveLoop::step(Clock clocks) {
  double duty = static_cast<double>(core_.lead().duty()) / design().pwm_period;
  if (broken_ == Break::motor_swapped) duty = -duty;
  if (broken_ == Break::supply_low) duty *= low_supply;
  plant_.advance(plant::Bridge::averaged(duty, core_.lead().gates_enabled()), clocks);
  mean_.add(clocks, plant_.observables().motor_torque_mean_nm);
  const auto& events = through_the_wires(plant_.events());
  core_.advance(clocks, events.data(), events.data() + events.size(),
                [this](const Snapshot& s) { tick(s); });
}

/// The action of a host that reads a snapshot, computes the wall and writes its torque.
void LiveLoop::host(const Snapshot& s) {
  const double depth_rad = s.position * design().count_rad - contact_rad_;
  double torque_nm = 0;
  if (depth_rad > 0) {
    torque_nm = -stiffness_nm_rad_ * depth_rad - damping_nm_s_rad_ * core_.velocity_rad_s(s);
  }
  const ValueRange range = range_of(*design().find("setpoint_torque"));
  core_.set_parameter("setpoint_torque",
                      std::clamp(std::min(torque_nm, 0.0), range.low, range.high));
}

void LiveLoop::tick(const Snapshot& s) {
  last_ = s;
  motor_.pass(s.voltage, s.velocity);
  if (s.faults != 0 && armed_) arm(false);  // as a panel does: nothing arms again by itself
  if (host_ticks_ > 1 && scene_ == "wall" && ticks_ % host_ticks_ == 0) host(s);
  const double float_nm = core_.rider(0)->out().tau_hat_nm;
  if (ticks_++ % every_ != 0) return;
  const plant::Observables& o = plant_.observables();
  samples_.push_back({static_cast<double>(ticks_) / static_cast<double>(design().tick_hz),
                      o.theta_rad, held() ? hand_rad_ : o.theta_rad, core_.torque_nm(s.tau_ref),
                      core_.torque_nm(s.tau_hat), mean_.mean(), o.hand_torque_nm,
                      core_.velocity_rad_s(s), float_nm, s.position * design().count_rad});
}

std::uint64_t hash_of(const std::string& design, const RunInputs& inputs) {
  Fnv1a hash;
  const auto twin = make_backend(design, "twin");
  twin->reset(1, inputs.pins);
  std::size_t edge = 0, write = 0;
  while (twin->now() < inputs.clocks) {
    const Clock now = twin->now();
    while (write < inputs.writes.size() && inputs.writes[write].clock <= now) {
      twin->write(inputs.writes[write].address, inputs.writes[write].data);
      ++write;
    }
    Clock until = std::min(inputs.clocks, now + twin->design().pwm_period);
    if (write < inputs.writes.size()) until = std::min(until, inputs.writes[write].clock);
    std::size_t last = edge;
    while (last < inputs.edges.size() && inputs.edges[last].clock < until) ++last;
    twin->advance(until - now, inputs.edges.data() + edge, inputs.edges.data() + last);
    edge = last;
    for (const Snapshot& s : twin->snapshots()) {
      for (const Word& word : snapshot_words) hash.add(word.value(s));
    }
  }
  return hash.value();
}

}  // namespace feltgate::page
