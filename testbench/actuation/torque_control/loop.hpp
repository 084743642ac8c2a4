// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// torque_control and dob in a closed loop with a blocked lever, and torque_control against quad
// precision. Documentation: docs/blocks/torque_control.md
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "feltgate/dob.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/words.hpp"
#include "wave_bus.hpp"

namespace feltgate::test {

inline std::int64_t torque_raw(double newton_metres) {
  return std::llround(std::ldexp(newton_metres, 16));
}

/// tick() with the interface of RtlAlone.
struct TwinAlone {
  Step step;
  Control::Out run(const Wave& w) {
    tick(step, w);
    Control::Out out;
    out.current_ref = step.current.raw();
    out.voltage = step.voltage.raw();
    out.duty = step.duty.raw();
    return out;
  }
};

/// A common mistake: the observer gets the current before its limit.
struct Unlimited {
  TwinAlone twin, without;
  Control::Out run(const Wave& w) {
    Control::Out out = twin.run(w);
    Wave free = w;
    free.words.set(A::current_limit, Current::max_raw());
    out.current_ref = without.run(free).current_ref;
    return out;
  }
};

/// A blocked lever: the observer gets the current of the tick before; the control gets tau_hat of
/// the observer.
template <class Driven>
class Loop {
 public:
  /// tau_hat in Nm after each tick.
  std::vector<double> run(Wave w, int ticks) {
    std::vector<double> tau_hat;
    for (int k = 0; k < ticks; ++k) {
      observer_.tick(words_, w.armed, Current::from_raw(out_.current_ref), Velocity{});
      w.tau_hat = observer_.tau_hat.raw();
      tau_hat.push_back(observer_.tau_hat.to_double());
      out_ = driven_.run(w);
    }
    return tau_hat;
  }
  std::int64_t current() const { return out_.current_ref; }
  std::int64_t voltage() const { return out_.voltage; }

 private:
  Driven driven_;
  feltgate::Words<Design, Fixed> words_;
  ObserverStep<Design, Fixed> observer_;
  Control::Out out_;
};

/// Exact parameters for the law in quad precision; the voltage set-point is an input, not a gain.
struct ExactWords : ParameterReader<Design, ExactWords> {
  explicit ExactWords(const Words& words)
      : setpoint(static_cast<quad>(words.at(A::voltage_setpoint)) * lsb(14)) {}
  template <int Key>
  quad get(int address) const {
    return address == A::voltage_setpoint ? setpoint : static_cast<quad>(parameter(address).si);
  }
  quad setpoint;
};

/// Largest errors of a tick against quad precision, in LSB of 2^-16 A, of 2^-14 V and of a clock,
/// and the largest bounds that hold for them.
struct Worst {
  double current = 0, current_bound = 0, voltage = 0, voltage_bound = 0, duty = 0, duty_bound = 0;

  /// Compares one wave. Returns the name of the bound that does not hold, or nullptr.
  const char* add(const Wave& w) {
    Step fixed;
    TorqueControlStep<Design, Real<quad>> real;
    if (w.mode == Mode::voltage) {  // the tick before has set the voltage to the set-point
      fixed.voltage = Voltage::from_raw(w.words.at(A::voltage_setpoint));
      real.voltage = static_cast<quad>(w.words.at(A::voltage_setpoint)) * lsb(14);
    }
    tick(fixed, w);
    const quad tau_ref = exact(Torque::from_raw(w.tau_ref));
    const quad tau_hat = exact(Torque::from_raw(w.tau_hat));
    const quad omega = exact(Velocity::from_raw(w.velocity));
    const ExactWords words(w.words);
    real.tick(words, w.armed, w.mode, tau_ref, tau_hat, omega);

    const auto off = [](int address) { return coefficient_error(parameter(address)); };
    const quad ampere = lsb(16), volt = lsb(14);
    const bool direct = w.mode == Mode::voltage;
    // A truncated product has an error of less than one LSB; a limit has only the error of its
    // quantisation.
    quad i = direct ? off(A::voltage_to_current) * magnitude(words.setpoint) + ampere
                    : off(A::torque_gain) * magnitude(tau_ref) +
                          off(A::observer_gain) * magnitude(tau_hat) + 2 * ampere;
    i = std::max(i, off(A::current_limit));
    const int gain = real.region_high ? A::voltage_gain_high : A::voltage_gain;
    const quad dead =
        std::max(off(A::dead_voltage_slope) * magnitude(tau_ref) + volt, off(A::dead_voltage));
    quad v = direct
                 ? quad{0}
                 : static_cast<quad>(parameter(gain).si) * i + off(gain) * magnitude(real.current) +
                       volt + off(A::emf_constant) * magnitude(omega) + volt + dead;
    // At the end of the window the errors are those of the window and of the back-EMF at its
    // centre.
    v = std::max(v, off(A::voltage_window) + off(A::emf_constant) * magnitude(omega) + volt);
    const quad d = static_cast<quad>(parameter(A::duty_gain).si) * v +
                   off(A::duty_gain) * magnitude(real.applied) + quad{0.5};

    const bool holds =
        raise(&current, &current_bound, exact(fixed.current) - real.current, i, ampere) &&
        raise(&voltage, &voltage_bound, exact(fixed.applied) - real.applied, v, volt) &&
        raise(&duty, &duty_bound, exact(fixed.duty) - real.duty, d, 1);
    if (fixed.region_high != real.region_high) return "region";
    return holds ? nullptr : "error above its bound";
  }

 private:
  static bool raise(double* worst, double* largest, quad error, quad bound, quad unit) {
    *worst = larger(*worst, static_cast<double>(magnitude(error) / unit));
    *largest = larger(*largest, static_cast<double>(bound / unit));
    return magnitude(error) <= bound;
  }
};

}  // namespace feltgate::test
