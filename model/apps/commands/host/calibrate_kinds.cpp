// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT calibrate cogging and align. Documentation: docs/calibration.md
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/commands/commands.hpp"
#include "apps/commands/host/bench_design.hpp"
#include "apps/commands/host/bench_motor.hpp"
#include "apps/commands/host/verbs.hpp"
#include "design/law_target.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "host/calibrate/align.hpp"
#include "host/calibrate/report.hpp"
#include "host/identify/report.hpp"
#include "law/compile.hpp"

namespace feltgate::host {

namespace {

/// Written once it is one that the engine of the design takes. Errors: LawError, law::Refused.
void write_law(files::OutputFile* to, const std::string& path, const std::string& text,
               const design::Elaborated& e) {
  (void)law::compile_text(text, path, design::law_target(e));
  to->write(text);
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

int calibrate_cogging(Session& session, const CoggingArguments& a) {
  if (a.from.empty() == a.slow_turn.empty() || (a.from.empty() && !a.write.empty())) {
    throw std::invalid_argument(
        "calibrate cogging needs --slow-turn FILE, a law to write that turns the lever, or --from "
        "FILE, what was recorded of it: time_s, position, tau_hat and tau_ref");
  }
  if (!a.into.empty() && a.write.empty()) {
    throw std::invalid_argument("--into LAW says what --write FILE writes; give both");
  }
  const BenchDesign known(session, "");
  const design::Elaborated& e = known.design();
  const SmallTorque small = small_torque_of(e);
  if (!e.design.engine && !(a.write.empty() && a.slow_turn.empty())) {
    throw std::invalid_argument(fmt::format(
        "design {} has no engine for a law; give one that has with --design", e.design.name));
  }
  files::Outputs outputs;
  std::string into, into_path;
  if (!a.into.empty()) {
    into_path = find_law(a.into);
    outputs.reads(into_path);
    std::ifstream in(into_path);
    into.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) throw std::invalid_argument(into_path + ": cannot be read; check the path");
  }
  if (!a.from.empty() && a.from != "-") outputs.reads(a.from);
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* write = outputs.open("--write", a.write);
  files::OutputFile* slow = outputs.open("--slow-turn", a.slow_turn);
  if (slow != nullptr) {
    write_law(slow, a.slow_turn, slow_turn_law(e), e);
    outputs.say(
        fmt::format("{}: turns the lever by 1.2 turns up and down in 31 s; record "
                    "position, tau_hat and tau_ref\n",
                    a.slow_turn));
    outputs.commit();
    return exit_ok;
  }
  const Cogging cogging = identify_cogging(ColumnTable::of_file(a.from), e, a.confidence);
  std::string text = report_text(cogging, a.confidence);
  if (write != nullptr) {
    if (cogging.terms.empty()) {
      throw std::invalid_argument(
          fmt::format("--write {}: there is nothing to take away\n{}", a.write, text));
    }
    write_law(write, a.write,
              compensating_law(cogging, small, fmt::format("{}, design {}", a.from, e.design.name),
                               into, into_path),
              e);
    text += fmt::format("{}: a law that takes it away{}\n", a.write,
                        a.into.empty() ? "" : ", with " + a.into);
  }
  outputs.say(text);
  if (json != nullptr) json->write(files::json_text(report_json(cogging, a.confidence)));
  outputs.commit();
  return exit_ok;
}

}  // namespace feltgate::host
