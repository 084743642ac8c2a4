// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The whole chain tick by tick, from the sampled counts to the duty, by the laws of the axis in a
// number policy N: Fixed, or Real<T> with T float, double or 113 bits. It has no pins, no clocks
// and no safety. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <array>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "feltgate/axis/observer.hpp"
#include "feltgate/axis/params.hpp"
#include "feltgate/axis/ramp.hpp"
#include "feltgate/axis/scene.hpp"
#include "feltgate/axis/torque_law.hpp"
#include "feltgate/axis/velocity_estimator.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/quad.hpp"
#include "real_chain.hpp"

namespace feltgate {

/// Integer of a parameter for a value in its unit, rounded to nearest.
/// Throws std::invalid_argument when it does not fit, with the range.
std::int64_t quantise_parameter(const ParameterInfo& info, double value);

/// Makes the chain "fixed", "float", "double" or "quad". Throws std::invalid_argument for another
/// kind, and for a design whose velocity needs the clocks of the edges.
std::unique_ptr<RealChain> make_chain(const DesignInfo& design, const std::string& kind);

/// What may stand between the ramp and the torque law: nothing.
template <class N>
struct AsIs {
  using T = typename N::T;
  void reset() {}
  T tick(T tau_ref, T, T) { return tau_ref; }
};

/// `Controller`: gets tau_ref, tau_hat and velocity, and gives the torque that the motor is to
/// have.
template <class N, class Controller = AsIs<N>>
class Chain final : public RealChain {
 public:
  using T = typename N::T;

  Chain(const char* name, DesignInfo design, Controller controller = {})
      : name_(name),
        design_(std::move(design)),
        controller_(std::move(controller)),
        formats_(design_.data),
        velocity_law_(design_.data),
        observer_law_(design_.data),
        scene_law_(design_.data),
        ramp_law_(design_.data),
        torque_law_(design_.data),
        measures_(design_.data["CURRENT_LOOP"] != 0),
        velocity_f_(design_.data["VELOCITY_F"]),
        torque_f_(design_.data["TORQUE_F"]),
        current_f_(design_.data["CURRENT_F"]),
        voltage_f_(design_.data["VOLTAGE_F"]) {
    if constexpr (!N::is_fixed) {
      if (design_.velocity_gain_rad_s != 0) {
        velocity_law_.gain = static_cast<T>(design_.velocity_gain_rad_s);
        velocity_law_.exponent = velocity_f_;
      }
    }
    reset();
  }
  const char* name() const override { return name_; }

  void reset() override {
    stored_.fill(0);
    words_ = {};
    for (const ParameterInfo& p : design_.parameters) {
      if constexpr (N::is_fixed) {
        store(p.address, static_cast<Stored>(p.raw));
      } else {
        store(p.address, static_cast<Stored>(p.si));
      }
    }
    line_.assign(static_cast<std::size_t>(design_.data["M1"]), 0);
    window_ = {};
    velocity_ = {};
    observer_ = {};
    scene_ = {};
    ramp_ = {};
    torque_ = {};
    program_ = {};
    controller_.reset();
    made_ = false;
    raw_ = {};
  }

  void set_parameter(int address, double value) override {
    if constexpr (N::is_fixed) {
      const ParameterInfo& info = design_.at(address);
      set_word(address, static_cast<std::uint32_t>(quantise_parameter(info, value)));
    } else {
      store(address, static_cast<Stored>(value));
    }
  }

  void set_word(int address, std::uint32_t written) override {
    const Format f = design_.at(address).field;
    const std::uint32_t word = fitted(f, written);
    if constexpr (N::is_fixed) {
      store(address, word);
    } else {
      const std::int64_t integer =
          f.sign != 0 ? axis::signed_bits(word, f.width()) : axis::low_bits(word, f.width());
      store(address, static_cast<Stored>(axis::Fixed::value(integer, f.fraction)));
    }
  }

  void program(double torque_nm) override { program_.torque = N::of(torque_nm, torque_f_); }

  void tick(const ChainIn& in) override {
    const bool armed = in.armed;
    load_scene(in.scene);
    if (in.restart) ramp_.ramping = true;
    velocity_ = velocity_law_.tick(velocity_, words_, window_.counts(in.travel));
    window_.tick(line_.data(), static_cast<int>(line_.size()), in.travel);
    const T velocity = velocity_.velocity;
    const T current =
        measures_ ? N::integer(static_cast<T>(in.current), 0, current_f_) : torque_.current;
    observer_ = observer_law_.tick(observer_, words_, armed, current, velocity);
    scene_ =
        scene_law_.tick(scene_, words_, armed, in.scene, in_scene(in.position), velocity, program_);
    ramp_ = ramp_law_.tick(
        ramp_, words_,
        {armed, in.scene, in.relief.frozen, in.relief.derated, false, scene_.torque});
    if (!armed) controller_.reset();
    const T asked = controller_.tick(ramp_.tau_ref, observer_.tau_hat, velocity);
    torque_ = torque_law_.tick(torque_, words_, armed, in.mode, asked, observer_.tau_hat, velocity);
    made_ = false;
    if constexpr (N::is_fixed) {
      raw_ = {velocity_.velocity,
              static_cast<std::int32_t>(observer_.tau_hat),
              static_cast<std::int32_t>(ramp_.tau_ref),
              static_cast<std::int32_t>(torque_.current),
              static_cast<std::int32_t>(torque_.voltage),
              static_cast<std::int16_t>(torque_.duty),
              limits()};
    }
  }

