// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Motors, encoders, step and loop of the whole plant. docs/devices/pantograph.md
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "files/toml/toml_reader.hpp"
#include "pantograph_fixture.hpp"
#include "sim/plant/axes_loop.hpp"
#include "sim/plant/plant_table.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

// Without dead time, because its loss depends on the current at the beginning of a step.
Vec2 pushed(const PantographParameters& p, double n_x, double n_y, Clock step, double seconds) {
  Effects on = p.effects;
  on.dead_time = false;
  Pantograph plant(p, on, Drive{});
  const Joints torque = plant.linkage().pose(plant.seen().theta_rad).torque({n_x, n_y});
  const double per_a = p.joint.ratio() * p.motor.torque_constant_nm_a;
  std::array<Bridge, 2> bridges;
  for (std::size_t i = 0; i < 2; ++i) {
    const double volts = p.motor.resistance_ohm * torque[i] / per_a +
                         std::copysign(p.motor.dead_voltage_v, torque[i]);
    bridges[i] = Bridge::averaged(volts / p.supply.voltage_v);
  }
  while (plant.now() < clocks_of(seconds)) plant.advance(bridges, step);
  return plant.seen().pen_m;
}

}  // namespace

TEST_CASE("gates move the pen: up by both motors, to the side by one way", "[pantograph]") {
  const PantographParameters p = pantograph();
  // Up asks (+, -): joint 1 turns positive, joint 5 negative. 2 of 10 us on.
  for (const bool up : {true, false}) {
    Pantograph plant(p, p.effects, Drive{});
    for (Clock clock = 0; clock < 300000; ++clock) {
      const bool on = clock % 500 < 100;
      const Bridge forth = on ? Bridge::gates(1, 0, 0, 1) : Bridge::gates(0, 1, 0, 1);
      const Bridge back = on ? Bridge::gates(0, 1, 1, 0) : Bridge::gates(0, 1, 0, 1);
      plant.advance({forth, up ? back : forth}, 1);
    }
    const PantographSeen& s = plant.seen();
    CHECK(s.current_a[0] > 1.0);
    if (up) {
      CHECK(s.pen_m.y > 0.1005);
      CHECK(s.pen_m.x == Approx(0.0).margin(1e-9));
      CHECK(s.current_a[1] == Approx(-s.current_a[0]).epsilon(1e-9));
    } else {
      CHECK(s.pen_m.x < -0.0005);  // both positive: the pen turns about the motors
      // The pen moves outward at the same time.
      CHECK(s.omega_rad_s[0] == Approx(s.omega_rad_s[1]).epsilon(0.1));
    }
  }
}

TEST_CASE("switched gates and the averaged bridge move it alike", "[pantograph]") {
  const PantographParameters p = pantograph();
  Effects on = p.effects;
  on.dead_time = false;  // the gates here have none
  Drive drive;
  drive.pwm_hz = 50e3;
  Pantograph switched(p, on, drive), averaged(p, on, drive);
  for (Clock clock = 0; clock < 500000; clock += 5) {
    const Clock at = clock % 1000;
    const auto gates = [&](Clock width, bool forth) {
      const bool high = at < width;
      if (forth) return high ? Bridge::gates(1, 0, 0, 1) : Bridge::gates(0, 1, 0, 1);
      return high ? Bridge::gates(0, 1, 1, 0) : Bridge::gates(0, 1, 0, 1);
    };
    switched.advance({gates(150, true), gates(100, false)}, 5);
  }
  while (averaged.now() < 500000) {
    averaged.advance({Bridge::averaged(0.15), Bridge::averaged(-0.1)}, 250);
  }
  CHECK(averaged.seen().pen_m.y - 0.1 == Approx(switched.seen().pen_m.y - 0.1).epsilon(0.02));
  CHECK(averaged.seen().pen_m.x == Approx(switched.seen().pen_m.x).epsilon(0.02));
  CHECK(averaged.seen().pen_m.y > 0.102);
}

