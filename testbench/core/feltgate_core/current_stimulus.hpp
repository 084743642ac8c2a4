// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The modulators of a current loop in a random run of a core: a winding, or three, that the core
// drives, with troubles. Documentation: docs/testing.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/core_ports.hpp"
#include "random.hpp"
#include "sim/plant/sigma_delta.hpp"

namespace feltgate::test {

/// The modulator at a winding that the duty in force drives; at times its line stands, it has an
/// offset, or the winding is shorted; or the driver has a fault.
class CurrentStimulus {
 public:
  void set(const CoreOut& out, CoreIn* in) {
    if (left_-- <= 0) {
      left_ = 1'000 + random_.below(150'000);
      trouble_ = random_.below(8);
      if (trouble_ < 3) left_ %= 20'000;
    }
    if (out.duty_active == 0) current_a_ = trouble_ == 3 ? 2 : 0;
    const double ohm = trouble_ == 0 ? 0.05 : 0.42;
    current_a_ += (out.duty_active * 0.024 - ohm * current_a_) * (20e-9 / 82e-6);
    const bool rises = out.current_clock && !clock_;
    clock_ = out.current_clock;
    if (rises) bit_ = modulator_.next(current_a_ + (trouble_ == 1 ? 40 : 0));
    in->current_data = trouble_ == 2 || bit_;
    in->driver_fault = trouble_ == 4 && left_ < 200;
  }

 private:
  Random random_{77};
  plant::SigmaDelta modulator_{32};
  double current_a_ = 0;
  std::int64_t left_ = 0;
  std::uint32_t trouble_ = 9;
  bool clock_ = false, bit_ = false;
};

/// The modulators at phases A and B of a winding between the six gates; at times a line stands or
/// has an offset, the winding is shorted, a phase is open, or the driver has a fault.
class PhasesStimulus {
 public:
  void set(const CoreOut& out, CoreIn* in) {
    if (left_-- <= 0) {
      left_ = 1'000 + random_.below(150'000);
      trouble_ = random_.below(30);
      which_ = random_.below(2);
      if (trouble_ < 3) left_ %= 20'000;
    }
    flow(out.gates);
    const bool rises = out.current_clock && !clock_;
    clock_ = out.current_clock;
    for (std::size_t n = 0; rises && n < 2; ++n) {
      const bool mine = n == which_;
      const double wrong_a = mine && trouble_ == 1 ? 4 : mine && trouble_ == 3 && idle_ ? 0.3 : 0;
      bits_[n] = modulators_[n].next(amperes_[n] + wrong_a) || (mine && trouble_ == 2);
    }
    in->current_data = static_cast<std::uint8_t>(bits_[0] | bits_[1] << 1);
    in->driver_fault = trouble_ == 4 && left_ < 200;
  }

 private:
  void flow(unsigned gates) {
    std::array<double, 3> volts{};
    double mean_v = 0;
    for (std::size_t l = 0; l < 3; ++l) {
      const bool hi = (gates >> 2 * l & 1u) != 0, lo = (gates >> 2 * l & 2u) != 0;
      volts[l] = hi || (!lo && amperes_[l] < 0) ? 5.0 : 0.0;
      mean_v += volts[l] / 3;
    }
    idle_ = gates == 0;
    const double ohm = trouble_ == 0 ? 0.2 : 2.9;
    for (std::size_t l = 0; l < 2; ++l) {
      amperes_[l] += (volts[l] - mean_v - ohm * amperes_[l]) * (20e-9 / 1e-3);
      if (idle_) amperes_[l] = 0;
    }
    if (trouble_ == 5) amperes_[which_] = 0;
    amperes_[2] = -amperes_[0] - amperes_[1];
  }

  Random random_{77};
  std::array<plant::SigmaDelta, 2> modulators_{plant::SigmaDelta{2}, plant::SigmaDelta{2}};
  std::array<double, 3> amperes_{};
  std::array<bool, 2> bits_{};
  std::int64_t left_ = 0;
  std::uint32_t trouble_ = 9, which_ = 0;
  bool clock_ = false, idle_ = true;
};

}  // namespace feltgate::test
