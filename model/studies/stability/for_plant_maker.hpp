// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes the design of a plant step by step: every value of the base is scaled by what the plant has
// in its place. Documentation: docs/designs.md
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "design/design.hpp"
#include "design/text_edit.hpp"
#include "sim/plant/parameters.hpp"

namespace feltgate::stability {

using design::Design;
using design::TextEdit;
using plant::Parameters;

/// A number as TOML: a float keeps its point.
std::string toml_number(double value);

/// Edits the base step by step; later steps use what earlier ones found.
class Maker {
 public:
  Maker(const std::string& base, const Design& d, const Parameters& p, double nominal_a,
        const std::string& plant_name)
      : d_(d), m_(d), p_(p), nominal_a_(nominal_a), edit_(base, "of the plant " + plant_name) {
    edit_.set_description(fmt::format("{} with the constants of the plant {}", d.name, plant_name));
    constants();
    encoder();
    edit_.because("follows from the plant");
    clock();
    limits();
    heat();
    polarity();
    self_test();
    scenes();
    current_loop();
    formats();
    tell();
  }

  void set_emf(double emf) { set("motor", "emf_constant_v_s_rad", emf); }
  /// Leaves out the scenes of a key of [scenes]; false where it is not one's.
  bool drop(const std::string& key);
  std::string text() const { return edit_.text(); }
  std::vector<std::string> notes;

 private:
  void set(const char* section, const char* key, double value) {
    if (edit_.text_of(section, key)) edit_.set(section, key, toml_number(value));
  }
  template <class... Args>
  void note(fmt::format_string<Args...> text, Args&&... args) {
    notes.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void constants();
  void encoder();
  void clock();
  void limits();
  void heat();
  void polarity();
  void self_test();
  void scenes();
  void current_loop();
  void formats();
  void tell();

  double speed_without_load(const Design& d) const {
    return d.full_duty_v() / d.emf_constant_v_s_rad;
  }
  /// The largest step of the estimated speed that one count makes.
  double grain_rad_s() const { return m_.count_rad() * m_.velocity_cutoff_rad_s; }
  /// The current that dead time and brushes count for in the estimate.
  double dead_a() const {
    return design::parameter_values(m_).at("dead_voltage").si / m_.resistance_ohm;
  }

  const Design d_;  ///< the base
  Design m_;        ///< what is made, as far as it goes
  const Parameters& p_;
  double nominal_a_;
  TextEdit edit_;
  int slower_ = 1;  ///< ticks are so much longer than the base's
};

}  // namespace feltgate::stability
