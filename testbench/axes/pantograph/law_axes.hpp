// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law file in real numbers as a law of joints. docs/devices/pantograph.md
#pragma once

#include <string>
#include <vector>

#include "catch.hpp"
#include "law/evaluate.hpp"
#include "law/read_law.hpp"
#include "sampled_law.hpp"

namespace feltgate::plant {

class LawAxes {
 public:
  explicit LawAxes(const std::string& name)
      : law_(law::read_law(std::string(FELTGATE_SOURCE_DIR) + "/rtl/laws/" + name + ".law")),
        evaluation_(law_) {}
  LawAxes(const LawAxes&) = delete;  // the evaluation refers to the law in this object
  LawAxes& operator=(const LawAxes&) = delete;

  void set(const std::string& name, double si) {
    for (std::size_t i = 0; i < law_.parameters.size(); ++i) {
      if (law_.parameters[i].name == name) return evaluation_.set_parameter(i, si);
    }
    FAIL("the law has no parameter " << name);
  }
  std::array<double, 2> torque(const AxesMotion<2>& m) {
    inputs_.clear();
    for (const law::Input& input : law_.inputs) {
      const auto axis = static_cast<std::size_t>(input.axis);
      inputs_.push_back(input.source == law::Source::position ? m.theta_rad[axis]
                                                              : m.omega_rad_s[axis]);
    }
    evaluation_.run(inputs_);
    std::array<double, 2> torque{};
    for (std::size_t i = 0; i < law_.outputs.size(); ++i) {
      torque[static_cast<std::size_t>(law_.outputs[i].axis)] = evaluation_.outputs()[i];
    }
    return torque;
  }
  AxesLaw<2> axes() {
    return [this](const AxesMotion<2>& m) { return torque(m); };
  }

 private:
  law::Law law_;
  law::Evaluation<double> evaluation_;
  std::vector<double> inputs_;
};

}  // namespace feltgate::plant
