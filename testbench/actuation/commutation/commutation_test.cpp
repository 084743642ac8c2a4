// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// commutation: RTL against twin in every clock, and against cosines in double; the voltage's vector
// and the torque over every angle of an encoder; sines; words; small periods; where a motor turns.
// Documentation: docs/blocks/three_phase.md
#include <Vcommutation.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "catch.hpp"
#include "feltgate/commutation.hpp"
#include "feltgate/largest.hpp"
#include "figures_record.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

#ifdef COMMUTATION_SINES
constexpr auto kModulation = Commutation::kSines;
constexpr int kLatency = 108;
#else
constexpr auto kModulation = Commutation::kSpaceVectors;
constexpr int kLatency = 85;
#endif
constexpr int kPeriod = COMMUTATION_PERIOD;
constexpr double kThird = 2 * M_PI / 3;

struct Adapter {
  static void drive(Vcommutation& rtl, const Commutation::In& in) {
    FELTGATE_DRIVE(rtl, in, sample, gain, offset, polarity);
    rtl.position_i = static_cast<std::uint32_t>(in.position);
    rtl.amplitude_i = port_bits<13, std::uint16_t>(in.amplitude);
  }
  template <class Check>
  static void compare(Check& check, const Vcommutation& rtl, const Commutation::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, on_a, on_b, on_c, valid);
  }
};

using Bench = LockStep<Vcommutation, Commutation, Adapter>;

/// The voltage of three on-times, in clocks: along leg A, and a quarter of a turn ahead.
struct Vector {
  double x, y;
  Vector(double a, double b, double c) : x((2 * a - b - c) / 3), y((b - c) / std::sqrt(3)) {}
};

/// What is wrong with on-times that were asked for at an electrical angle, or nullptr.
class Judge {
 public:
  Judge(int period, bool sines) : period_(period), sines_(sines) {}

  const char* operator()(double angle, double amplitude, bool backward, double a, double b,
                         double c) {
    if (backward) std::swap(b, c);
    // Sines have a clock less at each end of the period.
    const double most = sines_ ? std::floor((period_ / 2.0 - 1) * std::sqrt(3)) : period_;
    const double length = std::fmax(-most, std::fmin(most, amplitude)) / std::sqrt(3);
    const Vector is(a, b, c);
    const double x = is.x - length * std::cos(angle), y = is.y - length * std::sin(angle);
    vector = std::hypot(x, y);
    torque = x * std::cos(angle) + y * std::sin(angle);
    if (!(std::fmin(a, std::fmin(b, c)) >= 0)) return "no on-time is below 0";
    if (!(std::fmax(a, std::fmax(b, c)) <= period_)) return "no on-time is above the period";
    if (!(vector <= 0.45 + 2e-4 * std::fabs(length))) return "the vector is as asked for";
    if (sines_) {
      const double on[] = {a, b, c};
      for (int leg = 0; leg < 3; ++leg) {
        const double wanted = period_ / 2.0 + length * std::cos(angle - leg * kThird);
        if (!(std::fabs(on[leg] - wanted) <= 1.5 + 2e-4 * std::fabs(length)))
          return "a leg is a sine";
      }
      return nullptr;
    }
    const double outer = std::fmax(a, std::fmax(b, c)) + std::fmin(a, std::fmin(b, c));
    return std::fabs(outer - period_) <= 1 ? nullptr : "the outer legs lie around the middle";
  }

  double vector = 0, torque = 0;  // errors of the last, clocks

 private:
  int period_;
  bool sines_;
};

/// The angle of inputs, in double from an exact product.
double angle_of(const Commutation::In& in) {
  const std::int64_t product = std::int64_t{in.position} * std::int64_t{in.gain};
  const auto turn = static_cast<double>(product % (std::int64_t{1} << 32)) + in.offset;
  return std::ldexp(turn, -32) * 2 * M_PI;
}

/// Kinds of inputs, each for a while: any words, an encoder that turns, angles at the sectors' ends
/// and middles, steps of the angle's bits that count, ends of the amplitude.
struct RandomInputs {
  Random random;
  Commutation::In in{};
  int every = kLatency;

