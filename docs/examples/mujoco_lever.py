# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The lever in MuJoCo, the core's twin as its controller: a hand leans on a wall. docs/plant.md"""

import math

import feltgate
import mujoco

LEVER = """<mujoco>
<option timestep="20e-6" gravity="0 0 0"/>
<worldbody><body>
  <inertial pos="0 0 0" mass="1" diaginertia="1.22e-4 1.22e-4 1.22e-4"/>
  <joint name="lever" axis="0 0 1"/>
</body></worldbody>
<actuator>
  <dcmotor joint="lever" motorconst="0.0302" resistance="0.42" inductance="82.3e-6"
           lugre="40 0.02 3.5e-3 4.5e-3 0.5"/>
</actuator>
</mujoco>"""

model = mujoco.MjModel.from_xml_string(LEVER)
data = mujoco.MjData(model)
# This motor has no brushes' drop, and the bridge no dead time: nothing to compensate.
twin = feltgate.Twin("lever").set(dead_voltage=0, self_test_pulse=0).arm("wall")
while data.time < 0.3:
    count = math.floor(data.qpos[0] / feltgate.count_rad())  # the encoder
    out = twin.run([count] * 20)  # ticks of 1 us: a period of the PWM
    data.ctrl[0] = 24 * out.duty[-1]
    data.qfrc_applied[0] = 0.1 - 0.02 * data.qvel[0]  # the hand, Nm
    mujoco.mj_step(model, data)
print(f"A hand of 0.1 Nm leans on the wall at 0.5 rad; the lever is at {data.qpos[0]:.3f} rad.")
