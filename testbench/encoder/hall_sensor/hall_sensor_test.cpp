// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// hall_sensor: RTL against twin, and against the law in plain numbers, in every clock; rotors with
// an encoder and Hall lines, sound and broken: how far the angle is from the rotor's, and what is
// found. Documentation: docs/blocks/three_phase.md
#include "feltgate/hall_sensor.hpp"

#include <Vhall_sensor.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "../../sim/plant/three_phase_fixture.hpp"
#include "catch.hpp"
#include "figures_record.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr int kGlitch = HALL_GLITCH;
constexpr double kTurn = 4294967296.0;  // 2^-32 turn
constexpr double kTwoPi = 6.283185307179586;

struct Adapter {
  static void drive(Vhall_sensor& rtl, const HallSensor::In& in) {
    FELTGATE_DRIVE(rtl, in, hall, count, gain, gates_enable, clear);
  }
  template <class Check>
  static void compare(Check& check, const Vhall_sensor& rtl, const HallSensor::Out& out) {
    FELTGATE_COMPARE(check, rtl, out, angle, exact, faults, waits);
  }
};

using Bench = LockStep<Vhall_sensor, HallSensor, Adapter>;

/// The lines as the order of their edges says: A rises, C falls, B rises, A falls, C rises, B
/// falls.
int sector_of(unsigned code) {
  constexpr std::array<unsigned, 6> order{5, 1, 3, 2, 6, 4};
  for (std::size_t k = 0; k < 6; ++k) {
    if (order[k] == code) return static_cast<int>(k);
  }
  return -1;
}

/// The law in turns, counts and clocks: lines that were the same in Glitch + 2 samples are those of
/// two clocks later; the angle is a begin and all counts since then.
class Reference {
 public:
  const char* operator()(const HallSensor::In& in, const Vhall_sensor& rtl, const HallSensor&,
                         bool in_reset) {
    if (in_reset) {
      *this = Reference{};
    } else {
      clock(in, rtl.faults_o);
    }
    const bool alike = ready_ && sector_of(code_) < 0;
    if ((rtl.waits_o != 0) == ready_) return "waits for a sector by the law";
    if (rtl.faults_o != (seen_ | (alike ? 1u : 0u))) return "faults by the law";
    if ((rtl.exact_o != 0) != exact_) return "exact by the law";
    const double off = std::remainder(rtl.angle_o / kTurn - angle(), 1.0);
    // A begin is in 2^-16 turn.
    return std::fabs(off) < 0x1p-16 ? nullptr : "the angle by the law";
  }

 private:
  double angle() const { return begin_ + counts_ / kTurn; }
  void clock(const HallSensor::In& in, unsigned said) {
    const bool alike = ready_ && sector_of(code_) < 0;
    const bool runs = ready_ && !alike && in.gain != 0;
    unsigned events = alike && in.gates_enable ? 1 : 0;
    bool close = false;
    if (sector_ >= 0) {
      const double off = std::fabs(std::remainder(angle() - (sector_ + 0.5) / 6, 1.0));
      const double limit = exact_ ? 1.0 / 6 : 1.0 / 4;
      // The block rounds the middle and the limit to 2^-16 turn.
      if (off > limit + 2e-5) events |= 2;
      close = std::fabs(off - limit) <= 2e-5;
    }
    bool begins = false, exact = false;
    if (runs) {
      const int sector = sector_of(code_);
      begins = sector_ < 0;
      if (begins) {
        begin_ = (sector + 0.5) / 6;
      } else if (sector != sector_) {
        const bool up = sector == (sector_ + 1) % 6, down = sector_ == (sector + 1) % 6;
        if (!up && !down) events |= 4;
        if (!exact_ && (up || down)) {
          begins = true;
          begin_ = (up ? sector : sector_) / 6.0;
        }
        exact = exact_ || up || down;
      } else {
        exact = exact_;
      }
      sector_ = sector;
    }
    if (begins) counts_ = 0;
    const int moved = (in.count - count_) & 3;
    counts_ += (moved == 1 ? 1.0 : moved == 3 ? -1.0 : 0.0) * in.gain;
    count_ = in.count;
    const bool restarts = in.clear && seen_ != 0;
    if (!runs || restarts) sector_ = -1;
    exact_ = exact && !restarts;
    if (in.gain == 0) begin_ = counts_ = 0;
    if (restarts) events = 0;
    seen_ = (in.clear ? 0 : seen_) | events;
    if (close) seen_ = (seen_ & ~2u) | (said & 2u);  // at the limit either is right
    accept(in.hall & 7u);
  }
  void accept(unsigned hall) {
    // Rows of equal samples that end two clocks ago.
    if (rows_[1] >= kGlitch + 2) {
      code_ = samples_[1];
      ready_ = true;
    }
    rows_[1] = rows_[0];
    samples_[1] = samples_[0];
    rows_[0] = hall == samples_[0] ? rows_[0] + 1 : 1;
    samples_[0] = hall;
  }

