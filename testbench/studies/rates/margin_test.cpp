// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Margins against the borders of the stability study and against 2 b / T.
#include "studies/rates/margin.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/plant/plant_file.hpp"
#include "studies/stability/mass_loop.hpp"

using namespace feltgate;
using namespace feltgate::rates;

namespace {

stability::LoopModel model() {
  const std::string root = FELTGATE_ROOT;
  const auto e = design::elaborate(design::read_design(root + "/rtl/designs/lever.toml"),
                                   design::read_registers(root + "/rtl/registers.toml"));
  return stability::make_model(e, plant::read_plant_file(root + "/vectors/plants/linear.toml"));
}

Slope slope(double stiffness_nm_rad, double damping_nm_s_rad, double jump_nm = 0) {
  Slope s;
  s.stiffness_nm_rad = stiffness_nm_rad;
  s.damping_nm_s_rad = damping_nm_s_rad;
  s.jump_nm = jump_nm;
  return s;
}

}  // namespace

TEST_CASE("a sampled wall without other delays ends at 2 b / T") {
  // b = 0.003 and B = 0.1 N s/m; so heavy that a period's swing is small: what the backward
  // difference itself lags is none.
  const double rates_hz[] = {144, 490, 1e3, 40e3, 1e6};
  const double expected_n_m[] = {29.7, 100.9, 206, 8240, 2.06e5};
  for (int i = 0; i < 5; ++i) {
    const stability::MassLoop loop{1e6 / rates_hz[i], 0.003, 1 / rates_hz[i], 0.1, 0, 0};
    CAPTURE(rates_hz[i]);
    CHECK(stability::stiffest(loop) == Approx(expected_n_m[i]).epsilon(0.005));
    CHECK(stability::stiffest(loop) == Approx(2 * 0.103 * rates_hz[i]).epsilon(0.005));
  }
}

TEST_CASE("a margin is the border of the stability study over the stiffness") {
  const stability::LoopModel m = model();
  const Slope wall = slope(4, 0.005);
  for (const int ticks : {1000, 100, 1}) {
    const int delay = ticks > 1 ? stability::host_ticks : 0;
    const Margin found = margin(m, wall, ticks, delay);
    const double border = stability::border(m, 0.005, ticks).stiffness_nm_rad;
    CAPTURE(ticks);
    CHECK(found.of == Margin::Of::stiffness);
    CHECK(found.border == Approx(border).epsilon(0.003));
    CHECK(found.ratio == Approx(border / 4).epsilon(0.003));
  }
  // A run of the engine costs a tick of delay beside the block's none: a little.
  CHECK(margin(m, wall, 1, 1).border < margin(m, wall, 1, 0).border);
  CHECK(margin(m, wall, 1, 1).border > 0.98 * margin(m, wall, 1, 0).border);
}

TEST_CASE("damping has a margin where nothing is stiff, and nothing has none") {
  const stability::LoopModel m = model();
  const Margin slow = margin(m, slope(0, 0.03), 7000, 1), fast = margin(m, slope(0, 0.03), 1, 0);
  CHECK(slow.of == Margin::Of::damping);
  CHECK(slow.ratio < fast.ratio);
  CHECK(fast.border == Approx(0.03 * fast.ratio));
  CHECK(margin(m, slope(0, 0, 0.5), 1000, 1).of == Margin::Of::none);
}
