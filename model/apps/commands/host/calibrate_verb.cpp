// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT calibrate. Documentation: docs/calibration.md
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands/host/bench.hpp"
#include "apps/commands/host/verbs.hpp"
#include "host/calibrate/align.hpp"
#include "law/units.hpp"

namespace feltgate::host {

namespace {

struct CalibrateArguments {
  std::string what, from, write, json, save;
  bool closed = false;
  std::vector<double> points;
  double arm_m = 0, torque_constant = 0, gain = 1, confidence = 0.95, hold_s = 3, voltage_v = 0;
};

constexpr double kSettle_s = 0.1;
constexpr int kTicks = 20;     ///< read for a mean of tau_hat
constexpr double kStill = 16;  ///< counts that a blocked lever may give

/// "0.065" or "65mNm", "5.9N" with the arm of the pulley.
double torque_typed(const std::string& text, double arm_m) {
  try {
    const std::string unit = law::read_amount(text, "0.065, which is Nm, or 5.9N").unit;
    if (unit.empty() || unit.back() != 'N') return law::amount_in(text, "Nm");
    if (!(arm_m > 0)) throw MeasurementError("forces need the arm of the pulley: --arm 0.011 (m)");
    return law::amount_in(text, "N") * arm_m;
  } catch (const MeasurementError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw MeasurementError(error.what());
  }
}

/// Measures point by point: commands a torque, takes the mean of tau_hat, reads the typed gauge
/// value, removes the command.
class Procedure {
 public:
  Procedure(Device& device, const CalibrateArguments& a)
      : a_(a),
        motor_(device, a.closed ? Mode::closed_loop : Mode::direct_voltage),
        command_(a.closed ? "setpoint_torque" : "voltage_setpoint"),
        unit_(a.closed ? "Nm" : "V") {}

  /// Adds to `readings`, which keeps them when the motor goes off.
  void run(std::vector<Reading>* readings) {
    say(fmt::format(
        "Block the shaft and set the gauge to zero. Each of {} values stands for {:g} s at most,\n"
        "then the motor is off and you may still type. Ctrl-C ends it. Type the reading in Nm, or\n"
        "with its unit as 5.9N; nothing but Enter skips a value, 'again' repeats it.\n",
        a_.points.size(), a_.hold_s));
    if (a_.closed) set_gains();
    for (std::size_t k = 0; k < a_.points.size() && !Interruptible::interrupted(); ++k) {
      say(fmt::format("{}/{}: {:g} {} ", k + 1, a_.points.size(), a_.points[k], unit_));
      Reading r = powered(a_.points[k]);
      const auto answer = this->answer();
      motor_.set(command_, 0);
      motor_.disarm();
      if (answer && isatty(STDIN_FILENO) == 0) say(*answer + "\n");
      const auto line = answer ? answer : unpowered();
      if (!line) break;
      if (*line == "again") {
        --k;
      } else if (!line->empty()) {
        try {
          r.torque_nm = torque_typed(*line, a_.arm_m);
          readings->push_back(r);
        } catch (const MeasurementError& e) {
          say(fmt::format("{}\n", e.what()));
          --k;
        }
      }
    }
  }

 private:
  void set_gains() {
    if (motor_.device().design().design.emf_in_law()) return;
    motor_.set("voltage_gain", a_.gain);
    motor_.set("voltage_gain_high", a_.gain);
  }

  /// Commands the value and returns the observer's estimate.
  Reading powered(double value) {
    Device& device = motor_.device();
    motor_.set(command_, 0);
    motor_.arm(a_.closed ? "setpoint" : "free");
    const Quantity& position = device.quantities().find("position");
    const Quantity& tau_hat = device.quantities().find("tau_hat");
    const Tick before = device.tick();
    motor_.set(command_, value);
    began_ = HostClock::now();
    motor_.wait(kSettle_s);
    Reading r;
    r.command = value;
    double sum = 0;
    for (int k = 0; k < kTicks; ++k) {
      motor_.poll();
      sum += device.tick().value(tau_hat);
    }
    r.tau_hat_nm = sum / kTicks;
    const double moved =
        static_cast<std::int32_t>(device.tick().word(position) - before.word(position));
    say(fmt::format("(observer {:.4f} Nm{}) gauge: ", *r.tau_hat_nm,
                    std::abs(moved) > kStill
                        ? fmt::format(", the lever moved by {:g} counts: block it better", moved)
                        : ""));
    return r;
  }

