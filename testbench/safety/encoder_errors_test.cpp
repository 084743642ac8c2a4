// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "feltgate/axis/encoder_errors.hpp"

#include "ports/encoder_errors.hpp"

using namespace feltgate::test;

namespace {

struct Twin : BlockTwin<ports::encoder_errors> {
  void clock(const In& in) { block.clock(in.tick, in.illegal); }
  Out out(const In& in) const { return {block.trip(in.illegal)}; }

  EncoderErrors block;
};

}  // namespace

TEST_CASE("encoder_errors: RTL and twin, every clock") { lock_step(Twin(), {800'000}); }
