# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""With a board in software: feltgate.Device (values, arming, arrays, errors, Ctrl-C); and the Python
code of docs/python.md runs as it stands, as does the notebook.
"""

import contextlib
import io
import os
import re
import signal
import sys
import threading
import time
import unittest

import numpy as np

import feltgate

from board_process import BoardProcess

from testing import ROOT, Scratch, ran, text_of

NOTEBOOK = ROOT / "docs/fixed_against_float.ipynb"


class Device(unittest.TestCase):
    def test_values(self):
        with BoardProcess() as board, feltgate.Device(board.port) as device:
            info = device.info()
            self.assertEqual((info["design"], info["simulated"]), ("lever", True))
            self.assertEqual(device.set(torque_limit=0.25), {"torque_limit": 0.25})
            self.assertEqual(device.get("torque_limit"), 0.25)
            contact = device.set(wall_contact="0.2rad")["wall_contact"]
            self.assertAlmostEqual(contact, 0.2 / feltgate.count_rad(), places=2)
            tick = device.tick()
            self.assertAlmostEqual(tick["angle"], tick["position"] * feltgate.count_rad())
            self.assertTrue(device.names()["torque_limit"]["settable"])
            with self.assertRaisesRegex(ValueError, 'did you mean "torque_limit"'):
                device.set(torque_limt=0.1)
            with self.assertRaisesRegex(ValueError, "choose a value from -16 to 16"):
                device.set(torque_limit=99)

    def test_arming_and_what_ends_it(self):
        with BoardProcess() as board:
            with feltgate.Device(board.port) as device:
                device.arm("wall")
                self.assertEqual(board.order("armed?"), "1")
                with self.assertRaisesRegex(feltgate.Refused, "cannot change while armed"):
                    device.set(voltage_gain=0.3)
                device.hold(0.2)
                self.assertGreater(int(board.order("kicks?")), 4)
            self.assertEqual(board.order("armed?"), "0")
            with feltgate.Device(board.port) as device:
                device.arm("wall")
                board.order("fault 2")
                with self.assertRaisesRegex(feltgate.Refused, "the motor is off: fault speed"):
                    device.stream(seconds=1)
                with self.assertRaisesRegex(feltgate.Refused, "fault speed is latched"):
                    device.arm()
                device.clear_faults()
                device.arm("damper")
                self.assertEqual(device.info()["scene"], "damper")

    def test_arrays(self):
        with BoardProcess() as board, feltgate.Device(board.port) as device:
            live = device.stream(["angle", "velocity"], seconds=0.3, every_s=0.005)
            self.assertEqual(list(live), ["time_s", "angle", "velocity"])
            self.assertGreater(len(live.angle), 10)
            self.assertTrue(np.all(np.diff(live.time_s) > 0))
            fast = device.capture(["angle", "velocity"], trigger="angle>0.1", span_s=0.05)
            self.assertEqual(len(fast.angle), 1024)
            (at,) = np.flatnonzero(fast.time_s == 0)
            self.assertEqual(at, 256)
            self.assertGreaterEqual(fast.angle[at], 0.0995)
            self.assertLess(fast.angle[at - 1], 0.1005)
            with self.assertRaisesRegex(feltgate.Refused, "did not come within 0.2 s"):
                device.capture(trigger="velocity>900", wait_s=0.2)
            self.assertEqual(device.link()["damaged"], 0)

    def test_the_leader_of_a_robot_arm(self):
        sys.path.insert(0, str(ROOT / "docs/examples"))
        self.addCleanup(sys.path.pop, 0)
        from lever_leader import LeverLeader

        with BoardProcess() as board:
            leader = LeverLeader(board.port)
            self.assertFalse(leader.is_connected)
            leader.connect(calibrate=True)
            self.assertTrue(leader.is_connected)
            self.assertEqual(board.order("armed?"), "1")
            action = leader.get_action()
            self.assertEqual(set(action), set(leader.action_features))
            self.assertTrue(all(type(value) is kind for value, kind in zip(
                action.values(), leader.action_features.values())))  # fmt: skip
            self.assertAlmostEqual(leader.send_feedback({"lever.torque_nm": 0.1})["lever.torque_nm"], 0.1, 4)
            self.assertAlmostEqual(leader.send_feedback({"lever.torque_nm": -9.0})["lever.torque_nm"], -0.2, 4)
            leader.calibrate()
            self.assertEqual(board.order("armed?"), "1")
            leader.disconnect()
            self.assertFalse(leader.is_connected)
            self.assertEqual(board.order("armed?"), "0")
            with feltgate.Device(board.port):
                with self.assertRaisesRegex(ValueError, "is in use by"):
                    leader.connect()
            self.assertFalse(leader.is_connected)

    def test_a_board_without_engine(self):
        with BoardProcess() as board, feltgate.Device(board.port) as device:
            with self.assertRaisesRegex(feltgate.Refused, "has no engine"):
                device.law("detent")
            with self.assertRaisesRegex(feltgate.Refused, "has no engine"):
                device.events()
            with self.assertRaisesRegex(ValueError, 'did you mean "detent"'):
                device.law("detnt")

    def test_trouble(self):
        with self.assertRaisesRegex(ValueError, "there is no such port"):
            feltgate.Device("/dev/ttyNOWHERE")
        with BoardProcess() as board:
            with feltgate.Device(board.port, patience_s=0.3) as device:
                with self.assertRaisesRegex(ValueError, "is in use by"):
                    feltgate.Device(board.port)
                board.order("silent")
                with self.assertRaisesRegex(feltgate.LinkLost, "no answer"):
                    device.get("angle")
                board.order("loud")
                self.assertTrue(np.isfinite(device.get("angle")))
            self.assertTrue(issubclass(feltgate.LinkLost, ConnectionError))
            with self.assertRaisesRegex(RuntimeError, "is closed"):
                device.get("angle")

    def test_interrupt(self):
        with BoardProcess() as board:
            with self.assertRaises(KeyboardInterrupt), feltgate.Device(board.port) as device:
                device.arm("wall")
                threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
                start = time.monotonic()
                device.hold(30)
            self.assertLess(time.monotonic() - start, 5)
            self.assertEqual(board.order("armed?"), "0")


class Pages(Scratch):
    def test_python_page(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        page = "docs/python.md"
        blocks = re.findall(r"^```python\n(.*?)^```$", text_of(page), re.M | re.S)
        self.assertGreaterEqual(len(blocks), 5)
        with BoardProcess() as board, contextlib.redirect_stdout(io.StringIO()):
            names = {"port": board.port}
            for block in blocks:
                exec(compile(block, page, "exec"), names)  # one after the other, as a reader would

    def test_notebook(self):
        self.ended(ran(sys.executable, ROOT / "scripts/notebook.py", NOTEBOOK, "--check"))


if __name__ == "__main__":
    unittest.main()
