#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/NAME.svg: of the pantograph, the stylus and the gimbal, from the rows of their runs.
The functions below that have the name of a picture say which runs; without a word this says it too.
"""

import csv
from pathlib import Path

from docs_picture import BLUE, GREY, RED, columns, draw, np, plt, vectors

JOINTS = (("outer joint", BLUE), ("middle joint", GREY), ("inner joint", RED))


def gimbal(path):
    """The torques of three motors while a handle is turned once around, from the rows of the scene.

      feltgate run gimbal --engine twin --csv gimbal.csv --every 50
      scripts/pen_pictures.py gimbal gimbal.csv
    """
    run = columns(path)
    most_nm = 2 * vectors("scenes/gimbal")["parameters"]["stiffness"]
    times, turned = 1e3 * run["time_s"], np.degrees(run["theta_rad.0"])
    figure, (angle, torque) = plt.subplots(1, 2, figsize=(10, 3.6), layout="constrained")
    for n, (name, colour) in enumerate(JOINTS):
        angle.plot(times, np.degrees(run[f"theta_rad.{n}"]), color=colour, lw=1.3, label=name)
        torque.plot(turned, run[f"tau_ref_nm.{n}"], color=colour, lw=1.3)
    torque.plot(turned, -most_nm * np.sin(np.radians(turned) / 2), color="black", lw=0.8, ls=":")
    angle.set(xlabel="time, ms", ylabel="joint, degrees", xlim=(0, times[-1]))
    angle.legend(fontsize=8, frameon=False)
    torque.set(xlabel="outer joint, degrees", ylabel="torque asked for, Nm", xlim=(0, 360),
               xticks=range(0, 361, 60))
    return figure


def drop_of(path):
    """Times, angles between the cranks by restitution; lines of the test program are skipped."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = [line for line in file if line.startswith("time_s") or line[0].isdigit()]
    by = {}
    for row in csv.DictReader(lines):
        times, angles = by.setdefault(float(row["restitution"]), ([], []))
        times.append(1e3 * float(row["time_s"]))
        angles.append(float(row["between_deg"]))
    return by


def at(angle, length=1.0):
    """A vector in this direction."""
    return length * np.array((np.cos(angle), np.sin(angle)))


def workspace(axes, plant, torque):
    """Rings of equal angle between the cranks, three poses, and what the motors can push there."""
    length = plant["linkage"]["crank_1_m"]
    least, most = np.radians((plant["stops"]["least_deg"], plant["stops"]["most_deg"]))
    for angle in (least, np.radians(60), np.radians(120), most):
        radius = 2e3 * length * np.cos(angle / 2)
        style = "-" if angle in (least, most) else ":"
        axes.add_patch(plt.Circle((0, 0), radius, fill=False, color=GREY, ls=style))
        axes.text(*at(-0.6, radius), f"{np.degrees(angle):.0f}°",
                  color=GREY, fontsize=8, ha="center", va="center",
                  bbox={"fc": "w", "ec": "none", "pad": 0.5})
    for first, last, alpha in ((30, 150, 1.0), (-20, 60, 0.45), (110, 235, 0.45)):
        a, b = np.radians((first, last))
        ends = at(a, 1e3 * length), at(b, 1e3 * length)
        pen = sum(ends)
        for end, color in zip(ends, (BLUE, RED)):
            axes.plot([0, end[0]], [0, end[1]], color=color, lw=3, alpha=alpha)
            axes.plot([end[0], pen[0]], [end[1], pen[1]], color="k", lw=1.5, alpha=alpha)
        axes.plot(*pen, "o", color="k", ms=4, alpha=alpha)
        # Forces that both motors can make there: a parallelogram around the pen, 40 mm per N.
        across = length * np.sin(b - a)
        corners = [pen + 40 * (torque * (one * at(b) - five * at(a)) / across)
                   for one, five in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        axes.add_patch(plt.Polygon(corners, fc=BLUE, ec=BLUE, alpha=0.15 * alpha))
    axes.set(xlim=(-215, 215), ylim=(-130, 215), aspect="equal", xlabel="x, mm", ylabel="y, mm",
             title="pen between the stops; forces of 1 A, 40 mm per N")


def drop(axes, plant, table):
    for (restitution, (times, angles)), color in zip(table.items(), (GREY, BLUE, RED)):
        axes.plot(times, angles, color=color, lw=1.2, label=f"restitution {restitution:g}")
    for key in ("least_deg", "most_deg"):
        axes.axhline(plant["stops"][key], color="k", lw=0.8, ls="--")
    axes.set(xlabel="time, ms", ylabel="angle between the cranks, degrees",
             title="pulled outward by 1 N, without friction")
    axes.legend(fontsize=8, frameon=False, loc=(0.55, 0.72))
    axes.grid(alpha=0.3)


def pantograph(table):
    """Where the pen of the default pantograph can be and what its motors can push there, and a drop of
    its cranks against a stop, from the table that the test prints.

      build/testbench/axes/linkage_test "[.drop]" > drop.csv
      scripts/pen_pictures.py pantograph drop.csv
    """
    plant = vectors("devices/pantograph")
    ratio = plant["joint"]["drum_radius_m"] / plant["joint"]["pulley_radius_m"]
    # 1 A in each motor.
    torque = ratio * plant["motor"]["torque_constant_nm_a"]
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 4.2), layout="constrained")
    workspace(axes[0], plant, torque)
    drop(axes[1], plant, drop_of(table))
    return figure


