// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The current loop of the blocks current_sense, current_control and pwm, bit by bit, around the
// winding that its gates switch clock by clock; what it does, beside closed forms.
// Documentation: docs/controllers.md
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "feltgate/current_control.hpp"
#include "feltgate/current_sense.hpp"
#include "feltgate/encoder_source.hpp"
#include "feltgate/pwm.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/sigma_delta.hpp"
#include "studies/controllers/controllers.hpp"

namespace feltgate::controllers {

constexpr double shunt_full_scale_a = 32;  ///< 320 mV over 10 mohm
constexpr double overcurrent_a = 24;

/// What varies. The gains are those of the bench's winding.
struct CurrentSetting {
  plant::Parameters plant;
  double bandwidth_hz = 2000;  ///< where the open loop crosses 1
  /// Whether what brushes and dead time take is fed forward, as the voltage law of the design does.
  bool feeds_lost = true;
  bool locked = true;  ///< else the lever is free
  /// In place of the modulator an ADC of 12 bits, ideal but for its LSB: samples a second. It
  /// converts one after the other, from the middle of each pulse on.
  double adc_hz = 0;
};

/// The loop of design `lever`, clock by clock.
class CurrentLoop {
 public:
  CurrentLoop(const Bench& bench, const CurrentSetting& setting);

  /// One clock with this reference.
  void clock(double reference_a);
  void run(Clock clocks, double reference_a) {
    while (clocks-- > 0) clock(reference_a);
  }
  void short_motor(double wiring_ohm, double wiring_h) { plant_.short_motor(wiring_ohm, wiring_h); }

  const plant::Observables& seen() const { return plant_.observables(); }
  const Pwm::Out& gates() const { return pwm_.out(); }
  bool gates_on() const;
  /// Mean current of the last PWM period, A, up to this clock.
  double period_mean_a() const { return sum_a_ / period(); }
  int period() const { return static_cast<int>(means_a_.size()); }  ///< of the PWM, clocks
  double clock_hz() const { return clock_hz_; }
  Clock clocks(double seconds) const;

 private:
  /// A clock of the ADC; true when the sample of the middle is there.
  bool convert();

  plant::Plant plant_;
  plant::SigmaDelta modulator_{shunt_full_scale_a};
  CurrentSense sense_;
  CurrentSense::In sense_in_;
  CurrentControl control_;
  CurrentControl::In control_in_;
  Pwm pwm_;
  double clock_hz_;
  double per_v_ = 0, lost_v_ = 0, lost_v_a_ = 0;
  int in_period_ = 0;  ///< clocks since the PWM took a duty
  int strobe_at_ = 0;  ///< of these
  bool tripped_ = false;
  int middle_at_ = 0, conversion_ = 0;  ///< clocks; of an ADC, 0: the modulator
  std::int32_t converted_ = 0;          ///< taken by it, of full scale
  std::vector<double> means_a_;         ///< of each clock of a period
  std::size_t next_mean_ = 0;
  double sum_a_ = 0;
};

/// A step of the torque at stall, in the mean over a PWM period; the worst of ten phases in it.
struct CurrentStep {
  double settling_ms = 0, overshoot_pct = 0;
  std::vector<double> mean_nm, raw_nm;  ///< of the first phase, every 1 us; raw has the ripple
};
CurrentStep current_step(const Bench& bench, const CurrentSetting& setting, double from_nm,
                         double to_nm);

/// From the reference to the current.
struct CurrentSine {
  double hz = 0, gain_db = 0, phase_deg = 0;
  double form_gain_db = 0, form_phase_deg = 0;  ///< of the averaged winding
};
CurrentSine current_sine(const Bench& bench, const CurrentSetting& setting, double hz);

/// A figure beside its closed form.
struct CurrentFigure {
  std::string key;   ///< with unit
  std::string what;  ///< with unit
  double measured = 0, form = 0;
  bool bound = false;   ///< the closed form is the most that can be, not what must be
  std::string formula;  ///< in words or signs
  std::string asked;    ///< empty: nothing
  int decimals = 2;
};
struct CurrentReport {
  std::vector<CurrentFigure> figures;
  CurrentStep step;                ///< from 0 to 0.2 Nm
  std::vector<CurrentSine> sines;  ///< with gains for 2 kHz
  std::vector<double> short_a;     ///< the short with the largest peak, every 0.1 us
};
CurrentReport measure_current(const Bench& bench, const std::function<void(double)>& progress = {});
/// A Markdown table, as it stands in docs/controllers.md.
std::string current_text(const CurrentReport& report);
std::string current_json(const CurrentReport& report);

}  // namespace feltgate::controllers
