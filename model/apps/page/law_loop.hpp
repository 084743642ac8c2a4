// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A body in a hand that the mouse leads, pushed by the words of a law: no core, no motor, no dry
// friction. One loop for every device of the page; a Body says what its joints are and where it can
// be. Documentation: docs/page.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/page/image_law.hpp"
#include "sim/axes_loop/plane_host.hpp"
#include "sim/plant/hand.hpp"
#include "sim/plant/rotation.hpp"
#include "studies/shape/rhombus.hpp"

namespace feltgate::page {

/// An event of a law: its value in SI, and the time of the run that told it.
struct Told {
  std::string name;
  double value = 0, time_s = 0;
};

template <class Body>
class LawLoop : public Body {
 public:
  using Place = typename Body::Place;
  using Rate = typename Body::Rate;  ///< a vector: of speeds, and of forces

  /// Throws std::invalid_argument for a broken image, as load() does.
  explicit LawLoop(const std::string& image, Body body = {}) : Body(std::move(body)) {
    load(image);
    place(Body::start());
  }
  /// Replaces the law; body and hand stay.
  void load(const std::string& image) { law_ = std::make_unique<ImageLaw>(image); }
  /// Sets a parameter or a word of a mailbox. Throws std::invalid_argument.
  void set(const std::string& parameter, double value) { law_->set(parameter, value); }
  /// Body and hand rest here.
  void place(const Place& at) {
    rest_hand(Body::within(at));
    at_ = hand_;
    speed_ = force_ = {};
  }
  /// The hand rests here.
  void rest_hand(const Place& at) { hand_ = wanted_ = at; }
  /// The place to which the hand moves at constant speed during the next advance(), or the nearest
  /// that it reaches; one that is not finite is ignored.
  void lead(const Place& to) {
    if (Body::finite(to)) wanted_ = Body::within(to);
  }
  std::optional<StateWord> watched;  ///< a state whose value in each run of an advance() is kept
  /// Runs the law as often as it fits in the time; the remainder is added to the next call.
  void advance(double seconds) {
    told_.clear();
    seen_.clear();
    const double dt = law_->period_s();
    owed_s_ += seconds;
    const int runs = static_cast<int>(owed_s_ / dt);
    if (runs < 1) return;
    owed_s_ -= runs * dt;
    const Rate led = 1 / (runs * dt) * Body::gap(wanted_, hand_);
    mean_ = {};
    for (int n = 0; n < runs; ++n) {
      step(dt, Body::hand_rate(led, hand_, dt));
      mean_ = mean_ + 1.0 / runs * force_;
    }
    if (Body::is_led()) hand_ = wanted_;
  }

  const Place& at() const { return at_; }
  const Rate& speed() const { return speed_; }
  const Place& hand() const { return hand_; }
  const Place& wanted() const { return wanted_; }
  /// Of the law, in the last run, and the mean of the last advance(), which a hand feels.
  const Rate& force() const { return force_; }
  const Rate& mean_force() const { return mean_; }
  double time_s() const { return time_s_; }
  const ImageLaw& law() const { return *law_; }
  /// Of the last advance(): the law's events, in order, and the values of the watched state.
  const std::vector<Told>& told() const { return told_; }
  const std::vector<float>& seen() const { return seen_; }

 private:
  void step(double dt, const Rate& hand_rate) {
    Body::sense(*law_, at_, speed_);
    law_->run();
    note();
    force_ = Body::force(*law_, at_);
    hand_ = Body::moved(hand_, dt * hand_rate);
    const plant::Impedance& grip = Body::grip;
    const Rate held =
        grip.stiffness_n_m * Body::gap(hand_, at_) + grip.damping_ns_m * (hand_rate - speed_);
    speed_ = speed_ + dt * Body::acceleration(held, force_, at_, speed_);
    at_ = Body::moved(at_, dt * speed_);
    Body::stop(at_, speed_);
    time_s_ += dt;
  }
  void note() {
    if (watched) seen_.push_back(static_cast<float>(law_->state(*watched)));
    for (const law::MachineEvent& e : law_->events()) {
      for (const law::ImageEvent& named : law_->event_names()) {
        if (named.number == e.number) told_.push_back({named.name, named.scale * e.value, time_s_});
      }
    }
  }

