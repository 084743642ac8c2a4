# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The lever as a leader arm, in the shape that robot-arm projects expect of a teleoperator: connect(),
get_action(), send_feedback(), disconnect(). docs/python.md

    lever_leader.py PORT: prints where the lever is, and pulls it softly to 0 for five seconds.
"""

import sys
import time

import feltgate


class LeverLeader:
    """A lever behind its link. Ten calls a second keep the motor armed; without them it disarms."""

    name = "feltgate_lever"
    action_features = {"lever.pos_rad": float, "lever.vel_rad_s": float}
    feedback_features = {"lever.torque_nm": float}

    def __init__(self, port, most_nm=0.2):
        self.port, self.most_nm, self._device = port, most_nm, None

    @property
    def is_connected(self):
        return self._device is not None

    @property
    def is_calibrated(self):
        return True  # the encoder counts from where calibrate() was

    def connect(self, calibrate=False):
        """Opens the port, disarms first, then arms with a torque of 0."""
        device = feltgate.Device(self.port)
        try:
            device.disarm()
            if calibrate:
                device.set_zero()
            device.set(setpoint_torque=0.0)
            device.arm("setpoint")
        except BaseException:
            device.close()
            raise
        self._device = device

    def calibrate(self):
        """The lever's present angle becomes 0."""
        self._device.disarm()
        self._device.set_zero()
        self._device.set(setpoint_torque=0.0)
        self._device.arm("setpoint")

    def configure(self):
        """Nothing to set: the board has its design."""

    def get_action(self):
        """Where the lever is: angle in rad, velocity in rad/s."""
        self._device.kick()
        return {
            "lever.pos_rad": self._device.get("angle"),
            "lever.vel_rad_s": self._device.get("velocity"),
        }

    def send_feedback(self, feedback):
        """The torque that the hand shall feel, Nm; held within most_nm. Returns what acts."""
        torque_nm = max(-self.most_nm, min(self.most_nm, feedback["lever.torque_nm"]))
        self._device.kick()
        return {"lever.torque_nm": self._device.set(setpoint_torque=torque_nm)["setpoint_torque"]}

    def disconnect(self):
        """Disarms and lets go of the port."""
        if self._device is not None:
            self._device.close()
            self._device = None


def main():
    leader = LeverLeader(sys.argv[1])
    leader.connect()
    try:
        end = time.monotonic() + 5
        while time.monotonic() < end:
            action = leader.get_action()
            felt = leader.send_feedback({"lever.torque_nm": -0.2 * action["lever.pos_rad"]})
            print(f"{action['lever.pos_rad']:8.4f} rad {felt['lever.torque_nm']:8.4f} Nm", end="\r")
    finally:
        leader.disconnect()


if __name__ == "__main__":
    main()
