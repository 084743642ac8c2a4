// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The laws of a stick over drums and under a ceiling. Documentation:
// docs/devices/strings-and-drums.md
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "catch.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

TEST_CASE("ceiling: 10 mm deep are 0.07 Nm") {
  Running<> law(shipped("ceiling"));
  CHECK(law.torque({{"position", 0.4}}) == 0);
  CHECK(law.torque({{"position", 0.5 + 0.01 / 0.3}}) == Approx(-0.07));
  law.set("length", 0.2);
  CHECK(law.torque({{"position", 0.5 + 0.01 / 0.2}}) == Approx(-0.07));
  CHECK(law.torque({{"position", 5}}) == Approx(-700 * 0.06 * 0.06));
}

TEST_CASE("wall and ceiling on a tracker, without and with the encoder") {
  Running<> wall(shipped("wall_tracked")), ceiling(shipped("ceiling_tracked"));
  for (double x = 0; x < 1; x += 0.01) {
    for (const double turned : {-0.02, 0.0, 0.015}) {
      const double at = x - turned;  // the encoder when the tracker saw x
      for (const bool fused : {false, true}) {
        const double place = fused ? x + 0.7 - at : x;
        for (Running<>* law : {&wall, &ceiling}) {
          law->set("tracked", x);
          law->set("turned", at);
          law->set("fusion", fused ? 1 : 0);
        }
        const double push = 11.459 * std::clamp(place - 0.5, 0.0, 0.5);
        const double depth = std::clamp(0.3 * (place - 0.5), 0.0, 0.05);
        CHECK(wall.torque({{"position", 0.7}}) == Approx(-push).margin(1e-12));
        CHECK(ceiling.torque({{"position", 0.7}}) == Approx(-700 * depth * depth).margin(1e-12));
      }
    }
  }
}

TEST_CASE("drums: boxes open downward, each hit told once with speed and place") {
  Running<> law(shipped("drums"));
  const auto hits = [&] {
    std::string names;
    for (std::size_t n = 0; n < law.law().events.size(); ++n) {
      if (law.evaluation().happened(n)) names += law.law().events[n].name + " ";
    }
    return names;
  };
  const double middles[] = {-0.3, 0.0, 0.3}, skins[] = {900, 600, 300};
  for (int drum = 0; drum < 3; ++drum) {
    law.set("across", middles[drum] + 0.03);
    CHECK(law.torque({{"position", 0.01}, {"velocity", -5}}) == 0);
    CHECK(hits().empty());
    const double depth = 0.3 * std::sin(0.04);
    CHECK(law.torque({{"position", -0.04}, {"velocity", -5}}) ==
          Approx(skins[drum] * depth * depth));
    const std::string number = std::to_string(drum + 1);
    CHECK(hits() == "hit" + number + " place" + number + " ");
    CHECK(law.evaluation().event_value(2 * static_cast<std::size_t>(drum)) ==
          Approx(0.3 * std::cos(0.04) * 5));
    CHECK(law.evaluation().event_value(2 * static_cast<std::size_t>(drum) + 1) == Approx(0.25));
    law.torque({{"position", -0.05}});
    CHECK(hits().empty());  // still inside
  }
  // Beside, before and behind a drum, and far below it: open downward.
  law.set("across", 0.13);
  CHECK(law.torque({{"position", -0.04}}) == 0);
  law.set("across", 0);
  law.set("ahead", 0.13);
  CHECK(law.torque({{"position", -0.04}}) == 0);
  law.set("ahead", 0);
  law.set("height", -0.4);
  CHECK(law.torque({{"position", 0}}) == Approx(600 * 0.05 * 0.05));
}