TEST_CASE("stall: current, torque and force are the closed form's", "[pantograph]") {
  const PantographParameters p = pantograph();
  Effects on = p.effects;
  on.dead_time = false;
  PenHand hold;
  PenPhase still;
  still.kind = PenPhase::Kind::kPrescribed;
  still.x = {segment(Segment::Kind::kHold, 1.0)};
  still.y = {segment(Segment::Kind::kHold, 1.0)};
  hold.phases = {still};
  Pantograph plant(p, on, Drive{}, hold);
  const Joints duty{0.2, -0.2};
  while (plant.now() < clocks_of(0.01)) {
    plant.advance({Bridge::averaged(duty[0]), Bridge::averaged(duty[1])}, 250);
  }
  const double amps = (0.2 * 24.0 - 0.34) / 0.42, nm = 3.0 * 0.0302 * amps;
  CHECK(plant.seen().current_a[0] == Approx(amps).epsilon(1e-6));
  CHECK(plant.seen().motor_nm[1] == Approx(-nm).epsilon(1e-6));
  // (nm, -nm) is a force in y at this pose.
  CHECK(plant.seen().hand_n.x == Approx(0.0).margin(1e-9));
  CHECK(plant.seen().hand_n.y == Approx(-nm / (0.1 * std::cos(30 * kDegree))).epsilon(1e-6));
  CHECK(plant.seen().supply_a == Approx(2 * 0.2 * amps).epsilon(1e-6));

  // Dead time reduces both by the same share: 0.5 us of 50 us.
  Pantograph late(p, p.effects, Drive{}, hold);
  while (late.now() < clocks_of(0.01)) {
    late.advance({Bridge::averaged(duty[0]), Bridge::averaged(duty[1])}, 250);
  }
  CHECK(late.seen().current_a[0] < 0.95 * amps);
  CHECK(late.seen().supply_a == Approx(2 * 0.19 * late.seen().current_a[0]).epsilon(1e-6));
}

TEST_CASE("the supply limit is one for both motors", "[pantograph]") {
  const PantographParameters p = pantograph();
  Effects on = p.effects;
  on.supply_limit = true;
  Pantograph plant(p, on, Drive{});
  const Bridge full = Bridge::averaged(1.0);
  while (plant.now() < clocks_of(2e-3)) plant.advance({full, full}, 25);
  CHECK(plant.seen().supply_a <= 7.0 + 1e-9);
  CHECK(plant.seen().bus_v < 12.0);
}

TEST_CASE("edges of both encoders count the angles", "[pantograph]") {
  PantographParameters p = pantograph();
  for (const bool on_motor : {false, true}) {
    p.joint.encoder_on_motor = on_motor;
    Pantograph plant(p, p.effects, Drive{});
    const double per = on_motor ? p.joint.ratio() : 1.0;
    std::array<std::size_t, 2> edges{};
    std::array<Clock, 2> last{-1, -1};
    const std::array<std::int64_t, 2> begin{plant.encoder(0).count(), plant.encoder(1).count()};
    while (plant.now() < clocks_of(0.04)) {
      plant.advance({Bridge::averaged(0.2), Bridge::averaged(-0.15)}, 250);
      for (std::size_t i = 0; i < 2; ++i) {
        for (const EncoderEvent& e : plant.events(i)) {
          REQUIRE(e.clock > last[i]);
          REQUIRE(e.clock <= plant.now());
          last[i] = e.clock;
          ++edges[i];
        }
      }
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const double counts = per * plant.seen().theta_rad[i] / plant.encoder(i).count_rad();
      CHECK(plant.encoder(i).count() == static_cast<std::int64_t>(std::floor(counts)));
      const auto way = static_cast<std::size_t>(std::abs(plant.encoder(i).count() - begin[i]));
      CHECK(way > 30);
      CHECK(edges[i] == way);
    }
  }
  // One count of the crank is 153 um of the pen.
  CHECK(0.1 * 2 * 3.14159265 / 4096 == Approx(153e-6).epsilon(3e-3));
}

