// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/image_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "law/host_machine.hpp"
#include "sim/backends/backend.hpp"

namespace feltgate::page {

namespace {

/// The nearest word of `width` bits.
std::int32_t word_of(double value, int fraction, int width) {
  const double top = std::ldexp(1.0, width - 1);
  const double word = std::nearbyint(std::ldexp(value, fraction));
  return static_cast<std::int32_t>(std::clamp(word, -top, top - 1));
}

}  // namespace

StateWord state_word(const law::Compiled& law, const std::string& name) {
  for (std::size_t k = 0; k < law.law.states.size(); ++k) {
    if (law.law.states[k].name != name) continue;
    const int first = law.target.thread * EngineMap::private_words;
    return {first + law.assembled.state_address[k], law.program.states[k].scale};
  }
  throw std::invalid_argument(fmt::format("law {} has no state {}", law.image.name, name));
}

ImageLaw::ImageLaw(const std::string& image_text)
    : image_(law::read_image(image_text)),
      design_(design_named(image_.design)),
      values_(image_),
      machine_(law::memory(image_)),
      period_s_(image_.threads[0].divider / static_cast<double>(design_.tick_hz)) {
  machine_.enter();
}

void ImageLaw::set(const std::string& parameter, double value) {
  law::write(machine_, values_.set(parameter, value));
}

void ImageLaw::set(const std::map<std::string, double>& values) {
  law::write(machine_, values_.set(values));
}

void ImageLaw::joint(int axis, double angle_rad, double speed_rad_s, double observed_nm) {
  const auto first = static_cast<std::size_t>(3 * axis);
  inputs_[first] = static_cast<std::int32_t>(std::floor(angle_rad / design_.count_rad));
  const Format f = design_.velocity, t = design_.torque;
  inputs_[first + 1] = word_of(speed_rad_s, f.fraction, f.width());
  inputs_[first + 2] = word_of(observed_nm, t.fraction, t.width());
}

void ImageLaw::joints(plant::Vec3 rad, plant::Vec3 rad_s) {
  joint(0, rad.x, rad_s.x);
  joint(1, rad.y, rad_s.y);
  joint(2, rad.z, rad_s.z);
}

void ImageLaw::run() {
  run_ = &machine_.run(0, inputs_);
  if (!run_->ended) throw std::runtime_error(fmt::format("law {} does not end", image_.name));
}

double ImageLaw::torque_nm(int axis) const {
  const Format f = design_.torque;
  const std::int32_t top = static_cast<std::int32_t>((std::int64_t{1} << (f.width() - 1)) - 1);
  const std::int32_t word = run_->outputs[static_cast<std::size_t>(axis)];
  return std::ldexp(std::clamp(word, -top - 1, top), -f.fraction);
}

}  // namespace feltgate::page
