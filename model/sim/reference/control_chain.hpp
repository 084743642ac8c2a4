// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One tick of the whole chain, from the sampled counts to the duty, by the laws of the blocks in
// any number policy: no pins, no clocks, no supervisor. Documentation: docs/speed-for-accuracy.md
#pragma once

#include "feltgate/chain_tick.hpp"
#include "real_chain.hpp"

namespace feltgate {

/// The chain of design D in number policy N; `words()` holds its parameters.
template <class D, class N>
class ControlChain : public ChainTick<D, N> {
 public:
  /// Restores the state after a reset and the parameters of the design.
  void reset() {
    ChainTick<D, N>::reset();
    this->words().reset();
  }

  void tick(const ChainIn& in) {
    if constexpr (D::current_loop != 0) this->measure(in.current);
    if (in.restart) this->restart();
    ChainTick<D, N>::tick(in.position, in.travel, in.armed, in.scene, static_cast<Mode>(in.mode),
                          in.relief);
  }
};

}  // namespace feltgate