TEST_CASE("a device sees every edge between two calls once", "[pantograph]") {
  // Takes the place of a core's twin: it counts the pins and is called every 7000 clocks.
  struct Counter : AxesDevice<Pantograph> {
    std::array<std::size_t, 2> edges{};
    Clock asked = -1;
    std::array<Bridge, 2> act(const AxesSense<Pantograph>& sense) override {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        for (const EncoderEvent& e : sense.events[axis]) {
          CHECK(e.clock > asked);
          CHECK(e.clock <= sense.now);
          ++edges[axis];
        }
      }
      asked = sense.now;
      return {Bridge::averaged(0.15), Bridge::averaged(-0.12)};
    }
    Clock next(Clock now) const override { return now + 7000; }
  } device;
  const PantographParameters p = pantograph();
  Pantograph plant(p, p.effects, Drive{});
  AxesLoop<Pantograph> loop(plant, device);
  const std::array<std::int64_t, 2> begin{plant.encoder(0).count(), plant.encoder(1).count()};
  loop.run(7000 * 300 + 1, [](const Pantograph&) {});
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(device.edges[i] ==
          static_cast<std::size_t>(std::abs(plant.encoder(i).count() - begin[i])));
    CHECK(device.edges[i] > 20);
  }
}

TEST_CASE("the plant's step is of second order, and 5 us are enough", "[pantograph]") {
  const PantographParameters p = pantograph();
  const Vec2 exact = pushed(p, 0.5, 2.0, 5, 0.03);
  const double coarse = length(pushed(p, 0.5, 2.0, 250, 0.03) - exact);
  const double fine = length(pushed(p, 0.5, 2.0, 125, 0.03) - exact);
  CHECK(length(exact - Vec2{0.0, 0.1}) > 5e-3);
  CHECK(coarse < 1e-7);
  CHECK(fine < 0.4 * coarse);
}

TEST_CASE("dry friction of the capstan holds small forces and lets larger ones go",
          "[pantograph]") {
  const PantographParameters p = pantograph();
  // Break-away needs 3*4.5 mNm at a crank: 0.156 N along y at this pose.
  const double break_n = 3 * p.lugre.static_nm / (0.1 * std::cos(30 * kDegree));
  for (const double share : {0.8, 1.3}) {
    PenPhase push;
    push.kind = PenPhase::Kind::kForce;
    push.y = {segment(Segment::Kind::kRamp, 0.2, share * break_n)};
    push.x = {segment(Segment::Kind::kHold, 0.2)};
    Pantograph plant(p, p.effects, Drive{}, PenHand{{}, {push}});
    while (plant.now() < clocks_of(0.5)) plant.advance(Joints{}, 250);
    const double way = std::abs(plant.seen().pen_m.y - 0.1);
    if (share < 1.0) CHECK(way < 1e-4);
    if (share > 1.0) CHECK(way > 1e-3);
  }
}

TEST_CASE("a motor breaks away by its own friction, whatever the capstan", "[pantograph]") {
  PantographParameters p = pantograph();
  Effects on = p.effects;
  on.dead_time = false;
  for (const double ratio : {1.0, 3.0}) {
    p.joint.drum_radius_m = ratio * p.joint.pulley_radius_m;
    for (const double share : {0.8, 1.3}) {
      const double amps = share * p.lugre.static_nm / p.motor.torque_constant_nm_a;
      const double volts = p.motor.resistance_ohm * amps + p.motor.dead_voltage_v;
      Pantograph plant(p, on, Drive{});
      while (plant.now() < clocks_of(0.2)) {
        plant.advance({Bridge::averaged(volts / 24.0), Bridge::averaged(-volts / 24.0)}, 250);
      }
      const double way = std::abs(plant.seen().pen_m.y - 0.1);
      if (share < 1.0) CHECK(way < 3e-4);
      if (share > 1.0) CHECK(way > 1e-3);
    }
  }
}

TEST_CASE("each encoder has imperfect edges of its own", "[pantograph]") {
  const PantographParameters p = pantograph();
  Effects on = p.effects;
  on.encoder_imperfect = true;
  const Pantograph plant(p, on, Drive{});
  int alike = 0;
  for (int edge = 0; edge < 400; edge += 4) {
    alike += plant.encoder(0).edge_rad(edge) == plant.encoder(1).edge_rad(edge) ? 1 : 0;
  }
  CHECK(alike < 3);
}

