// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design of a plant: every value of the base is scaled by what the plant has in its place.
// Documentation: docs/designs.md
#include "studies/stability/for_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "files/toml/toml_reader.hpp"
#include "studies/stability/for_plant_maker.hpp"
#include "studies/stability/loop_poles.hpp"

namespace feltgate::stability {

using namespace design;

namespace {

using plant::Effects;

/// A name that can stand in a comment and between quotes.
std::string plain(std::string name) {
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte >= 127 || c == '"' || c == '\\') c = '_';
  }
  return name;
}

/// The key in the line that an error names, "" where it names none.
std::string key_of(const std::string& error, const std::string& path, const std::string& text) {
  if (error.compare(0, path.size() + 1, path + ":") != 0) return {};
  long line = std::strtol(error.c_str() + path.size() + 1, nullptr, 10);
  std::size_t at = 0;
  for (; line > 1 && at != std::string::npos; --line) at = text.find('\n', at) + 1;
  const std::string row = text.substr(at, text.find('\n', at) - at);
  return row.substr(0, row.find(' '));
}

}  // namespace

PlantDesign design_for_plant(const std::string& base, const Parameters& p, double nominal_a,
                             const std::string& as_named, const std::string& path,
                             const RegisterMap& registers) {
  const std::string plant_name = plain(as_named);
  const Design d = read_design(base);
  if (d.voltage_law != "motor_model") {
    d.fail("voltage.law",
           "the gains of the law \"" + d.voltage_law + "\" are not a plant's constants",
           "take a base with law = \"motor_model\", such as lever");
  }
  if (p.phases.has_value() != (d.phases == 3)) {
    d.fail("pwm.phases",
           fmt::format("the motor of plant {} has {}", plant_name,
                       p.phases ? "three phases" : "brushes"),
           p.phases ? "take a base that drives such a motor, gimbal_motor or hall_motor"
                    : "take a base that drives such a motor, lever or lever_absolute");
  }
  if (d.hall && !p.phases->hall) {
    d.fail("commutation.hall", fmt::format("the motor of plant {} has no Hall lines", plant_name),
           "take a base with an absolute encoder, such as gimbal_motor");
  }
  Maker maker(base, d, p, nominal_a, plant_name);
  const std::string head =
      fmt::format("# Written by: feltgate design {} --for-plant {} --nominal-current {:g}\n",
                  d.name, plant_name, nominal_a);
  PlantDesign made;
  // Where the quantised compensation of the back-EMF would exceed it, the lever speeds up by
  // itself.
  for (const double share : {1.0, 0.999, 0.99, 0.97}) {
    maker.set_emf(share * p.motor.back_emf_constant_v_s_rad);
    for (bool whole = false; !whole;) {
      made.text = head + maker.text();
      try {
        made.design = elaborate(design_from_text(made.text, path), registers);
        whole = true;
      } catch (const config::ConfigError& e) {
        if (maker.drop(key_of(e.what(), path, made.text))) continue;
        // The file of these lines is not written.
        const std::string told = e.what();
        const std::size_t place = told.find(": ");
        throw std::invalid_argument(
            fmt::format("{} with the constants of the plant {} is no design: {}", d.name,
                        plant_name, place == std::string::npos ? told : told.substr(place + 2)));
      }
    }
    if (closed_loop(made.design, p).stable()) {
      if (share < 1) {
        maker.notes.push_back(fmt::format(
            "motor.emf_constant_v_s_rad is {} of the plant's: with all of it the loop is unstable",
            share));
      }
      break;
    }
  }
  refuse_unstable(made.design, p);
  made.notes = maker.notes;
  Effects all;
  made.changed = shared_constants(d, p, all);
  const auto same = [](const Constant& c) { return std::abs(c.excess()) < 1e-9; };
  made.changed.erase(std::remove_if(made.changed.begin(), made.changed.end(), same),
                     made.changed.end());
  return made;
}

}  // namespace feltgate::stability
