# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The plant beside MuJoCo's DC motor: five motions of all parts together, one of each part alone;
the example's wall holds. docs/plant.md

mujoco_test.py VENV: where scripts/build.sh has fetched MuJoCo.
"""

import contextlib
import io
import os
import re
import sys
import unittest
from pathlib import Path

from testing import Scratch, text_of

# First, so that the arrays are those of its numpy, which is newer than Debian's.
sys.path[:0] = map(str, Path(sys.argv.pop(1)).glob("lib/python3*/site-packages"))
try:
    import mujoco
    import numpy as np
    from mujoco import rollout
except ImportError:
    if os.environ.get("CI"):
        raise
    mujoco = None
import feltgate

LIMIT = 0.5  # percent
STEP_S, END_S = 1e-6, 0.1
PARTS = {
    "inertia": (), "viscous": ("viscous",), "friction": ("lugre",), "back-EMF": ("back_emf",),
    "winding": ("inductance",), "cogging": ("cogging",),
    "together": ("viscous", "lugre", "back_emf", "inductance", "cogging"),
}  # fmt: skip
COGGING = {"per_turn": 12, "amplitude_nm": 0.009, "phase_rad": 0.4}
NOBODY = ([0, 1], [0, 0])
#: Volts at a time, the hand's torque in Nm at times, whether the lever is held.
MOTIONS = {
    "voltage step": (lambda t: 2 + 0 * t, NOBODY, False),
    "sine": (lambda t: 2 * np.sin(2 * np.pi * 20 * t), NOBODY, False),
    "coasting": (lambda t: 0 * t, ([0, 0.01, 0.01 + 1e-9], [0.02, 0.02, 0]), False),
    "load step": (lambda t: 2 + 0 * t, ([0, 0.05, 0.05 + 1e-9], [0, 0, -0.03]), False),
    "stall": (lambda t: 2 + 0 * t, NOBODY, True),
}
SHOWN = ("theta_rad", "omega_rad_s", "motor_torque_nm", "friction_nm")
MJCF = """<mujoco>
<option timestep="{step}" gravity="0 0 0"/>
<worldbody><body>
  <inertial pos="0 0 0" mass="1" diaginertia="{inertia} {inertia} {inertia}"/>
  <joint name="lever" axis="0 0 1" damping="{damping}"/>
</body></worldbody>
<actuator>
  <{motor} name="motor" joint="lever"/>
  <dcmotor name="friction" joint="lever" input="none" motorconst="0" resistance="1" lugre="{lugre}"/>
  <dcmotor name="cogging" joint="lever" input="none" motorconst="0" resistance="1" cogging="{cogging}"/>
</actuator>
<sensor><actuatorfrc actuator="motor"/><actuatorfrc actuator="friction"/></sensor>
</mujoco>"""


def theirs(p, effects, volts, hand_nm, held):
    """SHOWN of MuJoCo. Its DC motor always has a back-EMF; a gain and a filter do without."""
    gain, ohm = p["motor.torque_constant_nm_a"], p["motor.resistance_ohm"]
    henry = p["motor.inductance_h"] if "inductance" in effects else 0
    motor = f'dcmotor motorconst="{gain}" resistance="{ohm}" inductance="{henry} 0"'
    if "back_emf" not in effects:
        lag = f'dyntype="filterexact" dynprm="{henry / ohm}" actearly="true"' if henry else ""
        motor = f'general gainprm="{gain / ohm}" {lag}'
    names = ("stiffness_nm_rad", "damping_nm_s_rad", "coulomb_nm", "static_nm", "stribeck_rad_s")
    lugre = [p[f"lugre.{name}"] if "lugre" in effects else 0 for name in names]
    owners = {"lever": "viscous", "lugre": "lugre"}
    damping = sum(p[f"{o}.viscous_nm_s_rad"] for o, effect in owners.items() if effect in effects)
    amplitude = COGGING["amplitude_nm"] if "cogging" in effects else 0
    cogging = amplitude, COGGING["per_turn"], COGGING["phase_rad"]
    model = mujoco.MjModel.from_xml_string(MJCF.format(
        step=STEP_S, inertia=1e6 if held else p["lever.inertia_kg_m2"], damping=damping,
        motor=motor, lugre=" ".join(map(str, lugre)), cogging=" ".join(map(str, cogging))))  # fmt: skip
    kind = mujoco.mjtState
    start = np.zeros((1, mujoco.mj_stateSize(model, kind.mjSTATE_FULLPHYSICS)))
    state, torque = rollout.rollout(
        model, mujoco.MjData(model), start, np.c_[volts, hand_nm],
        control_spec=int(kind.mjSTATE_CTRL | kind.mjSTATE_QFRC_APPLIED))  # fmt: skip
    _, angle, speed = state[0, :, :3].T
    return angle, speed, torque[0, :, 0], damping * speed - torque[0, :, 1]


@unittest.skipUnless(mujoco, "no MuJoCo; ./feltgate test fetches it")
class Mujoco(Scratch):
    def error(self, part, motion):
        """The largest difference of a motion, in percent of the plant's peak."""
        volts_at, (times, torques), held = MOTIONS[motion]
        t = np.arange(0, END_S, STEP_S)
        hand = feltgate.Hand.motion(*NOBODY) if held else feltgate.Hand.torque(times, torques)
        switches = r"(?m)^(viscous|lugre|back_emf|inductance|dead_voltage|dead_time) = \w+"
        effects = PARTS[part]
        text = re.sub(
            switches, lambda m: f"{m[1]} = {str(m[1] in effects).lower()}",
            text_of("vectors/plants/p24.toml"))  # fmt: skip
        if "cogging" in effects:
            text += "\n[[cogging]]\n" + "".join(f"{k} = {v}\n" for k, v in COGGING.items())
        file = self.put("plant.toml", text)
        p = feltgate.Plant(file).parameters
        plant = feltgate.Plant(file, hand=hand)
        ours = plant.run(volts_at(t) / p["supply.voltage_v"], step_clocks=round(STEP_S * 50e6))
        hand_nm = np.interp(t + STEP_S / 2, times, torques)
        pairs = zip((ours[name] for name in SHOWN), theirs(p, effects, volts_at(t), hand_nm, held))
        errors = [100 * np.abs(a - b).max() / (np.abs(a).max() or 1) for a, b in pairs]
        return np.max(errors)  # NaN stays NaN, and fails

    def test_motions(self):
        alone = [(part, "sine") for part in PARTS if part != "together"]
        for part, motion in [*alone, *(("together", motion) for motion in MOTIONS)]:
            with self.subTest(f"{motion}, {part}"):
                self.assertLess(self.error(part, motion), LIMIT)

    def angle(self, old="", new=""):
        """The lever's at the end of the example."""
        names = {}
        with contextlib.redirect_stdout(io.StringIO()):
            exec(text_of("docs/examples/mujoco_lever.py").replace(old, new), names)
        self.assertEqual(names["out"].faults[-1], 0)
        return names["data"].qpos[0]

    def test_example(self):
        # 0.1 Nm into 4 Nm/rad behind 0.5 rad; 4.5 mNm of friction and a count of 1.5 mrad aside.
        self.assertAlmostEqual(self.angle(), 0.5 + 0.1 / 4, delta=0.0027)
        self.assertGreater(self.angle('arm("wall")', 'arm("free")'), 1)


if __name__ == "__main__":
    unittest.main()
