// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// operand_bus: RTL against twin on every clock, and the bus against the schedule: in the clock of
// each product its operand and nothing else. Documentation: docs/architecture.md
#include <Voperand_bus.h>

#include <array>
#include <cstdint>

#include "../../estimators/lowpass/exact.hpp"
#include "catch.hpp"
#include "feltgate/generated/map.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "unreset.hpp"

// Twin of rtl/core/wave/operand_bus.sv, clock by clock: who holds a clock drives it. It computes
// nothing.

namespace feltgate {

/// Clocked twin; the widths are those of the numbers that are put in.
class OperandBus {
 public:
  struct In {
    std::uint64_t wave = 0;
    // 0 outside their clocks
    std::int64_t velocity_difference = 0, observer_difference = 0, distance = 0, limited = 0;
    // held
    std::int64_t velocity = 0, tau_hat = 0, tau_ref = 0, current_ref = 0, voltage = 0;
    std::int64_t current_estimate = 0;
  };
  struct Out {
    std::int64_t operand = 0, dob = 0, scene = 0, control = 0, supervisor = 0;
    std::int64_t estimate = 0;
    bool is_signed = false;
    bool square_estimate = false;
  };

  /// The registers have no reset; this clears them.
  void reset() { *this = OperandBus{}; }

  /// What is new in its first clock is only selected here; what is older is copied.
  void clock(const In& in) {
    using W = Map::W;
    const auto ahead_of = [&in](int slot) { return ((in.wave >> (slot - 1)) & 1u) != 0; };
    take_velocity_ = ahead_of(W::emf_over_resistance) || ahead_of(W::inertia_gain) ||
                     ahead_of(W::scene_damping) || ahead_of(W::emf_constant);
    take_tau_hat_ = ahead_of(W::observer_gain);
    take_tau_ref_ = ahead_of(W::torque_gain) || ahead_of(W::dead_voltage_slope);
    current_ = ahead_of(W::torque_constant) ? in.current_ref : 0;
    const bool voltage = ahead_of(W::inverse_resistance) || ahead_of(W::voltage_to_current);
    voltage_ = voltage ? in.voltage : 0;
    square_estimate_ = ahead_of(W::current_square);
    estimate_ = square_estimate_ ? in.current_estimate : 0;
  }

  Out peek(const In& in) const {
    const std::int64_t velocity = take_velocity_ ? in.velocity : 0;
    const std::int64_t tau_hat = take_tau_hat_ ? in.tau_hat : 0;
    const std::int64_t tau_ref = take_tau_ref_ ? in.tau_ref : 0;
    Out out;
    out.dob = in.observer_difference | current_ | velocity;
    out.scene = in.distance | velocity;
    out.control = in.limited | tau_hat | tau_ref | voltage_ | velocity;
    out.supervisor = estimate_ | voltage_ | velocity;
    out.operand = in.velocity_difference | out.dob | out.scene | out.control | out.supervisor;
    out.is_signed = take_tau_hat_;
    out.estimate = estimate_;
    out.square_estimate = square_estimate_;
    return out;
  }

 private:
  bool take_velocity_ = false, take_tau_hat_ = false, take_tau_ref_ = false;
  bool square_estimate_ = false;
  std::int64_t current_ = 0, voltage_ = 0, estimate_ = 0;
};

}  // namespace feltgate

using namespace feltgate;
using namespace feltgate::test;

namespace {

using Twin = FilledPeek<OperandBus, 1>;
using Rtl = Unreset<Voperand_bus>;
using W = Map::W;
using R = Map::R;

constexpr int kBus = Design::multiplier_a_bits;
constexpr const auto& f = Design::f;

/// A bus of the RTL as a number.
template <class Word>
std::int64_t bus(Word word) {
  return sign_extend<kBus>(static_cast<std::uint64_t>(word));
}

struct Adapter {
  static void drive(Rtl& rtl, const Twin::In& in) {
    using Long = std::uint64_t;
    FELTGATE_STROBES(rtl, in.wave << 1, param_next, W, inverse_resistance, emf_over_resistance,
                     torque_constant, inertia_gain, damper_damping, current_square, emf_constant,
                     observer_gain, voltage_to_current, torque_gain, dead_voltage_slope);
    rtl.velocity_difference_i =
        port_bits<f.velocity_difference.width(), Long>(in.velocity_difference);
    rtl.observer_difference_i =
        port_bits<f.observer_difference.width(), Long>(in.observer_difference);
    rtl.distance_i = port_bits<f.scene_distance.width()>(in.distance);
    rtl.limited_i = port_bits<f.with_addend.width()>(in.limited);
    rtl.velocity_i = port_bits<f.velocity.width()>(in.velocity);
    rtl.tau_hat_i = port_bits<f.torque.width()>(in.tau_hat);
    rtl.tau_ref_i = port_bits<f.torque.width()>(in.tau_ref);
    rtl.current_ref_i = port_bits<f.current.width()>(in.current_ref);
    rtl.voltage_i = port_bits<f.voltage.width()>(in.voltage);
    rtl.current_estimate_i = port_bits<f.current_estimate.width()>(in.current_estimate);
  }
  template <class Check>
  static void compare(Check& check, const Rtl& rtl, const Twin::Out& out) {
    if (!out.known) return;
    check("operand", bus(rtl.operand_o), out.operand);
    check("dob", bus(rtl.dob_o), out.dob);
    check("scene", bus(rtl.scene_o), out.scene);
    check("control", bus(rtl.control_o), out.control);
    check("supervisor", bus(rtl.supervisor_o), out.supervisor);
    check("signed", rtl.signed_o, out.is_signed);
    check("estimate", sign_extend<f.current_estimate.width()>(std::uint32_t{rtl.estimate_o}),
          out.estimate);
    check("square_estimate", rtl.square_estimate_o, out.square_estimate);
  }
};

using Bench = LockStep<Rtl, Twin, Adapter>;

/// Waves of numbers that are new in every clock. `Strict`: who drives the bus itself is 0 outside
/// its clocks, as in the core; else everyone drives it always.
template <bool Strict>
struct Stimulus {
  Random random;
  int clock = 0;

