# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""A stand-in for exploration.point: figures from the point's own text, at once.

FAKE_POINT_DELAY_S slows a point down; FAKE_POINT_LOG takes a line per evaluation;
FAKE_POINT_FAIL, a point's id, makes that one fail. Documentation: docs/speed-for-accuracy.md
"""

import os
import time

from exploration import space


def evaluate(point, workdir, route=False):
    name = space.point_id(point)
    if log := os.environ.get("FAKE_POINT_LOG"):
        with open(log, "a", encoding="utf-8") as file:
            file.write(name + "\n")
    time.sleep(float(os.environ.get("FAKE_POINT_DELAY_S", "0")))
    if name == os.environ.get("FAKE_POINT_FAIL"):
        raise RuntimeError(f"point {name} cannot be built")
    seed = int(name, 16)
    return {
        "torque_error_rms_nm": (1 + seed % 97) * 1e-6,
        "lut4_equivalents": 2000 + seed % 101,
        "mult18": 2 + seed % 3,
        "delay_s": (1 + seed % 89) * 1e-5,
    } | ({"fmax_mhz": 50.0 + seed % 83} if route else {})