TEST_CASE("a motion that pins cannot show ends the run", "[pantograph]") {
  PantographParameters p = pantograph();
  p.encoder.lines = 1 << 20;
  Pantograph plant(p, p.effects, Drive{});
  CHECK_THROWS_WITH(
      [&] {
        while (plant.now() < clocks_of(0.1)) {
          plant.advance({Bridge::averaged(1.0), Bridge::averaged(1.0)}, 250);
        }
      }(),
      Catch::Matchers::Contains("a crank turns by more than one state of its encoder in a clock"));
  CHECK_THROWS_AS(plant.advance(Joints{}, 0), std::invalid_argument);
}

// Files of linkages: their values and their error messages. docs/devices/pantograph.md

namespace {

std::string shipped_text() {
  std::ifstream in(linkage_file("pantograph"));
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The error of the shipped file with `from` changed, as "line N: text".
std::string error_of(const std::string& from, const std::string& to) {
  std::string text = shipped_text();
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  text.replace(at, from.size(), to);
  try {
    (void)read_pantograph_text(text, "x.toml");
  } catch (const config::ConfigError& error) {
    const std::string place = "x.toml:" + std::to_string(line) + ": ";
    const std::string what = error.what();
    return what.rfind(place, 0) == 0 ? "here: " + what.substr(place.size()) : what;
  }
  return "no error";
}

}  // namespace

TEST_CASE("the shipped pantograph is read", "[pantograph_file]") {
  const PantographParameters p = pantograph();
  CHECK(p.name == "pantograph");
  CHECK(p.linkage.base_m == 0.0);
  CHECK(p.linkage.rod_5_m == 0.1);
  CHECK(p.bodies.crank_5.mass_kg == 0.0114);
  CHECK(p.bodies.pen_kg == 0.02);
  CHECK(p.joint.ratio() == Approx(3.0));
  CHECK(p.bodies.joint_inertia_kg_m2[1] == Approx(1e-5 + 9 * 1.38e-5));
  CHECK_FALSE(p.joint.encoder_on_motor);
  Effects on = p.effects;
  CHECK(p.smooth_nm_s_rad(on) == Approx(9 * 1.5e-6));
  on.viscous = true;
  CHECK(p.smooth_nm_s_rad(on) == Approx(9 * 1.5e-6 + 1e-3));
  CHECK(p.stops.least_rad == Approx(20 * kDegree));
  CHECK(p.stops.most_rad == Approx(160 * kDegree));
  CHECK(p.motor.torque_constant_nm_a == shipped("p24").motor.torque_constant_nm_a);
  CHECK(p.motor.resistance_ohm == shipped("p24").motor.resistance_ohm);
  CHECK(p.lugre.coulomb_nm == shipped("p24").lugre.coulomb_nm);
  CHECK(p.encoder.lines == 1024);
  CHECK(p.effects.lugre);
  CHECK_FALSE(p.effects.viscous);
  // The links of the file: 1270 kg/m^3, 100 x 15 x 6 mm.
  const double kg = 1270 * 0.1 * 0.015 * 0.006;
  CHECK(p.bodies.rod_1.mass_kg == Approx(kg).epsilon(5e-3));
  CHECK(p.bodies.rod_1.inertia_kg_m2 ==
        Approx(kg * (0.1 * 0.1 + 0.015 * 0.015) / 12).epsilon(5e-3));
}

TEST_CASE("errors of a linkage say file, line, what and mend", "[pantograph_file]") {
  CHECK(error_of("name = ", "name = ") == "no error");
  CHECK(error_of("crank_5_m = 0.1", "crank_5_m = -0.1") ==
        "here: \"crank_5_m\" = -0.1 is out of range; it must be greater than 0");
  CHECK(error_of("least_deg = 20.0", "least_deg = 170.0").find("\"most_deg\" is not above") !=
        std::string::npos);
  CHECK(error_of("most_deg = 160.0", "most_deg = 180.0") ==
        "here: the rods do not meet at 180 degrees; stop the cranks before the linkage is "
        "straight, or make the rods longer");
  CHECK(error_of("least_deg = 20.0", "least_deg = 0.0").find("do not meet at 0 degrees") !=
        std::string::npos);
  CHECK(error_of("start_m = [0.0, 0.1]", "start_m = [0.0, 0.3]") ==
        "here: the pen cannot be there; choose a place within the links' reach");
  CHECK(error_of("start_m = [0.0, 0.1]", "start_m = [0.0, 0.199]") ==
        "here: the cranks are 11.46 degrees apart there, beyond a stop; choose a place between "
        "the stops");
  CHECK(error_of("start_m = [0.0, 0.1]", "start_m = [0.1]") ==
        "here: \"start_m\" is not two numbers; write x and y, m");
  CHECK(error_of("encoder = \"joint\"", "encoder = \"pen\"") ==
        "here: \"encoder\" = \"pen\" is not known; it must be one of joint, motor");
  CHECK(error_of("restitution = 0.7", "restitution = 0.05").find("out of range") !=
        std::string::npos);
  CHECK(error_of("drum_radius_m", "drum_radius").find("\"drum_radius_m\" is missing") !=
        std::string::npos);
  CHECK(error_of("[rod_5]", "[rod_3]").find("\"rod_5\" is missing") != std::string::npos);
  CHECK(error_of("torque_constant_nm_a = 0.0302", "torque_constant_nm_a = 0").find("here:") == 0);
  CHECK(error_of("lugre = true", "lugre = 1").find("here:") == 0);
  CHECK_THROWS_AS(read_pantograph_file("/nonexistent/linkage.toml"), config::ConfigError);
}

TEST_CASE("the hand of a scene with a pen, and its errors", "[pantograph_file]") {
  const auto read = [](const std::string& text) {
    const toml::table table = toml::parse(text);
    return read_pen_hand(config::TomlReader(table, "s.toml", "the file").section("hand"));
  };
  const PenHand hand = read(R"([hand]
start_m = [0.01, 0.13]
[[hand.phase]]
kind = "impedance"
x = [{kind = "sine", amplitude_m = 0.02, frequency_hz = 2, duration_s = 0.5}]
y = [{kind = "step", to_m = 0.08, duration_s = 0.2}, {kind = "hold", duration_s = 0.6}]
stiffness_n_m = 200
[[hand.phase]]
kind = "force"
y = [{kind = "ramp", to_n = -1.5, duration_s = 0.3}]
[[hand.phase]]
kind = "prescribed"
x = [{kind = "minimum_jerk", to_m = 0.03, duration_s = 0.4}]
duration_s = 1
[[hand.phase]]
kind = "free"
)");
  REQUIRE(hand.phases.size() == 4);
  CHECK(hand.start_m->y == 0.13);
  CHECK(hand.phases[0].duration_s == Approx(0.8));
  CHECK(hand.phases[0].impedance.stiffness_n_m == 200.0);
  CHECK(hand.phases[0].impedance.mass_kg == 0.554);
  CHECK(hand.phases[0].x[0].amplitude == 0.02);
  CHECK(hand.phases[1].kind == PenPhase::Kind::kForce);
  CHECK(hand.phases[1].x.empty());
  CHECK(hand.phases[1].y[0].to == -1.5);
  CHECK(hand.phases[2].duration_s == 1.0);
  CHECK(std::isinf(hand.phases[3].duration_s));
  const auto error = [&read](const std::string& phase) {
    try {
      (void)read("[hand]\n[[hand.phase]]\n" + phase);
    } catch (const config::ConfigError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(error("kind = \"cord\"") ==
        "s.toml:3: \"kind\" = \"cord\" is not known; it must be one of free, prescribed, "
        "impedance, force");
  CHECK(error("kind = \"force\"") ==
        "s.toml:3: neither \"x\" nor \"y\" is there; write the motion of one at least");
  CHECK(error("kind = \"prescribed\"\nx = [{kind = \"step\", to_m = 1, duration_s = 1}]") ==
        "s.toml:4: an imposed place cannot step; use ramp or minimum_jerk");
  CHECK(error("kind = \"force\"\nx = [{kind = \"step\", to_m = 1, duration_s = 1}]")
            .find("\"to_n\" is missing") != std::string::npos);
  CHECK(error("kind = \"free\"\nz = 1").find("\"z\" is unknown") != std::string::npos);
}

// The hand at the pen: closed forms, phases, balance of all energies.

using Kind = PenPhase::Kind;

namespace {

PenHand hand_at_rest(Vec2 pen) {
  PenHand hand;
  hand.start_m = pen;
  PenPhase phase;
  phase.kind = Kind::kImpedance;
  hand.phases = {phase};
  return hand;
}

PenPhase towards(Kind kind, Segment::Kind segment_kind, double seconds, Vec2 to) {
  PenPhase phase;
  phase.kind = kind;
  phase.x = {segment(segment_kind, seconds, to.x)};
  phase.y = {segment(segment_kind, seconds, to.y)};
  return phase;
}

void run(Pantograph& plant, const Joints& torque, double seconds, Clock step = 250) {
  const Clock end = plant.now() + clocks_of(seconds);
  while (plant.now() < end) plant.advance(torque, step);
}

double out_of_balance_j(const Pantograph& plant, double begin_j) {
  const PantographSeen& s = plant.seen();
  return plant.stored_j() - begin_j -
         (s.hand_work_j + s.motor_work_j - s.dry_j - s.viscous_j - s.stop_j);
}

}  // namespace

TEST_CASE("pen hand: static displacement is force over stiffness, in both directions", "[pen]") {
  const PantographParameters p = pantograph();
  const Vec2 start{0.02, 0.11}, force{0.4, -0.3};
  Pantograph plant(p, kNoEffects, Drive{}, hand_at_rest(start));
  Effects dynamic = kNoEffects;
  dynamic.hand_dynamics = true;
  plant = Pantograph(p, dynamic, Drive{}, hand_at_rest(start));
  // The torques follow the position, so that the force at the pen is constant.
  for (int i = 0; i < 250000; ++i) {
    plant.advance(plant.linkage().pose(plant.seen().theta_rad).torque(force), 500);
  }
  const double per_n = 1.0 / 135.0 + 1.0 / 3000.0;
  CHECK(plant.seen().pen_m.x - start.x == Approx(force.x * per_n).epsilon(1e-5));
  CHECK(plant.seen().pen_m.y - start.y == Approx(force.y * per_n).epsilon(1e-5));
  CHECK(plant.seen().hand_m.x - start.x == Approx(force.x / 135.0).epsilon(1e-5));
  CHECK(plant.seen().hand_n.x == Approx(-force.x).epsilon(1e-4));
  CHECK(plant.seen().hand_n.y == Approx(-force.y).epsilon(1e-4));
}

TEST_CASE("pen hand: a rigid grip swings with the closed form's frequency", "[pen]") {
  // A hand of 0.554 kg on 135 N/m; the linkage adds little beside it and its pen mass is known.
  PantographParameters p = pantograph();
  Effects on = kNoEffects;
  on.hand_dynamics = true;
  PenHand hand = hand_at_rest({0.0, 0.1});
  hand.phases[0].impedance.damping_ns_m = 0.0;
  hand.phases[0].impedance.grip_stiffness_n_m = 3e4;
  hand.phases[0].x = {segment(Segment::Kind::kStep, 1.0, 1e-4)};
  Pantograph plant(p, on, Drive{}, hand);
  // Mass at the pen along x: 1/(J M^-1 J') there.
  const LinkagePose pose = plant.linkage().pose(plant.seen().theta_rad);
  const Joints moved = plant.dynamics().mass(pose).solve(pose.torque({1.0, 0.0}));
  const double mass = 1.0 / pose.pen_speed(moved).x;
  CHECK(mass > 0.05);
  const double rad_s = std::sqrt(135.0 / (0.554 + mass));
  // Crossings of the middle, upwards.
  double first = 0.0, last = 0.0, before = 0.0;
  int swings = -1;
  while (plant.seconds() < 2.5) {
    plant.advance(Joints{}, 250);
    const double now = plant.seen().hand_m.x - 1e-4;
    if (before < 0.0 && now >= 0.0) {
      last = plant.seconds() - 5e-6 * now / (now - before);
      if (++swings == 0) first = last;
    }
    before = now;
  }
  REQUIRE(swings > 3);
  CHECK(6.283185307 * swings / (last - first) == Approx(rad_s).epsilon(3e-4));
}

TEST_CASE("pen hand: along an even motion it does not lag, for its damper moves too", "[pen]") {
  const PantographParameters p = pantograph();
  Effects on = kNoEffects;
  on.hand_dynamics = true;
  PenHand hand = hand_at_rest({-0.04, 0.12});
  hand.phases[0].x = {segment(Segment::Kind::kRamp, 2.0, 0.06)};
  Pantograph plant(p, on, Drive{}, hand);
  run(plant, {}, 1.5);
  // A damper to the ground would hold it back by 6.45*0.05/135 = 2.4 mm.
  CHECK(plant.seen().hand_m.x == Approx(-0.04 + 0.05 * 1.5).margin(2e-4));
}

TEST_CASE("all work is accounted for: hand, motors, friction, stops", "[pen]") {
  const PantographParameters p = pantograph();
  Effects on = p.effects;
  on.viscous = true;
  PenHand hand = hand_at_rest({0.0, 0.1});
  hand.phases[0].duration_s = 0.5;
  hand.phases[0].x = {sine(0.5, 0.03, 3.0, 0.3)};
  hand.phases[0].y = {segment(Segment::Kind::kMinimumJerk, 0.3, 0.16)};
  // Against the stop at 20 degrees, where the pen is 0.197 m away.
  hand.phases.push_back(towards(Kind::kImpedance, Segment::Kind::kMinimumJerk, 0.3, {0.0, 0.25}));
  hand.phases[1].duration_s = 0.5;
  hand.phases.push_back(towards(Kind::kForce, Segment::Kind::kRamp, 0.1, {0.5, -2.0}));
  hand.phases[2].duration_s = 0.1;
  hand.phases.push_back({});
  Pantograph plant(p, on, Drive{}, hand);
  const double begin_j = plant.stored_j();
  double least_between = 10.0, worst_j = 0.0;
  for (int i = 0; i < 240000; ++i) {
    plant.advance({Bridge::averaged(0.05 * std::sin(1e-3 * i)), Bridge::averaged(-0.04)}, 250);
    least_between = std::min(least_between, plant.seen().theta_rad[1] - plant.seen().theta_rad[0]);
    worst_j = feltgate::larger(worst_j, std::abs(out_of_balance_j(plant, begin_j)));
  }
  const PantographSeen& s = plant.seen();
  CHECK(worst_j < 1e-10);
  CHECK(least_between < p.stops.least_rad);
  CHECK(s.stop_j > 1e-6);
  CHECK(s.dry_j > 1e-3);
  CHECK(s.viscous_j > 1e-5);
  CHECK(std::abs(s.motor_work_j) > 1e-4);
  CHECK(s.hand_work_j > 1e-3);
}

TEST_CASE("pen hand: whatever it does, linkage and friction only take energy", "[pen]") {
  const PantographParameters p = pantograph();
  for (const double hz : {1.0, 7.0, 40.0}) {
    PenHand hand = hand_at_rest({0.01, 0.12});
    hand.phases[0].x = {sine(5.0, 0.06, hz, 0.0)};
    hand.phases[0].y = {sine(5.0, 0.05, 1.7 * hz, 1.0)};
    Pantograph plant(p, p.effects, Drive{}, hand);
    double least = 0.0;
    for (int i = 0; i < 100000; ++i) {
      plant.advance({Bridge::off(), Bridge::off()}, 250);
      least = std::min(least, plant.seen().hand_work_j);
    }
    CHECK(least > -1e-9);
    CHECK(plant.seen().hand_work_j > 1e-4);
    CHECK(plant.seen().dry_j > 0.0);
  }
}

TEST_CASE("an imposed motion: places, Newton's force, the work of a cycle", "[pen]") {
  const PantographParameters p = pantograph();
  PenHand hand;
  hand.start_m = Vec2{0.0, 0.1};
  hand.phases = {towards(Kind::kPrescribed, Segment::Kind::kMinimumJerk, 0.2, {0.05, 0.14})};
  Pantograph plant(p, kNoEffects, Drive{}, hand);
  run(plant, {}, 0.1, 25);
  CHECK(plant.seen().pen_m.x == Approx(0.025).epsilon(1e-12));
  CHECK(plant.seen().pen_m.y == Approx(0.12).epsilon(1e-12));
  CHECK(plant.seen().pen_m_s.x == Approx(1.875 * 0.05 / 0.2).epsilon(1e-9));
  // At rest at both ends: all the work was returned.
  run(plant, {}, 0.2, 25);
  CHECK(plant.seen().pen_m.x == Approx(0.05).epsilon(1e-12));
  CHECK(plant.seen().hand_work_j == Approx(0.0).margin(1e-8));
  CHECK(length(plant.seen().hand_n) == Approx(0.0).margin(1e-9));

  // The force that moves the free linkage along the same way.
  const Vec2 again{0.0, 0.1};
  Pantograph led(p, kNoEffects, Drive{}, hand);
  Pantograph pushed(p, kNoEffects, Drive{}, PenHand{again, {}});
  for (int i = 0; i < 200000; ++i) {
    led.advance(Joints{}, 25);
    const LinkagePose pose = pushed.linkage().pose(pushed.seen().theta_rad);
    pushed.advance(pose.torque(led.seen().hand_n), 25);
  }
  CHECK(pushed.seen().pen_m.x == Approx(led.seen().pen_m.x).margin(2e-6));
  CHECK(pushed.seen().pen_m.y == Approx(led.seen().pen_m.y).margin(2e-6));
}

TEST_CASE("pen hand: steered, taken over, without dynamics", "[pen]") {
  const PantographParameters p = pantograph();
  Pantograph plant(p, p.effects, Drive{}, PenHand{});
  run(plant, {}, 0.01);
  CHECK(plant.seen().pen_m.y == Approx(0.1).epsilon(1e-9));
  PenPhase hold;
  hold.kind = Kind::kImpedance;
  plant.take(hold);
  run(plant, {}, 0.01);
  plant.steer({0.03, 0.13}, {});
  run(plant, {}, 2.0);
  CHECK(plant.seen().hand_m.x == Approx(0.03).margin(3e-3));
  CHECK(plant.seen().hand_m.y == Approx(0.13).margin(3e-3));
  plant.take({});
  run(plant, {}, 0.2);
  CHECK(length(plant.seen().hand_n) == 0.0);
  CHECK(plant.next_corner() > clocks_of(1e6));

  Effects stiff = p.effects;
  stiff.hand_dynamics = false;
  PenHand imposed = hand_at_rest({0.0, 0.12});
  imposed.phases[0].x = {segment(Segment::Kind::kRamp, 0.1, 0.02)};
  Pantograph led(p, stiff, Drive{}, imposed);
  CHECK(led.next_corner() == 1);
  run(led, {}, 0.05);
  CHECK(led.next_corner() == clocks_of(0.1));
  CHECK(led.seen().pen_m.x == Approx(0.01).epsilon(1e-9));
}

TEST_CASE("a hand that leads the pen out of reach ends the run with its time", "[pen]") {
  const PantographParameters p = pantograph();
  PenHand hand;
  hand.phases = {towards(Kind::kPrescribed, Segment::Kind::kRamp, 1.0, {0.0, 0.3})};
  Pantograph straight(p, p.effects, Drive{}, hand);
  CHECK_THROWS_AS(run(straight, {}, 1.0), MotionError);
  CHECK(straight.seconds() == Approx(0.5).epsilon(1e-3));
  hand.phases = {towards(Kind::kPrescribed, Segment::Kind::kHold, 0.5, {}),
                 towards(Kind::kPrescribed, Segment::Kind::kStep, 1.0, {0.0, 0.3})};
  hand.phases[0].duration_s = 0.5;
  Pantograph plant(p, p.effects, Drive{}, hand);
  CHECK_THROWS_WITH(run(plant, {}, 1.0),
                    Catch::Matchers::Contains("after 0.5") &&
                        Catch::Matchers::Contains("the hand puts the pen where it cannot be"));
  CHECK_THROWS_AS(Pantograph(p, p.effects, Drive{}, PenHand{Vec2{0.3, 0.0}, {}}),
                  std::invalid_argument);
}