  std::array<int, 2> rows_{3, 2};  // the block begins with lines that were low
  std::array<unsigned, 2> samples_{};
  unsigned code_ = 0, seen_ = 0;
  bool ready_ = false, exact_ = false;
  int sector_ = -1, count_ = 0;
  double begin_ = 0, counts_ = 0;
};

/// Anything: lines and gain that change now and then, counts that move, commands.
struct AnyInputs {
  Random random;
  HallSensor::In in{};
  int stay = 0, direction = 1;

  HallSensor::In operator()(std::int64_t) {
    if (stay-- <= 0) {
      stay = static_cast<int>(random.below(random.coin() ? kGlitch + 4u : 8 * kGlitch + 8u));
      const int now = sector_of(in.hall);
      if (now >= 0 && !random.one_in(12)) {
        in.hall = hall_code((now + (random.one_in(30) ? 2 + static_cast<int>(random.below(3))
                                    : direction > 0   ? 1
                                                      : 5)) %
                            6);
      } else {
        in.hall = static_cast<std::uint8_t>(random.below(8));
      }
      if (random.one_in(9)) direction = -direction;
    }
    if (random.one_in(400)) {
      // As many counts in a sector as the lines stay for; one count to a limit, or beside it; or
      // any.
      const std::uint32_t near = random.coin() ? 5459 + random.below(6) : 16'381 + random.below(6);
      in.gain = random.one_in(6)   ? 0
                : random.one_in(4) ? near << 16
                : random.one_in(4) ? static_cast<std::uint32_t>(random.bits())
                                   : static_cast<std::uint32_t>(kTurn / 6 / (4 * kGlitch + 1));
    }
    if (!random.one_in(3)) in.count = (in.count + (direction > 0 ? 1 : 3)) & 3;
    if (random.one_in(150)) in.gates_enable = !in.gates_enable;
    in.clear = random.one_in(60);
    return in;
  }
};

/// A rotor with an encoder and Hall lines; it changes its speed, and may be broken.
struct Rotor {
  enum class Broken {
    no,
    line_low,
    line_high,
    swapped,
    encoder_stands,
    encoder_slips,
    lines_stand
  };
  Random random;
  plant::HallLines lines;
  double counts_per_turn;  // electrical
  Broken broken = Broken::no;
  std::int64_t breaks_at = 1LL << 60;
  int which = 0;
  bool glitches = true;
  double rad = 0, rad_clock = 0, slipped_rad = 0, stands_rad = 0;  // electrical
  std::int64_t counted = 0;
  unsigned stood = 0;