  std::int64_t any(Format format) {
    const auto word = static_cast<std::int64_t>(random.bits()) >> (64 - format.width());
    return word >> random.below(static_cast<std::uint64_t>(format.width()));
  }
  /// Driven in the clocks given only.
  std::int64_t driven(Format format, std::initializer_list<int> clocks) {
    const std::int64_t word = any(format);
    bool own = !Strict;
    for (const int c : clocks) own = own || c == clock;
    return own ? word : 0;
  }
  Twin::In operator()(std::int64_t) {
    Twin::In in;
    in.wave = clock < Map::wave_length ? std::uint64_t{1} << clock : 0;
    in.velocity_difference = driven(f.velocity_difference, {W::velocity_a1});
    in.observer_difference = driven(f.observer_difference, {W::observer_a1});
    in.distance = driven(f.scene_distance, {W::scene_stiffness, W::charge_slope});
    in.limited = driven(f.limiter, {W::voltage_gain, W::duty_gain, R::duty});
    in.velocity = any(f.velocity);
    in.tau_hat = any(f.torque);
    in.tau_ref = any(f.torque);
    in.current_ref = any(f.current);
    in.voltage = any(f.voltage);
    in.current_estimate = any(f.current_estimate);
    clock = clock + 1 >= Map::wave_length + static_cast<int>(random.below(3)) ? 0 : clock + 1;
    return in;
  }
};

/// The bus by the schedule: after the edge it shows what is held and selected for the clock that
/// comes, beside what the inputs drive.
struct BySchedule {
  std::array<std::int64_t, Map::wave_length>* seen;  ///< numbers other than 0, by clock

  const char* operator()(const Twin::In& in, const Rtl& rtl, const Twin&, bool in_reset) {
    if (in_reset) return nullptr;
    const std::int64_t driven =
        in.velocity_difference | in.observer_difference | in.distance | in.limited;
    for (int clock = 1; clock < Map::wave_length; ++clock) {
      if (((in.wave >> (clock - 1)) & 1u) == 0) continue;
      const std::int64_t expected = next_operand(clock, in);
      if (expected != 0) ++(*seen)[static_cast<std::size_t>(clock)];
      if (bus(rtl.operand_o) != (expected | driven)) return "the operand of the schedule";
    }
    return nullptr;
  }
  /// What is held and selected for `clock`, by the inputs of the clock before it.
  static std::int64_t next_operand(int clock, const Twin::In& in) {
    switch (clock) {
      case W::inverse_resistance:
      case W::voltage_to_current:
        return in.voltage;
      case W::emf_over_resistance:
      case W::inertia_gain:
      case W::scene_damping:
      case W::emf_constant:
        return in.velocity;
      case W::torque_constant:
        return in.current_ref;
      case W::current_square:
        return in.current_estimate;
      case W::observer_gain:
        return in.tau_hat;
      case W::torque_gain:
      case W::dead_voltage_slope:
        return in.tau_ref;
      default:
        return 0;
    }
  }
};

}  // namespace

TEST_CASE("operand_bus: the operands of the schedule, and nothing else") {
  std::array<std::int64_t, Map::wave_length> seen{};
  const std::int64_t clocks = scaled_clocks(400000);
  Bench bench("operand_bus", 1);
  bench.run(Stimulus<true>{Random(2)}, clocks, {5000}, BySchedule{&seen});
  for (const int clock :
       {W::inverse_resistance, W::voltage_to_current, W::emf_over_resistance, W::inertia_gain,
        W::scene_damping, W::emf_constant, W::torque_constant, W::current_square, W::observer_gain,
        W::torque_gain, W::dead_voltage_slope}) {
    INFO("clock " << clock << ", operands " << seen[static_cast<std::size_t>(clock)]);
    REQUIRE(seen[static_cast<std::size_t>(clock)] * 100 > clocks);
  }
}

TEST_CASE("operand_bus: whoever drives it in whatever clock") {
  Bench bench("operand_bus", 3);
  bench.run(Stimulus<false>{Random(4)}, scaled_clocks(400000), {1000});
}