  Commutation::In operator()(std::int64_t clock) {
    if (random.one_in(2000))
      every = random.coin() ? kLatency : 1 + static_cast<int>(random.below(300));
    in.sample = clock % every == 0;
    if (random.one_in(3)) return in;
    const std::uint32_t kind = random.below(4);
    in.position = static_cast<std::int32_t>(random.bits());
    in.gain = static_cast<std::uint32_t>(random.bits());
    in.offset = static_cast<std::uint32_t>(random.bits());
    if (kind == 0 && random.coin()) {  // where each carry into the 18 bits that count shows
      in.offset = (in.offset & ~0x3fffU) - static_cast<std::uint32_t>(in.position) * in.gain;
      in.offset -= random.coin();
    } else if (kind == 1) {
      in.position = static_cast<std::int32_t>(clock);
      in.gain = commutation_gain(11, 16384);
    } else if (kind >= 2) {
      in.gain = 0;
      in.offset = static_cast<std::uint32_t>(random.below(24) * 0x100000000U / 24 +
                                             static_cast<std::uint64_t>(random.between(-99, 99)));
    }
    in.amplitude = static_cast<std::int16_t>(amplitude());
    in.polarity = random.coin();
    return in;
  }

 private:
  std::int64_t amplitude() {
    const int sign = random.coin() ? 1 : -1;
    switch (random.below(5)) {
      case 0:
        return random.coin() ? -4096 : 4095;
      case 1:
        return sign * random.between(0, 3);
      case 2:
        return sign * (kPeriod + random.between(-2, kPeriod < 4094 ? 2 : 1));
      default:
        return random.between(-4096, 4095);
    }
  }
};

/// Cosines in double, and the clocks of results.
class Reference {
 public:
  std::int64_t beyond = 0, sectors[2][6] = {};

  const char* operator()(const Commutation::In& in, const Vcommutation& rtl, const Commutation&,
                         bool in_reset) {
    ++clock_;
    const int a = rtl.on_a_o, b = rtl.on_b_o, c = rtl.on_c_o;
    if (in_reset) {
      taken_ = -1000;
      return 2 * a == kPeriod && a == b && a == c ? nullptr : "after a reset there is no voltage";
    }
    const bool result = clock_ == taken_ + kLatency - 1;
    if ((rtl.valid_o != 0) != result) return "a result in its clock";
    if (in.sample) take(in);
    if (!result) return nullptr;
    return judge_(angle_, amplitude_, backward_, a, b, c);
  }

 private:
  void take(const Commutation::In& in) {
    if (clock_ < taken_ + kLatency) return;
    taken_ = clock_;
    angle_ = angle_of(in);
    amplitude_ = in.amplitude;
    backward_ = in.polarity;
    beyond += std::abs(in.amplitude) > kPeriod;
    const double turns = angle_ / (2 * M_PI);
    const auto sector = static_cast<int>(6 * (turns - std::floor(turns))) % 6;
    ++sectors[in.amplitude < 0][sector];
  }

  Judge judge_{kPeriod, kModulation == Commutation::kSines};
  std::int64_t clock_ = 0, taken_ = -1000;
  double angle_ = 0, amplitude_ = 0;
  bool backward_ = false;
};

/// An encoder of 14 bits.
constexpr int kCounts = 16384;
Commutation::In at(int pole_pairs, int count, int amplitude) {
  Commutation::In in;
  in.position = count;
  in.gain = commutation_gain(pole_pairs, kCounts);
  in.amplitude = static_cast<std::int16_t>(amplitude);
  return in;
}

/// Peak to peak of the torque, over its mean, of sines with a peak of 1/sqrt(3) of the supply whose
/// legs meet their ends.
double clipped_sines() {
  double least = 1, most = 0, sum = 0;
  for (int n = 0; n < 3600; ++n) {
    const double angle = 2 * M_PI * n / 3600;
    double torque = 0;
    for (int leg = 0; leg < 3; ++leg) {
      const double way = std::cos(angle - 2 * M_PI * leg / 3);
      torque += 2.0 / 3 * way * std::clamp(way / std::sqrt(3), -0.5, 0.5);
    }
    least = std::min(least, torque), most = larger(most, torque), sum += torque / 3600;
  }
  return (most - least) / sum;
}

}  // namespace