  /// The reading, if it is typed while the motor may still push.
  std::optional<std::string> answer() {
    const Deadline end = began_ + std::chrono::duration_cast<HostClock::duration>(
                                      std::chrono::duration<double>(a_.hold_s));
    return typed_line(
        "a reading", [end] { return HostClock::now() < end && !Interruptible::interrupted(); },
        [this] { motor_.poll(); });
  }
  static std::optional<std::string> unpowered() {
    say("(motor off) ");
    return typed_line(
        "a reading", [] { return !Interruptible::interrupted(); }, [] {});
  }

  const CalibrateArguments& a_;
  BenchMotor motor_;
  std::string command_, unit_;
  Deadline began_{};
};

std::string readings_csv(const std::vector<Reading>& readings, bool closed) {
  std::string text = fmt::format("{},torque_nm,tau_hat_nm\n", closed ? "tau_ref_nm" : "voltage_v");
  for (const Reading& r : readings) {
    text += fmt::format("{},{},{}\n", r.command, r.torque_nm,
                        r.tau_hat_nm ? fmt::format("{}", *r.tau_hat_nm) : "");
  }
  return text;
}

/// The voltage with which an alignment turns the rotor. At most the nominal current flows.
double aligning_volts(const design::Design& d, double asked_v) {
  const double most_v = d.resistance_ohm * d.nominal_current_a;
  if (asked_v <= 0) return most_v / 2;
  if (asked_v <= most_v) return asked_v;
  throw std::invalid_argument(
      fmt::format("--voltage {:g}: is more than the {:.3g} V with which the nominal current flows; "
                  "give less",
                  asked_v, most_v));
}

/// Turns the rotor of the board's motor with the voltage, and back.
std::vector<AlignReading> turned(Session& session, double volts) {
  constexpr double rests_s = 0.2;
  BenchMotor motor(session.device(), Mode::direct_voltage);
  const KeptWords kept(motor, {"commutation_gain", "commutation_offset", "voltage_setpoint"});
  for (const char* word : {"commutation_gain", "commutation_offset", "voltage_setpoint"}) {
    motor.set(word, 0);
  }
  const Quantity& position = session.device().quantities().find("position");
  motor.arm("free");
  motor.set("voltage_setpoint", volts);
  return take_readings(
      [&](double turns) {
        motor.set("commutation_offset", turns);
        motor.wait_on_board(rests_s);
        return !Interruptible::interrupted();
      },
      [&] { return session.device().tick().value(position); });
}

int align(Session& session, const CalibrateArguments& a) {
  if (!a.from.empty() && (!a.save.empty() || a.voltage_v > 0)) {
    throw std::invalid_argument(
        "--save and --voltage are for readings that are taken now; leave out --from");
  }
  Bench bench(session, "calibrate align", {a.from}, a.write, a.json);
  const design::Design& d = bench.design().design;
  if (d.phases != 3) {
    throw std::invalid_argument(
        fmt::format("design {} drives no motor with three phases; give one that does with "
                    "--design",
                    d.name));
  }
  files::Outputs saved;  // whatever becomes of the fit
  files::OutputFile* save = saved.open("--save", a.save);
  std::vector<AlignReading> readings;
  if (a.from.empty()) {
    const Interruptible interruptible;
    const double volts = aligning_volts(d, a.voltage_v);
    bench.outputs().say(fmt::format("{}{:.3g} V turn the rotor by an electrical turn and back\n",
                                    simulated_banner(session.board()), volts));
    readings = turned(session, volts);
    if (Interruptible::interrupted()) return exit_signal + 2;
    if (save != nullptr) save->write(readings_csv(readings));
    saved.commit();
  } else {
    readings = align_readings(ColumnTable::of_file(a.from));
  }
  const Alignment found = fit_alignment(readings, 4.0 * d.lines, a.confidence);
  bench.finish(report_text(found), report_json(found), changes_of(found, bench.design()));
  return exit_ok;
}

int calibrate(Session& session, CalibrateArguments a) {
  if (a.what == "align") return align(session, a);
  if (a.voltage_v > 0) throw std::invalid_argument("--voltage belongs to calibrate align");
  if (!a.from.empty() && !a.save.empty()) {
    throw std::invalid_argument("--save is for readings that are taken now; leave out --from");
  }
  Bench bench(session, "calibrate", {a.from}, a.write, a.json);
  if (a.points.empty()) {
    a.points = a.closed ? std::vector<double>{0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5}
                        : std::vector<double>{1.5, 2.5, 3.5, 4.5, 5.5};
  }
  files::Outputs saved;  // whatever becomes of the fit
  files::OutputFile* save = saved.open("--save", a.save);
  std::vector<Reading> readings;
  if (a.from.empty()) {
    const Interruptible interruptible;
    say(simulated_banner(session.board()));
    const auto keep = [&] {
      if (save != nullptr) save->write(readings_csv(readings, a.closed));
      saved.commit();
    };
    try {
      Procedure(session.device(), a).run(&readings);
    } catch (const Refused& e) {
      keep();
      throw Refused(
          fmt::format("{}\n  {} readings {}; after i2t let the motor cool, and measure the "
                      "other values with --points",
                      e.what(), readings.size(),
                      save != nullptr ? "are in " + a.save : "are lost without --save"));
    }
    keep();
    if (Interruptible::interrupted()) return exit_signal + 2;
    say("\n");
  } else {
    const ColumnTable table = ColumnTable::of_file(a.from);
    readings = a.closed ? closed_loop_readings(table, a.arm_m) : open_loop_readings(table, a.arm_m);
  }
  const design::Elaborated& e = bench.design();
  std::vector<std::string> warnings;
  if (a.closed) {
    const ClosedLoop closed = fit_closed_loop(readings, e, a.gain, a.confidence);
    const std::vector<Change> changes = changes_of(closed, e, &warnings);
    bench.finish(report_text(closed) + notes_text(warnings), report_json(closed), changes);
  } else {
    const bool given = a.torque_constant > 0;
    const double kt = given ? a.torque_constant : e.design.torque_constant_nm_a;
    const OpenLoop open = fit_open_loop(readings, kt, a.confidence);
    const std::vector<Change> changes = changes_of(open, e, kt, given, &warnings);
    bench.finish(report_text(open, e) + notes_text(warnings), report_json(open), changes);
  }
  return exit_ok;
}

}  // namespace

Run add_calibrate(CLI::App& sub) {
  auto a = std::make_shared<CalibrateArguments>();
  sub.footer(
      R"(The paper's two calibrations against a blocked shaft and a gauge, step by step: open loop
gives R and the dead voltage, closed loop the voltage gains (or R and dead voltage again).
  feltgate host /dev/ttyUSB0 calibrate --arm 0.011 --write mine.toml
  feltgate host /dev/ttyUSB0 calibrate --closed --save closed.csv
  feltgate host - calibrate --from open.csv             readings of a file, no board
  feltgate host /dev/ttyUSB0 calibrate align --write mine.toml        the motor turns
A file has the columns voltage_v (or tau_ref_nm) and torque_nm (or force_n with --arm), and
perhaps tau_hat_nm. Read docs/calibration.md first: the motor pushes.
Exit code: 0 done, 1 the board refused or a fault came, 2 unusable input or readings that
do not say it, 3 the link broke down.)");
  option(sub, "what", a->what, "align", "align: pole pairs and angle of a motor with three phases",
         CLI::IsMember({"align"}));
  option(sub, "--voltage", a->voltage_v, "V",
         "of align: that turns the rotor; default: half of the nominal current's",
         checks::positive(100, "V"));
  sub.add_flag("--closed", a->closed, "the closed-loop calibration");
  option(sub, "--from", a->from, "FILE", "readings of this file instead of a board; - is the input",
         checks::no_folder());
  option(sub, "--points", a->points, "",
         "voltages (V) or torques (Nm) to take; default: those of the paper",
         checks::number(-24, 24, ""))
      ->delimiter(',');
  option(sub, "--arm", a->arm_m, "M", "of the pulley, for readings in N",
         checks::positive(10, "m"));
  option(sub, "--torque-constant", a->torque_constant, "NM/A",
         "Kt that turns the slope into R; default: the design's", checks::positive(100, "Nm/A"));
  defaulted(sub, "--gain", a->gain, "KV", "both voltage gains during --closed, of a law in regions",
            checks::positive(10, ""));
  defaulted(sub, "--hold", a->hold_s, "SECONDS", "longest time that a value stands",
            checks::positive(30, "s"));
  defaulted(sub, "--confidence", a->confidence, "SHARE", "of the intervals",
            checks::number(0.5, 0.9999, ""));
  option(sub, "--save", a->save, "FILE", "write the readings as CSV");
  option(sub, "--write", a->write, "FILE", "write the design file with what was found");
  option(sub, "--json", a->json, "FILE", "write all numbers to this file");
  return [a](Session& session) { return calibrate(session, *a); };
}

}  // namespace feltgate::host
