// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT record. Documentation: docs/host.md
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "apps/commands/host/streaming.hpp"
#include "apps/commands/host/verbs.hpp"
#include "files/output_file.hpp"
#include "host/capture.hpp"
#include "sim/traces/vector_file.hpp"

namespace feltgate::host {

namespace {

struct RecordArguments : StreamArguments {
  std::string csv, vector;
};

int record(Session& session, RecordArguments a) {
  if (a.csv.empty() && a.vector.empty()) {
    throw std::invalid_argument("record: nothing to write; give --csv FILE, --vector FILE or both");
  }
  Device& device = session.device();
  files::Outputs outputs;
  files::OutputFile* csv = outputs.open("--csv", a.csv);
  files::OutputFile* vector = outputs.open("--vector", a.vector);
  const Quantity& position = device.quantities().find("position");
  if (std::find(a.names.begin(), a.names.end(), "position") == a.names.end()) {
    a.names.emplace_back("position");
  }
  const std::uint32_t period = stream_period(session, a);
  const std::vector<const Quantity*> columns = stream_columns(device, a);
  if (csv != nullptr) csv->write(csv_head(columns));
  std::vector<PositionAt> positions;
  std::uint64_t rows = 0, lost = 0;
  double seconds = 0;
  const std::uint32_t dropped_before = device.stream_dropped();
  Progress progress("record", false);
  follow_stream(device, a, period, [&](const Tick& tick) {
    ++rows;
    lost += tick.lost;
    seconds = tick.time_s;
    if (csv != nullptr) csv->write(csv_row(columns, tick));
    if (vector != nullptr) {
      positions.push_back({std::llround(tick.time_s * device.board().tick_hz()),
                           static_cast<std::int32_t>(tick.word(position))});
    }
    if (a.seconds > 0) progress.update(std::min(1.0, seconds / a.seconds));
  });
  progress.finish();
  if (rows == 0) throw LinkLost(session.options.port + ": no tick of the stream came");
  // The counter of the frames also counts frames that the board dropped.
  const std::uint64_t dropped = device.stream_dropped() - dropped_before;
  std::string text = simulated_banner(device.board());
  if (vector != nullptr) {
    PositionEncoder encoder(device.design().design, positions);
    traces::write_vector(vector->handle(), a.vector, device.design().design.name,
                         device.board().clock_hz, encoder);
    text += fmt::format("{}: A and B whose position at every {}th tick is the recorded one\n",
                        a.vector, period);
  }
  text +=
      fmt::format("{} ticks in {:.3f} s, every {}th; {} lost on the way, {} dropped by the board\n",
                  rows, seconds, period, lost - std::min(lost, dropped), dropped);
  outputs.say(text + link_troubles(session.link().counts()));
  outputs.commit();
  return exit_ok;
}

}  // namespace

Run add_record(CLI::App& sub) {
  auto a = std::make_shared<RecordArguments>();
  a->names = {"position", "angle", "velocity", "tau_ref", "status", "faults"};
  sub.footer(R"(  feltgate host /dev/ttyUSB0 record --for 10 --csv moved.csv
  feltgate host /dev/ttyUSB0 record position --for 10 --vector moved.vec
  feltgate replay moved.vec                              the same motion through every back-end
  feltgate replay moved.csv --count-column position
The wire carries no pins and not every tick. The trace of --vector has edges spread evenly
between recorded positions, no index, no glitches and no illegal steps; for every tick exactly
as the core saw it: capture --vector.
Exit code: 0 recorded, 1 a fault ended an armed motor, 2 unusable input or port, 3 the link broke down.)");
  add_stream_options(sub, *a);
  sub.get_option("--every")->default_str("as the wire allows");
  option(sub, "--csv", a->csv, "FILE", "a row for each tick that came, time in seconds");
  option(sub, "--vector", a->vector, "FILE", "encoder trace for replay");
  return [a](Session& session) { return record(session, *a); };
}

}  // namespace feltgate::host
