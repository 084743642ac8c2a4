// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain in real arithmetic, tick by tick: the same laws and the same sampled counts as the
// core, so that the difference is quantisation and nothing else. Documentation:
// docs/architecture.md
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace feltgate {

/// What the wave of one tick starts from.
struct ChainIn {
  std::int32_t position = 0;  ///< counts
  std::int16_t travel = 0;    ///< counts, wrapping
  bool armed = false;
  int scene = 0;
  int mode = 0;
};

struct ChainOut {
  double velocity_rad_s = 0, tau_hat_nm = 0, tau_ref_nm = 0, current_a = 0, voltage_v = 0;
  double duty_clocks = 0;
};

class RealChain {
 public:
  virtual ~RealChain() = default;
  virtual const char* name() const = 0;
  virtual void reset() = 0;
  /// Exact value of the parameter at `address`, in its unit.
  virtual void set_parameter(int address, double value) = 0;
  virtual void tick(const ChainIn& in) = 0;
  virtual const ChainOut& out() const = 0;
};

/// Kinds: "double", "quad" (113 bits). Throws std::invalid_argument naming what there is.
std::unique_ptr<RealChain> make_real_chain(const std::string& design, const std::string& kind);

}  // namespace feltgate
