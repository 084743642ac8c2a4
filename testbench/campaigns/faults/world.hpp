// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The environment of the fault campaign: scenes that give torque, with motor, lever and a hand;
// what breaks of the sensors of other designs than lever. Documentation: docs/testing.md
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "campaigns/faults/outcome.hpp"
#include "encoder_phase.hpp"
#include "feltgate/core_ports.hpp"
#include "feltgate/design_info.hpp"
#include "random.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::faults {

/// The word of a parameter, with its address.
struct Word {
  int address = 0;
  std::uint32_t data = 0;
};

struct Act {
  std::string name;
  int scene = 0;
  bool arm = true;
  std::vector<Word> words;  ///< written before arming
  plant::Hand hand;
  double warm_s = 0.1;     ///< time before the faults; the scene gives torque by then
  double window_s = 0.06;  ///< time in which the faults come
};

/// Wall, spring, damper, membrane, charge, setpoint, free, disarmed; of design `lever`.
std::vector<Act> acts();

/// Word of a parameter for a value in its unit, of a design and of lever. Throws
/// std::invalid_argument.
Word word_of(const DesignInfo& design, const std::string& parameter, double value);
Word word(const std::string& parameter, double value);
/// 0 to 1, without its ends; and 1 or -1.
inline double share(test::Random* r) { return 1e-6 * (1 + static_cast<double>(r->below(999998))); }
inline double sign(test::Random* r) { return r->coin() ? 1 : -1; }
/// Hands.
plant::Hand leaning_hand(double from_rad, double to_rad, double sway_rad, double sway_hz);
plant::Hand moving_hand(double from_rad, double rad_s);

/// What is broken.
struct Harm {
  enum class Line { sound, low, high, held, noise };
  Line modulator = Line::sound;
  double reads = 1, offset_a = 0;  ///< of the current, what the modulator gets
  unsigned shunts = 1;             ///< of which this holds, by the bits of CoreIn::current_data
  bool exchanged = false;          ///< the lines of two modulators
  bool driver_fault = false;       ///< a pulse of nFAULT
  bool shorted = false;            ///< the motor's terminals
  unsigned dead_gates = 0;         ///< that stay off, by the bits of CoreOut::gates
  double loose_s = 0;              ///< for so long only; 0: for ever
  std::optional<std::size_t> open_phase;
  bool swapped_phases = false;  ///< B and C
  AbsoluteSensor::Defect sensor = AbsoluteSensor::Defect::none;
  int stuck_bit = -1;  ///< of its angle; its frames are valid
  bool stuck_high = false;
  unsigned cut_lines = 0;      ///< to the sensor, by the bits of CoreOut::serial: it sees them high
  double flips = 0;            ///< share of the clocks in which the sensor's data pin is inverted
  double slipped_rad = 0;      ///< of the magnet on its shaft
  bool channels_held = false;  ///< of an encoder with A and B
  double slips = 0;            ///< share of the counts that such an encoder loses
  unsigned hall_low = 0, hall_high = 0;  ///< Hall lines that stand, by the bits of CoreIn::hall
  int hall_exchanged = -1;               ///< this one and the next
  bool stop = false;
  /// A sensor that is not there is plugged in so long after the request to arm: nothing is broken
  /// from then on. 0: never.
  double late_s = 0;
};

/// An encoder with A and B whose hub slips: the pins of the counts that are left.
class SlippingEncoder {
 public:
  explicit SlippingEncoder(EncoderPins now) : was_(phase(now)), base_(phase(now)) {}
  EncoderPins shown(EncoderPins now, double loses) {
    const unsigned p = phase(now);
    const unsigned moved = (p - was_) & 3U;
    was_ = p;
    if (moved == 1) ++counts_;
    if (moved == 3) --counts_;
    const double left = static_cast<double>(counts_) * (1 - loses);
    return test::pins_at(base_ + static_cast<unsigned>(static_cast<std::int64_t>(std::floor(left))),
                         now.z);
  }

 private:
  static unsigned phase(EncoderPins p) { return p.a ? (p.b ? 2 : 3) : (p.b ? 1 : 0); }
  unsigned was_, base_;
  std::int64_t counts_ = 0;
};

/// Hall lines as broken wires make them.
inline std::uint8_t broken_hall(unsigned code, const Harm& harm) {
  if (harm.hall_exchanged >= 0) {
    const auto a = static_cast<unsigned>(harm.hall_exchanged), b = (a + 1) % 3;
    const unsigned differ = (code >> a ^ code >> b) & 1U;
    code ^= differ << a | differ << b;
  }
  return static_cast<std::uint8_t>((code | harm.hall_high) & ~harm.hall_low);
}

plant::Plant make_plant(const std::string& root, const plant::Hand& hand);
TorqueJudge::Motor motor_of_plant(const std::string& root);
double count_rad();

/// Converts gate times to the bridge input of the plant.
plant::Bridge bridge_of(const GateTimes& gates, int clocks);

}  // namespace feltgate::faults
