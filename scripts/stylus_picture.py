#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/stylus.svg: a stylus over the edge of a cube and over a sphere, from the rows
of the two scenes.

  feltgate run stylus_cube --engine twin --csv cube.csv --every 20
  feltgate run stylus_sphere --engine twin --csv sphere.csv --every 20
  scripts/stylus_picture.py cube.csv sphere.csv
"""

import math
import tomllib

from docs_picture import BLUE, GREY, RED, ROOT, columns, files, plt, save

NAMES = ("time_s", "pen_x_m", "pen_y_m", "pen_z_m", "plane_tilt_rad", "tau_ref_nm.0",
         "tau_ref_nm.1", "tau_ref_nm.2")


def table_of(path, name):
    return tomllib.loads((ROOT / "vectors" / path).read_text(encoding="utf-8"))[name]


def plane_of(scene):
    return table_of(f"scenes/{scene}.toml", "plane")


CAPSTAN_M = table_of("devices/stylus.toml", "lever")["radius_m"]


def over_the_edge(axes, run, half):
    axes.plot([-half, half, half, -half, -half], [half, half, -half, -half, half], color=GREY, lw=1)
    x, z = ([1e3 * v for v in run[name]] for name in ("pen_x_m", "pen_z_m"))
    axes.plot(x, z, color=BLUE, lw=1.4, label="pen, 2 mm deep, from left to right")
    label = "force asked of the motors, 0.2 N a mm"
    for i in range(0, len(x), max(1, len(x) // 60)):
        push = [5e-3 * run[f"tau_ref_nm.{n}"][i] / CAPSTAN_M * 1e3 for n in (0, 2)]
        if math.hypot(*push) < 0.1:
            continue
        axes.plot([x[i], x[i] + push[0]], [z[i], z[i] + push[1]], color=RED, lw=0.8, label=label)
        label = None
    axes.set_aspect("equal")
    axes.set(xlabel="x, mm", ylabel="z, mm", xlim=(11.5, 25), ylim=(13, 23))
    axes.legend(fontsize=8, frameon=False, loc="lower left")


def over_a_sphere(forces, tilts, run, stiffness, radius):
    times = [1e3 * t for t in run["time_s"]]
    for n, (name, colour) in enumerate(zip("xyz", (BLUE, GREY, RED), strict=True)):
        pen = [run[f"pen_{name}_m"][i] for i in range(len(times))]
        exact = []
        for i, own in enumerate(pen):
            far = math.hypot(*(run[f"pen_{other}_m"][i] for other in "xyz"))
            exact.append(stiffness * (radius - far) * own / far)
        forces.plot(times, [v / CAPSTAN_M for v in run[f"tau_ref_nm.{n}"]], color=colour, lw=1.2,
                    label=name)
        forces.plot(times, exact, color="black", lw=0.6, ls=":")
    forces.set(ylabel="force, N", xlim=(0, times[-1]))
    forces.set_title("sphere; dotted: of its own surface", fontsize=9)
    forces.legend(fontsize=8, frameon=False, ncols=3, loc="lower right")
    tilts.plot(times, [math.degrees(a) for a in run["plane_tilt_rad"]], color=BLUE, lw=0.9)
    tilts.set(xlabel="time, ms", ylabel="off the tangent, degrees", xlim=(0, times[-1]))


def main():
    cube, sphere = (columns(path, NAMES) for path in files(2, __doc__))
    figure, panels = plt.subplot_mosaic("ab\nac", figsize=(10, 4.4), layout="constrained")
    over_the_edge(panels["a"], cube, 1e3 * plane_of("stylus_cube")["cube_m"][3])
    world = plane_of("stylus_sphere")
    over_a_sphere(panels["b"], panels["c"], sphere, world["stiffness_n_m"], world["sphere_m"][3])
    save(figure, "stylus")


if __name__ == "__main__":
    main()
