// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lock-step of a block, or of registers, without a reset input. The comparison starts when the
// clocks of the pipeline have passed since the reset of the bench. Documentation: docs/testing.md
#pragma once

namespace feltgate::test {

/// Adds a reset input, which the bench drives, to a Verilated block that has none.
template <class Model>
struct Unreset : Model {
  using Model::Model;
  int rst_ni = 0;
};

/// A twin that tells when its outputs must equal those of the RTL: from `Clocks` clocks after a
/// reset.
template <class Block, int Clocks>
struct Filled {
  using In = typename Block::In;
  struct Out : Block::Out {
    bool known = false;
  };
  void reset() {
    block.reset();
    clocks = 0;
    show();
  }
  void clock(const In& in) {
    block.clock(in);
    if (clocks < Clocks) ++clocks;
    show();
  }
  const Out& out() const { return seen; }

  Block block;
  Out seen;
  int clocks = 0;

 private:
  void show() {
    static_cast<typename Block::Out&>(seen) = block.out();
    seen.known = clocks >= Clocks;
  }
};

/// The same for a block whose outputs depend on the inputs of the same clock.
template <class Block, int Clocks>
struct FilledPeek {
  using In = typename Block::In;
  struct Out : Block::Out {
    bool known = false;
  };
  void reset() {
    block.reset();
    clocks = 0;
  }
  void clock(const In& in) {
    block.clock(in);
    if (clocks < Clocks) ++clocks;
  }
  Out peek(const In& in) const { return {block.peek(in), clocks >= Clocks}; }

  Block block;
  int clocks = 0;
};

}  // namespace feltgate::test
