// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's stick: a stroke whose speed at the skin is that of the hand's closed form, on the drum
// that the wrist is over, and a skin that holds the stick. Documentation: docs/page.md
#include <cmath>
#include <string>

#include "apps/page/law_loops.hpp"
#include "catch.hpp"
#include "law/compile.hpp"
#include "sim/backends/backend.hpp"

namespace feltgate::page {
namespace {

const std::string& drums() {
  static const std::string image =
      law::text(law::compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/drums.law",
                                  law::target_of(design_named("lever")))
                    .image);
  return image;
}

const plant::Impedance hand;

}  // namespace

TEST_CASE("page: a stroke is told by the drum under the wrist, with the tip's speed and place") {
  const double w0 = std::sqrt(hand.stiffness_n_m / hand.mass_kg);
  const double a = hand.damping_ns_m / hand.mass_kg / 2, w = std::sqrt(w0 * w0 - a * a);
  // From 0.3 to -0.3 rad at once: (th + 0.3) / 0.6 = e^(-at) (cos wt - a/w sin wt), through the
  // damper too; the tip is at the skins where that is 1/2.
  const auto share = [&](double t) {
    return std::exp(-a * t) * (std::cos(w * t) - a / w * std::sin(w * t));
  };
  double t = 0;
  while (share(t) > 0.5) t += 1e-6;
  const double rad_s = 0.6 * (share(t) - share(t + 1e-6)) / 1e-6;
  for (const int drum : {1, 2, 3}) {
    StickLoop loop(drums());
    CHECK(1 / loop.law().period_s() == Approx(20000));
    loop.set("across", 0.3 * (drum - 2) + 0.06);
    loop.lead(-0.3);
    loop.advance(loop.law().period_s());
    loop.advance(t + 5e-3);
    INFO("drum " << drum << ", " << rad_s << " rad/s after " << t << " s");
    REQUIRE(loop.events().size() == 2);
    const StickEvent hit = loop.events()[0], place = loop.events()[1];
    CHECK(hit.name == "hit" + std::to_string(drum));
    CHECK(place.name == "place" + std::to_string(drum));
    // Words of the law: the length is rounded to 2^-9 m. A run is 50 us.
    CHECK(hit.value == Approx(0.3 * rad_s).epsilon(0.005));
    CHECK(hit.time_s == Approx(t).margin(2e-4));
    CHECK(place.value == Approx(0.5).margin(0.002));
  }
  StickLoop beside(drums());
  beside.set("across", 0.15);
  beside.lead(-0.3);
  beside.advance(0.5);
  CHECK(beside.events().empty());
}

TEST_CASE("page: hand and skin hold the stick where their torques are equal") {
  StickLoop loop(drums());
  loop.lead(-0.2);
  loop.advance(3);
  const double stiffness = hand.stiffness_n_m * Lever::radius_m * Lever::radius_m;
  double theta = 0;  // 600 (0.3 sin th)^2 = k (th + 0.2)
  while (600 * std::pow(0.3 * std::sin(theta), 2) < stiffness * (theta + 0.2)) theta -= 1e-6;
  // Between two counts it trembles; a count is 1.5 mrad, and angles are cut.
  double mean_rad = 0, mean_nm = 0;
  constexpr int samples = 2000;
  for (int i = 0; i < samples; ++i) {
    loop.advance(5e-4);
    mean_rad += loop.theta_rad() / samples;
    mean_nm += loop.torque_nm() / samples;
  }
  CHECK(mean_rad == Approx(theta).margin(0.0016));
  CHECK(mean_nm == Approx(stiffness * (mean_rad + 0.2)).epsilon(0.005));
}

}  // namespace feltgate::page