  HallSensor::In operator()(std::int64_t clock) {
    if (clock % 20'000 == 0) rad_clock = (2 * random.uniform() - 1) * 0.2 / (8.0 * kGlitch);
    if (clock % 20'000 > 15'000 && broken == Broken::no) rad_clock *= 0.999;
    rad += rad_clock;
    const bool now = clock >= breaks_at;
    if (!now) stands_rad = rad, stood = lines.code(rad);
    if (now && broken == Broken::encoder_slips) slipped_rad += 0.3 * rad_clock;
    const bool stands = now && broken == Broken::encoder_stands;
    const double seen_rad = (stands ? stands_rad : rad) - slipped_rad;
    const auto wanted = static_cast<std::int64_t>(std::floor(seen_rad / kTwoPi * counts_per_turn));
    counted += wanted > counted ? 1 : wanted < counted ? -1 : 0;
    HallSensor::In in;
    in.count = static_cast<std::uint8_t>(counted & 3);
    in.gain = static_cast<std::uint32_t>(std::llround(kTurn / counts_per_turn));
    in.gates_enable = true;
    unsigned code = lines.code(rad);
    if (now && broken == Broken::line_low) code &= ~(1u << which);
    if (now && broken == Broken::line_high) code |= 1u << which;
    if (now && broken == Broken::lines_stand) code = stood;
    if (broken == Broken::swapped) {
      const int a = which, b = (which + 1) % 3;
      const unsigned differ = (code >> a ^ code >> b) & 1u;
      code ^= differ << a | differ << b;
    }
    if (glitches && clock % 64 < kGlitch / 2 && clock / 64 % 3 == 0)
      code ^= 1u << (clock / 192 % 3);
    in.hall = static_cast<std::uint8_t>(code);
    return in;
  }
};

plant::HallLines misplaced(Random* random, double most_rad) {
  plant::HallLines lines;
  for (double& e : lines.error_rad) e = most_rad * (2 * random->uniform() - 1);
  return lines;
}

double degrees(double rad) { return rad * 360 / kTwoPi; }

}  // namespace