  std::unique_ptr<ImageLaw> law_;
  Place at_{}, hand_{}, wanted_{};
  Rate speed_{}, force_{}, mean_{};
  double time_s_ = 0, owed_s_ = 0;
  std::vector<Told> told_;
  std::vector<float> seen_;
};

/// What most bodies have in common: places that are vectors, without an end.
template <class P, class R = P>
struct PlainBody {
  using Place = P;
  using Rate = R;
  static constexpr double radius_m = 0.1;

  plant::Impedance grip;            ///< of the hand; its mass moves with the body
  double own_kg = 0, own_ns_m = 0;  ///< mass and viscous friction of the body itself

  /// The hand at a radius, in angles.
  static plant::Impedance in_angles() {
    plant::Impedance i;
    for (double* of : {&i.stiffness_n_m, &i.damping_ns_m, &i.mass_kg}) *of *= radius_m * radius_m;
    return i;
  }
  static P start() { return {}; }
  static P within(const P& p) { return p; }
  static R gap(const P& to, const P& from) { return to - from; }
  static P moved(const P& at, const R& by) { return at + by; }
  /// The body's place and speed where it is stopped by an end.
  static void stop(P&, R&) {}
  /// The hand's rate in a run, and whether lead() moves it.
  static R hand_rate(const R& led, const P&, double) { return led; }
  static bool is_led() { return true; }
  R acceleration(const R& held, const R& pushed, const P&, const R& speed) const {
    return 1 / (grip.mass_kg + own_kg) * (held - own_ns_m * speed + pushed);
  }
};

/// A lever that a hand leads to `most_rad` at most, either way, or a hand that draws it to and fro.
struct Lever : PlainBody<double> {
  static constexpr double turn_rad = 0.9;  ///< where a hand that draws it turns around
  double begins_rad, most_rad, drawn_rad_s = 0;
  Lever(double begins, double most) : begins_rad(begins), most_rad(most) { grip = in_angles(); }
  static Lever stick() { return {0.3, 0.6}; }
  static Lever bow() { return {0, 1}; }
  double start() const { return begins_rad; }
  double within(double rad) const { return std::clamp(rad, -most_rad, most_rad); }
  static bool finite(double rad) { return std::isfinite(rad); }
  bool is_led() const { return drawn_rad_s == 0; }
  double hand_rate(double led, double hand, double dt) {
    if (is_led()) return led;
    const double ahead = hand + drawn_rad_s * dt;
    // Only away from the middle, so that a hand from beyond the turn comes back.
    if (std::fabs(ahead) > turn_rad && ahead * drawn_rad_s > 0) drawn_rad_s = -drawn_rad_s;
    return drawn_rad_s;
  }
  static void sense(ImageLaw& law, double rad, double rad_s) { law.joint(0, rad, rad_s); }
  static double force(const ImageLaw& law, double) { return law.torque_nm(0); }
};
using LeverLoop = LawLoop<Lever>;

/// Draws a bow by itself: the hand moves to and fro so that the bow has this speed, m/s. With 0 or
/// NaN, lead() moves the hand again, from its present angle.
inline void draw(LeverLoop& bow, double bow_m_s) {
  const double rad_s = std::isfinite(bow_m_s) ? std::fabs(bow_m_s) / bow.law().value("reach") : 0;
  if (rad_s == 0 && !bow.is_led()) bow.rest_hand(bow.hand());
  bow.drawn_rad_s = std::copysign(rad_s, bow.drawn_rad_s);
}

/// The object that the second of two levers meets: a spring from 0 rad on, the same from
/// TwoLevers::wall_rad on, a torque towards lower angles.
enum class Met { nothing, spring, wall, weight };

/// Two levers that only a law couples: x is of the first, y of the second, which can meet an
/// object.
struct TwoLevers : PlainBody<shape::Point> {
  static constexpr double most_rad = 1.0;  ///< that the hand is led to, either way
  static constexpr double wall_rad = 0.3;
  /// What the law reads as tau_hat lags by a first-order filter of this time, as an observer does.
  static constexpr double observer_s = 2e-3;
  double inertia_kg_m2, met_nm = 0, period_s = 0;
  Met met = Met::nothing;
  double strength = 0;          ///< of the object: Nm/rad, of a weight Nm
  bool second_is_held = false;  ///< by the hand; else the first
  Rate observed_nm{};
  explicit TwoLevers(double inertia) : inertia_kg_m2(inertia) { grip = in_angles(); }
  static bool finite(Place rad) { return std::isfinite(rad.x + rad.y); }
  static Place within(Place rad) {
    return {std::clamp(rad.x, -most_rad, most_rad), std::clamp(rad.y, -most_rad, most_rad)};
  }
  void sense(ImageLaw& law, Place rad, Rate rad_s) {
    period_s = law.period_s();
    law.joint(0, rad.x, rad_s.x, observed_nm.x);
    law.joint(1, rad.y, rad_s.y, observed_nm.y);
  }
  static Rate force(const ImageLaw& law, Place) { return {law.torque_nm(0), law.torque_nm(1)}; }
  Rate acceleration(Rate hand_nm, Rate pushed, Place rad, Rate) {
    met_nm = met == Met::spring   ? -strength * rad.y
             : met == Met::wall   ? -strength * std::max(rad.y - wall_rad, 0.0)
             : met == Met::weight ? -strength
                                  : 0;
    const double j = inertia_kg_m2, with_hand = j + grip.mass_kg;
    const Rate rad_s2{
        (pushed.x + (second_is_held ? 0 : hand_nm.x)) / (second_is_held ? j : with_hand),
        (pushed.y + met_nm + (second_is_held ? hand_nm.y : 0)) / (second_is_held ? with_hand : j)};
    // The motor's torque less what the lever's own inertia takes: what it gives to the world.
    observed_nm =
        observed_nm + std::min(1.0, period_s / observer_s) * (pushed - j * rad_s2 - observed_nm);
    return rad_s2;
  }
};
using CoupledLoop = LawLoop<TwoLevers>;
/// The hand holds this lever from now on, where that is.
inline void hold(CoupledLoop& levers, bool second) {
  if (second != levers.second_is_held) levers.rest_hand(levers.at());
  levers.second_is_held = second;
}

/// The pen of the pantograph.
struct Pen : PlainBody<shape::Point> {
  /// Its reach: smallest and largest distance from the motors, smallest distance in front of them.
  static constexpr double nearest_m = 0.04, farthest_m = 0.19, front_m = 0.02;
  static Place start() { return {0, 0.06}; }
  static bool finite(Place p) { return std::isfinite(p.x) && std::isfinite(p.y); }
  static Place within(Place p) {
    p.y = std::fmax(p.y, front_m);
    const double r = std::hypot(p.x, p.y);
    p = p * (std::fmin(std::fmax(r, nearest_m), farthest_m) / r);
    if (p.y >= front_m) return p;
    // Drawn in from far beside the motors.
    return {std::copysign(std::sqrt(farthest_m * farthest_m - front_m * front_m), p.x), front_m};
  }
  static void stop(Place& at, Rate& speed) {
    const Place inside = within(at);
    if (std::hypot(at.x - inside.x, at.y - inside.y) > 1e-12) speed = {};
    at = inside;
  }
  static void sense(ImageLaw& law, Place at, Rate speed) {
    const auto angle = shape::cranks(at), rate = shape::crank_speeds(at, speed);
    law.joint(0, angle[0], rate[0]);
    law.joint(1, angle[1], rate[1]);
  }
  static Rate force(const ImageLaw& law, Place at) {
    return shape::force_at(at, {law.torque_nm(0), law.torque_nm(1)});
  }
};
using PenLoop = LawLoop<Pen>;

/// A pen on three slides; a host knows the world and sends nearest planes to the law.
struct Stylus : PlainBody<plant::Vec3> {
  static constexpr double most_n = 3.3;   ///< largest force per axis, vectors/devices/stylus.toml
  static constexpr double reach_m = 0.1;  ///< along each axis, to both sides
  double capstan_m = 0;                   ///< radius: force = torque / radius
  std::optional<PlaneHost> host;
  Clock host_runs = 0;                 ///< the clock of the host: runs since touch()
  std::map<std::string, double> sent;  ///< values of the plane in the mailbox
  bool limited = false;                ///< whether the law asked for more than most_n
  static Place start() { return {0, 0, 0.05}; }
  static bool finite(Place p) { return std::isfinite(p.x + p.y + p.z); }
  static Place limited_to(double most, Place p) {
    for (double* part : {&p.x, &p.y, &p.z}) *part = std::clamp(*part, -most, most);
    return p;
  }
  static Place within(Place p) { return limited_to(reach_m, p); }
  static void stop(Place& at, Rate& speed) {
    const Place inside = within(at);
    if (at.x != inside.x) speed.x = 0;
    if (at.y != inside.y) speed.y = 0;
    if (at.z != inside.z) speed.z = 0;
    at = inside;
  }
  void sense(ImageLaw& law, Place at, Rate speed) {
    law.joints(1 / capstan_m * at, 1 / capstan_m * speed);
    if (host && host_runs >= host->next()) {
      // The host knows the pen where the cores count it.
      const Place counted{law.counted_rad(0), law.counted_rad(1), law.counted_rad(2)};
      auto words = host->act(host_runs, capstan_m * counted);
      // The same plane once more changes nothing, and costs as much as a run of the law.
      if (!words.empty() && words != sent) law.set(sent = std::move(words));
    }
    ++host_runs;
  }
  Rate force(const ImageLaw& law, Place) {
    const Rate asked = 1 / capstan_m * law.torques_nm();
    const Rate given = limited_to(most_n, asked);
    limited = plant::length(asked - given) > 0;
    return given;
  }
};
class StylusLoop : public LawLoop<Stylus> {
 public:
  using LawLoop::LawLoop;  // in an empty world
  /// Changes the host's world, material, rate or age from the next run on. The previous plane holds
  /// until the first new one arrives.
  void touch(const PlaneHostSettings& world) {
    world_ = world;
    host.emplace(world, std::llround(1 / law().period_s()));
    host_runs = 0;
    sent.clear();
  }
  /// Depth of the pen below the world's surface, m; negative outside; 0 without a world.
  double depth_m() const {
    const Plane p = nearest_plane(world_, at());
    return host ? plant::dot(p.normal, p.point_m - at()) : 0;
  }
  /// The plane that arrived last; nothing if none has arrived.
  std::optional<Plane> plane() const { return host ? host->plane() : std::nullopt; }
  /// Angle between the normal that arrived last and the world's normal at the pen, and age of the
  /// pose of that plane: at the end of the last advance(), 0 if no plane has arrived.
  double tilt_rad() const { return told_by_host()[3]; }
  double age_s() const { return told_by_host()[4]; }

