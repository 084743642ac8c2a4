// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Haptic Lever as a device of CHAI3D 3.2, derived from its cGenericHapticDevice and shaped as
// its cMyCustomDevice. Written from the documented interface, never linked with CHAI3D itself.
// Documentation: docs/devices.md#chai3d
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "devices/CGenericHapticDevice.h"
#include "host/host_device.hpp"
#include "host/transport.hpp"

namespace chai3d {

class cFeltgateDevice;
using cFeltgateDevicePtr = std::shared_ptr<cFeltgateDevice>;

/// A lever in CHAI3D's frame (x to the user, y to the right, z up). It turns about the x axis; at
/// angle 0 it points up, and a positive angle moves its end to the right. The position is that of
/// the end, relative to angle 0; the rotation is the lever's.
class cFeltgateDevice : public cGenericHapticDevice {
 public:
  /// Baud rate of the board's link, and length of the lever, m.
  static constexpr int baud = 1'000'000;
  static constexpr double radius_m = 0.1;

  explicit cFeltgateDevice(unsigned int a_deviceNumber = 0) : cGenericHapticDevice(a_deviceNumber) {
    m_deviceReady = false;
    m_deviceAvailable = a_deviceNumber < getNumDevices();
    cHapticDeviceInfo& s = m_specifications;
    s = {};
    s.m_model = C_HAPTIC_DEVICE_CUSTOM;
    s.m_manufacturerName = "feltgate";
    s.m_modelName = "Haptic Lever";
    s.m_maxLinearForce = max_torque_nm / radius_m;
    s.m_maxAngularTorque = max_torque_nm;
    s.m_maxLinearStiffness = max_stiffness_nm_rad / (radius_m * radius_m);
    s.m_maxAngularStiffness = max_stiffness_nm_rad;
    s.m_maxLinearDamping = max_damping_nm_s_rad / (radius_m * radius_m);
    s.m_maxAngularDamping = max_damping_nm_s_rad;
    s.m_workspaceRadius = radius_m;
    s.m_sensedPosition = s.m_sensedRotation = true;
    s.m_actuatedPosition = s.m_actuatedRotation = true;
    s.m_leftHand = s.m_rightHand = true;
  }
  /// The motor is off afterwards, if the link still works; if not, the board's watchdog does it.
  ~cFeltgateDevice() override { (void)release(); }

  static cFeltgateDevicePtr create(unsigned int a_deviceNumber = 0) {
    return std::make_shared<cFeltgateDevice>(a_deviceNumber);
  }

  /// The ports: those in FELTGATE_PORTS, with commas between them, or the serial ports that there
  /// are.
  static unsigned int getNumDevices() { return static_cast<unsigned int>(ports().size()); }

  /// Disarms the board before anything else is set, then arms it with a torque of 0. Errors:
  /// C_ERROR, and lastError() says why.
  bool open() override {
    if (!m_deviceAvailable) return fails("there is no port for this device");
    if (m_deviceReady) return fails("it is open already");
    const bool opened = tried([&] {
      transport_ = openTransport();
      link_ = std::make_unique<feltgate::host::Link>(*transport_);
      const auto board = feltgate::host::read_board(*link_);
      auto known = feltgate::host::design_by_crc(root(), board.design_crc);
      if (!known) {
        throw std::invalid_argument(
            "no design in rtl/designs is the board's; set FELTGATE_ROOT to the repository that it "
            "was built from");
      }
      device_ = std::make_unique<feltgate::host::Device>(*link_, board, std::move(known->design));
      keep_ = std::make_unique<feltgate::host::KeepAlive>(*device_);
      device_->disarm();
      arm();
    });
    if (!opened) {
      release();
      return C_ERROR;
    }
    m_deviceReady = true;
    return C_SUCCESS;
  }

  /// Disarms the motor and closes the port.
  bool close() override {
    if (!m_deviceReady) return fails("it is not open");
    return release();
  }

  /// With a_forceCalibration the present angle becomes 0: the motor is off meanwhile. An
  /// incremental encoder needs no other calibration.
  bool calibrate(bool a_forceCalibration = false) override {
    if (!m_deviceReady) return C_ERROR;
    if (!a_forceCalibration) return C_SUCCESS;
    return tried([&] {
      keep_->release();
      device_->set_zero();
      arm();
    });
  }

  bool getPosition(cVector3d& a_position) override {
    if (!m_deviceReady || !tried([&] { readAngle(); })) return C_ERROR;
    a_position.set(0.0, radius_m * std::sin(angle_rad_), radius_m * (std::cos(angle_rad_) - 1.0));
    estimateLinearVelocity(a_position);
    return C_SUCCESS;
  }

