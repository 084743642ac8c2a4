// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extracts the numbers of a design for an error bound. Documentation: docs/error-bounds.md
#include "studies/bounds/chain_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace feltgate::bounds {

double Number::used() const { return std::ldexp(static_cast<double>(raw), -format.fraction); }

const Number& ChainNumbers::at(const std::string& name) const {
  for (const Number& n : numbers) {
    if (n.name == name) return n;
  }
  throw std::out_of_range("the design has no parameter " + name);
}

void ChainNumbers::set(const std::string& name, double value) {
  (void)at(name);
  for (Number& n : numbers) {
    if (n.name != name) continue;
    n.si = value;
    n.raw = std::llround(std::ldexp(value, n.format.fraction));
  }
}

bool ChainNumbers::built(const std::string& scene) const {
  return std::find(scenes.begin(), scenes.end(), scene) != scenes.end();
}

ChainNumbers chain_numbers(const design::Elaborated& e) {
  e.design.needs_n_method("the error bound");
  ChainNumbers c;
  c.design = e.design.name;
  c.formats = e.formats;
  c.rounding = e.design.rounding;
  c.used_gain = e.rad_s_per_count();
  c.exact_gain = e.design.velocity_gain_rad_s();
  c.quantised_gain = e.velocity_gain != 0;
  c.reference_gain = c.quantised_gain ? c.exact_gain : c.used_gain;
  c.gain_fraction = e.base.velocity_gain.fraction;
  for (const design::Word& w : e.words) {
    c.numbers.push_back({w.parameter.name, w.format, w.si, w.raw});
  }
  c.scenes = e.design.scenes;
  return c;
}

}  // namespace feltgate::bounds
