// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of a design beside a plant's. Documentation: docs/designs.md
#include "studies/stability/constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace feltgate::stability {

using design::Design;
using plant::Effects;
using plant::Parameters;

std::vector<Constant> shared_constants(const Design& d, const Parameters& p, const Effects& on) {
  const bool model = d.voltage_law == "motor_model";
  std::vector<Constant> all{
      {"torque constant", "Nm/A", "observer.torque_constant_nm_a", d.torque_constant_nm_a,
       p.motor.torque_constant_nm_a},
      {"resistance", "ohm", "motor.resistance_ohm", d.resistance_ohm, p.motor.resistance_ohm},
      {"inertia", "kg m^2", "observer.inertia_kg_m2", d.inertia_kg_m2, p.lever.inertia_kg_m2}};
  if (!d.absolute) {  // its bits are its own
    all.push_back({"encoder lines", "", "encoder.lines", static_cast<double>(d.lines),
                   static_cast<double>(p.encoder.lines)});
  }
  all.push_back({"supply voltage", "V", "pwm.supply_v", d.supply_v, p.supply.voltage_v});
  if (on.back_emf) {
    all.push_back({"back-EMF constant", "V s/rad", "motor.emf_constant_v_s_rad",
                   d.emf_constant_v_s_rad, p.motor.back_emf_constant_v_s_rad});
  }
  // Where the plant has none, what the design adds for it is torque too much.
  if (model && (on.dead_voltage || d.dead_voltage_v > 0)) {
    all.push_back({"dead voltage", "V", "voltage.dead_voltage_v", d.dead_voltage_v,
                   on.dead_voltage ? p.motor.dead_voltage_v : 0});
  }
  if (d.phases == 3 && p.phases) {
    all.push_back({"pole pairs", "", "commutation.pole_pairs", static_cast<double>(d.pole_pairs),
                   static_cast<double>(p.phases->pole_pairs)});
    // With Hall lines it is theirs, wherever the rotor stands at power-up.
    const bool lines = d.hall && p.phases->hall;
    all.push_back({"electrical offset", "rad", "commutation.offset_rad", d.commutation_offset_rad,
                   lines ? p.phases->hall->begin_rad : p.phases->offset_rad});
  }
  if (d.compensate_dead_time && (on.dead_time || d.diode_drop_v > 0)) {
    all.push_back({"diode drop", "V", "pwm.diode_drop_v", d.diode_drop_v,
                   on.dead_time ? p.supply.diode_drop_v : 0});
  }
  return all;
}

double Constant::excess() const {
  if (of_design == of_plant) return 0;
  return of_design == 0 ? std::numeric_limits<double>::infinity() : of_plant / of_design - 1;
}

std::vector<Constant> differing_constants(const Design& d, const Parameters& p,
                                          const Effects& effects) {
  std::vector<Constant> found = shared_constants(d, p, effects);
  const auto close = [](const Constant& c) { return std::abs(c.excess()) <= noticeable; };
  found.erase(std::remove_if(found.begin(), found.end(), close), found.end());
  return found;
}

}  // namespace feltgate::stability