TEST_CASE("commutation: all inputs and resets") {
  Bench bench("commutation", 1, Commutation(kPeriod, kModulation));
  Reference seen;
  bench.run(RandomInputs{Random(1)}, scaled_clocks(2'000'000), {30'000}, std::ref(seen));
  REQUIRE(seen.beyond > 1000);
  for (const auto& sign : seen.sectors) {
    for (const std::int64_t sector : sign) REQUIRE(sector > 200);
  }
}

TEST_CASE("commutation: the vector at every angle of an encoder") {
  std::string wrong;
  double most = 0;
  const Commutation twin(kPeriod, kModulation);
  for (const int pole_pairs : {1, 7, 11}) {
    for (int amplitude = -kPeriod; amplitude <= kPeriod; amplitude += kPeriod / 25) {
      Judge judge(kPeriod, kModulation == Commutation::kSines);
      for (int count = 0; count < kCounts; ++count) {
        const auto [a, b, c] = twin.on_times(at(pole_pairs, count, amplitude));
        const double angle = 2 * M_PI * pole_pairs * count / kCounts;
        const char* found = judge(angle, amplitude, false, a, b, c);
        if (found != nullptr) {
          wrong = fmt::format("{}: {} pole pairs, count {}, amplitude {}: {} clocks", found,
                              pole_pairs, count, amplitude, judge.vector);
        }
        most = larger(most, judge.vector);
      }
    }
  }
  INFO("largest error " << most << " clocks");
  CHECK(wrong == "");
  CHECK(most > 0.3);
}

TEST_CASE("commutation: torque over a turn") {
  if (kModulation == Commutation::kSines) return;  // the same differences between legs: below
  std::string figures =
      "| amplitude / period | torque, P 1000: peak, rms % | length, % | angle, ° | P 2500: peak, "
      "rms % | length, % | angle, ° |\n|---|---|---|---|---|---|---|\n";
  for (const int part : {1, 2, 5, 10, 20, 50, 100}) {
    figures += fmt::format("| 1/{} ", part);
    for (const int period : {1000, 2500}) {
      const Commutation twin(period);
      Judge judge(period, false);
      const double length = period / part / std::sqrt(3);
      double peak = 0, squares = 0, longer = 0, turned = 0;
      for (const int pole_pairs : {1, 7, 11}) {
        for (int count = 0; count < kCounts; ++count) {
          const auto [a, b, c] = twin.on_times(at(pole_pairs, count, period / part));
          const double angle = 2 * M_PI * pole_pairs * count / kCounts;
          if (judge(angle, period / part, false, a, b, c) != nullptr) FAIL("see the case above");
          const Vector is(a, b, c);
          peak = larger(peak, std::fabs(judge.torque) / length);
          squares += judge.torque * judge.torque / (length * length);
          longer = larger(longer, std::fabs(std::hypot(is.x, is.y) / length - 1));
          const double off = std::remainder(std::atan2(is.y, is.x) - angle, 2 * M_PI);
          turned = larger(turned, std::fabs(off));
        }
      }
      if (part <= 10) CHECK(peak < 0.01);
      figures +=
          fmt::format("| {:.3f}, {:.3f} | {:.3f} | {:.3f} ", 100 * peak,
                      100 * std::sqrt(squares / (3 * kCounts)), 100 * longer, 180 / M_PI * turned);
    }
    figures += "|\n";
  }
  figures +=
      "\n| modulation | greatest peak of a phase, of the supply | closed form | torque there: "
      "peak, % "
      "| farthest leg from the middle | as large as space vectors: torque, peak to peak, % |\n"
      "|---|---|---|---|---|---|\n";
  double reach = 0;
  for (const auto modulation : {Commutation::kSines, Commutation::kSpaceVectors}) {
    const bool sines = modulation == Commutation::kSines;
    const Commutation twin(1000, modulation);
    double sum = 0, far = 0, peak = 0;
    for (int count = 0; count < kCounts; ++count) {
      const auto [a, b, c] = twin.on_times(at(11, count, twin.limit()));
      const Vector is(a, b, c);
      const double angle = 2 * M_PI * 11 * count / kCounts;
      const double along = is.x * std::cos(angle) + is.y * std::sin(angle);
      sum += std::hypot(is.x, is.y) / 1000 / kCounts;
      peak = larger(peak, std::fabs(along * std::sqrt(3) / twin.limit() - 1));
      for (const int on : {+a, +b, +c}) far = larger(far, std::abs(on - 500) / 1000.0);
    }
    // Sines have two clocks less, for the roundings of their legs.
    CHECK(sum == Approx(sines ? 0.5 : 1 / std::sqrt(3)).epsilon(0.003));
    CHECK((peak < 2e-3 && far <= 0.5 && far > 0.498));
    if (!sines) CHECK(sum / reach == Approx(2 / std::sqrt(3)).epsilon(0.003));
    figures += fmt::format("| {} | {:.4f} | {} | {:.2f} | {:.3f} | {} |\n",
                           sines ? "sines" : "space vectors, 2/√3 = 1.1547 times as much", sum,
                           sines ? "1/2" : "1/√3 = 0.5774", 100 * peak, far,
                           sines ? fmt::format("{:.1f}, clipped", 100 * clipped_sines()) : "-");
    reach = sum;
  }
  if (kPeriod == 1000) check_figures("commutation", figures);
}

TEST_CASE("commutation: sines and space vectors differ by what all legs share") {
  std::int64_t wrong = 0, same = 0;
  for (const int period : {24, 1000, 4094}) {
    const Commutation sines(period, Commutation::kSines), vectors(period);
    for (int amplitude = -sines.limit(); amplitude <= sines.limit(); amplitude += period / 24) {
      for (int count = 0; count < kCounts; count += 5) {
        const auto s = sines.on_times(at(1, count, amplitude));
        const auto v = vectors.on_times(at(1, count, amplitude));
        wrong += s[0] - v[0] != s[1] - v[1] || s[0] - v[0] != s[2] - v[2];
        same += s == v;
      }
    }
  }
  CHECK(wrong == 0);
  CHECK(same > 0);
  // Two thirds of root 3 higher: what space vectors gain, less the clocks that sines leave.
  CHECK(Commutation(1000, Commutation::kSines).limit() == static_cast<int>(499 * std::sqrt(3)));
}

TEST_CASE("commutation: on-times of any period stay within it, and nothing is no voltage") {
  std::int64_t outside = 0, unequal = 0;
  for (const auto modulation : {Commutation::kSines, Commutation::kSpaceVectors}) {
    for (const int period : {4, 6, 8, 10, 14, 22, 32, 1000, 2500, 4094}) {
      const Commutation twin(period, modulation);
      const int step = period < 100 ? 1 : 61;
      for (int amplitude = -period; amplitude <= period; amplitude += step) {
        Commutation::In in;
        in.amplitude = static_cast<std::int16_t>(amplitude);
        for (std::uint32_t turn = 0; turn < 6000; ++turn) {
          in.offset = turn * 715828U;
          for (const int on : twin.on_times(in)) {
            outside += on < 0 || on > period;
            unequal += amplitude == 0 && 2 * on != period;
          }
        }
      }
    }
  }
  CHECK(outside == 0);
  CHECK(unequal == 0);
}

TEST_CASE("commutation: words of a motor") {
  // Exact modulo a turn for a power of two: no error after any number of turns, nor at the wrap.
  for (const int pole_pairs : {1, 7, 11, 20}) {
    CHECK(commutation_gain(pole_pairs, kCounts) * std::uint32_t{kCounts} == 0);
    CHECK(commutation_gain(pole_pairs, kCounts) == static_cast<std::uint32_t>(pole_pairs) << 18);
  }
  // Else half of 2^-32 turn for each count: after 1000 turns of 4000 counts within 0.17 degrees.
  for (const int pole_pairs : {1, 7, 11, 20}) {
    for (const int counts : {4000, 10'000, 4095}) {
      const double exact = static_cast<double>(pole_pairs) / counts;
      const double error = std::ldexp(commutation_gain(pole_pairs, counts), -32) - exact;
      CHECK(std::fabs(error) <= std::ldexp(1, -33));
    }
    const std::uint32_t angle = commutation_gain(pole_pairs, 4000) * 4'000'000U;
    CHECK(std::fabs(std::ldexp(360.0 * static_cast<std::int32_t>(angle), -32)) < 0.17);
  }
  CHECK(commutation_angle(0.25) == 0x40000000);
  CHECK(commutation_angle(-0.25) == 0xc0000000);
  // Aligning: a gain of 0 holds the angle of the offset, wherever the rotor is.
  const Commutation twin(1000);
  Commutation::In in = at(0, 12'345, 500);
  in.offset = commutation_angle(1.0 / 3);
  const auto [a, b, c] = twin.on_times(in);
  CHECK(Vector(a, b, c).x == Approx(-500 / std::sqrt(12)).margin(0.6));
  CHECK(Vector(a, b, c).y == Approx(250).margin(0.6));
}
