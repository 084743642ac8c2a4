// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bridges to interfaces of others, on simulated boards in simulated time: the device class for
// CHAI3D on a stub of it, and two levers over two links. Documentation: docs/devices.md
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "../../../docs/examples/teleoperation/teleoperation.hpp"
#include "catch.hpp"
#include "feltgate/generated/link.hpp"
#include "host/chai3d/feltgate_device.hpp"
#include "host/link.hpp"

using namespace feltgate;
using chai3d::C_ERROR;
using chai3d::C_SUCCESS;
using chai3d::cFeltgateDevice;
using chai3d::cVector3d;

namespace {

// The core's own words: docs/registers.md.
constexpr std::uint32_t control = 0x200, control_arm = 2, command = 0x201, setpoint_torque = 0x04a;

/// A write that went over the wire.
struct Written {
  std::uint32_t address, word;
};

/// One board that several transports may use one after the other, and what they wrote to it.
struct Wire {
  explicit Wire(const plant::Hand& hand)
      : board(board::make_core("lever", "twin", {}),
              plant::read_plant_file(FELTGATE_ROOT "/vectors/plants/p24.toml"), hand, {}) {}
  void run_s(double seconds) { board.run_to(board.board().now() + std::llround(seconds * 50e6)); }
  double angle_rad() const { return board.board().plant().theta_rad; }

  board::BoardWire board;
  host::FrameReader reader;
  std::vector<Written> writes;
  bool cut = false;
};

/// The port that the device closes at its end; the board goes on.
class Tap : public host::Transport {
 public:
  explicit Tap(Wire& wire) : wire_(wire) {}
  void write(const std::uint8_t* data, std::size_t size) override {
    if (wire_.cut) throw host::LinkLost("wire: cut");
    wire_.board.write(data, size);
    wire_.reader.add(data, size);
    while (const auto frame = wire_.reader.next()) {
      const auto& f = *frame;
      if (f[0] != LinkMap::kind_write) continue;
      // Not the commands freeze and thaw, which hold what is read and set nothing.
      const auto at = [&f](std::size_t k) { return static_cast<std::uint32_t>(f.at(k)); };
      const Written w{at(2) | at(3) << 8, at(4) | at(5) << 8 | at(6) << 16 | at(7) << 24};
      if (w.address != command || (w.word & ~0x18U) != 0) wire_.writes.push_back(w);
    }
  }
  std::size_t read(std::uint8_t* data, std::size_t size, host::Deadline deadline) override {
    return wire_.board.read(data, size, deadline);
  }
  const std::string& name() const override { return wire_.board.name(); }

 private:
  Wire& wire_;
};

class OnWire : public cFeltgateDevice {
 public:
  explicit OnWire(Wire& wire) : wire_(wire) {}

 protected:
  std::unique_ptr<host::Transport> openTransport() override { return std::make_unique<Tap>(wire_); }
  std::string root() const override { return FELTGATE_ROOT; }

 private:
  Wire& wire_;
};

/// One port in the environment, so that a device is available.
struct Ports {
  explicit Ports(const char* names) { setenv("FELTGATE_PORTS", names, 1); }
  ~Ports() { unsetenv("FELTGATE_PORTS"); }
};

plant::Hand hand_of(plant::HandPhase::Kind kind, double to, double within_s) {
  plant::Segment wait, go;  // waits for the self-test, which wants a lever at rest
  wait.duration_s = 0.4;
  go.kind = plant::Segment::Kind::kMinimumJerk;
  go.duration_s = within_s;
  go.to = to;
  plant::HandPhase phase;
  phase.kind = kind;
  phase.profile = {wait, go};
  plant::Hand hand;
  hand.phases = {phase};
  return hand;
}

/// The host's clock is that on the wall and the board's is not: its watchdog must wait for longer.
void calm_watchdog(Wire& wire) {
  Tap tap(wire);
  host::Link link(tap);
  const host::BoardInfo board = host::read_board(link);
  host::Device device(link, board, host::design_by_crc(FELTGATE_ROOT, board.design_crc)->design);
  REQUIRE(device.set("watchdog_ticks", 8e6).kept);
  wire.writes.clear();
}

double motor_nm(const Wire& wire) { return wire.board.board().plant().motor_torque_nm; }

}  // namespace

