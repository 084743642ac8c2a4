// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Design `lever` whose observer can be fed back by its word observer_gain. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <array>

#include "feltgate/generated/lever.hpp"

namespace feltgate::controllers {

/// Wide enough for an observer that is fed back; `lever` feeds none back.
constexpr Format observer_gain{1, 3, 14};

constexpr BaseFormats fed(BaseFormats b) {
  b.observer_gain = observer_gain;
  return b;
}

constexpr std::size_t parameter_count = sizeof(Lever::parameters) / sizeof(ParameterInfo);
using Parameters = std::array<ParameterInfo, parameter_count>;
constexpr Parameters with_format(Parameters all, int address, Format format) {
  for (ParameterInfo& p : all) {
    if (p.address == address) p.format = format;
  }
  return all;
}
constexpr Parameters lever_parameters() {
  Parameters all{};
  for (std::size_t i = 0; i < parameter_count; ++i) all[i] = Lever::parameters[i];
  return all;
}

/// Design `lever` with that word.
struct FedLever : Lever {
  struct P : Lever::P {
    static constexpr Format observer_gain = controllers::observer_gain;
  };
  static constexpr BaseFormats base = fed(Lever::base);
  static constexpr Formats f = derive(base);
  static constexpr Parameters parameters =
      with_format(lever_parameters(), A::observer_gain, controllers::observer_gain);
};

}  // namespace feltgate::controllers
