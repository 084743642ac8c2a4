// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Interface of a core that can be run: the Verilated RTL, the twin, or both in lock-step.
// Documentation: docs/architecture.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "feltgate/core_ports.hpp"
#include "feltgate/design_info.hpp"  // IWYU pragma: export
#include "feltgate/encoder_source.hpp"
#include "feltgate/generated/causes.hpp"  // IWYU pragma: export
#include "feltgate/parameter.hpp"

namespace feltgate {

constexpr std::size_t most_axes = 3;

/// The integers of one tick, as shown by the core when its snapshot is valid.
struct Snapshot {
  std::uint32_t tick = 0;
  std::int32_t position = 0;  ///< counts
  /// Raw, in the design's formats; duty in clocks of the PWM period.
  std::int64_t velocity = 0, tau_hat = 0, tau_ref = 0, current_ref = 0, voltage = 0, duty = 0;
  std::int32_t current = 0;  ///< measured by a current loop, [1,1,17] of full scale
  std::uint8_t scene = 0, first_fault = 0;
  std::uint16_t limits = 0, faults = 0;
  bool armed = false;
  // Not outputs of the RTL, hence not compared:
  std::int16_t travel = 0;  ///< sampled free-running count
  std::int64_t writes = 0;  ///< register writes executed before this tick
  /// For the scene law: whether a run of the program began with the samples of this tick; whether
  /// it is known from which samples the torque in force comes, and their tick.
  bool law_begins = false, law_known = false;
  std::uint32_t law_tick = 0;
  std::int64_t law_changes = 0;  ///< parameter sets that had come into force when that run began
  bool law_restart = false;      ///< the law's torque might jump in this tick
  bool law_stale = false;        ///< a mailbox of the law is too old: its torque is 0

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
        current(o.current),
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
           voltage == o.voltage && duty == o.duty && current == o.current && scene == o.scene &&
           limits == o.limits && faults == o.faults && first_fault == o.first_fault &&
           armed == o.armed;
  }
};

/// An event of a law: its number in the file, its value as a word, the tick.
struct LawEvent {
  int number = 0;
  std::int32_t value = 0;
  std::uint32_t tick = 0;
};

/// Switches and pins of the board's panel.
struct Panel {
  bool arm = false;
  bool stop = false;
  std::uint8_t scene = 0;
};

/// Hall lines that change once at most; bit n: line n.
struct HallChange {
  std::uint8_t before = 0, after = 0;
  Clock at = 0;  ///< first clock of `after`
  std::uint8_t code(Clock now) const { return now < at ? before : after; }
};

/// Clocks for which each gate was on, such as during the last advance().
struct GateClocks {
  std::int64_t a_hi = 0, a_lo = 0, b_hi = 0, b_lo = 0;
  std::int64_t c_hi = 0, c_lo = 0;  ///< of a bridge with three phases

  /// Counts a clock with these gates on, as in CoreOut.
  void add(unsigned on) {
    a_hi += on & 1U;
    a_lo += on >> 1 & 1U;
    b_hi += on >> 2 & 1U;
    b_lo += on >> 3 & 1U;
    c_hi += on >> 4 & 1U;
    c_lo += on >> 5 & 1U;
  }
};

/// What every back-end has, whatever its number of axes.
class AnyBackend {
 public:
  virtual ~AnyBackend() = default;
  virtual const char* name() const = 0;
  virtual const DesignInfo& design() const = 0;
  virtual int axes() const { return 1; }

  /// Queues a register write; one is executed per tick, in order. Axis n begins at n * axes_stride.
  virtual void write(int address, std::uint32_t data) = 0;
  /// Sets the stop pin from now() on.
  virtual void stop(bool pressed) = 0;
  /// Breaks an absolute encoder, or mends it: AbsoluteSensor::defects. Errors:
  /// std::invalid_argument where there is none.
  virtual void break_encoder(const std::string& defect);
  /// Clocks since reset.
  virtual Clock now() const = 0;

  /// Writes a waveform of the clocks [from, to] of the next run (to < 0: to its end); call it
  /// before reset(). Errors: std::invalid_argument for a back-end without RTL.
  virtual void trace(const std::string& path, Clock from, Clock to);

