# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The demo's section on walls: a stability study, its pictures. Documentation: docs/speed-for-accuracy.md"""

import json
import subprocess

import interrupts
from reports import page, runs, stability_plots

DESIGN = "lever"


class Study:
    """The borders alone, beside other work; written to folder/stability.json. Left early, it ends."""

    def __init__(self, folder):
        self.path = folder / "stability.json"
        self.process = interrupts.start(
            [runs.program(), "stability", DESIGN, "--no-experiments", "--json", self.path],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
            self.process.communicate()

    def result(self):
        """(study, complaint) once it has come to its end."""
        stdout, stderr = self.process.communicate()
        status = self.process.returncode
        interrupts.check(status)
        if status == 0:
            return json.loads(self.path.read_text(encoding="utf-8")), ""
        said = (stderr or stdout).strip().splitlines()
        return None, f"stability {DESIGN}: {said[-1] if said else f'exit code {status}'}"


def table(found):
    head = [
        "scene rate",
        "B, Nm s/rad",
        "chain's bits, Nm/rad",
        "eigenvalues",
        "closed form",
        "Z-width",
    ]
    rows = []
    for p in found["borders"]:
        row = [stability_plots.rate_text(p["rate_hz"]), page.number(p["damping_nm_s_rad"])]
        if p["eigenvalues_nm_rad"] == 0:
            row.append("no stiffness is stable")
        else:
            row += [
                page.number(p[key])
                for key in ("bits_nm_rad", "eigenvalues_nm_rad", "closed_nm_rad", "z_width")
            ]
        rows.append(row)
    return page.table(head, rows)


def html(found):
    text = page.paragraph(
        "How stiff a wall may be before it shakes by itself, against its damping and the rate at "
        "which it is computed: by bisection on the chain's own bits around a linear plant, by the "
        "eigenvalues of the loop, and by (b+B)/(T/2+td). docs/speed-for-accuracy.md says where the three "
        "must agree and why they differ elsewhere."
    )
    text += page.pictures(stability_plots.pictures(found))
    text += page.fold("Stiffest stable wall for each rate and damping", table(found))
    return page.section("stability", f"Walls: stability of {found['design']}", text)
