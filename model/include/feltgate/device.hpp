// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin as a device in SI units: encoder in, torque and duty out, parameters and scenes by name.
// Every clock goes through FeltgateCore, so that the bits are the core's.
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

/// How the torque is made.
enum class Control { closed_loop = 0, open_loop = 1, voltage = 2 };

/// A parameter with what its word can hold, all in `unit`.
struct Parameter {
  std::string_view name, unit;
  double value = 0;  ///< last set, as rounded to the word
  double low = 0, high = 0, step = 0;
};

/// A device of any design; TwinDevice<Lever> below is one, make_device("lever") of feltgate::sim
/// another. Requests (parameters, scene, arming) act with the ticks to come, as on the pins.
class Device {
 public:
  virtual ~Device() = default;
  const DesignInfo& design() const { return design_; }
  /// Duration of a tick, s.
  double tick_s() const { return 1.0 / static_cast<double>(design_.tick_hz); }

  /// One clock with these levels at the encoder's pins.
  const CoreOut& clock(EncoderPins encoder);
  /// The rest of the running tick with these levels.
  const Reading& tick(EncoderPins encoder);
  /// The rest of the running tick, in which the lever moves evenly to this angle; pins as of an
  /// ideal encoder. Errors: std::invalid_argument where it crosses more than an edge per clock.
  const Reading& tick_to(double angle_rad);
  /// `clocks` clocks with these pin changes, in order, at absolute clocks from now() to the end of
  /// the stretch. Errors: std::invalid_argument for a later one.
  void run(Clock clocks, const std::vector<EncoderEvent>& events);

  /// Asks for torque; whatever edges that takes. Errors: std::runtime_error while a fault is
  /// latched or the stop is pressed. A fault or a stop ends the request.
  void arm();
  void disarm();
  bool armed() const { return out().armed; }
  void stop(bool pressed);
  /// Forgets the latched faults and disarms.
  void clear_faults();
  /// The angle of now reads 0 from then on; tick_to() keeps its own zero.
  void set_zero() { write(design_.command_address, 1u << design_.command.set_zero); }

  /// What is rendered: "free", "wall", ... Errors: std::invalid_argument with what there is.
  void select(const std::string& scene);
  /// Errors: std::runtime_error while armed.
  void set_control(Control how);
  /// A parameter in its unit (docs/registers.md), rounded to its word. Writes act in order, one at
  /// the end of each tick. Errors: std::invalid_argument with the nearest name or the range;
  /// std::runtime_error while armed for one that an armed core refuses (docs/registers.md).
  void set(const std::string& parameter, double value);
  Parameter parameter(const std::string& name) const;
  std::vector<Parameter> parameters() const;
  /// Writes that have not acted yet.
  std::size_t pending() const { return writes_.size(); }
  /// Counts of an angle: the unit of positions among the parameters.
  double counts(double angle_rad) const { return angle_rad / design_.count_rad; }

  /// The last tick whose snapshot has come.
  const Reading& reading() const { return reading_; }
  /// What the bridge does in this clock: a share of the supply, and whether its gates are open.
  double bridge_duty() const { return out().duty_active / static_cast<double>(design_.pwm_period); }
  bool gates_enabled() const { return out().gates_enable; }
  /// Clocks since reset.
  Clock now() const { return now_; }
  /// Pins of the last clock, raw, both ways.
  const CoreIn& inputs() const { return in_; }
  virtual const CoreOut& out() const = 0;

 protected:
  explicit Device(DesignInfo design);
  /// Clocks of the core with the inputs held; `stretch` with every snapshot noted.
  virtual void step(const CoreIn& in) = 0;
  virtual void stretch(const CoreIn& in, Clock clocks) = 0;
  void note(const CoreOut& snapshot) { reading_ = reading_of(design_, snapshot); }

 private:
  void write(int address, std::uint32_t data);
  /// An armed core drops a write there; it waits until the core is disarmed, and arming for it.
  bool holds(int address) const;
  void refuse_while_armed(const std::string& what) const;
  int clock_of_tick() const { return static_cast<int>(now_ % design_.clocks_per_tick); }
  Clock end_of_tick() const { return now_ + design_.clocks_per_tick - clock_of_tick(); }
  void begin_tick();
  void advance(Clock until);
  const ParameterInfo& find(const std::string& name) const;

  DesignInfo design_;
  CoreIn in_;
  Reading reading_;
  Clock now_ = 0;
  std::int64_t count_ = 0;  ///< where tick_to() has moved its encoder
  std::deque<std::pair<std::uint16_t, std::uint32_t>> writes_;
  std::vector<std::int64_t> raw_;  ///< of the parameters, in their order
  int held_ = 0;                   ///< writes that only a disarmed core takes
  bool wanted_ = false;            ///< to be armed
  bool low_before_ = false;        ///< the request was low at the end of the tick before
  bool clearing_ = false;          ///< clear_faults() has yet to act
  bool cleared_ = false;           ///< its write is on its way in this tick
};

/// The twin of design D as a device.
template <class D>
class TwinDevice final : public Device {
 public:
  TwinDevice() : Device(design_info<D>()) {}
  const CoreOut& out() const override { return core_.out(); }
  const FeltgateCore<D>& core() const { return core_; }

 private:
  void step(const CoreIn& in) override {
    core_.clock(in);
    if (core_.out().snapshot_valid) note(core_.out());
  }
  void stretch(const CoreIn& in, Clock clocks) override {
    core_.run(in, clocks, [this] { note(core_.out()); });
  }

  FeltgateCore<D> core_;
};

}  // namespace feltgate

#include "feltgate/device_run.hpp"  // IWYU pragma: export
