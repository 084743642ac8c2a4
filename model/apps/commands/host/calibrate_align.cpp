// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT calibrate align. Documentation: docs/calibration.md
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/commands/commands.hpp"
#include "apps/commands/host/bench_design.hpp"
#include "apps/commands/host/bench_motor.hpp"
#include "apps/commands/host/verbs.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "host/calibrate/align.hpp"
#include "host/calibrate/report.hpp"

namespace feltgate::host {

namespace {

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

}  // namespace

int calibrate_align(Session& session, const AlignArguments& a) {
  if (!a.from.empty() && (!a.save.empty() || a.voltage_v > 0)) {
    throw std::invalid_argument(
        "--save and --voltage are for readings that are taken now; leave out --from");
  }
  const BenchDesign known(session, a.from.empty() ? "calibrate align" : "");
  const design::Design& d = known.design().design;
  if (d.phases != 3) {
    throw std::invalid_argument(
        fmt::format("design {} drives no motor with three phases; give one that does with "
                    "--design",
                    d.name));
  }
  files::Outputs outputs;
  if (!a.from.empty() && a.from != "-") outputs.reads(a.from);
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* write = outputs.open("--write", a.write);
  files::Outputs saved;  // whatever becomes of the fit
  files::OutputFile* save = saved.open("--save", a.save);
  std::vector<AlignReading> readings;
  if (a.from.empty()) {
    const Interruptible interruptible;
    const double volts = aligning_volts(d, a.voltage_v);
    outputs.say(fmt::format("{}{:.3g} V turn the rotor by an electrical turn and back\n",
                            simulated_banner(session.board()), volts));
    readings = turned(session, volts);
    if (Interruptible::interrupted()) return exit_signal + 2;
    if (save != nullptr) save->write(readings_csv(readings));
    saved.commit();
  } else {
    readings = align_readings(ColumnTable::of_file(a.from));
  }
  const Alignment found = fit_alignment(readings, 4.0 * d.lines, a.confidence);
  const std::vector<Change> changes = changes_of(found, known.design());
  auto result = report_json(found);
  result["changes"] = report_json(changes);
  outputs.say(report_text(found) + known.write(changes, write, a.write));
  if (json != nullptr) json->write(files::json_text(result));
  outputs.commit();
  return exit_ok;
}

}  // namespace feltgate::host
