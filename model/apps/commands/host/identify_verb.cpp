// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT identify. Documentation: docs/calibration.md
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands/host/bench.hpp"
#include "apps/commands/host/verbs.hpp"
#include "host/identify/identify.hpp"

namespace feltgate::host {

namespace {

struct IdentifyArguments {
  std::string from, coast, write, json, save;
  double volts = 6, resistance = 0, electrical_s = 0;
  bool yes = false;
};

/// Steps as shares of the largest voltage, each for kStep_s: both signs, several sizes.
constexpr double kPlan[] = {0.5, -0.5, 0.35, -0.35, 0.75, -0.75, 0.4, -0.6, 1.0, -1.0, 0.9, -0.4};
constexpr double kStep_s = 0.25, kSpin_s = 0.5, kStandsAfter_s = 0.3, kLongestCoast_s = 20;

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
      take(kStep_s);
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
    motor_.wait(kSpin_s);
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

int identify(Session& session, const IdentifyArguments& a) {
  if (!(a.from.empty() ? a.coast : a.save).empty()) {
    throw std::invalid_argument(
        "--coast belongs to --from FILE, and --save to recordings that are made now");
  }
  Bench bench(session, "identify", {a.from, a.coast}, a.write, a.json);
  files::Outputs saved;  // whatever becomes of the fit
  const auto save = [&](const char* part) {
    return a.save.empty() ? nullptr : saved.open("--save", a.save + part);
  };
  files::OutputFile *drive_csv = save(".drive.csv"), *coast_csv = save(".coast.csv");
  const auto file = [&](const std::string& path, bool voltage) {
    return recording_of(ColumnTable::of_file(path), bench.design().design.count_rad(), voltage);
  };
  Recording driven;
  std::optional<Recording> coasting;
  if (a.from.empty()) {
    if (!a.yes) {
      throw std::invalid_argument(fmt::format(
          "identify drives the free lever with up to {:g} V to and fro for {:g} s and lets it run "
          "down: nothing may be in its way, no hand on it; say so with --free",
          a.volts, kStep_s * std::size(kPlan)));
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
  const Drive drive = identify_drive(driven, a.electrical_s);
  std::optional<Coast> coast;
  if (coasting) coast = identify_coast(*coasting);
  const Constants constants = constants_of(drive, coast, a.resistance);
  bench.finish(report_text(drive, coast, constants), report_json(drive, coast, constants),
               changes_of(constants, bench.design()));
  return exit_ok;
}

}  // namespace

Run add_identify(CLI::App& sub) {
  auto a = std::make_shared<IdentifyArguments>();
  sub.footer(
      R"(Drives the free lever to and fro, lets it run down, and says what voltage and position
know of the motor, with intervals, and what to measure for the rest.
  feltgate host /dev/ttyUSB0 identify --free --resistance 0.42 --save lever
  feltgate host - identify --from lever.drive.csv --coast lever.coast.csv
A file has the columns time_s, position_rad (or position, counts) and voltage_v, a row a
millisecond. docs/calibration.md explains.
Exit code: 0 done, 1 the board refused or a fault came, 2 unusable input or recordings
that do not say it, 3 the link broke down.)");
  sub.add_flag("--free", a->yes, "the lever may turn as it likes: drive it now");
  defaulted(sub, "--volts", a->volts, "V", "largest voltage of the drive",
            checks::positive(48, "V"));
  option(sub, "--from", a->from, "FILE", "a driven recording instead of a board",
         checks::no_folder());
  option(sub, "--coast", a->coast, "FILE", "its coast-down");
  option(sub, "--resistance", a->resistance, "OHM", "R by ohmmeter, with wiring and bridge",
         checks::positive(1e4, "ohm"));
  option(sub, "--electrical-time", a->electrical_s, "SECONDS", "L/R: makes J right to a permille",
         checks::number(0, 0.01, "s"));
  option(sub, "--save", a->save, "PREFIX",
         "write the recordings as PREFIX.drive.csv and PREFIX.coast.csv");
  option(sub, "--write", a->write, "FILE", "write the design file with what was found");
  option(sub, "--json", a->json, "FILE", "write all numbers to this file");
  return [a](Session& session) { return identify(session, *a); };
}

}  // namespace feltgate::host
