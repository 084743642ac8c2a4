// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_point_bounds ROOT FILE.toml VELOCITY: the proven bounds of a design, coarse or not,
// against the exact one, up to a raw velocity of so many rad/s, as JSON. Documentation:
// docs/speed-for-accuracy.md
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "feltgate/largest.hpp"
#include "files/toml/toml_reader.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace {

/// A bound above this counts as infinite: outward rounding can make infinity finite.
constexpr double endless = 1e100;

}  // namespace

int main(int argc, char** argv) {
  using namespace feltgate;
  if (argc != 4) {
    std::cerr << "usage: feltgate_point_bounds ROOT FILE.toml VELOCITY\n";
    return 2;
  }
  try {
    const auto registers = design::read_registers(std::string(argv[1]) + "/rtl/registers.toml");
    auto d = design::read_design(argv[2]);
    d.allow_coarse = true;
    const auto e = elaborate(d, registers);
    // The worst of the scenes that have a bound; the others are named.
    std::vector<std::pair<std::string, double>> worst{
        {"torque_nm", 0}, {"tau_ref_nm", 0}, {"tau_hat_nm", 0}, {"velocity_rad_s", 0}};
    nlohmann::ordered_json j, without = nlohmann::ordered_json::array();
    for (const std::string& scene : d.scenes) {
      const auto b = bounds::error_bounds(e, {std::atof(argv[3]), scene, 0});
      const double found[] = {b.torque_nm.against_exact, b.tau_ref_nm.against_exact,
                              b.tau_hat_nm.against_exact, b.velocity_rad_s.against_exact};
      if (*std::max_element(std::begin(found), std::end(found)) > endless) {
        without.push_back(scene);
        continue;
      }
      for (std::size_t k = 0; k < worst.size(); ++k) {
        worst[k].second = larger(worst[k].second, found[k]);
      }
    }
    for (const auto& [name, bound] : worst) j["bound_" + name] = bound;
    j["bound_without"] = without;
    std::cout << j.dump() << "\n";
    return 0;
  } catch (const config::ConfigError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
