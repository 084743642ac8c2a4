// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Prints a run as text for a terminal. Documentation: docs/json.md
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "apps/commands/run_output.hpp"
#include "sim/loop/scenario_bounds.hpp"

namespace feltgate {

namespace {

std::string engine_line(const BackendFigures& e, double simulated_s) {
  const double speed = e.busy_s > 0 ? simulated_s / e.busy_s : 0;
  if (!e.compared) {
    return fmt::format("{:<8} {:>14} {:>12} {:>12} {:>12} {:>12} {:>12} {:>9.3g}x\n", e.name, "-",
                       "-", "-", "-", "-", "-", speed);
  }
  return fmt::format(
      "{:<8} {:>14.3g} {:>12.3g} {:>12.3g} {:>12.3g} {:>12.3g} {:>12.3g} {:>9.3g}x\n", e.name,
      e.velocity_rad_s.max(), e.velocity_rad_s.rms(), e.tau_hat_nm.max(), e.tau_hat_nm.rms(),
      e.torque_nm.max(), e.torque_nm.rms(), speed);
}

/// The bounds below the table of errors, and what there is in ticks for which they do not hold.
std::string bound_lines(const RunResult& r) {
  const auto line = [&r](const char* name, const auto& value) {
    const auto told = [&](std::size_t i) {
      const double x = value(r.felt.errors[i]);
      return std::isfinite(x) ? fmt::format("{:.3g}", x) : "none";
    };
    return fmt::format("{:<8} {:>14} {:>12} {:>12} {:>12} {:>12}\n", name, told(0), "", told(1), "",
                       told(2));
  };
  std::string text = line("bound", [](const FeltError& e) { return e.bound; });
  if (const auto outside = r.felt.errors.back().error.outside(); outside > 0) {
    text += line("outside", [](const FeltError& e) { return e.error.max_outside(); });
    text += fmt::format(
        "the bound is not for {} ticks, of a ramp or saturation and what follows: their largest "
        "errors are \"outside\", and in no other figure\n",
        outside);
  }
  return text +
         fmt::format(
             "bound: proven for any motion up to this one's {:.4g} rad/s before the "
             "low-pass\n",
             r.largest_velocity_rad_s) +
         r.bound_sources;
}

std::string engine_table(const RunResult& r) {
  std::string text = fmt::format("\n{:<8} {:>14} {:>12} {:>12} {:>12} {:>12} {:>12} {:>10}\n",
                                 "engine", "velocity max", "rms rad/s", "tau_hat max", "rms Nm",
                                 "command max", "rms Nm", "speed");
  for (const BackendFigures& e : r.engines) text += engine_line(e, r.simulated_s);
  if (r.reference.empty()) return text + "errors: none, for without double or quad among them\n";
  text += fmt::format(
      "errors against {} on the same sampled counts; \"command\" is the torque that the core "
      "commands\n",
      r.reference);
  if (r.felt.closed_loop) {
    text += fmt::format(
        "the motor's own torque was off from what the scene asked by {:.3g} Nm, rms {:.3g} Nm\n",
        r.felt.torque.motor_error.max(), r.felt.torque.motor_error.rms());
  }
  return r.felt.errors.empty() ? text : text + bound_lines(r);
}

std::string step_table(const RunResult& r) {
  for (const BackendFigures& e : r.engines) {
    if (e.steps.empty()) continue;
    std::string text =
        fmt::format("\n{:<10} {:>16} {:>16} {:>12} {:>14} {:>16}\n", "step Nm", "tau_hat settles",
                    "motor settles", "overshoot", "final error", "tau_hat error");
    for (const StepFigures& f : e.steps) {
      const auto observed = [&f](const char* format, double value) {
        return f.tau_hat_void ? std::string("void") : fmt::format(fmt::runtime(format), value);
      };
      text += fmt::format("{:<10.4g} {:>16} {:>13.3f} ms {:>10.2f} % {:>12.3f} % {:>16}\n",
                          f.tau_ref_nm, observed("{:.3f} ms", f.tau_hat.settling_ms),
                          f.torque.settling_ms, f.torque.overshoot_pct, f.torque.final_error_pct,
                          observed("{:.4f} %", f.tau_hat.final_error_pct));
    }
    return text;  // RTL and twin show the same
  }
  return {};
}

std::string line(const char* name, const std::string& text) {
  return fmt::format("  {:<14} {}\n", name, text);
}

}  // namespace

std::string acted_text(const std::map<std::string, Acted>& all) {
  std::vector<std::string> items;
  for (const auto& [name, a] : all) {
    items.push_back(fmt::format("{} {:.4g} s (from {:.4g} s)", name, a.seconds, a.first_s));
  }
  return items.empty() ? "none" : fmt::format("{}", fmt::join(items, ", "));
}

std::string large_error_lines(const SessionResult& r) {
  std::string text;
  for (const std::string& large : r.large) text += fmt::format("failed: {}\n", large);
  return text;
}

std::string stale_line(const Acted& stale) {
  if (stale.seconds == 0) return {};
  return fmt::format(
      "note: the law's mailbox is stale for {:.4g} s, from {:.4g} s: no torque then; add [feed] "
      "rate_hz (or raise it), or a longer max_age\n",
      stale.seconds, stale.first_s);
}

std::string energy_lines(const FeltEnergy& e) {
  const std::string owed =
      e.peak_to_hand_j > 0
          ? fmt::format("gave up to {:.3g} J more than it had taken", e.peak_to_hand_j)
          : "never gave more than it had taken";
  return line("energy", fmt::format("taken from the hand {:.4g} J, given to it {:.4g} J",
                                    e.taken_from_hand_j, e.given_to_hand_j)) +
         line("", fmt::format("net taken {:.4g} J, {:.4g} J at the peak; {}", e.net_from_hand_j(),
                              e.peak_from_hand_j, owed));
}

namespace {

std::string error_text(const FeltError& e) {
  const auto unit = e.signal == "velocity_rad_s" ? "rad/s" : "Nm";
  const auto name = e.signal == "velocity_rad_s" ? "velocity"
                    : e.signal == "tau_hat_nm"   ? "observed torque"
                                                 : "commanded torque";
  if (!std::isfinite(e.bound)) {
    return fmt::format("{} {:.3g} {}, no bound is proven", name, e.error.max(), unit);
  }
  const std::string outside =
      e.error.outside() > 0
          ? fmt::format(", and {:.3g} in ticks that the bound is not for", e.error.max_outside())
          : "";
  return fmt::format("{} {:.3g} {}, {} the proven {:.3g}{}", name, e.error.max(), unit,
                     e.holds() ? "within" : "ABOVE", e.bound, outside);
}

}  // namespace

std::string expectation_lines(const std::vector<Expected>& all) {
  std::vector<std::string> kept;
  std::string broken;
  for (const Expected& e : all) {
    if (e.kept()) {
      kept.push_back(e.figure);
    } else {
      broken +=
          line("broken", fmt::format("{} = {:.6g}, expected {}", e.figure, e.value, e.wanted()));
    }
  }
  const std::string none = all.empty() ? "none was checked" : "none";
  return line("kept", kept.empty() ? none : fmt::format("{}", fmt::join(kept, ", "))) + broken;
}

std::string felt_text(const RunResult& r) {
  const Felt& f = r.felt;
  std::string text =
      f.closed_loop ? "\nWhat was felt (motor and hand: means over 1 ms)\n" : "\nWhat was felt\n";
  const auto peak = [](const Peak& p) {
    return fmt::format("{:.4g} Nm at {:.4g} s", p.value, p.at_s);
  };
  text += line("asked", "up to " + peak(f.torque.asked));
  text += line("commanded", "up to " + peak(f.torque.commanded));
  if (f.closed_loop) {
    text += line("motor", fmt::format("up to {}; off from asked by up to {:.3g} Nm, rms {:.3g} Nm",
                                      peak(f.torque.motor), f.torque.motor_error.max(),
                                      f.torque.motor_error.rms()));
    text += line("hand", "up to " + peak(f.torque.hand));
    text += energy_lines(f.energy);
  }
  bool first = true;
  for (const FeltError& e : f.errors) {
    text += line(first ? "largest error" : "", error_text(e));
    first = false;
  }
  text += line("limits", acted_text(f.limits));
  if (f.tau_hat_void.seconds > 0) {
    text += line("tau_hat", fmt::format("void for {:.4g} s (from {:.4g} s): voltage or duty at the "
                                        "limit, the motor gives less than tau_hat says",
                                        f.tau_hat_void.seconds, f.tau_hat_void.first_s));
  }
  text += line("faults", acted_text(f.faults));
  if (f.closed_loop) text += expectation_lines(r.expectations);
  return text;
}

namespace {

/// Explains an unexpected result: constants that differ between plant and design.
std::string differing_lines(const RunLabels& labels) {
  if (labels.differing.empty()) return {};
  std::string text = "the plant is not the one that the design counts on:\n";
  for (const stability::Constant& c : labels.differing) {
    text += fmt::format("  {:<18} design {:.4g}, plant {:.4g} {}", c.name, c.of_design, c.of_plant,
                        c.unit);
    if (std::isfinite(c.excess())) text += fmt::format(" ({:+.1f} %)", 100 * c.excess());
    text += "\n";
  }
  return text +
         fmt::format(
             "a design for this plant: feltgate design --for-plant {} --nominal-current AMPERES -o "
             "rtl/designs/mine.toml\n",
             labels.plant_as_named);
}

}  // namespace

std::string run_text(const RunResult& r, const RunLabels& labels) {
  std::string text = large_error_lines(r);
  text += fmt::format("{} {}, design {}", labels.subject_key, r.subject, r.design);
  if (!labels.plant.empty()) text += fmt::format(", plant {}", labels.plant);
  text += fmt::format("\n{:.6g} s, {} clocks, {} ticks", r.simulated_s, r.clocks, r.ticks);
  if (r.lock_step) text += fmt::format("; mismatches between RTL and twin: {}", r.mismatches);
  text += labels.encoder.empty()
              ? fmt::format("\nencoder: {} step{}, {} illegal, {} reversal{}\n", r.position.steps,
                            r.position.steps == 1 ? "" : "s", r.position.illegal,
                            r.position.reversals, r.position.reversals == 1 ? "" : "s")
              : fmt::format("\nencoder: {}\n", labels.encoder);
  if (r.felt.closed_loop) {
    const bool longer = r.longest_step_clocks > labels.step_clocks;
    text += fmt::format("plant: steps of {}{} clocks; effects off: {}\n", labels.step_clocks,
                        longer ? fmt::format(" to {}", r.longest_step_clocks) : "",
                        labels.effects_off.empty()
                            ? "none"
                            : fmt::format("{}", fmt::join(labels.effects_off, " ")));
  }
  text += differing_lines(labels);
  if (!r.first_mismatch.empty()) text += fmt::format("first mismatch: {}\n", r.first_mismatch);
  if (r.engines.size() > 1) {
    text += engine_table(r);
  } else if (r.engines.front().busy_s > 0) {
    text += fmt::format("engine: {}, {:.3g} times real time\n", r.engines.front().name,
                        r.simulated_s / r.engines.front().busy_s);
  }
  text += step_table(r) + felt_text(r) + stale_line(r.law_stale);
  for (const std::string& jump : labels.speed_jumps) text += fmt::format("note: {}\n", jump);
  if (labels.never_armed_s > 0) {
    text += fmt::format("note: the motor never arms: arm_s = {:g}, and the scene ends at {:g} s\n",
                        labels.never_armed_s, r.simulated_s);
  }
  for (const std::string& note : labels.notes) text += fmt::format("note: {}\n", note);
  for (const std::string& broken : r.broken) text += fmt::format("not as expected: {}\n", broken);
  return text;
}

}  // namespace feltgate