  const ChainOut& out() const override {
    if (made_) return out_;
    made_ = true;
    out_ = {N::value(velocity_.velocity, velocity_f_), N::value(observer_.tau_hat, torque_f_),
            N::value(ramp_.tau_ref, torque_f_),        N::value(torque_.current, current_f_),
            N::value(torque_.voltage, voltage_f_),     N::value(torque_.duty, 0)};
    return out_;
  }

  bool ramping() const override { return ramp_.limit_ramp; }
  const ChainRaw* raw() const override { return N::is_fixed ? &raw_ : nullptr; }

  T velocity() const { return velocity_.velocity; }
  T tau_hat() const { return observer_.tau_hat; }
  T tau_ref() const { return ramp_.tau_ref; }
  T current() const { return torque_.current; }
  T voltage() const { return torque_.voltage; }
  /// Input of the velocity's low-pass in a tick with this travel.
  T velocity_input(std::int16_t travel) const {
    return N::saturate(velocity_law_.speed(window_.counts(travel)), velocity_law_.w);
  }

 private:
  /// The word in fixed point, else the value in the parameter's unit.
  using Stored = std::conditional_t<N::is_fixed, std::uint32_t, T>;

  /// Saturated in fixed point alone.
  static std::int64_t in_scene(std::int32_t position) {
    return N::is_fixed ? axis::Fixed::saturate(position, 18) : position;
  }
  void store(int address, Stored x) {
    stored_[static_cast<std::size_t>(address)] = x;
    if (address >= 64) {
      loaded_ = -1;
    } else if constexpr (N::is_fixed) {
      formats_.load(words_, address, x);
    } else if (const auto word = axis::Words<T>::common(address)) {
      words_.*word = x;
    }
  }
  /// The words of the scene in force. In real arithmetic a place has one value, whatever its name.
  void load_scene(int scene) {
    if (scene == loaded_) return;
    loaded_ = scene;
    for (const int place : axis::ParamsMemory::places) {
      const Stored x = stored_[static_cast<std::size_t>(scene * 32 + place)];
      if constexpr (N::is_fixed) {
        formats_.load_scene(words_, place, x);
      } else if (place == 1) {
        words_.first = x;
      } else if (place == 2) {
        words_.second = words_.stiffness = words_.strength = x;
      } else if (place == 3) {
        words_.slope = x;
      } else if (place == 6) {
        words_.core = x;
      } else {
        words_.damping = words_.torque = x;
      }
    }
  }
  std::uint16_t limits() const {
    using L = Map::L;
    return static_cast<std::uint16_t>(
        ramp_.limit_torque << L::torque | ramp_.limit_ramp << L::ramp |
        torque_.limit_current << L::current | torque_.limit_voltage << L::voltage |
        torque_.limit_duty << L::duty | velocity_.saturated << L::velocity |
        observer_.saturated << L::tau_hat);
  }

  const char* name_;
  DesignInfo design_;
  Controller controller_;
  axis::WordFormats formats_;
  axis::VelocityEstimator<N> velocity_law_;
  axis::Observer<N> observer_law_;
  axis::Scene<N> scene_law_;
  axis::Ramp<N> ramp_law_;
  axis::TorqueLaw<N> torque_law_;
  bool measures_;
  int velocity_f_, torque_f_, current_f_, voltage_f_;

  std::array<Stored, 512> stored_{};
  axis::Words<T> words_;
  int loaded_ = -1;  ///< the scene whose words are in words_
  std::vector<std::int16_t> line_;
  axis::TravelWindow window_;
  typename axis::VelocityEstimator<N>::State velocity_;
  typename axis::Observer<N>::State observer_;
  typename axis::Scene<N>::State scene_;
  typename axis::Ramp<N>::State ramp_;
  typename axis::TorqueLaw<N>::State torque_;
  axis::Law<T> program_;
  mutable ChainOut out_;  // made from the chain when first asked for after a tick
  mutable bool made_ = false;
  ChainRaw raw_;
};

}  // namespace feltgate
