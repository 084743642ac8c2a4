// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Effect of a host's write while the motor is armed: a parameter acts, lets the torque ramp, or is
// refused; part of the control word is held. Used by Device, and by chains that run beside a
// core. Documentation: docs/blocks/ramp.md, docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Effect of a write: at once; at once, but the torque ramps; none, the write is dropped.
enum class WhileArmed : std::uint8_t { acts, ramps, refused };

/// Whether a scene's torque is an input, which acts at once, rather than a law of the position.
constexpr bool is_input_scene(int scene) { return ((Map::input_scenes >> scene) & 1U) != 0; }

/// Effect of a write to the parameter at `address` (below 512) while `scene` is in force.
constexpr WhileArmed while_armed(int address, int scene) {
  const auto in = [address](std::uint64_t mask) {
    return address < 64 && ((mask >> address) & 1U) != 0;
  };
  if (in(Map::refused_while_armed)) return WhileArmed::refused;
  const bool of_scene = address >= 64 && address / 32 == scene && !is_input_scene(scene);
  return of_scene || in(Map::ramps_while_armed) ? WhileArmed::ramps : WhileArmed::acts;
}

/// Fields of the control word that are held while armed.
constexpr std::uint32_t held_control =
    (~std::uint32_t{0} << Map::C::control_mode) & ((1U << Map::C::control_width) - 1);

/// Whether a control word disarms: the host has control in it and does not ask to arm.
constexpr bool disarms(std::uint32_t control) {
  return ((control >> Map::C::control_host) & 1U) != 0 &&
         ((control >> Map::C::control_arm) & 1U) == 0;
}

/// The control word in force after `written` is carried out; `holds`: the held fields do not
/// change.
constexpr std::uint32_t control_after(std::uint32_t in_force, std::uint32_t written, bool holds) {
  const std::uint32_t held = holds ? held_control : 0;
  return (in_force & held) | (written & ~held & ((1U << Map::C::control_width) - 1));
}

/// Repeats the core's treatment of host writes for a chain that has no register port.
class HostBeside {
 public:
  explicit HostBeside(std::uint32_t control_reset) : control_(control_reset) {}

  /// A write that the core has carried out since the last tick; returns whether to set a parameter.
  /// `armed`: whether the core is armed since. `disarmed`: a disarm came in the same tick.
  bool write(int address, std::uint32_t word, bool armed, bool disarmed = false) {
    armed = armed || armed_;
    if (address == Map::C::control) {
      control_ = control_after(control_, word, armed && !disarmed && !disarms(word));
    } else if (address == Map::C::command) {
      if (((word >> Map::C::command_set_zero) & 1U) != 0) zero();
    } else if (address < 512) {
      const WhileArmed effect = while_armed(address, scene_);
      if (effect == WhileArmed::ramps) restart_ = true;
      return !armed || effect != WhileArmed::refused;
    }
    return false;
  }
  /// Reports that the position was set to zero.
  void zero() { restart_ = restart_ || !is_input_scene(scene_); }

  int mode() const {
    return static_cast<int>((control_ >> Map::C::control_mode) &
                            ((1U << Map::C::control_mode_width) - 1));
  }
  /// Call once per tick, with the state of that tick; returns whether the ramp starts again.
  bool restart(bool armed, int scene) {
    const bool now = restart_;
    armed_ = armed;
    scene_ = scene;
    restart_ = false;
    return now;
  }

 private:
  std::uint32_t control_;
  bool armed_ = false, restart_ = false;
  int scene_ = 0;
};

}  // namespace feltgate
