// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT identify. Documentation: docs/identify.md
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/host/bench_design.hpp"
#include "apps/commands/host/bench_motor.hpp"
#include "apps/commands/host/verbs.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "host/calibrate/report.hpp"
#include "host/identify/report.hpp"

namespace feltgate::host {

namespace {

struct IdentifyArguments {
  std::string from, coast, loaded, weighed, write, json, save;
  double volts = 6, step_s = 0.25, spin_s = 0.5;
  double resistance = 0, resistance_error = 0, emf = 0, electrical_s = 0;
  double added_kg_m2 = 0, mass_kg = 0, radius_m = 0, level_rad = 0, confidence = 0.95;
  bool yes = false;
};

/// Steps as shares of the largest voltage, each for step_s: both signs, several sizes.
constexpr double kPlan[] = {0.5, -0.5, 0.35, -0.35, 0.75, -0.75, 0.4, -0.6, 1.0, -1.0, 0.9, -0.4};
constexpr double kStandsAfter_s = 0.3, kLongestCoast_s = 20;

void say(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

/// Drives a free lever and records its ticks.
class Drives {
 public:
  explicit Drives(Device& device)
      : motor_(device, Mode::direct_voltage),
        position_(device.quantities().find("position")),
        voltage_(device.quantities().find("voltage")),
        count_rad_(device.design().design.count_rad()) {}

  Recording drive(const IdentifyArguments& a, int baud) {
    start("drive", baud);
    motor_.arm("free");
    for (const double share : kPlan) {
      motor_.set("voltage_setpoint", share * a.volts);
      take(a.step_s);
      if (Interruptible::interrupted()) break;
    }
    motor_.set("voltage_setpoint", 0);
    motor_.disarm();
    return end();
  }

  Recording coast(const IdentifyArguments& a, int baud) {
    motor_.set("voltage_setpoint", 0);
    motor_.arm("free");
    motor_.set("voltage_setpoint", a.volts);
    motor_.wait(a.spin_s);
    start("coast", baud);
    motor_.disarm();
    const Deadline last = within(kLongestCoast_s);
    double moved_s = 0, angle = 0;
    do {
      take(0.05);
      if (recording_.rows() > 0 && recording_.angle_rad.back() != angle) {
        angle = recording_.angle_rad.back();
        moved_s = recording_.time_s.back();
      }
    } while (recording_.length_s() < moved_s + kStandsAfter_s && HostClock::now() < last &&
             !Interruptible::interrupted());
    motor_.set("voltage_setpoint", 0);
    return end();
  }

 private:
  void start(const std::string& name, int baud) {
    Device& device = motor_.device();
    const auto mask = Quantities::bit(position_) | Quantities::bit(voltage_);
    const auto every_ms = static_cast<std::uint32_t>(1e-3 * device.board().tick_hz());
    recording_ = {};
    recording_.name = name;
    device.stream(mask, std::max(device.shortest_period(mask, baud), every_ms));
  }
  Recording end() {
    motor_.device().stream(0, 0);
    return recording_;
  }
  /// Collects ticks of the stream for a duration in board time, and feeds the watchdog meanwhile.
  void take(double seconds) {
    Device& device = motor_.device();
    const double until_s = recording_.rows() > 0 ? recording_.time_s.back() + seconds : seconds;
    const Deadline patience = within(20 * seconds + 2);
    while (!Interruptible::interrupted()) {
      const auto tick = device.streamed(within(0.01));
      if (HostClock::now() > patience) {
        throw LinkLost("the stream brings no ticks any more");
      }
      motor_.feed();
      if (!tick) continue;
      recording_.time_s.push_back(tick->time_s);
      recording_.angle_rad.push_back(static_cast<std::int32_t>(tick->word(position_)) * count_rad_);
      recording_.voltage_v.push_back(tick->value(voltage_));
      if (tick->time_s >= until_s) return;
    }
  }

  BenchMotor motor_;
  const Quantity& position_;
  const Quantity& voltage_;
  double count_rad_;
  Recording recording_;
};

std::string recording_csv(const Recording& r) {
  std::string text = "time_s,position_rad,voltage_v\n";
  for (std::size_t k = 0; k < r.rows(); ++k) {
    text += fmt::format("{:.6f},{:.9g},{:.6g}\n", r.time_s[k], r.angle_rad[k], r.voltage_v[k]);
  }
  return text;
}

/// Refuses options that do not go together before anything moves.
void check(const IdentifyArguments& a) {
  if (a.loaded.empty() != (a.added_kg_m2 == 0)) {
    throw std::invalid_argument("--loaded FILE and --added-inertia KGM2 go together");
  }
  if (a.weighed.empty() != (a.mass_kg == 0 || a.radius_m == 0)) {
    throw std::invalid_argument("--weighed FILE, --weight KG and --radius M go together");
  }
  if ((a.resistance > 0) + !a.loaded.empty() + !a.weighed.empty() > 1) {
    throw std::invalid_argument(
        "--resistance, --loaded and --weighed each separate J from R; give the best of them");
  }
  if (a.from.empty() && !a.coast.empty()) {
    throw std::invalid_argument("--coast FILE belongs to --from FILE; a board records its own");
  }
  if (!a.from.empty() && !a.save.empty()) {
    throw std::invalid_argument("--save is for recordings that are made now; leave out --from");
  }
}

int identify(Session& session, const IdentifyArguments& a) {
  check(a);
  const BenchDesign known(session, a.from.empty() ? "identify" : "");
  const design::Design& d = known.design().design;
  files::Outputs outputs;
  for (const std::string& file : {a.from, a.coast, a.loaded, a.weighed}) {
    if (!file.empty()) outputs.reads(file);
  }
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* write = outputs.open("--write", a.write);
  files::Outputs saved;  // whatever becomes of the fit
  const auto save = [&](const char* part) -> files::OutputFile* {
    return a.save.empty() ? nullptr : saved.open("--save", a.save + part);
  };
  files::OutputFile* drive_csv = save(".drive.csv");
  files::OutputFile* coast_csv = save(".coast.csv");
  const auto file = [&](const std::string& path, bool voltage) {
    return recording_of(ColumnTable::of_file(path), d.count_rad(), d.tick_s(), voltage);
  };
  Recording driven;
  std::optional<Recording> coasting;
  if (a.from.empty()) {
    if (!a.yes) {
      throw std::invalid_argument(fmt::format(
          "identify drives the free lever with up to {:g} V to and fro for {:g} s and lets it run "
          "down: nothing may be in its way, no hand on it; say so with --free",
          a.volts, a.step_s * std::size(kPlan)));
    }
    const Interruptible interruptible;
    say(simulated_banner(session.board()));
    Drives drives(session.device());
    say("driving\n");
    driven = drives.drive(a, session.options.baud);
    if (!Interruptible::interrupted()) say("running down\n");
    if (!Interruptible::interrupted()) coasting = drives.coast(a, session.options.baud);
    if (drive_csv != nullptr) drive_csv->write(recording_csv(driven));
    if (coast_csv != nullptr && coasting) coast_csv->write(recording_csv(*coasting));
    saved.commit();
    if (Interruptible::interrupted()) return exit_signal + 2;
  } else {
    driven = file(a.from, true);
    if (!a.coast.empty()) coasting = file(a.coast, false);
  }
  const Drive drive = identify_drive(driven, a.electrical_s, a.confidence);
  std::optional<Coast> coast;
  if (coasting) coast = identify_coast(*coasting, a.confidence);
  Separation separation;
  if (a.resistance > 0) separation.resistance_ohm = a.resistance;
  separation.resistance_error_ohm = a.resistance_error;
  if (a.emf > 0) separation.emf_constant_v_s_rad = a.emf;
  if (!a.loaded.empty()) {
    separation.added_kg_m2 = a.added_kg_m2;
    separation.loaded = identify_drive(file(a.loaded, true), a.electrical_s, a.confidence);
  }
  if (!a.weighed.empty()) {
    separation.weighed = identify_weight(file(a.weighed, true), a.mass_kg, a.radius_m, a.level_rad,
                                         a.electrical_s, a.confidence);
  }
  const Constants constants = separate(drive, coast, separation, a.confidence);
  const auto changes = changes_of(constants, known.design(), a.confidence);
  auto result = report_json(drive, coast, constants, a.confidence);
  result["changes"] = report_json(changes);
  outputs.say(report_text(drive, coast, constants, a.confidence) +
              known.write(changes, write, a.write));
  if (json != nullptr) json->write(files::json_text(result));
  outputs.commit();
  return exit_ok;
}

void add_separation_options(CLI::App& sub, IdentifyArguments& a) {
  sub.add_option("--resistance", a.resistance, "R by ohmmeter, with wiring and bridge")
      ->type_name("OHM")
      ->transform(checks::positive(1e4, "ohm"));
  sub.add_option("--resistance-error", a.resistance_error, "standard deviation of that")
      ->type_name("OHM")
      ->transform(checks::number(0, 1e4, "ohm"));
  sub.add_option("--loaded", a.loaded, "the same drive with a known inertia more on the shaft")
      ->type_name("FILE");
  sub.add_option("--added-inertia", a.added_kg_m2, "which one")
      ->type_name("KGM2")
      ->transform(checks::positive(10, "kg m^2"));
  sub.add_option("--weighed", a.weighed, "a drive with a weight on the lever, the shaft lying")
      ->type_name("FILE");
  sub.add_option("--weight", a.mass_kg, "which one")
      ->type_name("KG")
      ->transform(checks::positive(100, "kg"));
  sub.add_option("--radius", a.radius_m, "of the weight")
      ->type_name("M")
      ->transform(checks::positive(10, "m"));
  sub.add_option("--level", a.level_rad, "angle at which the lever is level")
      ->type_name("RAD")
      ->transform(checks::number(-1e6, 1e6, "rad"));
  sub.add_option("--emf-constant", a.emf, "Ke of a data sheet, where there is no coast-down")
      ->type_name("VS/RAD")
      ->transform(checks::positive(100, "V s/rad"));
  sub.add_option("--electrical-time", a.electrical_s, "L/R: makes J right to a permille")
      ->type_name("SECONDS")
      ->transform(checks::number(0, 0.01, "s"));
}

}  // namespace

Run add_identify(CLI::App& sub) {
  auto a = std::make_shared<IdentifyArguments>();
  sub.footer(
      "Drives the free lever to and fro, lets it run down, and says what voltage and position "
      "know\n"
      "of the motor, with intervals, and what to measure for the rest.\n"
      "  feltgate host /dev/ttyUSB0 identify --free --resistance 0.42 --save lever\n"
      "  feltgate host - identify --from lever.drive.csv --coast lever.coast.csv --resistance "
      "0.42\n"
      "A file has the columns time_s (or tick), position_rad (or position, counts) and voltage_v,\n"
      "a row a millisecond. docs/calibration.md explains.\n"
      "Exit code: 0 done, 1 the board refused or a fault came, 2 unusable input or recordings "
      "that\n"
      "do not say it, 3 the link broke down.");
  sub.add_flag("--free", a->yes, "the lever may turn as it likes: drive it now");
  sub.add_option("--volts", a->volts, "largest voltage of the drive")
      ->type_name("V")
      ->capture_default_str()
      ->transform(checks::positive(48, "V"));
  sub.add_option("--step", a->step_s, "how long each voltage stands")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->transform(checks::number(0.1, 10, "s"));
  sub.add_option("--spin", a->spin_s, "how long it is spun up before it runs down")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->transform(checks::number(0.1, 10, "s"));
  sub.add_option("--from", a->from, "a driven recording instead of a board")
      ->type_name("FILE")
      ->check(checks::no_folder());
  sub.add_option("--coast", a->coast, "its coast-down")->type_name("FILE");
  add_separation_options(sub, *a);
  sub.add_option("--confidence", a->confidence, "of the intervals")
      ->type_name("SHARE")
      ->capture_default_str()
      ->check(checks::number(0.5, 0.9999, ""));
  sub.add_option("--save", a->save, "write the recordings as PREFIX.drive.csv and PREFIX.coast.csv")
      ->type_name("PREFIX");
  sub.add_option("--write", a->write, "write the design file with what was found")
      ->type_name("FILE");
  sub.add_option("--json", a->json, "write all numbers to this file")->type_name("FILE");
  return [a](Session& session) { return identify(session, *a); };
}

}  // namespace feltgate::host
