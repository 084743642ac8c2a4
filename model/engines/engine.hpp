// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core that can be run: the Verilated RTL, the twin, or both in lock-step.
// Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "feltgate/core_ports.hpp"
#include "feltgate/encoder_source.hpp"
#include "feltgate/parameter.hpp"

namespace feltgate {

/// The integers of one tick, as the core shows them when its snapshot is valid.
struct Snapshot {
  std::uint32_t tick = 0;
  std::int32_t position = 0;  ///< counts
  std::int64_t velocity = 0, tau_hat = 0, tau_ref = 0, current_ref = 0, voltage = 0, duty = 0;
  std::uint8_t scene = 0, limits = 0, faults = 0, first_fault = 0;
  bool armed = false;
  // Not shown by the RTL, hence not compared:
  std::int16_t travel = 0;  ///< sampled free-running count
  std::int64_t writes = 0;  ///< register writes carried out before this wave

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
        limits(o.limits),
        faults(o.faults),
        first_fault(o.first_fault),
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

/// Bits of Snapshot::limits: which limit holds the torque now.
namespace limit {
constexpr unsigned torque = 1;  ///< torque reference at its limit
constexpr unsigned ramp = 2;    ///< ramping after arming or a change of scene
constexpr unsigned current = 4;
constexpr unsigned voltage = 8;
constexpr unsigned duty = 16;
constexpr unsigned velocity = 32;  ///< the raw velocity saturated its format
constexpr unsigned tau_hat = 64;   ///< tau_hat saturated its format
constexpr unsigned gates_closed = 128;
/// By the number of the bit.
inline constexpr std::array<const char*, 8> names{"torque", "ramp",     "current", "voltage",
                                                  "duty",   "velocity", "tau_hat", "gates_closed"};
}  // namespace limit

/// Bits of Snapshot::faults by number; as the causes of the supervisor (Fault).
inline constexpr std::array<const char*, 7> fault_names{"none", "encoder",  "speed", "polarity",
                                                        "i2t",  "watchdog", "stop"};

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

/// Bits of the control word.
struct ControlBits {
  int host = 0, arm = 0, scene = 0, mode = 0;
};

/// What a design looks like at run time.
struct DesignInfo {
  const char* name = "";
  std::int64_t clock_hz = 0, tick_hz = 0;
  int clocks_per_tick = 0, pwm_period = 0, dead_clocks = 0, pwm_mode = 0;
  int m1 = 0;                  ///< ticks of the N-method's window
  double rad_s_per_count = 0;  ///< what it makes of a count in that window
  double count_rad = 0, supply_v = 0;
  Format velocity{}, torque{}, current{}, voltage{};
  double torque_constant_nm_a = 0;
  const ParameterInfo* parameters = nullptr;
  int parameter_count = 0;
  int control_address = 0, command_address = 0;
  ControlBits control;
  std::uint32_t control_reset = 0;
  std::function<int(const std::string&)> scene_number;  ///< -1: no such scene, or not built

  const ParameterInfo* find(const std::string& name) const;
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

/// A design that is not in rtl/designs (those of tests): makers by kind, as the two functions
/// make_engine and make_real_chain know them. design_names() does not list it.
class RealChain;
struct DesignMakers {
  std::string name;
  std::unique_ptr<Engine> (*engine)(const std::string& kind);
  std::unique_ptr<RealChain> (*chain)(const std::string& kind);
};
void add_design(const DesignMakers& design);

/// Makes "rtl" and "lockstep" of the designs built in. Set by the library feltgate_rtl before
/// main(); nobody else needs to.
using RtlMaker = std::unique_ptr<Engine> (*)(const std::string& design, const std::string& kind);
void provide_rtl_engines(RtlMaker maker);

/// Integer of a parameter for a value in its unit, rounded to nearest.
/// Throws std::invalid_argument when it does not fit, with the range.
std::int64_t quantise_parameter(const ParameterInfo& info, double value);

}  // namespace feltgate