def pen_of(path):
    """Times in s, heights in mm."""
    time_s, height_m = columns(path, ("time_s", "pen_y_m")).values()
    return time_s, 1e3 * height_m


def pantograph_wall(as_it_is, filtered):
    """The pen on a floor of 50 N/m at 1 kHz, without and with filters, from the rows of two runs.

      ./feltgate run pantograph_wall --engine twin --every 1000 --csv as_it_is.csv
      ./feltgate run pantograph_wall_filtered --engine twin --every 1000 --csv filtered.csv
      scripts/pen_pictures.py pantograph_wall as_it_is.csv filtered.csv
    """
    figure, axes = plt.subplots(figsize=(7.9, 2.9), layout="constrained")
    axes.axhline(110, color=GREY, lw=0.8, ls="--")
    axes.text(1.4, 110.2, "floor", color=GREY, ha="right")
    axes.plot(*pen_of(as_it_is), color=BLUE, lw=1.0, label="speed and force as they are")
    axes.plot(*pen_of(filtered), color=RED, lw=1.0, label="behind the filters")
    axes.annotate("0.5 N before, 0.6 N after", (0.41, 107.6), color=GREY)
    axes.axvline(0.4, color=GREY, lw=0.6, ls=":")
    axes.set(xlabel="time [s]", ylabel="pen [mm]", xlim=(0, 1.4))
    axes.legend(loc="lower left", frameon=False)
    return figure


def disc(axes, slow, x, y, radius):
    angles = 2 * np.pi * np.arange(201) / 200
    axes.plot(1e3 * (x + radius * np.cos(angles)), 1e3 * (y + radius * np.sin(angles)), color=GREY,
              lw=1)
    axes.plot(1e3 * slow["pen_x_m"], 1e3 * slow["pen_y_m"], color=BLUE, lw=1.4,
              label="pen, 2 mm deep")
    label = "planes sent, 50 a second"
    sides = np.array([-1, 1])
    for i in np.flatnonzero(slow["plane_step_n"] > 0):
        nx, ny = slow["plane_normal_x"][i], slow["plane_normal_y"][i]
        axes.plot(1e3 * (x + radius * nx - sides * 0.006 * ny),
                  1e3 * (y + radius * ny + sides * 0.006 * nx), color=RED, lw=1, label=label)
        label = None
    axes.set_aspect("equal")
    axes.set(xlabel="x, mm", ylabel="y, mm", xlim=(-36, 36), ylim=(104, 146))
    axes.legend(fontsize=8, frameon=False, loc="lower center")


def steps_of(axes, run, title, thinned):
    times, step = 1e3 * run["time_s"], run["plane_step_n"]
    axes.plot(times[::thinned], np.degrees(run["plane_tilt_rad"][::thinned]), color=BLUE, lw=0.9)
    axes.set_ylabel("off the tangent, degrees", color=BLUE)
    axes.set_title(title, fontsize=9)
    right = axes.twinx()
    right.vlines(times[step > 0], 0, 1e3 * step[step > 0], color=RED, lw=1)
    right.set_ylabel("force's step, mN", color=RED)
    right.set_ylim(bottom=0)
    axes.set_xlabel("time, ms")


def local_plane(slow, fast):
    """A disc rendered by its tangents at 50 Hz and 1 kHz, from the rows of the two scenes.

      feltgate run plane_circle_slow --engine twin --csv slow.csv --every 1
      feltgate run plane_circle --engine twin --csv fast.csv --every 1
      scripts/pen_pictures.py local_plane slow.csv fast.csv
    """
    slow, fast = columns(slow), columns(fast)
    figure, panels = plt.subplot_mosaic("ab\nac", figsize=(10, 4.4), layout="constrained")
    disc(panels["a"], slow, *vectors("scenes/plane_circle_slow")["plane"]["circle_m"])
    steps_of(panels["b"], slow, "50 Hz", 200)
    steps_of(panels["c"], fast, "1 kHz", 50)
    return figure


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


def stylus(cube, sphere):
    """A stylus over the edge of a cube and over a sphere, from the rows of the two scenes.

      feltgate run stylus_cube --engine twin --csv cube.csv --every 20
      feltgate run stylus_sphere --engine twin --csv sphere.csv --every 20
      scripts/pen_pictures.py stylus cube.csv sphere.csv
    """
    figure, panels = plt.subplot_mosaic("ab\nac", figsize=(10, 4.4), layout="constrained")
    half = 1e3 * vectors("scenes/stylus_cube")["plane"]["cube_m"][3]
    over_the_edge(panels["a"], columns(cube), half)
    world = vectors("scenes/stylus_sphere")["plane"]
    stiffness, radius = world["stiffness_n_m"], world["sphere_m"][3]
    over_a_sphere(panels["b"], panels["c"], columns(sphere), stiffness, radius)
    return figure


