// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The shipped law of the coupling, in real numbers, against the gimbal's own turns.
// docs/devices/three-axes.md
#include "catch.hpp"
#include "gimbal_fixture.hpp"
#include "law/evaluate.hpp"
#include "law/read_law.hpp"

using namespace feltgate;
using namespace feltgate::plant;

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
