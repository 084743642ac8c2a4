// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Open-loop run on an encoder recording. Documentation: docs/traces.md
#include "sim/loop/replay.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "sim/loop/ensemble.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/traces/capture.hpp"

namespace feltgate {

RunResult run_replay(EncoderSource& source, const std::string& subject,
                     const ReplayOptions& options) {
  const BackendChoice choice = choose_backends(options.engine);
  if (choice.rider_drives && choice.riders.size() == 1) {
    throw std::invalid_argument(fmt::format(
        "engine \"{0}\" alone has nothing to be compared with here; choose twin,{0} or all",
        options.engine));
  }
  Ensemble core(options.design, choice, options.seed, source.initial(),
                Waveform{options.fst, options.fst_from, options.fst_to});
  const DesignInfo& d = core.design();
  if (d.current_full_scale_a > 0 || d.absolute || d.hall) {
    throw std::invalid_argument(
        fmt::format("design {} measures {}, which a recording does not have", d.name,
                    d.absolute ? "the angle by an absolute encoder"
                    : d.hall   ? "the motor's angle by Hall lines"
                               : "the motor's current"));
  }
  core.skip_self_test();
  core.set_control(scene_number(d, options.scene), 0, options.arm);
  core.cover(options.coverage);

  RunResult out;
  out.design = d.name;
  out.subject = subject;
  traces::StepCounter counter(source.initial());
  FeltMeter felt(1.0 / static_cast<double>(d.tick_hz), d.current_full_scale_a > 0);
  Row row;
  const auto tick = [&](const Snapshot& s) {
    ++out.ticks;
    BackendSignals now;
    core.signals(now, s);
    felt.tick(now.tau_ref_nm, now.torque_nm, s.limits, s.faults);
    if (!options.row || (out.ticks - 1) % options.row_every != 0) return;
    row.time_s = static_cast<double>(out.ticks) / static_cast<double>(d.tick_hz);
    core.fill(row, s);
    options.row(row);
  };

  // Blocks of a thousand ticks: long enough to be fast, short enough to show progress.
  const Clock block = 1000 * static_cast<Clock>(d.clocks_per_tick);
  std::vector<EncoderEvent> events;
  std::optional<EncoderEvent> pending = source.next();
  bool ended = false;
  while (!ended) {
    const Clock begin = core.lead().now();
    Clock end = begin + block;
    if (options.most_clocks > 0 && end >= options.most_clocks) {
      end = options.most_clocks;
      ended = true;
    }
    events.clear();
    while (pending && pending->clock < end) {
      events.push_back(*pending);
      counter.add(*pending);
      pending = source.next();
    }
    // The recording's length is known once its last event was read; the run ends at a whole tick.
    if (!pending && source.length() <= end) {
      const Clock whole =
          (source.length() + d.clocks_per_tick - 1) / d.clocks_per_tick * d.clocks_per_tick;
      if (whole <= end) {
        end = whole;
        ended = true;
      }
    }
    if (end > begin) {
      core.advance(end - begin, events.data(), events.data() + events.size(), tick);
    }
    if (options.progress) options.progress(core.lead().now());
  }
  // Two ticks more, so that the last edge is sampled too.
  core.advance(2 * d.clocks_per_tick, nullptr, nullptr, tick);
  out.clocks = core.lead().now();
  out.simulated_s = static_cast<double>(out.clocks) / static_cast<double>(d.clock_hz);
  note_mismatches(out, core.lead());
  out.position = {counter.result().steps, counter.result().illegal, counter.result().reversals};
  out.last_position = static_cast<std::int32_t>(counter.result().position);
  out.largest_velocity_rad_s = core.largest_velocity_rad_s();
  out.reference = choice.reference();
  out.engines = core.figures();
  out.felt = felt.felt();
  return out;
}

}  // namespace feltgate
