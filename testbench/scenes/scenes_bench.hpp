// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of the Verilated scenes against its twin, and what each wave must have done.
// Documentation: docs/blocks/scenes.md
#pragma once

#include <Vscenes.h>

#include <algorithm>
#include <array>

#include "feltgate/scenes.hpp"
#include "scene_wave.hpp"

namespace feltgate::test {

#ifdef FELTGATE_SCENE_MASK
/// The design with another set of scenes.
struct Built : Design {
  static constexpr int scene_mask = FELTGATE_SCENE_MASK;
};
#else
using Built = Design;
#endif
using Twin = Scenes<Built>;
using A = Design::A;
using S = Design::S;

struct Block {
  static Twin::In in(const Wave& wave, const Bus& bus) {
    return {wave.armed, wave.scene, bus.start, wave.position, bus.param, bus.product};
  }
  static std::int64_t operand(const Twin::Out& out) { return out.operand; }
  static void drive(Vscenes& rtl, const Twin::In& in) {
    rtl.armed_i = in.armed;
    rtl.scene_i = static_cast<std::uint8_t>(in.scene);
    rtl.start_i = in.start;
    rtl.position_i = port_bits<18>(in.position);
    rtl.param_i = in.param;
    rtl.product_i = port_bits<53, std::uint64_t>(in.product);
  }
  template <class Check>
  static void compare(Check& check, const Vscenes& rtl, const Twin::Out& out) {
    check("operand", sign_extend<26>(rtl.operand_o), out.operand);
    check("square", rtl.square_o, out.square);
    check("tau_ref", sign_extend<kTorque.width()>(rtl.tau_ref_o), out.tau_ref);
    check("limit_torque", rtl.limit_torque_o, out.limit_torque);
    check("limit_ramp", rtl.limit_ramp_o, out.limit_ramp);
  }
};

struct Tally {
  std::int64_t waves = 0, disarmed = 0, limited = 0, ramping = 0, free = 0, ends = 0;
  std::array<std::int64_t, 16> acting{};  ///< waves with a torque, by scene
};

/// tick() gives the same; and the properties of limit and ramp.
struct TickBeside {
  Tally* tally;
  Twin beside{};
  std::int64_t before = 0;
  bool ramp_before = true;
  void forget() {
    beside.reset();
    before = 0;
    ramp_before = true;
  }
  const char* operator()(const Probe& p, const Vscenes& rtl, const Twin&) {
    const Wave& w = p.wave;
    beside.tick(p.memory.words(), w.armed, w.scene, w.position,
                Twin::Velocity::from_raw(w.velocity));
    const std::int64_t tau = sign_extend<kTorque.width()>(rtl.tau_ref_o);
    const std::int64_t limit = decode_word(kTorque, p.memory.word(A::torque_limit));
    const std::int64_t step = decode_word(Design::f.ramp, p.memory.word(A::ramp_step));
    ++tally->waves;
    tally->disarmed += !w.armed;
    tally->limited += rtl.limit_torque_o;
    tally->ramping += rtl.limit_ramp_o;
    tally->free += w.armed && !rtl.limit_ramp_o;
    tally->ends += w.armed && ramp_before && !rtl.limit_ramp_o;
    tally->acting[static_cast<std::size_t>(w.scene)] += tau != 0;
    const std::int64_t moved = tau > before ? tau - before : before - tau;
    const bool ramped = rtl.limit_ramp_o != 0;
    before = tau;
    ramp_before = ramped;
    if (beside.tau_ref().raw() != tau) return "tick() gives another torque";
    if (beside.limit_torque() != (rtl.limit_torque_o != 0)) return "tick() gives another limit";
    if (beside.limit_ramp() != ramped) return "tick() gives another ramp";
    if (!w.armed && tau != 0) return "a torque while disarmed";
    if (!ramped &&
        (tau > std::max<std::int64_t>(limit, 0) || tau < -std::max<std::int64_t>(limit, 0)))
      return "beyond the limit";
    if (ramped && moved > (std::max<std::int64_t>(step, 0) + 255) / 256)
      return "faster than the ramp";
    return nullptr;
  }
};

using Bench = LockStep<Vscenes, Twin, Block>;

}  // namespace feltgate::test