 private:
  /// As the rows of a native run have it: normal, tilt, age, step.
  std::vector<double> told_by_host() const {
    if (!host) return std::vector<double>(6);
    PlaneHost told = *host;  // a copy, because add() notes what it told
    std::vector<double> row;
    told.add(host_runs, at(), row);
    return row;
  }
  PlaneHostSettings world_;
};

/// A handle that turns about three axes, in front of the body of the law rigid_body.
struct Handle : PlainBody<plant::Quaternion, plant::Vec3> {
  static constexpr double host_hz = 1000;  ///< at which a host sends the handle's orientation
  std::array<StateWord, 4> body;           ///< the states of its quaternion: w, x, y, z
  int runs = 0;                            ///< until the host sends again
  explicit Handle(const std::array<StateWord, 4>& words) : body(words) { grip = in_angles(); }
  static bool finite(const Place& q) { return std::isfinite(q.w + q.x + q.y + q.z); }
  static Rate gap(const Place& to, const Place& from) { return plant::coupling_nm(1, to, from); }
  static Place moved(const Place& q, Rate rad) {
    const double angle = plant::length(rad);
    if (angle == 0) return q;
    const Place next = Place::about(1 / angle * rad, angle) * q;
    const double size = std::hypot(next.w, plant::length(next.vector()));
    return {next.w / size, next.x / size, next.y / size, next.z / size};
  }
  void sense(ImageLaw& law, const Place& at, Rate speed) {
    if (runs-- <= 0) {
      runs = static_cast<int>(std::lround(1 / (host_hz * law.period_s()))) - 1;
      law.set({{"ow", at.w}, {"ox", at.x}, {"oy", at.y}, {"oz", at.z}});
    }
    // The law reads how fast the axes turn, and no angle.
    law.joints({}, speed);
  }
  static Rate force(const ImageLaw& law, const Place&) { return law.torques_nm(); }
};
using GimbalLoop = LawLoop<Handle>;
/// The hand turns by this vector, rad, about the axes of the base, during the next advance().
inline void turn(GimbalLoop& loop, plant::Vec3 rad) {
  loop.lead(Handle::moved(loop.wanted(), rad));
}
inline plant::Quaternion body_of(const GimbalLoop& loop) {
  const auto part = [&](std::size_t n) { return loop.law().state(loop.body[n]); };
  return {part(0), part(1), part(2), part(3)};
}
/// Angle between handle and body, the shorter way.
inline double twist_rad(const GimbalLoop& loop) {
  return 2 * std::acos(std::min(1.0, std::abs((body_of(loop) * loop.at().inverse()).w)));
}

}  // namespace feltgate::page
