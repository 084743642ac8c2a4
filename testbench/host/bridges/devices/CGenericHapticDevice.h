// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A stub of CHAI3D 3.2's devices/CGenericHapticDevice.h, written here from the documented
// signatures: what a device class derives from, overrides and calls, and nothing else of CHAI3D.
// Documentation: docs/devices.md#chai3d
#pragma once

#include <array>
#include <string>

namespace chai3d {

const bool C_ERROR = false;
const bool C_SUCCESS = true;

struct cVector3d {
  cVector3d() = default;
  cVector3d(double x, double y, double z) : v_{x, y, z} {}
  void set(double x, double y, double z) { v_ = {x, y, z}; }
  void zero() { v_ = {}; }
  double x() const { return v_[0]; }
  double y() const { return v_[1]; }
  double z() const { return v_[2]; }

 private:
  std::array<double, 3> v_{};
};

struct cMatrix3d {
  void identity() { set(1, 0, 0, 0, 1, 0, 0, 0, 1); }
  void set(double m00, double m01, double m02, double m10, double m11, double m12, double m20,
           double m21, double m22) {
    m_ = {m00, m01, m02, m10, m11, m12, m20, m21, m22};
  }
  /// CHAI3D has m(0, 0) as an operator too.
  double operator()(int row, int column) const {
    return m_[static_cast<std::size_t>(3 * row + column)];
  }

 private:
  std::array<double, 9> m_{};
};

enum cHapticDeviceModel { C_HAPTIC_DEVICE_VIRTUAL, C_HAPTIC_DEVICE_CUSTOM };

struct cHapticDeviceInfo {
  cHapticDeviceModel m_model;
  std::string m_modelName;
  std::string m_manufacturerName;
  double m_maxLinearForce;
  double m_maxAngularTorque;
  double m_maxGripperForce;
  double m_maxLinearStiffness;
  double m_maxAngularStiffness;
  double m_maxGripperLinearStiffness;
  double m_maxLinearDamping;
  double m_maxAngularDamping;
  double m_maxGripperAngularDamping;
  double m_workspaceRadius;
  double m_gripperMaxAngleRad;
  bool m_sensedPosition;
  bool m_sensedRotation;
  bool m_sensedGripper;
  bool m_actuatedPosition;
  bool m_actuatedRotation;
  bool m_actuatedGripper;
  bool m_leftHand;
  bool m_rightHand;
};

class cGenericDevice {
 public:
  explicit cGenericDevice(unsigned int a_deviceNumber = 0)
      : m_deviceNumber(static_cast<int>(a_deviceNumber)) {}
  virtual ~cGenericDevice() = default;
  virtual bool open() { return C_ERROR; }
  virtual bool close() { return C_ERROR; }
  bool isDeviceAvailable() { return m_deviceAvailable; }
  bool isDeviceReady() { return m_deviceReady; }

 protected:
  bool m_deviceAvailable = false;
  bool m_deviceReady = false;
  int m_deviceNumber;
};

class cGenericHapticDevice : public cGenericDevice {
 public:
  explicit cGenericHapticDevice(unsigned int a_deviceNumber = 0) : cGenericDevice(a_deviceNumber) {}
  virtual bool calibrate(bool = false) { return m_deviceReady; }
  virtual bool getPosition(cVector3d& a_position) {
    a_position.zero();
    return m_deviceReady;
  }
  virtual bool getRotation(cMatrix3d& a_rotation) {
    a_rotation.identity();
    return m_deviceReady;
  }
  virtual bool getForce(cVector3d& a_force) {
    a_force = m_prevForce;
    return m_deviceReady;
  }
  virtual bool getUserSwitches(unsigned int& a_userSwitches) {
    a_userSwitches = 0;
    return m_deviceReady;
  }
  cHapticDeviceInfo getSpecifications() { return m_specifications; }
  bool setForce(const cVector3d& a_force) {
    return setForceAndTorqueAndGripperForce(a_force, cVector3d(0.0, 0.0, 0.0), 0.0);
  }
  virtual bool setForceAndTorqueAndGripperForce(const cVector3d&, const cVector3d&, const double) {
    return m_deviceReady;
  }
  static unsigned int getNumDevices() { return 0; }

  cHapticDeviceInfo m_specifications{};

 protected:
  void estimateLinearVelocity(cVector3d&) { ++m_estimates; }
  void estimateAngularVelocity(cMatrix3d&) { ++m_estimates; }

  cVector3d m_prevForce;
  cVector3d m_prevTorque;
  int m_estimates = 0;
};

}  // namespace chai3d