  /// Lock-step back-ends: number of clocks in which an output differed, and the first difference.
  virtual std::int64_t mismatches() const { return 0; }
  virtual std::string first_mismatch() const { return {}; }
  virtual Clock first_mismatch_clock() const { return 0; }
};

/// A core of one design, with encoder pins, panel and register writes as inputs.
class Backend : public AnyBackend {
 public:
  /// Power-up and reset; `seed` fills the state that reset does not define.
  virtual void reset(std::uint64_t seed, EncoderPins pins) = 0;
  /// Sets the panel's inputs from now() on.
  virtual void set_panel(const Panel& panel) = 0;
  void stop(bool pressed) override {
    Panel panel;
    panel.stop = pressed;
    set_panel(panel);
  }

  /// Sets the bits of a current loop's modulators from now() on; bit n: of modulator n.
  virtual void set_current_bits(std::uint8_t bits) = 0;
  /// Hall lines of the motor from now() on.
  virtual void set_hall(const HallChange& lines) = 0;
  /// The shaft of an absolute encoder turns between these angles in the next `clocks`.
  virtual void turn_encoder(double from_rad, double to_rad, Clock clocks) = 0;

  /// Advances `clocks` clocks from now(). Pin events are in order, at absolute clocks; an event
  /// after the end is kept for the next call.
  virtual void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) = 0;

  /// Snapshots that became valid during the last advance().
  virtual const std::vector<Snapshot>& snapshots() const = 0;
  virtual GateClocks gates() const = 0;
  /// All events of the law since reset(), at most the first 65536; empty for an engine without a
  /// law. Call it only at the end of a run: it may change how the engine computes, but not its
  /// results.
  virtual std::vector<LawEvent> law_events() { return {}; }
  /// Duty in force in the bridge, in clocks of the PWM period, and whether the gates are enabled.
  virtual int duty() const = 0;
  virtual bool gates_enabled() const = 0;
  /// Of a bridge with three phases: FeltgateCore::on_time() of a leg. Errors: std::invalid_argument
  /// for a back-end of the RTL alone, which shows its gates only.
  virtual int on_time(std::size_t leg) const;
  /// Lock-step back-ends: time spent in one half ("rtl" or "twin"), s.
  virtual double busy_s(const std::string& half) const {
    (void)half;
    return 0;
  }
};

/// Makes a back-end of a design of one axis, which design_named() knows. Kinds: "twin"; "rtl" and
/// "lockstep" where the program has the Verilated core of the design. Errors: std::invalid_argument
/// that names the choices.
std::unique_ptr<Backend> make_backend(const std::string& design, const std::string& kind);
/// Names of the designs of rtl/designs.
std::vector<std::string> design_names();
/// A design by its name in rtl/designs, or by the path of its file, which has a / or ends with
/// .toml. It is read once. Errors: std::invalid_argument that names the choices; those of the file.
const DesignInfo& design_named(const std::string& design);

/// Where the functions above find designs. feltgate_backends sets the files that it was built with,
/// before main(); a program may set others.
struct DesignSource {
  std::function<DesignInfo(const std::string&)> named;
  std::function<std::vector<std::string>()> names;
};
void set_design_source(DesignSource source);

/// Adds the Verilated core of a design, before main(). `design_crc`: of the design that it was made
/// of; another one's core is refused.
using RtlMaker = std::unique_ptr<Backend> (*)(const DesignInfo& design, bool lock_step);
bool add_rtl(const std::string& design, std::uint32_t design_crc, RtlMaker maker);
/// Refuses a Verilated core, of a file that has changed since it was made.
void require_rtl_of(const DesignInfo& design, std::uint32_t design_crc);

/// Integer of a parameter for a value in its unit, rounded to nearest. Errors:
/// std::invalid_argument with the range if it does not fit.
std::int64_t quantise_parameter(const ParameterInfo& info, double value);
/// The control word of a host that has control, with this scene, mode and request to arm.
std::uint32_t control_word(const DesignInfo& design, int scene, int mode, bool arm);

}  // namespace feltgate
