// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Three cores and the compiled law of the coupling in closed loop with the gimbal, bit by bit.
// docs/devices/three-axes.md
#include <algorithm>

#include "../pantograph/image_axes.hpp"
#include "catch.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/largest.hpp"
#include "gimbal_fixture.hpp"
#include "law/evaluate.hpp"
#include "law/read_law.hpp"
#include "sim/plant/drive.hpp"

using namespace feltgate;
using namespace feltgate::plant;
using Cores = AxesTwin<LeverLaw, Gimbal>;

namespace {

/// The motors of the design, without a capstan.
GimbalParameters direct() {
  GimbalParameters p = gimbal();
  p.joint.drum_radius_m = p.joint.pulley_radius_m;
  const double joint = p.joint.inertia_kg_m2();
  p.bodies.joint_inertia_kg_m2 = {joint, joint, joint};
  return p;
}

void give(test::ImageAxes<3>& image, const Quaternion& q) {
  image.set("dw", q.w);
  image.set("dx", q.x);
  image.set("dy", q.y);
  image.set("dz", q.z);
}

}  // namespace

TEST_CASE("the compiled law asks for J transposed times the coupling, everywhere", "[cores]") {
  const DesignInfo design = design_info<LeverLaw>();
  test::ImageAxes<3> image("gimbal", design);
  constexpr double stiffness = 0.2;
  image.set("stiffness", stiffness);
  const Quaternion target = gimbal_pose({-0.7, 0.4, 1.1}).handle;
  give(image, target);
  double worst_nm = 0.0;
  for (int outer = -2000; outer <= 2000; outer += 229) {
    for (int middle = -850; middle <= 850; middle += 131) {
      for (int inner = -2000; inner <= 2000; inner += 211) {
        AxesWords<3> words;
        words.position = {outer, middle, inner};
        const auto raw = image.run(words);
        const GimbalPose p = gimbal_pose(
            {outer * design.count_rad, middle * design.count_rad, inner * design.count_rad});
        if (std::abs((target * p.handle.inverse()).w) < 1e-3) continue;  // either way is as short
        const GimbalJoints asked = p.torque(coupling_nm(stiffness, target, p.handle));
        for (std::size_t i = 0; i < 3; ++i) {
          const double nm = std::ldexp(raw[i], -design.torque.fraction);
          worst_nm = feltgate::larger(worst_nm, std::abs(nm - asked[i]));
        }
      }
    }
  }
  INFO("torque within " << 1e3 * worst_nm << " mNm of 0.4 Nm");
  CHECK(worst_nm < 0.5e-3);
}

TEST_CASE("law file to bridge with three cores: home by the shorter way, no flip", "[cores]") {
  const GimbalParameters p = direct();
  for (const double degrees : {-179.0, 181.0}) {
    TurningHand hand;
    hand.start_rad = {degrees * kDegree, 0.2, -0.1};
    Gimbal plant(p, p.effects, drive_of(design_info<LeverLaw>()), hand);
    test::ImageAxes<3> image("gimbal", design_info<LeverLaw>());
    image.set("stiffness", 0.2);
    give(image, gimbal_pose({0.0, 0.2, -0.1}).handle);
    Cores cores(image.program(),
                {plant.encoder(0).count(), plant.encoder(1).count(), plant.encoder(2).count()},
                2 * image.compiled().divider);
    AxesLoop<Gimbal> loop(plant, cores);
    const auto torque_nm = [&cores] {
      return std::ldexp(cores.out(0).tau_ref, -design_info<LeverLaw>().torque.fraction);
    };
    loop.run(clocks_of(0.02));
    CHECK(torque_nm() == Approx(5.0 * 0.02).epsilon(0.01));  // the ramp's 5 Nm/s
    loop.run(clocks_of(0.07));
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(cores.out(i).armed);
      CHECK(cores.out(i).faults == 0);
    }
    // The lever turns up from -179 degrees, and also from 181 (the same orientation, one turn
    // further): to 0 and 360.
    const double way = plant.seen().theta_rad[0] - hand.start_rad[0];
    CHECK(way > 0.3);
    CHECK(way < 3.0);
    CHECK(torque_nm() > 0.1);
    CHECK(plant.seen().motor_nm[0] == Approx(torque_nm()).epsilon(0.03));
  }
}

// The shipped law of the coupling, in real numbers, against the gimbal's own turns.

TEST_CASE("the law file couples orientations as the gimbal's quaternions do", "[law]") {
  const law::Law file =
      law::read_law(std::string(FELTGATE_SOURCE_DIR) + "/rtl/laws/quaternion.law");
  law::Evaluation<double> evaluation(file);
  const auto set = [&](const std::string& name, double si) {
    for (std::size_t i = 0; i < file.parameters.size(); ++i) {
      if (file.parameters[i].name == name) return evaluation.set_parameter(i, si);
    }
    FAIL("the law has no parameter " << name);
  };
  const auto give = [&](const std::string& prefix, const Quaternion& q) {
    set(prefix + "w", q.w);
    set(prefix + "x", q.x);
    set(prefix + "y", q.y);
    set(prefix + "z", q.z);
  };
  set("stiffness", 0.15);
  const Quaternion target = gimbal_pose({-0.7, 0.4, 1.1}).handle;
  give("d", target);
  for (double outer = -170; outer <= 170; outer += 34) {
    for (double middle = -70; middle <= 70; middle += 28) {
      for (double inner = -170; inner <= 170; inner += 34) {
        const Quaternion handle =
            gimbal_pose({outer * kDegree, middle * kDegree, inner * kDegree}).handle;
        give("o", handle);
        evaluation.run({});
        Vec3 nm;
        for (std::size_t i = 0; i < file.outputs.size(); ++i) {
          (file.outputs[i].axis == 0   ? nm.x
           : file.outputs[i].axis == 1 ? nm.y
                                       : nm.z) = evaluation.outputs()[i];
        }
        CHECK(length(nm - coupling_nm(0.15, target, handle)) < 1e-15);
      }
    }
  }
}