TEST_CASE("CHAI3D: as many devices as ports, and none behind them") {
  const Ports ports("/dev/nowhere,/dev/nothing");
  CHECK(cFeltgateDevice::getNumDevices() == 2);
  CHECK(cFeltgateDevice::create(1)->isDeviceAvailable());
  const auto third = cFeltgateDevice::create(2);
  CHECK_FALSE(third->isDeviceAvailable());
  CHECK(third->open() == C_ERROR);
  CHECK(third->lastError() == "there is no port for this device");
  const auto first = cFeltgateDevice::create(0);
  CHECK(first->open() == C_ERROR);
  CHECK(first->lastError().find("/dev/nowhere") != std::string::npos);
  cVector3d v(1, 1, 1);
  CHECK(first->getPosition(v) == C_ERROR);
  CHECK(first->setForce(v) == C_ERROR);
  CHECK(first->close() == C_ERROR);
}

TEST_CASE("CHAI3D: open disarms before it sets anything, close leaves the motor off") {
  const Ports port("wire");
  Wire wire(hand_of(plant::HandPhase::Kind::kImpedance, 0, 0.1));  // holds it
  calm_watchdog(wire);
  {
    OnWire device(wire);
    REQUIRE(device.open() == C_SUCCESS);
    REQUIRE(device.isDeviceReady());
    CHECK(device.open() == C_ERROR);
    REQUIRE(wire.writes.size() > 3);
    CHECK(wire.writes[0].address == control);
    CHECK((wire.writes[0].word & control_arm) == 0);
    bool armed = false, at_rest = false;
    for (const Written& w : wire.writes) {
      if (w.address == setpoint_torque) at_rest = w.word == 0;
      if (w.address == control && (w.word & control_arm) != 0) armed = at_rest;
      if (w.address < control) CHECK(w.address == setpoint_torque);  // no other parameter
    }
    CHECK(armed);
    unsigned int switches = 0;
    CHECK(device.getUserSwitches(switches) == C_SUCCESS);
    CHECK(switches == 1);
    CHECK(device.setForce(cVector3d(0, 1, 0)) == C_SUCCESS);
    wire.run_s(0.03);
    CHECK(motor_nm(wire) > 0.08);
    CHECK(device.close() == C_SUCCESS);
    wire.run_s(0.01);
    CHECK(std::abs(motor_nm(wire)) < 0.01);
    REQUIRE(device.open() == C_SUCCESS);
    wire.run_s(0.03);
    CHECK(std::abs(motor_nm(wire)) < 0.01);  // the force of the last time is forgotten
    CHECK(device.setForce(cVector3d(0, 1, 0)) == C_SUCCESS);
  }
  wire.run_s(0.03);
  CHECK(std::abs(motor_nm(wire)) < 0.01);  // the destructor's work
}

TEST_CASE("CHAI3D: position, rotation, force and its limits") {
  const Ports port("wire");
  Wire wire(hand_of(plant::HandPhase::Kind::kPrescribed, 0.3, 0.2));
  calm_watchdog(wire);
  OnWire device(wire);
  REQUIRE(device.open() == C_SUCCESS);
  wire.run_s(0.65);
  const double theta = wire.angle_rad(), r = cFeltgateDevice::radius_m;
  REQUIRE(std::abs(theta - 0.3) < 1e-9);
  cVector3d p;
  REQUIRE(device.getPosition(p) == C_SUCCESS);
  constexpr double count_m = 2e-4;
  CHECK(p.x() == 0);
  CHECK(std::abs(p.y() - r * std::sin(theta)) < count_m);
  CHECK(std::abs(p.z() - r * (std::cos(theta) - 1)) < count_m);
  chai3d::cMatrix3d m;
  REQUIRE(device.getRotation(m) == C_SUCCESS);
  // It carries the lever that points up to where its end is.
  CHECK(std::abs(r * m(0, 2) - p.x()) < 1e-12);
  CHECK(std::abs(r * m(1, 2) - p.y()) < 1e-12);
  CHECK(std::abs(r * m(2, 2) - r - p.z()) < 1e-12);
  CHECK(std::abs(m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1) - 1) < 1e-12);

  const auto torque_of = [&](const cVector3d& force, const cVector3d& torque) {
    REQUIRE(device.setForceAndTorqueAndGripperForce(force, torque, 0) == C_SUCCESS);
    wire.run_s(0.15);
    return motor_nm(wire);
  };
  const double s = std::sin(theta), c = std::cos(theta);
  const cVector3d none(0, 0, 0);
  CHECK(std::abs(torque_of({0, c, -s}, none) - 0.1) < 0.01);  // 1 N along the way, 0.1 m
  cVector3d felt;
  REQUIRE(device.getForce(felt) == C_SUCCESS);
  CHECK(std::abs(felt.y() - c) < 0.02);
  CHECK(std::abs(felt.z() + s) < 0.02);
  CHECK(std::abs(torque_of({5, s, c}, none)) < 0.01);          // across it
  CHECK(std::abs(torque_of(none, {0.1, 2, 3}) + 0.1) < 0.01);  // x to the user: against the angle
  CHECK(std::abs(torque_of({0, 1e6, 0}, none) - 0.3) < 0.02);  // its own limit
  CHECK(std::abs(torque_of({0, std::numeric_limits<double>::quiet_NaN(), 0}, none)) < 0.01);

  REQUIRE(device.calibrate(false) == C_SUCCESS);
  REQUIRE(device.getPosition(p) == C_SUCCESS);
  CHECK(p.y() > 0.02);
  REQUIRE(device.calibrate(true) == C_SUCCESS);
  REQUIRE(device.getPosition(p) == C_SUCCESS);
  CHECK(std::abs(p.y()) < count_m);
  wire.cut = true;
  CHECK(device.getPosition(p) == C_ERROR);
  CHECK_FALSE(device.isDeviceReady());
}

