// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// core_vectors CLOCKS SEED OUT: inputs of the core and the twin's outputs, one clock a line in hex,
// for core_tb.sv in Icarus. The stimulus is that of the lock-step test. Documentation:
// docs/testing.md
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "../../core/feltgate_core/core_stimulus.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: core_vectors CLOCKS SEED OUT\n", stderr);
    return 2;
  }
  using feltgate::CoreIn;
  using feltgate::CoreOut;
  using D = feltgate::Lever;
  feltgate::test::CoreStimulus<D> stimulus(std::strtoull(argv[2], nullptr, 10));
  feltgate::FeltgateCore<D> twin;
  std::FILE* out = std::fopen(argv[3], "w");
  if (out == nullptr) {
    std::fprintf(stderr, "%s: cannot be written\n", argv[3]);
    return 2;
  }
  const auto bits = [](std::int64_t v, int width) {
    return static_cast<std::uint64_t>(v) & ((std::uint64_t{1} << width) - 1);
  };
  const long long clocks = std::strtoll(argv[1], nullptr, 10);
  for (long long k = 0; k < clocks; ++k) {
    const CoreIn in = stimulus(k);
    twin.clock(in);
    const CoreOut& o = twin.out();
    const unsigned pins =
        static_cast<unsigned>(in.encoder.a | in.encoder.b << 1 | in.encoder.z << 2 | in.arm << 3 |
                              in.stop << 4 | in.set_zero << 5 | in.reg_write << 6);
    const unsigned flags = static_cast<unsigned>(
        o.armed | o.gates_enable << 1 | o.snapshot_valid << 2 | o.reg_busy << 3 | o.gates << 4);
    // One word per group of ports, each as wide as core_tb.sv reads it.
    std::fprintf(out,
                 "%02x%01x%03x%08x %02x%08x%02x%08x%08x%08" PRIx64 "%06" PRIx64 "%06" PRIx64
                 "%06" PRIx64 "%05" PRIx64 "%04" PRIx64 "%04" PRIx64 "%01x%03x%04x%02x%08x\n",
                 pins, in.scene & 15u, in.reg_addr & 0xfffu, in.reg_wdata,
                 static_cast<unsigned>(o.word_valid << 7 | o.word_slot), o.word_data, flags,
                 o.tick_count, static_cast<std::uint32_t>(o.position), bits(o.velocity, 32),
                 bits(o.tau_hat, 24), bits(o.tau_ref, 24), bits(o.current_ref, 24),
                 bits(o.voltage, 20), bits(o.duty, 16), bits(o.duty_active, 16), o.scene & 15u,
                 o.limits, o.faults, o.first_fault & 31u, o.reg_rdata);
  }
  return std::fclose(out) == 0 ? 0 : 2;
}
