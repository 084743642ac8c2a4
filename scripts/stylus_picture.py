#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/stylus.svg: a stylus over the edge of a cube and over a sphere, from the rows
of the two scenes.

  feltgate run stylus_cube --engine twin --csv cube.csv --every 20
  feltgate run stylus_sphere --engine twin --csv sphere.csv --every 20
  scripts/stylus_picture.py cube.csv sphere.csv
"""

from docs_picture import BLUE, GREY, RED, columns, draw, np, plt, vectors

CAPSTAN_M = vectors("devices/stylus")["lever"]["radius_m"]


def over_the_edge(axes, run, half):
    axes.plot([-half, half, half, -half, -half], [half, half, -half, -half, half], color=GREY, lw=1)
    x, z = 1e3 * run["pen_x_m"], 1e3 * run["pen_z_m"]
    axes.plot(x, z, color=BLUE, lw=1.4, label="pen, 2 mm deep, from left to right")
    label = "force asked of the motors, 0.2 N a mm"
    for i in range(0, len(x), max(1, len(x) // 60)):
        push = [5e-3 * run[f"tau_ref_nm.{n}"][i] / CAPSTAN_M * 1e3 for n in (0, 2)]
        if np.hypot(*push) < 0.1:
            continue
        axes.plot([x[i], x[i] + push[0]], [z[i], z[i] + push[1]], color=RED, lw=0.8, label=label)
        label = None
    axes.set_aspect("equal")
    axes.set(xlabel="x, mm", ylabel="z, mm", xlim=(11.5, 25), ylim=(13, 23))
    axes.legend(fontsize=8, frameon=False, loc="lower left")


def over_a_sphere(forces, tilts, run, stiffness, radius):
    times = 1e3 * run["time_s"]
    pen = np.array([run[f"pen_{name}_m"] for name in "xyz"])
    far = np.linalg.norm(pen, axis=0)
    for n, (name, colour) in enumerate(zip("xyz", (BLUE, GREY, RED), strict=True)):
        forces.plot(times, run[f"tau_ref_nm.{n}"] / CAPSTAN_M, color=colour, lw=1.2, label=name)
        forces.plot(times, stiffness * (radius - far) * pen[n] / far, color="black", lw=0.6, ls=":")
    forces.set(ylabel="force, N", xlim=(0, times[-1]))
    forces.set_title("sphere; dotted: of its own surface", fontsize=9)
    forces.legend(fontsize=8, frameon=False, ncols=3, loc="lower right")
    tilts.plot(times, np.degrees(run["plane_tilt_rad"]), color=BLUE, lw=0.9)
    tilts.set(xlabel="time, ms", ylabel="off the tangent, degrees", xlim=(0, times[-1]))


def picture(cube, sphere):
    figure, panels = plt.subplot_mosaic("ab\nac", figsize=(10, 4.4), layout="constrained")
    half = 1e3 * vectors("scenes/stylus_cube")["plane"]["cube_m"][3]
    over_the_edge(panels["a"], columns(cube), half)
    world = vectors("scenes/stylus_sphere")["plane"]
    stiffness, radius = world["stiffness_n_m"], world["sphere_m"][3]
    over_a_sphere(panels["b"], panels["c"], columns(sphere), stiffness, radius)
    return figure


if __name__ == "__main__":
    draw(__doc__, stylus=picture)
