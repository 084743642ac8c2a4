// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The shipped laws of pantograph and gimbal, in real numbers and as words of the engine, against
// the kinematics of the plants, which share no code with them. docs/devices/pantograph.md,
// docs/devices/three-axes.md
#include <map>
#include <string>
#include <vector>

#include "catch.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/largest.hpp"
#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/evaluate.hpp"
#include "law/load.hpp"
#include "law/read_law.hpp"
#include "pantograph_fixture.hpp"
#include "sim/plant/gimbal/gimbal.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

class RealLaw {
 public:
  explicit RealLaw(const std::string& name)
      : law_(law::read_law(std::string(FELTGATE_SOURCE_DIR) + "/rtl/laws/" + name + ".law")),
        evaluation_(law_) {}
  RealLaw(const RealLaw&) = delete;  // the evaluation refers to the law in this object
  RealLaw& operator=(const RealLaw&) = delete;

  void set(const std::map<std::string, double>& si) {
    std::size_t known = 0;
    for (std::size_t i = 0; i < law_.parameters.size(); ++i) {
      const auto value = si.find(law_.parameters[i].name);
      if (value == si.end()) continue;
      evaluation_.set_parameter(i, value->second);
      ++known;
    }
    REQUIRE(known == si.size());
  }
  void set(const std::string& prefix, const Quaternion& q) {
    set({{prefix + "w", q.w}, {prefix + "x", q.x}, {prefix + "y", q.y}, {prefix + "z", q.z}});
  }
  template <std::size_t N>
  std::array<double, N> torque(const std::array<double, N>& theta_rad,
                               const std::array<double, N>& omega_rad_s = {}) {
    std::vector<double> inputs;
    for (const law::Input& in : law_.inputs) {
      inputs.push_back(
          (in.source == law::Source::position ? theta_rad : omega_rad_s)[std::size_t(in.axis)]);
    }
    evaluation_.run(inputs);
    std::array<double, N> torque{};
    REQUIRE(law_.outputs.size() == N);
    for (std::size_t n = 0; n < N; ++n) {
      torque[static_cast<std::size_t>(law_.outputs[n].axis)] = evaluation_.outputs()[n];
    }
    return torque;
  }

 private:
  law::Law law_;
  law::Evaluation<double> evaluation_;
};

/// The compiled words of a law in the engine's interpreter; joints in counts, at rest.
template <std::size_t N>
std::array<double, N> compiled_nm(const law::Compiled& compiled,
                                  const std::map<std::string, double>& si,
                                  const std::array<int, N>& counts) {
  std::vector<double> values;
  for (const law::ImageWord& w : compiled.image.words) {
    if (!w.formula.empty()) continue;
    const auto value = si.find(w.name);
    values.push_back(value == si.end() ? w.initial * w.scale : value->second);
  }
  law::Machine machine(law::memory(compiled.image));
  const std::vector<std::int32_t> words = law::parameter_words(compiled.image, values);
  for (const law::ImageWord& w : compiled.image.words) {
    machine.set_parameter(w.word, words[static_cast<std::size_t>(w.word)]);
  }
  machine.commit();
  law::MachineInputs inputs{};
  for (std::size_t n = 0; n < N; ++n) inputs[3 * n] = counts[n];
  const law::MachineRun& run = machine.run(compiled.target.thread, inputs);
  REQUIRE(run.ended);
  std::array<double, N> nm{};
  for (std::size_t n = 0; n < N; ++n) {
    nm[n] = std::ldexp(run.outputs[n], -design_info<LeverLaw>().torque.fraction);
  }
  return nm;
}
law::Compiled compiled_law(const std::string& name) {
  return law::compile_file(std::string(FELTGATE_SOURCE_DIR) + "/rtl/laws/" + name + ".law",
                           law::target_of(design_info<LeverLaw>()));
}

template <class Check>
void at_orientations(Check&& check) {
  for (double outer = -170; outer <= 170; outer += 34) {
    for (double middle = -70; middle <= 70; middle += 28) {
      for (double inner = -170; inner <= 170; inner += 34) {
        check(GimbalJoints{outer * kDegree, middle * kDegree, inner * kDegree});
      }
    }
  }
}

}  // namespace