TEST_CASE("CHAI3D: a wall of the stiffness that the specification gives holds a hand at 1 kHz") {
  const Ports port("wire");
  Wire wire(hand_of(plant::HandPhase::Kind::kTorque, 0.1, 0.1));
  calm_watchdog(wire);
  OnWire device(wire);
  REQUIRE(device.open() == C_SUCCESS);
  const chai3d::cHapticDeviceInfo info = device.getSpecifications();
  const double start_s = static_cast<double>(wire.board.board().now()) / 50e6;
  double low = 1, high = -1, before = 0;
  for (int n = 1; n <= 700; ++n) {
    wire.board.run_to(std::llround((start_s + 1e-3 * n) * 50e6));
    cVector3d p;
    REQUIRE(device.getPosition(p) == C_SUCCESS);
    const double speed = (p.y() - before) * 1e3;
    before = p.y();
    const double depth = p.y() - 0.005;
    const double wall_n = -info.m_maxLinearStiffness * depth - info.m_maxLinearDamping * speed;
    REQUIRE(device.setForce({0, depth > 0 ? std::min(wall_n, 0.0) : 0.0, 0}) == C_SUCCESS);
    if (n < 600) continue;
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  // 0.1 Nm at 0.1 m are 1 N: it rests 10 mm deep, but for friction and what 1 kHz shakes.
  CHECK(low > 0.005 + 0.7 / info.m_maxLinearStiffness);
  CHECK(high < 0.005 + 1.3 / info.m_maxLinearStiffness);
}

TEST_CASE("CHAI3D: a program that stops calling loses the motor within the watchdog's time") {
  const Ports port("wire");
  Wire wire(hand_of(plant::HandPhase::Kind::kImpedance, 0, 0.1));
  OnWire device(wire);
  REQUIRE(device.open() == C_SUCCESS);
  REQUIRE(device.setForce({0, 0.5, 0}) == C_SUCCESS);
  wire.run_s(0.2);
  unsigned int switches = 1;
  REQUIRE(device.getUserSwitches(switches) == C_SUCCESS);
  CHECK(switches == 0);
}

TEST_CASE("teleoperation: passive and stable with the controller, and not without") {
  examples::Coupling on, off;
  off.passivity = false;
  const auto run = [](double delay_s, const examples::Coupling& c, double run_s) {
    const examples::Teleoperated t = examples::teleoperate(FELTGATE_ROOT, delay_s, c, run_s);
    CAPTURE(delay_s, c.passivity, t.least_energy_j, t.least_of_plant_j, t.fastest_rad_s,
            t.apart_rad);
    if (c.passivity) {
      CHECK(t.least_energy_j > -1e-4);
      CHECK(t.least_of_plant_j > -1e-3);
      CHECK(t.fastest_rad_s < 1);
      CHECK(t.apart_rad < 0.1);
      CHECK(t.armed);
      CHECK(std::abs(t.follower_rad) > 0.1);  // it has been carried along
    } else {
      CHECK(t.least_energy_j < -0.5);
      CHECK(t.least_of_plant_j < -0.5);
      CHECK(t.fastest_rad_s > 50);
    }
  };
  run(0.02, on, 0.8);  // nearest to the swing of the coupled levers
  run(0.1, on, 1.0);
  run(0.1, off, 0.8);
  run(0.2, on, 1.2);
}
