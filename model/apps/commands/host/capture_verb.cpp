// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT capture. Documentation: docs/host.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "apps/commands/host/streaming.hpp"
#include "apps/commands/host/verbs.hpp"
#include "files/output_file.hpp"
#include "host/capture.hpp"
#include "sim/traces/vector_file.hpp"

namespace feltgate::host {

namespace {

struct CaptureArguments {
  std::vector<std::string> names{"angle",       "velocity", "tau_ref", "tau_hat",
                                 "current_ref", "voltage",  "status",  "faults"};
  std::string trigger = "now", arm, csv, picture, xy, vector;
  double before = 0.25, span_s = 0, wait_s = 10;
};

CaptureSetup setup_of(Session& session, const CaptureArguments& a) {
  Device& device = session.device();
  CaptureSetup s;
  s.quantities = a.names;
  if (!a.vector.empty() && std::find(a.names.begin(), a.names.end(), "position") == a.names.end()) {
    s.quantities.emplace_back("position");
  }
  const int rows = device.board().capture_rows;
  s.trigger =
      parse_trigger(device, means_event(a.trigger) ? session.laws_if_any() : nullptr, a.trigger);
  s.rows_before = std::min(rows - 1, static_cast<int>(a.before * rows));
  if (a.span_s > 0) {
    const double ticks = std::ceil(a.span_s * device.board().tick_hz() / rows);
    s.period = static_cast<std::uint32_t>(std::clamp(ticks, 1.0, 4e9));
  }
  return s;
}

/// Waits until the rows are full. Returns false if the trigger did not occur.
bool wait_for_it(Device& device, Hold& hold, const CaptureArguments& a, const CaptureSetup& setup) {
  constexpr int waits = 2;
  constexpr double rest_s = 0.02;
  bool told = a.trigger == "now";
  return wait_for_capture(device, setup, a.wait_s, [&](int state) {
    hold.poll();
    if (state == waits && !told) {
      told = true;
      std::fputs(fmt::format("waiting for {}\n", a.trigger).c_str(), stderr);
    }
    return Interruptible::interrupted() ? -1.0 : std::min(hold.next_in_s(), rest_s);
  });
}

std::string csv_text(const Captured& c) {
  std::string text = csv_head(c.columns);
  for (const Tick& row : c.rows) text += csv_row(c.columns, row);
  return text;
}

std::string table(const Captured& c) {
  std::string text =
      fmt::format("{:<14} {:>12} {:>12} {:>12}\n", "", "smallest", "at trigger", "largest");
  for (const Quantity* q : c.columns) {
    double low = INFINITY, high = -INFINITY;
    for (const Tick& row : c.rows) {
      low = std::min(low, row.value(*q));
      high = std::max(high, row.value(*q));
    }
    const auto at = static_cast<std::size_t>(std::max(c.trigger_row, 0));
    if (q->unit.empty()) {
      text += fmt::format("{:<14} {:>12} {:>12}\n", q->name, "", q->text_of(c.rows[at].word(*q)));
      continue;
    }
    text += fmt::format("{:<14} {:>12.6g} {:>12.6g} {:>12.6g} {}\n", q->name, low,
                        c.rows[at].value(*q), high, q->unit == "1" ? "" : q->unit);
  }
  return text;
}

void write_trace(Device& device, const Captured& c, const CaptureSetup& setup,
                 const std::string& path, files::OutputFile& out) {
  const Quantity& position = device.quantities().find("position");
  std::vector<PositionAt> positions;
  for (std::size_t n = 0; n < c.rows.size(); ++n) {
    positions.push_back({static_cast<std::int64_t>(n) * setup.period,
                         static_cast<std::int32_t>(c.rows[n].word(position))});
  }
  PositionEncoder encoder(device.design().design, positions);
  traces::write_vector(out.handle(), path, device.design().design.name, device.board().clock_hz,
                       encoder);
}

/// Why a held motor is off, or nothing while it is on; the capture may show this very event.
std::string why_off(Device& device, const Hold& hold) {
  const Tick tick = hold.holds() ? device.tick() : Tick{};
  if (!hold.holds() || device.armed(tick)) return "";
  return "the motor went off meanwhile" + fault_lines(device, tick);
}

int draw(const CaptureArguments& a, const std::string& csv, bool simulated) {
  std::vector<std::string> words{csv, a.picture};
  if (!a.xy.empty()) words.insert(words.end(), {"--xy", a.xy});
  if (simulated) words.emplace_back("--simulated");
  words.insert(words.end(), {"--title", "trigger: " + a.trigger});
  return run_script("host_picture.py", words, stdout);
}

int capture(Session& session, const CaptureArguments& a) {
  if (!a.picture.empty() && a.csv.empty()) {
    throw std::invalid_argument("--picture draws what --csv has written; add --csv FILE");
  }
  if (!a.xy.empty() && a.picture.empty())
    throw std::invalid_argument("--xy is for --picture FILE; add it");
  Device& device = session.device();
  const CaptureSetup setup = setup_of(session, a);
  files::Outputs outputs;
  files::OutputFile* csv = outputs.open("--csv", a.csv);
  files::OutputFile* vector = outputs.open("--vector", a.vector);
  Captured c;
  std::string off;
  {
    const Interruptible interruptible;
    Hold hold(device);
    if (a.arm.empty()) hold.take_over();
    start_capture(device, setup);
    if (!a.arm.empty()) hold.arm(a.arm);
    if (!wait_for_it(device, hold, a, setup)) {
      if (Interruptible::interrupted()) {
        std::fputs("feltgate host: interrupted; nothing is written\n", stderr);
        return exit_signal + 2;
      }
      throw Refused(fmt::format("the trigger {} did not come within {:g} s; nothing is written",
                                a.trigger, a.wait_s));
    }
    Progress progress("reading", false);
    c = read_capture(device, setup, [&](double share) {
      hold.poll();
      progress.update(share);
    });
    off = why_off(device, hold);
    hold.release();
  }
  if (c.rows.empty()) throw Refused("the board says that it captured nothing");
  if (csv != nullptr) csv->write(csv_text(c));
  if (vector != nullptr) write_trace(device, c, setup, a.vector, *vector);
  std::string text = simulated_banner(device.board());
  text += fmt::format("{} rows, {:.6g} s from {:.6g} s before the trigger on, every {:g} us\n",
                      c.rows.size(), static_cast<double>(c.rows.size()) * c.row_s,
                      c.trigger_row * c.row_s, 1e6 * c.row_s);
  outputs.say(text + table(c) + link_troubles(session.link().counts()));
  outputs.commit();
  if (!off.empty()) std::fputs(("feltgate host: " + off + "\n").c_str(), stderr);
  const int drawn = a.picture.empty() ? int{exit_ok} : draw(a, a.csv, c.simulated);
  return off.empty() ? drawn : int{exit_failed};
}

}  // namespace

Run add_capture(CLI::App& sub) {
  auto a = std::make_shared<CaptureArguments>();
  sub.footer(
      R"(  feltgate host /dev/ttyUSB0 capture --arm wall --trigger 'tau_ref>0.05' --csv wall.csv --picture wall.svg
  feltgate host /dev/ttyUSB0 capture angle tau_ref --span 0.5 --csv push.csv --picture push.png --xy angle,tau_ref
  feltgate host /dev/ttyUSB0 capture --trigger fault --wait 3600 --csv fault.csv
  feltgate host /dev/ttyUSB0 capture tick angle tau_ref --arm law --trigger event:hit
  feltgate host /dev/ttyUSB0 capture position velocity --vector moved.vec
Triggers: 'velocity>5' rises to the value or above, 'angle<-10deg' falls below; 'fault',
'fault:speed,stop', 'limit:current', 'armed'; 'event:hit', an event of the board's law, 'event' any;
'now'. The memory is the board's: 1024 rows of 8 words, one row a tick unless --span asks for
longer. The CSV has its time in seconds from the trigger on, for PlotJuggler and spreadsheets.
Exit code: 0 captured, 1 the trigger did not come or the motor went off, 2 unusable input or port, 3 the link broke down.)");
  defaulted(sub, "names", a->names, "NAME", "words of a tick, at most 8 different ones");
  defaulted(sub, "--trigger", a->trigger, "WHEN", "when");
  defaulted(sub, "--before", a->before, "SHARE", "share of the rows that lie before the trigger",
            checks::number(0, 1, ""));
  option(sub, "--span", a->span_s, "SECONDS", "time that all rows cover; default: a tick a row",
         checks::positive(1e6, "s"));
  defaulted(sub, "--wait", a->wait_s, "SECONDS", "for the trigger", checks::positive(1e6, "s"));
  option(sub, "--arm", a->arm, "SCENE", "arm this scene, kick the watchdog, disarm at the end");
  option(sub, "--csv", a->csv, "FILE", "a row each, time in seconds");
  option(sub, "--picture", a->picture, "FILE", "picture of the CSV, .svg or .png");
  option(sub, "--xy", a->xy, "X,Y",
         "with --picture: one quantity over another instead of over time");
  option(sub, "--vector", a->vector, "FILE",
         "encoder trace for replay: every tick as the core saw it");
  return [a](Session& session) { return capture(session, *a); };
}

}  // namespace feltgate::host