TEXTURE = ("pen_x_m", "pen_y_m", "height_m", "force_x_n", "force_y_n")


def texture_forces(axes, path):
    x, y, height, *force = columns(path, TEXTURE).values()
    axes.plot(1e3 * x, 1e3 * height, color=GREY, lw=1.4, label="surface")
    axes.axhline(80, color=GREY, lw=0.6, ls=":")
    axes.plot(1e3 * x, 1e3 * y, color=BLUE, lw=0.8, label="pen, 1 mm below black")
    axes.quiver(*(values[::4] for values in (1e3 * x, 1e3 * y, *force)), color=RED, angles="xy",
                scale_units="xy", scale=0.5, width=0.003, label="force, 1 N is 2 mm")
    axes.set(xlabel="x, mm", ylabel="y, mm", xlim=(-18, 18), ylim=(78, 87))
    axes.legend(fontsize=8, frameon=False, loc="upper center", ncols=3)


def firmness(axes, path):
    with open(path, encoding="utf-8") as table:
        rows = [line.split() for line in table]
    rows = [row for row in rows if len(row) == 4 and row[0][0].isdigit()]
    texel, _, split, normal = np.array(rows).astype(float).T
    axes.semilogx(texel, split, "o-", color=BLUE, label="depth split")
    axes.semilogx(texel, normal, "o-", color=RED, label="along the normal")
    axes.set(xlabel="texel, mm", ylabel="upright stiffness felt, share", ylim=(0, 1.15))
    axes.legend(fontsize=8, frameon=False, loc="center right")


def texture(way, table):
    """A row of an image, the forces on it, and how firm it is by texel.

      feltgate texture vectors/textures/ripples.png --depth 4mm --path way.csv
      feltgate texture vectors/textures/ripples.png --depth 1mm --table > table.txt
      scripts/pen_pictures.py texture way.csv table.txt
    """
    figure, panels = plt.subplot_mosaic("aab", figsize=(10, 3.6), layout="constrained")
    texture_forces(panels["a"], way)
    firmness(panels["b"], table)
    return figure


COLOURS = {"proxy": BLUE, "walk": RED, "simple": GREY}
STIFFNESS_N_PER_M = 50.0


def inside(axes, x, y, force_x, force_y):
    """The pen's way, the proxy's, and a force now and then; m and N."""
    axes.plot(1e3 * x, 1e3 * y, color="k", lw=0.8, label="pen, 2 mm deep")
    axes.plot(1e3 * (x + force_x / STIFFNESS_N_PER_M), 1e3 * (y + force_y / STIFFNESS_N_PER_M),
              color=COLOURS["proxy"], lw=1.5, label="proxy")
    some = slice(None, None, 25)
    axes.quiver(1e3 * x[some], 1e3 * y[some], force_x[some], force_y[some], color=COLOURS["walk"],
                width=0.004, scale=1.6, label="force, 0.1 N")
    axes.set_aspect("equal")
    axes.set(xlabel="x, mm", ylabel="y, mm")
    axes.margins(y=0.1)
    axes.legend(loc="center", bbox_to_anchor=(0.62, 0.5), fontsize=8)


def turning(axes, name, x, y, force_x, force_y):
    """The force's direction along the way."""
    way = np.cumsum(1e3 * np.hypot(np.diff(x, prepend=x[0]), np.diff(y, prepend=y[0])))
    direction = np.unwrap(np.degrees(np.arctan2(force_y, force_x)), period=360)
    axes.plot(way, direction, color=COLOURS[name], lw=1.2, label=name,
              ls="--" if name == "simple" else "-")


def shapes(proxy, walk, simple):
    """A pen that moves around inside a fish, the proxy and the force; and how the force's direction
    turns along the path, for the three laws, from paths that `feltgate shape` prints.

      for law in proxy walk simple; do
        ./feltgate shape vectors/shapes/fish.svg --radius 3mm --vertices 40 --law $law --path $law.csv
      done
      scripts/pen_pictures.py shapes proxy.csv walk.csv simple.csv
    """
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for path in (proxy, walk, simple):
        way, name = columns(path).values(), Path(path).stem
        if name == "proxy":
            inside(left, *way)
        turning(right, name, *way)
    right.set(xlim=(15, 60), ylim=(170, 330), xlabel="way of the pen, mm",
              ylabel="direction of the force, degrees")
    right.legend(fontsize=8)
    right.grid(alpha=0.3)
    return figure


if __name__ == "__main__":
    draw(__doc__, gimbal, pantograph, pantograph_wall, local_plane, stylus, texture, shapes)
