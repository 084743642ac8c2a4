// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A body in a hand that the mouse leads, pushed by the words of a law: no core, no motor, no dry
// friction. One loop for every device of the page; a Body says what its joints are and where it can
// be. Documentation: docs/page.md
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "apps/page/image_law.hpp"
#include "apps/page/pace.hpp"
#include "sim/plant/hand.hpp"

namespace feltgate::page {

/// What most bodies have in common: places that are vectors, without an end.
template <class P, class R = P>
struct PlainBody {
  using Place = P;
  using Rate = R;  ///< a vector: of speeds, and of forces
  static constexpr double radius_m = 0.1;

  plant::Impedance grip;  ///< of the hand; its mass moves with the body

  /// The same at a radius, in angles.
  static plant::Impedance in_angles() {
    plant::Impedance i;
    for (double* of : {&i.stiffness_n_m, &i.damping_ns_m, &i.mass_kg}) *of *= radius_m * radius_m;
    return i;
  }
  static P start() { return {}; }
  /// Whether a hand can be led there; the nearest place to which it goes.
  static bool finite(const P&) { return true; }
  static P within(const P& p) { return p; }
  static R gap(const P& to, const P& from) { return to - from; }
  static P moved(const P& at, const R& by) { return at + by; }
  /// The body's place and speed where it is stopped by an end.
  static void stop(P&, R&) {}
  /// The hand's way in an advance(), its rate in a run, and where it is after the last of them.
  R way(const P& wanted, const P& hand) const { return wanted - hand; }
  static R hand_rate(const R& led, const P&, double) { return led; }
  static void arrive(P& hand, const P& wanted) { hand = wanted; }
  /// Before the first run of an advance(), and after each run of the law.
  static void begin() {}
  static void note(const ImageLaw&, double) {}
  R acceleration(const R& held, const R& pushed, const P&, const R&) const {
    return 1 / grip.mass_kg * (held + pushed);
  }
};

template <class Body>
class LawLoop : protected Body {
 public:
  using Place = typename Body::Place;
  using Rate = typename Body::Rate;

  explicit LawLoop(std::unique_ptr<ImageLaw> law, Body body = {})
      : Body(std::move(body)), law_(std::move(law)) {
    place(Body::start());
  }

  /// Sets a parameter or a word of a mailbox. Throws std::invalid_argument.
  void set(const std::string& parameter, double value) { law_->set(parameter, value); }
  /// Body and hand rest here.
  void place(const Place& at) {
    at_ = hand_ = wanted_ = Body::within(at);
    speed_ = force_ = {};
  }
  /// The place to which the hand moves at constant speed during the next advance(), or the nearest
  /// that it reaches; one that is not finite is ignored.
  void lead(const Place& to) {
    if (Body::finite(to)) wanted_ = Body::within(to);
  }
  /// Runs the law as often as it fits in the time; the remainder is added to the next call.
  void advance(double seconds) {
    Body::begin();
    const double dt = law_->period_s();
    const int runs = pace_.runs(seconds, dt);
    if (runs < 1) return;
    const Rate led = 1 / (runs * dt) * Body::way(wanted_, hand_);
    mean_ = {};
    for (int n = 0; n < runs; ++n) {
      step(dt, Body::hand_rate(led, hand_, dt));
      mean_ = mean_ + 1.0 / runs * force_;
    }
    Body::arrive(hand_, wanted_);
  }

  const ImageLaw& law() const { return *law_; }
  double time_s() const { return time_s_; }

 protected:
  std::unique_ptr<ImageLaw> law_;
  Place at_{}, hand_{}, wanted_{};
  Rate speed_{};
  Rate force_{}, mean_{};  ///< of the law: in the last run, and the mean of the last advance()

 private:
  void step(double dt, const Rate& hand_rate) {
    Body::sense(*law_, at_, speed_);
    law_->run();
    Body::note(*law_, time_s_);
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

  double time_s_ = 0;
  Pace pace_;
};

}  // namespace feltgate::page
