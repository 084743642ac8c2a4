// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law in the memories from power-up on: armed by a pin and felt, RTL against twin on every clock,
// and nobody ever writes a register. Documentation: docs/blocks/engine.md
#include <Vstandalone.h>

#include <cmath>

#include "catch.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_axes.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "law/compile.hpp"
#include "law/load.hpp"
#include "lock_step.hpp"
#include "sim/backends/rtl_ports.hpp"
#include "twins.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Design = LeverLaw;
using Twin = test::AxesOf<Design, 1, false, true>;
constexpr int kTick = Design::clocks_per_tick;
constexpr std::int64_t kCountClocks = 50 * kTick;

struct Adapter {
  static void drive(Vstandalone& rtl, const AxesIn<1>& in) {
    rtl.enc_a_i = in.axis[0].encoder.a;
    rtl.enc_b_i = in.axis[0].encoder.b;
    rtl.arm_i = in.arm;
    rtl.scene_i = in.axis[0].scene;
  }
  template <class Check>
  static void compare(Check& check, const Vstandalone& rtl, const AxesOut<1>& out) {
    const CoreOut& o = out.axis[0];
    check("armed", rtl.armed_o, o.armed);
    check("first_fault", rtl.first_fault_o, o.first_fault);
    check("position", rtl.position_o, static_cast<std::uint32_t>(o.position));
    check("gates", rtl.gates_o, o.gates);
    check("tau_ref", sign_extend(std::uint64_t{rtl.tau_ref_o}, Design::f.torque.width()),
          std::int64_t{o.tau_ref});
  }
};

law::Compiled compiled() {
  return law::compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/spring.law",
                           law::target_of(design_info<Design>()));
}

/// Turned in one direction, a count every kCountClocks, from the clock `from` on.
AxesIn<1> turned(std::int64_t clock, std::int64_t from, std::int64_t counts) {
  static constexpr bool a[] = {false, false, true, true}, b[] = {false, true, true, false};
  const std::int64_t n = std::clamp<std::int64_t>((clock - from) / kCountClocks, 0, counts);
  AxesIn<1> in;
  in.axis[0].encoder.a = a[n % 4];
  in.axis[0].encoder.b = b[n % 4];
  in.axis[0].scene = static_cast<std::uint8_t>(Map::S::law);
  return in;
}

}  // namespace

TEST_CASE("law_content: a law from power-up on is armed by a pin and felt") {
  const law::Compiled law = compiled();
  Twin twin;
  twin.glue().engine().configure(law::memory(law.image), law::reset_words(law.image));
  constexpr std::int64_t ticks = 20'000, counts = 200;
  LockStep<Vstandalone, Twin, Adapter> bench("standalone", 1, twin);
  bool was_armed = false;
  std::int64_t strongest = 0, at = 0;
  const auto stimulus = [](std::int64_t clock) {
    AxesIn<1> in = turned(clock, 8'000 * kTick, counts);
    in.arm = clock > 100 * kTick;
    return in;
  };
  const auto watch = [&](const AxesIn<1>&, const Vstandalone&, const Twin& t, bool) -> const char* {
    const CoreOut& out = t.out().axis[0];
    was_armed = was_armed || out.armed;
    if (std::llabs(out.tau_ref) > std::llabs(strongest)) strongest = out.tau_ref;
    at = out.position;
    return out.first_fault != 0 ? "a fault" : nullptr;
  };
  bench.run(stimulus, ticks * kTick, {}, watch);
  CHECK(was_armed);
  CHECK(at == counts);
  // -k x of the law's own default, from the file's words.
  const double k = law::LoadedParameters(law.image).value("stiffness");
  const double x = counts * design_info<Design>().count_rad;
  const double torque_nm = std::ldexp(static_cast<double>(strongest), -Design::f.torque.fraction);
  CHECK(std::abs(torque_nm + k * x) < 0.01 * k * x);
}

TEST_CASE("law_content: a reset brings the law back") {
  const law::Compiled law = compiled();
  Twin twin;
  twin.glue().engine().configure(law::memory(law.image), law::reset_words(law.image));
  LockStep<Vstandalone, Twin, Adapter> bench("standalone", 2, twin);
  const auto stimulus = [](std::int64_t clock) {
    AxesIn<1> in = turned(clock, 0, 1'000'000);
    in.arm = true;
    return in;
  };
  bench.run(stimulus, 60'000 * kTick / 10, ResetPlan{100'000});
}
