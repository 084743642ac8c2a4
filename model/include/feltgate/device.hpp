// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin as a device in SI units: encoder in, torque and duty out, parameters and scenes by name.
// Every clock goes through FeltgateCore, so the results equal the core's bit by bit.
// Documentation: docs/library.md
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "feltgate/core_ports.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/encoder_source.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/reading.hpp"
#include "feltgate/while_armed.hpp"

namespace feltgate {

/// The control mode: current from torque and tau_hat; from torque alone; or a voltage set-point.
enum class Control { closed_loop = 0, open_loop = 1, voltage = 2 };

/// A parameter with the range of its word; all values are in `unit`.
struct Parameter {
  std::string_view name, unit;
  double value = 0;  ///< the last value set, rounded to the word
  double low = 0, high = 0, step = 0;
};

/// A device of any design; TwinDevice below is the twin's, make_device("lever") of feltgate::sim
/// makes one by the name of its design. Requests (parameters, scene, arming) take effect with the
/// next ticks, as at the pins.
class Device {
 public:
  virtual ~Device() = default;
  const DesignInfo& design() const { return design_; }
  /// Duration of a tick, s.
  double tick_s() const { return 1.0 / static_cast<double>(design_.tick_hz); }

  /// Advances one clock with these levels at the encoder's pins.
  const CoreOut& clock(EncoderPins encoder);
  /// Advances to the end of the running tick with these levels.
  const Reading& tick(EncoderPins encoder);
  /// Advances to the end of the running tick, while the lever moves evenly to this angle; the pins
  /// are those of an ideal encoder. Errors: std::invalid_argument for more than one edge per clock.
  const Reading& tick_to(double angle_rad);
  /// Advances `clocks` clocks with these pin changes, in order. Their clocks are absolute, from
  /// now() to the end of the stretch. Errors: std::invalid_argument for a later one.
  void run(Clock clocks, const std::vector<EncoderEvent>& events);

  /// Requests torque, and makes the edges that the arm request needs. A fault or a stop ends the
  /// request. Errors: std::runtime_error while a fault is latched or the stop is pressed.
  void arm();
  void disarm();
  bool armed() const { return out().armed; }
  void stop(bool pressed);
  /// Clears the latched faults and disarms.
  void clear_faults();
  /// The present angle reads 0 from then on; tick_to() keeps its own zero.
  void set_zero() { write(design_.command_address, 1u << design_.command.set_zero); }

  /// Selects the scene: "free", "wall", ... Errors: std::invalid_argument, which names the choices.
  void select(const std::string& scene);
  /// Errors: std::runtime_error while armed.
  void set_control(Control how);
  /// Sets a parameter in its unit (docs/registers.md), rounded to its word. Writes take effect in
  /// order, one at the end of each tick. Errors: std::invalid_argument with the nearest name or the
  /// range; std::runtime_error while armed, for a parameter that an armed core refuses
  /// (docs/registers.md).
  void set(const std::string& parameter, double value);
  Parameter parameter(const std::string& name) const;
  std::vector<Parameter> parameters() const;
  /// Number of writes that have not taken effect yet.
  std::size_t pending() const { return writes_.size(); }
  /// An angle in counts, the unit of positions among the parameters; not rounded.
  double counts(double angle_rad) const { return angle_rad / design_.count_rad; }

  /// The last tick with a snapshot.
  const Reading& reading() const { return reading_; }
  /// The bridge in this clock: its duty as a share of the supply, and whether its gates are
  /// enabled.
  double bridge_duty() const { return out().duty_active / static_cast<double>(design_.pwm_period); }
  bool gates_enabled() const { return out().gates_enable; }
  /// Clocks since reset.
  Clock now() const { return now_; }
  /// Inputs and outputs of the core in the last clock, raw.
  const CoreIn& inputs() const { return in_; }
  virtual const CoreOut& out() const = 0;

 protected:
  explicit Device(DesignInfo design);
  /// Advances the core one clock; stretch() advances `clocks` clocks and notes every snapshot.
  virtual void step(const CoreIn& in) = 0;
  virtual void stretch(const CoreIn& in, Clock clocks) = 0;
  void note(const CoreOut& snapshot) { read(design_, snapshot, reading_); }

 private:
  void write(int address, std::uint32_t data);
  /// Whether an armed core drops a write to this address. Such a write waits until the core is
  /// disarmed, and arming waits for the write.
  bool holds(int address) const;
  void refuse_while_armed(const std::string& what) const;
  int clock_of_tick() const { return static_cast<int>(now_ % design_.clocks_per_tick); }
  Clock end_of_tick() const { return now_ + design_.clocks_per_tick - clock_of_tick(); }
  void begin_tick(const CoreOut& now);
  void advance(Clock until);
  const ParameterInfo& find(const std::string& name) const;

  DesignInfo design_;
  CoreIn in_;
  Reading reading_;
  Clock now_ = 0;
  std::int64_t count_ = 0;  ///< count of the encoder that tick_to() moves
  std::deque<std::pair<std::uint16_t, std::uint32_t>> writes_;
  std::vector<std::int64_t> raw_;  ///< words of the parameters, in their order
  int held_ = 0;                   ///< waiting writes that only a disarmed core takes
  bool wanted_ = false;            ///< arming is requested
  bool low_before_ = false;        ///< the request was low at the end of the last tick
  bool clearing_ = false;          ///< clear_faults() has not taken effect yet
  bool cleared_ = false;           ///< its write is sent in this tick
};

/// The twin of a design as a device: TwinDevice(design_info<Lever>()).
class TwinDevice final : public Device {
 public:
  explicit TwinDevice(const DesignInfo& design) : Device(design), core_(design.data) {}
  const CoreOut& out() const override { return core_.out(); }
  const FeltgateCore& core() const { return core_; }

 private:
  void step(const CoreIn& in) override {
    core_.clock(in);
    if (core_.out().snapshot_valid) note(core_.out());
  }
  void stretch(const CoreIn& in, Clock clocks) override {
    core_.run(in, clocks, [this] { note(core_.out()); });
  }

  FeltgateCore core_;
};

}  // namespace feltgate

#include "feltgate/device_run.hpp"  // IWYU pragma: export