  /// Of the angle that getPosition() has read last.
  bool getRotation(cMatrix3d& a_rotation) override {
    if (!m_deviceReady) return C_ERROR;
    const double c = std::cos(angle_rad_), s = std::sin(angle_rad_);
    a_rotation.set(1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c);
    estimateAngularVelocity(a_rotation);
    return C_SUCCESS;
  }

  /// The force at the lever's end that the core renders, as it is limited and ramped.
  bool getForce(cVector3d& a_force) override {
    double torque_nm = 0;
    if (!m_deviceReady || !tried([&] { torque_nm = device_->get("tau_ref"); })) return C_ERROR;
    const double force_n = torque_nm / radius_m;
    a_force.set(0.0, force_n * std::cos(angle_rad_), -force_n * std::sin(angle_rad_));
    return C_SUCCESS;
  }

  /// Bit 0: the motor is armed. The board's other inputs have no place on a lever.
  bool getUserSwitches(unsigned int& a_userSwitches) override {
    a_userSwitches = 0;
    if (!m_deviceReady) return C_ERROR;
    return tried([&] { a_userSwitches = device_->get("status.armed") != 0 ? 1U : 0U; });
  }

  /// The part of force and torque that turns the lever, held within its torque limit; there is no
  /// gripper. A force that is not finite is 0. It must be called, or getPosition(), ten times a
  /// second: else the board's watchdog disarms the motor.
  bool setForceAndTorqueAndGripperForce(const cVector3d& a_force, const cVector3d& a_torque,
                                        const double /*a_gripperForce*/) override {
    if (!m_deviceReady) return C_ERROR;
    const double along_n = a_force.y() * std::cos(angle_rad_) - a_force.z() * std::sin(angle_rad_);
    const double wanted_nm = radius_m * along_n - a_torque.x();
    const double torque_nm =
        std::isfinite(wanted_nm) ? std::clamp(wanted_nm, -max_torque_nm, max_torque_nm) : 0.0;
    return tried([&] {
      setTorque(torque_nm);
      m_prevForce = a_force;
      m_prevTorque = a_torque;
    });
  }

  /// Why the last call returned C_ERROR; empty before the first.
  const std::string& lastError() const { return error_; }

 protected:
  /// The board's port; a test gives another one.
  virtual std::unique_ptr<feltgate::host::Transport> openTransport() {
    return feltgate::host::open_serial(ports().at(static_cast<std::size_t>(m_deviceNumber)), baud);
  }
  /// The repository with rtl/designs.
  virtual std::string root() const {
    const char* given = std::getenv("FELTGATE_ROOT");
    return given != nullptr ? given : ".";
  }

 private:
  /// Torque and wall that the lever renders stably with CHAI3D in the loop at 1 kHz; the test
  /// presses against such a wall.
  static constexpr double max_torque_nm = 0.3, max_stiffness_nm_rad = 1.0,
                          max_damping_nm_s_rad = 0.005;

  static std::vector<std::string> ports() {
    std::vector<std::string> all;
    if (const char* given = std::getenv("FELTGATE_PORTS")) {
      std::istringstream list(given);
      for (std::string port; std::getline(list, port, ',');) {
        if (!port.empty()) all.push_back(port);
      }
      return all;
    }
    for (const auto& port : feltgate::host::found_ports()) all.push_back(port.path);
    return all;
  }

  bool fails(const std::string& why) {
    error_ = why;
    return C_ERROR;
  }
  /// Calls work(); CHAI3D knows no exceptions, so that what is thrown becomes C_ERROR. A link that
  /// is lost closes the device.
  template <class Work>
  bool tried(const Work& work) {
    try {
      work();
      return C_SUCCESS;
    } catch (const feltgate::host::LinkLost& error) {
      m_deviceReady = false;
      return fails(error.what());
    } catch (const std::exception& error) {
      return fails(error.what());
    }
  }
  bool release() {
    m_deviceReady = false;
    const bool disarmed = !keep_ || tried([&] { keep_->release(); });
    keep_.reset();
    device_.reset();
    link_.reset();
    transport_.reset();
    return disarmed;
  }
  void arm() {
    device_->set("setpoint_torque", 0.0);
    keep_->arm("setpoint");
    readAngle();
  }
  void readAngle() {
    angle_rad_ = device_->get("angle");
    keep_->poll();
  }
  void setTorque(double torque_nm) {
    const feltgate::host::Quantity& of = device_->quantities().find("setpoint_torque");
    link_->write(of.address, device_->quantities().setting(of, torque_nm).word);
    keep_->poll();
  }

  std::unique_ptr<feltgate::host::Transport> transport_;
  std::unique_ptr<feltgate::host::Link> link_;
  std::unique_ptr<feltgate::host::Device> device_;
  std::unique_ptr<feltgate::host::KeepAlive> keep_;
  double angle_rad_ = 0;
  std::string error_;
};

}  // namespace chai3d