TEST_CASE("law pantograph asks what J of the linkage says, everywhere") {
  constexpr double floor_m = 0.11, stiffness = 300.0, drag = 1.5;
  RealLaw file("pantograph");
  file.set({{"floor", floor_m}, {"stiffness", stiffness}, {"drag", drag}});
  const Linkage linkage(pantograph().linkage);
  int inside = 0;
  for (double first = -60; first <= 150; first += 7) {
    for (double between = 20; between <= 160; between += 7) {
      const Joints theta{first * kDegree, (first + between) * kDegree}, omega{1.1, -2.3};
      const LinkagePose p = linkage.pose(theta);
      Vec2 force = -drag * p.pen_speed(omega);
      if (p.pen.y < floor_m) force.y += stiffness * (floor_m - p.pen.y);
      inside += p.pen.y < floor_m ? 1 : 0;
      const Joints expected = p.torque(force), asked = file.torque(theta, omega);
      CHECK(asked[0] == Approx(expected[0]).margin(1e-12));
      CHECK(asked[1] == Approx(expected[1]).margin(1e-12));
    }
  }
  CHECK(inside > 100);
}

TEST_CASE("law gimbal asks for J transposed times the coupling, quaternion for the coupling") {
  const Quaternion target = gimbal_pose({-0.7, 0.4, 1.1}).handle;
  RealLaw of_joints("gimbal"), of_turns("quaternion");
  for (RealLaw* file : {&of_joints, &of_turns}) {
    file->set({{"stiffness", 0.15}});
    file->set("d", target);
  }
  at_orientations([&](const GimbalJoints& theta) {
    const GimbalPose pose = gimbal_pose(theta);
    if (std::abs((target * pose.handle.inverse()).w) < 1e-9) return;  // either way is as short
    const Vec3 nm = coupling_nm(0.15, target, pose.handle);
    of_turns.set("o", pose.handle);
    const auto turns = of_turns.torque<3>({});
    CHECK(length(Vec3{turns[0], turns[1], turns[2]} - nm) < 1e-15);
    const GimbalJoints joints = of_joints.torque(theta), expected = pose.torque(nm);
    for (std::size_t n = 0; n < 3; ++n) CHECK(joints[n] == Approx(expected[n]).margin(1e-12));
  });
}

TEST_CASE("the compiled laws ask what the plants say: a height within 5 um, a coupling 0.5 mNm") {
  constexpr double stiffness = 1000.0, depth_m = 2e-3;
  const double count_rad = design_info<LeverLaw>().count_rad;
  const law::Compiled pantograph_law = compiled_law("pantograph"), gimbal = compiled_law("gimbal");
  CHECK(pantograph_law.rate_hz >= 250e3);
  const Linkage linkage(pantograph().linkage);
  double worst_m = 0, worst_nm = 0, worst_of_gimbal_nm = 0;
  for (int first = -300; first < 1700; first += 92) {
    for (int between = 228; between < 1820; between += 87) {
      const LinkagePose p = linkage.pose({first * count_rad, (first + between) * count_rad});
      if (p.pen.y > 0.195) continue;
      const Joints nm = compiled_nm<2>(
          pantograph_law, {{"stiffness", stiffness}, {"drag", 0}, {"floor", p.pen.y + depth_m}},
          {first, first + between});
      const Joints asked = p.torque({0.0, stiffness * depth_m});
      for (std::size_t n = 0; n < 2; ++n) worst_nm = larger(worst_nm, std::abs(nm[n] - asked[n]));
      worst_m = larger(worst_m, std::abs(depth_m - p.force(nm).y / stiffness));
    }
  }
  const Quaternion d = gimbal_pose({-0.7, 0.4, 1.1}).handle;
  for (int outer = -2000; outer <= 2000; outer += 458) {
    for (int middle = -850; middle <= 850; middle += 262) {
      for (int inner = -2000; inner <= 2000; inner += 422) {
        const GimbalPose p =
            gimbal_pose({outer * count_rad, middle * count_rad, inner * count_rad});
        if (std::abs((d * p.handle.inverse()).w) < 1e-3) continue;  // either way is as short
        const auto nm = compiled_nm<3>(
            gimbal, {{"stiffness", 0.2}, {"dw", d.w}, {"dx", d.x}, {"dy", d.y}, {"dz", d.z}},
            {outer, middle, inner});
        const GimbalJoints asked = p.torque(coupling_nm(0.2, d, p.handle));
        for (std::size_t n = 0; n < 3; ++n) {
          worst_of_gimbal_nm = larger(worst_of_gimbal_nm, std::abs(nm[n] - asked[n]));
        }
      }
    }
  }
  INFO(1e6 * worst_m << " um, " << 1e3 * worst_nm << " and " << 1e3 * worst_of_gimbal_nm << " mNm");
  CHECK(worst_m < 5e-6);
  CHECK(worst_nm < 0.1e-3);
  CHECK(worst_of_gimbal_nm < 0.5e-3);
}
