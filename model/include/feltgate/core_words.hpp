// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin: the snapshot words `status` and `faults`, assembled from single bits. Included
// by feltgate_core.hpp. Documentation: docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/feltgate_core.hpp"

namespace feltgate {

template <class D, bool ReadBack>
std::uint32_t FeltgateCore<D, ReadBack>::status(const In& in, bool encoder_error) const {
  using C = typename D::C;
  const auto& s = supervisor_.out();
  const auto field = [](auto value, int at) { return static_cast<std::uint32_t>(value) << at; };
  return field(wave_.limits(s.gates_enable), C::status_limits) |
         field(out_.scene, C::status_scene) | field(s.armed, C::status_armed) |
         field(mode(), C::status_mode) | field(self_test_.result(), C::status_self_test) |
         field(self_test_.busy(out_.armed) || in.axis_testing, C::status_testing) |
         field(loop_.driver_fault(), C::status_driver_fault) |
         field(loop_.missing(), C::status_current_missing) |
         field(encoder_error, C::status_encoder_error) |
         field(registers_.out().refused, C::status_refused) |
         field(registers_.out().saturated, C::status_saturated) |
         field(s.unkicked, C::status_unkicked);
}

template <class D, bool ReadBack>
std::uint32_t FeltgateCore<D, ReadBack>::faults() const {
  using C = typename D::C;
  const auto& s = supervisor_.out();
  return std::uint32_t{s.faults} << C::faults_seen |
         std::uint32_t{s.first_fault} << C::faults_first | loop_.state() << C::faults_current |
         absolute_state(decoder_) << C::faults_absolute;
}

}  // namespace feltgate
