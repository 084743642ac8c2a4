// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain tick by tick behind one interface, in fixed point and in real arithmetic: the same laws
// and the same sampled counts as the core, so that the difference is quantisation and nothing
// else. Documentation: docs/engines.md
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "feltgate/generated/causes.hpp"
#include "feltgate/ramp.hpp"

namespace feltgate {

/// Limits that a chain knows nothing of.
inline constexpr unsigned limits_of_core = limit::gates_closed | limit::hold | limit::chatter;

/// What the wave of one tick starts from.
struct ChainIn {
  std::int32_t position = 0;  ///< counts
  std::int16_t travel = 0;    ///< counts, wrapping
  bool armed = false;
  int scene = 0;
  int mode = 0;
  bool restart = false;  ///< the torque may jump: it ramps
  Relief relief{};       ///< as the encoder's monitor and the hold timer of the core say
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
  /// The state after a reset and the parameters of the design.
  virtual void reset() = 0;
  /// Exact value of the parameter at `address`, in its unit; "fixed" rounds it to its word and
  /// throws std::invalid_argument when it does not fit.
  virtual void set_parameter(int address, double value) = 0;
  /// The same as a word of the parameter RAM: real arithmetic takes the value that the word means.
  virtual void set_word(int address, std::uint32_t word) = 0;
  /// What a program asks for [Nm], for the scene law, in the ticks to come; "fixed" rounds it.
  virtual void program(double torque_nm) { (void)torque_nm; }
  virtual void tick(const ChainIn& in) = 0;
  /// Signals of the last tick in their units; "fixed" scales its integers, which is exact.
  virtual const ChainOut& out() const = 0;
  /// Whether the torque reference ramped in the last tick.
  virtual bool ramping() const = 0;
  /// Integers of the last tick; nullptr in real arithmetic.
  virtual const ChainRaw* raw() const { return nullptr; }
};

/// Kinds: "fixed" (the core's integers), "float", "double", "quad" (113 bits).
/// Throws std::invalid_argument naming what there is.
std::unique_ptr<RealChain> make_real_chain(const std::string& design, const std::string& kind);

}  // namespace feltgate
