// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One interface to the chain, tick by tick, in fixed point and in real arithmetic. Laws and sampled
// counts are those of the core, so the only difference is quantisation. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "feltgate/generated/causes.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Limits of the core that a chain does not have.
inline constexpr unsigned limits_of_core = limit::gates_closed | limit::hold | limit::chatter;

/// Conditions that keep a torque from growing.
struct Relief {
  bool frozen = false;   ///< the reference may only move towards 0
  bool derated = false;  ///< hold_limit limits too
};
/// The relief that bits of a core's limits word stand for.
constexpr Relief relief_of(unsigned limits) {
  return {((limits >> Map::L::chatter) & 1U) != 0, ((limits >> Map::L::hold) & 1U) != 0};
}

/// Inputs of one tick.
struct ChainIn {
  std::int32_t position = 0;  ///< counts
  std::int16_t travel = 0;    ///< counts, wrapping
  bool armed = false;
  int scene = 0;
  int mode = 0;
  bool restart = false;      ///< the torque may jump, so it ramps
  Relief relief{};           ///< from the encoder's monitor and the hold timer of the core
  std::int32_t current = 0;  ///< measured, in the current's format
};

struct ChainOut {
  double velocity_rad_s = 0, tau_hat_nm = 0, tau_ref_nm = 0, current_a = 0, voltage_v = 0;
  double duty_clocks = 0;
};

/// The integers of a tick in fixed point, as in a snapshot of the core.
struct ChainRaw {
  std::int64_t velocity = 0;
  std::int32_t tau_hat = 0, tau_ref = 0, current_ref = 0, voltage = 0;
  std::int16_t duty = 0;
  std::uint16_t limits = 0;  ///< Snapshot::limits without limits_of_core
};

class RealChain {
 public:
  virtual ~RealChain() = default;
  virtual const char* name() const = 0;
  /// Restores the state after a reset and the parameters of the design.
  virtual void reset() = 0;
  /// Exact value of the parameter at `address`, in its unit; "fixed" rounds it to its word and
  /// throws std::invalid_argument when it does not fit.
  virtual void set_parameter(int address, double value) = 0;
  /// Sets a parameter by its word in the parameter RAM; real arithmetic uses the word's value.
  virtual void set_word(int address, std::uint32_t word) = 0;
  /// Sets the program's torque [Nm] for the scene law in the following ticks; "fixed" rounds it.
  virtual void program(double torque_nm) { (void)torque_nm; }
  virtual void tick(const ChainIn& in) = 0;
  /// Signals of the last tick in their units; "fixed" scales its integers, which is exact.
  virtual const ChainOut& out() const = 0;
  /// Whether the torque reference ramped in the last tick.
  virtual bool ramping() const = 0;
  /// Integers of the last tick; nullptr in real arithmetic.
  virtual const ChainRaw* raw() const { return nullptr; }
};

/// Makes a chain. Kinds: "fixed" (the core's integers), "float", "double", "quad" (113 bits).
/// Throws std::invalid_argument with the known names for an unknown one.
std::unique_ptr<RealChain> make_real_chain(const std::string& design, const std::string& kind);

}  // namespace feltgate