TEST_CASE("hall_sensor: all inputs and resets") {
  Bench bench("hall_sensor", 1, HallSensor(kGlitch));
  std::array<std::int64_t, 3> faults{};
  std::array<std::int64_t, 6> edges{};  // each way at the edge before a sector
  unsigned was = 0;
  bool exact = false;
  const auto watch = [&, reference = Reference{}](const HallSensor::In& in, const Vhall_sensor& rtl,
                                                  const HallSensor& twin, bool in_reset) mutable {
    for (std::size_t k = 0; k < 3; ++k) faults[k] += (rtl.faults_o & ~was) >> k & 1u;
    const auto edge = static_cast<std::size_t>(std::lround(rtl.angle_o / kTurn * 6) % 6);
    edges[edge] += !exact && rtl.exact_o != 0;
    was = rtl.faults_o, exact = rtl.exact_o != 0;
    return reference(in, rtl, twin, in_reset);
  };
  bench.run(AnyInputs{Random(1)}, scaled_clocks(1'500'000), {30'000}, watch);
  for (const std::int64_t n : faults) REQUIRE(n > 300);
  for (const std::int64_t n : edges) REQUIRE(n > 200);
}

TEST_CASE("hall_sensor: codes and sectors are one to one, and a step is one line") {
  unsigned seen = 0;
  for (int sector = 0; sector < 6; ++sector) {
    const unsigned code = hall_code(sector);
    CHECK(hall_sector(code) == sector);
    CHECK(sector_of(code) == sector);
    const unsigned step = code ^ hall_code((sector + 1) % 6);
    CHECK((step & (step - 1)) == 0);
    seen |= 1u << code;
    plant::HallLines lines;
    CHECK(lines.code(kTwoPi * (sector + 0.5) / 6) == code);
  }
  CHECK(seen == 0x7e);
}

TEST_CASE("hall_sensor: a sound rotor: no fault, and how far the angle is off") {
  double before = 0, after = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Random random(seed);
    Rotor rotor{random, misplaced(&random, kTwoPi / 36), seed % 2 == 0 ? 80.0 : 585.142857};
    // From any angle; the counter of the encoder begins at 0.
    rotor.slipped_rad = rotor.rad = kTwoPi * static_cast<double>(seed) / 24 - 3;
    const auto truth = std::make_shared<Rotor>(rotor);
    std::int64_t clock = 0;
    Bench bench("hall_sensor", seed, HallSensor(kGlitch));
    const auto stimulus = [truth, rotor](std::int64_t k) mutable {
      const HallSensor::In in = rotor(k);
      *truth = rotor;
      return in;
    };
    bench.run(stimulus, 60'000, {},
              [&](const HallSensor::In&, const auto&, const HallSensor& twin, bool) {
                const HallSensor::Out& out = twin.out();
                if (clock++ < kGlitch + 10) return static_cast<const char*>(nullptr);
                if (out.faults != 0 || out.waits) return "a sound rotor has a fault";
                const double off =
                    std::fabs(std::remainder(out.angle / kTurn - truth->rad / kTwoPi, 1.0));
                double& most = out.exact ? after : before;
                most = std::fmax(most, 360 * off);
                return static_cast<const char*>(nullptr);
              });
  }
  CAPTURE(before, after);
  // Half a sector, the place of a sensor, what the filter is late by, and two counts.
  CHECK(before > 30);
  CHECK(before < 30 + 10 + 360.0 * 3 / 80 + 5);
  CHECK(after > 5);
  CHECK(after < 10 + 360.0 * 3 / 80 + 5);
}

TEST_CASE("hall_sensor: what is broken is found, and how far the rotor turns until then") {
  using Broken = Rotor::Broken;
  struct Kind {
    const char* name;
    Broken broken;
    double most_degrees;
    unsigned faults;
  };
  // A line that is cut is all alike with the others once in a turn; where the lines or the encoder
  // stand, the angle and its sector move apart by the limit.
  std::string table =
      "| broken | the rotor turns by, electrical degrees: mean | most |\n|---|---|---|\n";
  for (const Kind& kind :
       {Kind{"a line is low", Broken::line_low, 360, 7},
        Kind{"a line is high", Broken::line_high, 360, 7},
        Kind{"all lines stand", Broken::lines_stand, 150, 2},
        Kind{"two lines change places, from power-up on", Broken::swapped, 270, 2},
        Kind{"the encoder stands", Broken::encoder_stands, 150, 2},
        Kind{"the encoder loses 30 % of its counts", Broken::encoder_slips, 420, 2}}) {
    double most = 0, sum = 0;
    constexpr std::uint64_t kSeeds = 36;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      Random random(seed);
      Rotor rotor{random, misplaced(&random, kTwoPi / 72), 240.0};
      rotor.glitches = false;
      rotor.broken = kind.broken;
      rotor.which = static_cast<int>(seed % 3);
      const bool swapped = kind.broken == Broken::swapped;
      rotor.breaks_at = swapped ? 0 : 5'000 + 170 * static_cast<int>(seed);
      if (swapped) rotor.rad = rotor.slipped_rad = 0.17 * static_cast<double>(seed);
      HallSensor twin(kGlitch);
      double from = rotor.rad;
      std::int64_t clock = 0;
      while (twin.out().faults == 0 && clock < 100'000) {
        const HallSensor::In in = rotor(clock);
        rotor.rad_clock = seed % 2 == 0 ? 0.001 : -0.001;
        if (clock == rotor.breaks_at) from = rotor.rad;
        twin.clock(in);
        ++clock;
      }
      CAPTURE(kind.name, seed, clock, twin.out().faults);
      CHECK(clock > rotor.breaks_at);
      CHECK((twin.out().faults & kind.faults) != 0);
      const double turned = degrees(std::fabs(rotor.rad - from));
      sum += turned;
      most = std::fmax(most, turned);
    }
    CAPTURE(kind.name, most);
    CHECK(most > 10);
    CHECK(most < kind.most_degrees);
    table += fmt::format("| {} | {:.0f} | {:.0f} |\n", kind.name, sum / kSeeds, most);
  }
  check_figures("hall_sensor", table);
}
