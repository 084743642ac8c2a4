// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Claims of the wrist device and of Haptic Hunt, and where the claims of the other papers are put
// together. Documentation: docs/claims.md
#include "studies/claims/claims.hpp"
#include "studies/stability/mass_loop.hpp"

#include "studies/stability/experiments.hpp"

namespace feltgate::claims {

namespace {

using stability::MassLoop;

// The wrist device.
constexpr double tracker_hz = 144, encoder_hz = 490;
constexpr double hard_nm_rad = 2 * 180 / pi, soft_nm_rad = 0.2 * 180 / pi;
/// Ours: 0.05 degrees of noise.
constexpr double noise_rad = 0.05 * pi / 180;

double jitter_mnm(const Lab& lab, double nm_rad, double noise, double smoothing) {
  const stability::HostCase c{tracker_hz, nm_rad, noise, smoothing};
  return 1e3 * stability::host_wall(lab.design("lever"), lab.plant("p24"), c).torque_rms_nm;
}

Claim noise_not_rate(const Lab& lab) {
  const double quiet = jitter_mnm(lab, soft_nm_rad, 0, 1);
  const double noisy = jitter_mnm(lab, soft_nm_rad, noise_rad, 1);
  const double smooth = jitter_mnm(lab, soft_nm_rad, noise_rad, 0.5);
  Claim c{"Determining the Cause of Instability; Filtering",
          "noise makes the wall jitter, and 144 Hz does not; smoothing with 0.5 reduces it",
          "A low rate shakes a wall where b < K T / 2; smoothing leaves sqrt(a / (2 - a)) of white "
          "noise",
          "a host's wall of 0.2 Nm/deg at 144 Hz on `lever` and `p24`, a hand leaning on its face; "
          "0.05 degrees of noise are ours",
          "a hand is on the lever, whose 0.065 Nm s/rad are above K T / 2",
          {}};
  c.asks_if("rms without noise", "mNm", none, quiet, at_most(0.1));
  c.asks_if("rms with noise", "mNm", none, noisy, at_least(1));
  c.asks_if("share left by smoothing", "", std::sqrt(0.5 / 1.5), smooth / noisy, at_most(0.7));
  c.explains("K T / 2", "Nm s/rad", soft_nm_rad / (2 * tracker_hz));
  return c;
}

Claim ceiling(const Lab& lab) {
  // 10 mm deep, on a stick of 0.3 m: T = k d^2 is as stiff as 2 k d l. Both lengths are ours.
  const auto stiff = [](double k) { return 2 * k * 0.01 * 0.3; };
  const double at_800 = jitter_mnm(lab, stiff(800), noise_rad, 0.5);
  Claim c{
      "Fig. 5; Conclusion & Next Steps",
      "a ceiling of 700 N/m works; instability is noticeable above 800 N/m",
      "T = k d² jitters by about 2 k d l times the noise, of which smoothing leaves 0.577; nothing "
      "sets 700 or 800 apart",
      "a host's wall as stiff as these ceilings are 10 mm deep on a stick of 0.3 m (both ours), "
      "144 Hz, smoothed",
      "the noise of the tracker, the depth and the stick's length are not given. Half the noise "
      "allows twice the stiffness",
      {}};
  const auto bound_mnm = [&stiff](double k, double noise) {
    return 1e3 * stiff(k) * noise * std::sqrt(0.5 / 1.5);
  };
  c.explains("stiffness at 700 N/m", "Nm/rad", stiff(700));
  c.explains("jitter at 700 N/m", "mNm", bound_mnm(700, noise_rad),
             jitter_mnm(lab, stiff(700), noise_rad, 0.5));
  c.explains("at 800 N/m", "mNm", bound_mnm(800, noise_rad), at_800);
  c.explains("at 800 N/m, half the noise", "mNm", bound_mnm(800, noise_rad / 2),
             jitter_mnm(lab, stiff(800), noise_rad / 2, 0.5));
  return c;
}

Claim encoder_wall(const Lab& lab) {
  const double count_rad = 2 * pi / 16384, step_nm = hard_nm_rad * count_rad;
  const design::Elaborated d = lab.design("lever");
  // Our count is four times as large, so a quarter of the stiffness makes the same step.
  const stability::Wall wall{step_nm / d.design.count_rad(), 0.005, 1};
  const auto quiet_share = [&](double friction_nm) {
    plant::Parameters p = lab.plant("p24");
    p.lugre.coulomb_nm = friction_nm;
    p.lugre.static_nm = 1.1 * friction_nm;
    return stability::rest_in_wall(d, p, wall, 2.5, 2).quiet / 2.0;
  };
  Claim c{
      "VR Tracking vs. Encoder Feedback, Fig. 3",
      "with the encoder (AS5048A) a wall of 2 Nm/deg is unstable only at its very border",
      "14 bits: 2 pi / 16384 a count. Between two counts a wall hunts unless friction holds K q / "
      "2; at 490 Hz it needs b > K T / 2",
      "`lever` pressed half way between two counts, with the same torque a count; friction of "
      "`p24`, and 30 mNm",
      "motor and hand hold 22 mNm. With the friction of our lever it hunts wherever it rests "
      "between two counts",
      {}};
  c.explains("a count", "mrad", 1e3 * count_rad);
  c.explains("torque of a count", "mNm", 1e3 * step_nm);
  c.explains("friction that it needs", "mNm", 1e3 * step_nm / 2);
  c.explains("damping that it needs", "Nm s/rad", hard_nm_rad / (2 * encoder_hz));
  c.asks("presses at rest, 3.5 mNm", "", 0, quiet_share(3.5e-3), at_least(1));
  c.asks_if("presses at rest, 30 mNm", "", 1, quiet_share(30e-3), at_least(1));
  return c;
}

// Haptic Hunt: 0.7 of the last force are kept in each run of 1 ms.
constexpr double hunt_s = 1e-3, kept_s = 0.7 / 0.3 * hunt_s;
/// Ours: pen and linkage, and the friction that the firmware's filter asks for.
constexpr double pen_kg = 0.1;

MassLoop hunt(double friction, bool filtered, double delay_s = 0) {
  return {pen_kg, friction, hunt_s, 0, filtered ? kept_s : 0, delay_s};
}

Claim recognition(const Lab&) {
  Claim c{
      "4.2",
      "52 of 70 guesses were right, 74.3 %, above the 14.3 % of random guessing",
      "52 / 70; 1 / 7; always \"fish\", which was there 34 times of 70",
      "-: people are not simulated; a [blind robot](devices/shapes.md#a-blind-robot) is, right in "
      "78 % without "
      "the cues of stiffness and damping and in 88 % with both, where its memory errs by 10 "
      "degrees per √cm",
      "it does. Who knows that fish comes first and always says so is right in 48.6 %; 74.3 % is "
      "above that too, by 4.3 standard deviations",
      {}};
  c.asks("right", "%", 100 * 52.0 / 70, none, near(74.3, 0.05));
  c.asks("random guessing", "%", 100.0 / 7, none, near(14.3, 0.05));
  c.explains("always \"fish\"", "%", 100 * 34.0 / 70);
  c.explains("52 above always \"fish\", standard deviations", "",
             (52 - 34) / std::sqrt(70 * (34.0 / 70) * (36.0 / 70)));
  return c;
}

Claim walls_50(const Lab&) {
  const double needed = 50 * (hunt_s / 2 + kept_s);
  Claim c{"3.2, Table 1",
          "50 N/m is the stiffest wall before the device becomes unstable",
          "b / (T/2 + 0.7/0.3 T): the force's filter lags too",
          "eigenvalues of a mass of 0.1 kg (ours) with the filter at 1 kHz; on the twin: "
          "[pantograph_wall](devices/pantograph_wall.md)",
          "the pen has 0.142 Ns/m of friction, which is not given; without the filter that would "
          "carry 283 N/m",
          {}};
  c.explains("friction that 50 N/m needs", "Ns/m", needed);
  c.asks_if("stiffest wall then", "N/m", needed / (hunt_s / 2 + kept_s),
            stability::stiffest(hunt(needed, true)), near(50, 2.5));
  c.explains("without the filter", "N/m", needed / (hunt_s / 2),
             stability::stiffest(hunt(needed, false)));
  return c;
}

Claim two_controllers(const Lab&) {
  // A float at 115 200 baud, ten bits a byte, and a run of the other controller.
  const double byte_s = 10 / 115200.0, delay_s = 4 * byte_s + hunt_s;
  const double needed = 50 * (hunt_s / 2 + kept_s);
  Claim c{
      "3.2, Signal Smoothing and Stabilization",
      "a second microcontroller delays, and the wall becomes jumpy and oscillates",
      "b / (T/2 + 0.7/0.3 T + td), with the friction at which 50 N/m are the border (`walls_50`)",
      "eigenvalues, as `walls_50`",
      "the delay, which is not given, is a number of four bytes at 115 200 baud and a run: it "
      "takes a third of the stiffness",
      {}};
  c.explains("delay", "ms", 1e3 * delay_s);
  c.asks_if("stiffest wall", "N/m", needed / (hunt_s / 2 + kept_s + delay_s),
            stability::stiffest(hunt(needed, true, delay_s)), at_most(40));
  return c;
}

Claim attraction(const Lab&) {
  return {"9.1, Force Feedback Model",
          "a force pulls the user towards the shape, up to a threshold pT where he sits",
          "-",
          "-: pT has no value, and neither has the slope",
          "no number is given; the final device left it out, since users took the pull for the "
          "shape",
          {}};
}

}  // namespace

std::vector<Source> other_papers() {
  std::vector<Source> all{{"noise_not_rate", 1, noise_not_rate},
                          {"ceiling", 1, ceiling},
                          {"encoder_wall", 1, encoder_wall},
                          {"recognition", 2, recognition},
                          {"walls_50", 2, walls_50},
                          {"two_controllers", 2, two_controllers},
                          {"attraction", 2, attraction}};
  for (const Source& s : touch_world()) all.push_back(s);
  for (const Source& s : dimple()) all.push_back(s);
  return all;
}

}  // namespace feltgate::claims
