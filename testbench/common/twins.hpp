// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twins of the design of a generated header, for tests that name its constants.
// Documentation: docs/testing.md
#pragma once

#include "feltgate/feltgate_axes.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/linked_core.hpp"
#include "sim/backends/rtl_ports.hpp"

namespace feltgate::test {

template <class D, bool Reads = true>
struct CoreOf : FeltgateCore {
  CoreOf() : FeltgateCore(design_of<D>(), Reads) {}
};

template <class D, int N, bool Reads = true, bool WithEngine = false>
struct AxesOf : FeltgateAxes<N, WithEngine> {
  AxesOf() : FeltgateAxes<N, WithEngine>(design_of<D>(), Reads) {}
};

template <class D, int N = 1>
struct LinkedOf : LinkedCore<N, D::engine != 0> {
  explicit LinkedOf(LinkedOptions options = {})
      : LinkedCore<N, D::engine != 0>(design_of<D>(), options) {}
};

/// Bits at the ports of the Verilated core of D.
template <class D>
const PortBits& port_bits() {
  static const PortBits bits(design_of<D>());
  return bits;
}

template <class D>
AbsoluteEncoder::Parameters absolute_parameters() {
  return axis::Absolute::parameters(design_of<D>());
}

/// Whether D has scene number `scene`.
template <class D>
constexpr bool scene_built(int scene) {
  return scene >= 0 && scene < 16 && ((D::scene_mask >> scene) & 1) != 0;
}

}  // namespace feltgate::test
