// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two Verilated cores, VA and VB, in one program and on one stimulus: time of each in turn, and a
// hash of every snapshot. Built by scripts/rtl_speed.py. Documentation: docs/bench.md
#include <time.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "VA.h"
#include "VB.h"
#include "verilated.h"

namespace {

double cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Armed, one scene after the other, a lever that moves forth, back and not at all.
template <class Rtl>
class Core {
 public:
  Core() {
    rtl_.rst_ni = 1;
    rtl_.clk_i = 0;
    rtl_.eval();
    rtl_.rst_ni = 0;
    for (int k = 0; k < 4; ++k) edge();
    rtl_.clk_i = 0;
    rtl_.eval();
    rtl_.rst_ni = 1;
  }
  void run(long clocks) {
    for (const long end = now_ + clocks; now_ < end; ++now_) {
      if (now_ % 50 == 3) {
        const long tick = now_ / 50, scene = tick / 4000 % 10;
        rtl_.arm_i = tick > 20 && tick % 4000 > 10;
        rtl_.scene_i = scene == 1 ? 0 : static_cast<std::uint8_t>(scene);
      }
      if (now_ % 1201 == 0) move(now_ / 1201 / 300 % 3);
      edge();
      if (rtl_.snapshot_valid_o) add();
    }
  }
  unsigned long long hash() const { return hash_; }
  unsigned faults() const { return faults_; }
  long armed() const { return armed_; }

 private:
  void edge() {
    rtl_.clk_i = 0;
    rtl_.eval();
    rtl_.clk_i = 1;
    rtl_.eval();
  }
  void move(long way) {
    if (way == 2) return;
    count_ += way == 0 ? 1 : -1;
    const unsigned phase = static_cast<unsigned>(count_) & 3u;
    rtl_.enc_a_i = phase >= 2;
    rtl_.enc_b_i = phase == 1 || phase == 2;
  }
  void add() {
    faults_ |= rtl_.faults_o;
    armed_ += rtl_.armed_o;
    for (const std::uint64_t v :
         {std::uint64_t{rtl_.position_o}, std::uint64_t{rtl_.velocity_o},
          std::uint64_t{rtl_.tau_hat_o}, std::uint64_t{rtl_.tau_ref_o},
          std::uint64_t{rtl_.current_ref_o}, std::uint64_t{rtl_.voltage_o},
          std::uint64_t{rtl_.duty_o}, std::uint64_t{rtl_.limits_o}, std::uint64_t{rtl_.faults_o}}) {
      hash_ = (hash_ ^ v) * 0x100000001b3u;
    }
  }

  VerilatedContext context_;
  Rtl rtl_{&context_};
  long now_ = 0, count_ = 0, armed_ = 0;
  unsigned faults_ = 0;
  unsigned long long hash_ = 0xcbf29ce484222325u;
};

template <class Rtl>
double ns_per_clock(Core<Rtl>& core, long clocks) {
  const double begin = cpu_s();
  core.run(clocks);
  return 1e9 * (cpu_s() - begin) / static_cast<double>(clocks);
}

}  // namespace

// rtl_speed CLOCKS ROUNDS: each round a line "ns of VA, ns of VB"; then the two hashes and what
// ran.
int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const long clocks = std::atol(argv[1]);
  Core<VA> a;
  Core<VB> b;
  for (int round = 0; round < std::atoi(argv[2]); ++round) {
    const double of_a = ns_per_clock(a, clocks), of_b = ns_per_clock(b, clocks);
    std::printf("%.3f %.3f\n", of_a, of_b);
  }
  std::printf("%016llx %016llx %ld %u\n", a.hash(), b.hash(), a.armed(), a.faults());
  return 0;
}
