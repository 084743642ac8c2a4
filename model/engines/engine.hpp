// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core that can be run: the Verilated RTL, the twin, or both in lock-step.
// Documentation: docs/architecture.md
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "feltgate/core_ports.hpp"
#include "feltgate/design_info.hpp"  // IWYU pragma: export
#include "feltgate/encoder_source.hpp"
#include "feltgate/generated/causes.hpp"  // IWYU pragma: export
#include "feltgate/parameter.hpp"

namespace feltgate {

/// The integers of one tick, as the core shows them when its snapshot is valid.
struct Snapshot {
  std::uint32_t tick = 0;
  std::int32_t position = 0;  ///< counts
  std::int64_t velocity = 0, tau_hat = 0, tau_ref = 0, current_ref = 0, voltage = 0, duty = 0;
  std::uint8_t scene = 0, first_fault = 0;
  std::uint16_t limits = 0, faults = 0;
  bool armed = false;
  // Not shown by the RTL, hence not compared:
  std::int16_t travel = 0;  ///< sampled free-running count
  std::int64_t writes = 0;  ///< register writes carried out before this wave
  /// Of the scene law: a run of the program began with the samples of this tick; the tick of the
  /// samples from which the torque in force comes, and whether there is one.
  bool law_begins = false, law_known = false;
  std::uint32_t law_tick = 0;
  std::int64_t law_changes = 0;  ///< sets of parameters that had come into force by then
  bool law_restart = false;      ///< this wave began with a torque of the law that may jump
  bool law_stale = false;        ///< a mailbox of the law is too old, which asks for no torque

  Snapshot() = default;
  Snapshot(const CoreOut& o, std::int16_t sampled_travel, std::int64_t writes_before)
      : tick(o.tick_count),
        position(o.position),
        velocity(o.velocity),
        tau_hat(o.tau_hat),
        tau_ref(o.tau_ref),
        current_ref(o.current_ref),
        voltage(o.voltage),
        duty(o.duty),
        scene(o.scene),
        first_fault(o.first_fault),
        limits(o.limits),
        faults(o.faults),
        armed(o.armed),
        travel(sampled_travel),
        writes(writes_before) {}
  bool operator==(const Snapshot& o) const {
    return tick == o.tick && position == o.position && velocity == o.velocity &&
           tau_hat == o.tau_hat && tau_ref == o.tau_ref && current_ref == o.current_ref &&
           voltage == o.voltage && duty == o.duty && scene == o.scene && limits == o.limits &&
           faults == o.faults && first_fault == o.first_fault && armed == o.armed;
  }
};

/// What a law tells the host: the event's number in the file, its value as a word, the tick.
struct LawEvent {
  int number = 0;
  std::int32_t value = 0;
  std::uint32_t tick = 0;
};

/// Switches and pins of the board.
struct Panel {
  bool arm = false;
  bool stop = false;
  std::uint8_t scene = 0;
};

/// Clocks for which each gate was on during the last advance().
struct GateClocks {
  std::int64_t a_hi = 0, a_lo = 0, b_hi = 0, b_lo = 0;
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual const char* name() const = 0;
  virtual const DesignInfo& design() const = 0;

  /// Power-up and reset; `seed` fills what reset leaves open.
  virtual void reset(std::uint64_t seed, EncoderPins pins) = 0;
  virtual void set_panel(const Panel& panel) = 0;
  /// Queues a register write; one is carried out per tick, in order.
  virtual void write(int address, std::uint32_t data) = 0;

  /// Runs `clocks` clocks from now(). Pin events are in order, at absolute clocks; an event later
  /// than the end is kept for the next call.
  virtual void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) = 0;

  virtual Clock now() const = 0;
  /// Snapshots that became valid during the last advance().
  virtual const std::vector<Snapshot>& snapshots() const = 0;
  virtual GateClocks gates() const = 0;
  /// false: nobody will ask for gates(), which then need not be kept up; before the first
  /// advance().
  virtual void keep_gate_times(bool) {}
  /// All that the law has told since reset(), the first 65536; of an engine without one none. Only
  /// at the end of a run: it may change how the engine goes on, not what it does.
  virtual std::vector<LawEvent> law_events() { return {}; }
  /// Duty in force in the bridge, in clocks of the PWM period, and whether the gates are open.
  virtual int duty() const = 0;
  virtual bool gates_enabled() const = 0;

  /// Writes a waveform of the clocks [from, to] of the next run (to < 0: to its end); before
  /// reset(). Throws std::invalid_argument where there is no RTL to look into.
  virtual void trace(const std::string& path, Clock from, Clock to);

  /// Lock-step engines: time spent in one half ("rtl" or "twin").
  virtual double busy_s(const std::string& half) const {
    (void)half;
    return 0;
  }
  /// Lock-step engines: number of clocks in which any output differed, and the first difference.
  virtual std::int64_t mismatches() const { return 0; }
  virtual std::string first_mismatch() const { return {}; }
  virtual Clock first_mismatch_clock() const { return 0; }
};

/// Engines of the designs that were built in. Kinds: "twin"; "rtl" and "lockstep" where
/// feltgate_rtl is linked. Throws std::invalid_argument naming what there is.
std::unique_ptr<Engine> make_engine(const std::string& design, const std::string& kind);
std::vector<std::string> design_names();
/// What is known of a design without an engine of it: rates, formats, parameters.
/// Throws like make_engine().
DesignInfo design_named(const std::string& design);

/// What the functions above know of a design, and make_device(), which needs `device`. Added before
/// main() by what is linked: feltgate_engines adds those of rtl/designs that are no presets, a
/// program of a preset adds that one. design_names() lists no preset.
class Device;
class RealChain;
struct DesignMakers {
  std::string name;
  std::unique_ptr<Engine> (*engine)(const std::string& kind);
  std::unique_ptr<RealChain> (*chain)(const std::string& kind);
  DesignInfo (*info)();
  std::unique_ptr<Device> (*device)() = nullptr;
  bool preset = true;
};
/// The last of a name is the one that is made; those of rtl/designs come first.
void add_design(const DesignMakers& design);

/// Makes "rtl" and "lockstep" of the designs built in. Set by the library feltgate_rtl before
/// main(); nobody else needs to.
using RtlMaker = std::unique_ptr<Engine> (*)(const std::string& design, const std::string& kind);
void provide_rtl_engines(RtlMaker maker);
/// Calls it. Throws std::invalid_argument where the library is not linked, and for another kind.
std::unique_ptr<Engine> make_rtl_engine(const std::string& design, const std::string& kind);

/// Integer of a parameter for a value in its unit, rounded to nearest.
/// Throws std::invalid_argument when it does not fit, with the range.
std::int64_t quantise_parameter(const ParameterInfo& info, double value);

}  // namespace feltgate
