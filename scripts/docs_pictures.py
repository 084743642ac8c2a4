#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/NAME.svg from runs of the built programs in FELTGATE_BUILD, which it starts; the same bytes
for the same numbers. Each function below is the picture of its name.

  docs_pictures.py NAME...     of all: docs_pictures.py all
"""

import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

import numpy as np
from outputs import write_whole
from reports import plots, runs

SCENES = ("collision", "end_stops", "flywheel", "graded_membrane", "moved_detents", "pendulum",
          "scroll_wheel", "turn_switch")
BLUE, RED, GREEN, GREY = "#0072b2", "#b23a00", "#008a64", "#8c96a0"


def run(scene, *words, every=100):
    """Columns of a scene's run by the twin."""
    design = runs.design_of(scene)
    with tempfile.TemporaryDirectory() as folder:
        rows = Path(folder, "rows.csv")
        command = (runs.program(design), "run", scene, "--design", design, "--engine", "twin", "--quiet", "--every",
                   every, *words, "--csv", rows)
        done = subprocess.run([str(word) for word in command], cwd=runs.ROOT, check=False)
        if done.returncode not in (0, 1):
            sys.exit(done.returncode)
        return runs.read_table(rows)


def panels(layout, size, title=""):
    """A figure and its axes by letter."""
    figure = plots.figure(size, title)
    return figure, figure.subplot_mosaic(layout)


def lines(axes, x, curves, across="", up="", colours=(BLUE, RED, GREEN), **look):
    """Curves {label: y} over x; a label that begins with _ is not in the legend."""
    for (label, y), colour in zip(curves.items(), colours):
        axes.plot(*plots.thinned(np.asarray(x), np.asarray(y)), label=label, color=colour, **{"lw": 1.1} | look)
    axes.set(**{k: v for k, v in (("xlabel", across), ("ylabel", up)) if v})
    if axes.get_legend_handles_labels()[0]:
        axes.legend()


def path(axes, x, y, across, up, label="_", colour=BLUE, **look):
    """A way in a plane, to one scale; m, drawn in mm."""
    axes.plot(1e3 * np.asarray(x), 1e3 * np.asarray(y), color=colour, label=label, **{"lw": 1.2} | look)
    axes.set(xlabel=f"{across}, mm", ylabel=f"{up}, mm", aspect="equal")


def arrows(axes, x, y, force, newton_per_mm, label):
    axes.quiver(1e3 * x, 1e3 * y, *force, color=RED, angles="xy", scale_units="xy", scale=newton_per_mm,
                width=0.003, label=label)
    axes.legend()


def one_lever(scene):
    r = run(scene)
    figure, p = panels("ac;bc", (9.2, 3.8), runs.scene_file(scene)["title"])
    ms = 1e3 * r["time_s"]
    lines(p["a"], ms, {"_": r["theta_rad"]}, up="angle, rad")
    lines(p["b"], ms, {"motor": r["motor_torque_nm"], "law": r["tau_ref_nm"]}, "time, ms", "torque, Nm", (GREY, BLUE))
    p["c"].plot(r["theta_rad"], r["tau_ref_nm"], color=BLUE, lw=1)
    p["c"].set(xlabel="angle, rad", ylabel="law's torque, Nm")
    return figure


def coupled_levers():
    figure, p = panels("ab", (8.6, 3.2), "Felt of a spring of 1 Nm/rad; two levers pushed apart, border 12.4 Nm/rad")
    for words, label, colour in ((("--set", "share=0"), "position to position", BLUE), ((), "observer", RED)):
        r = run("coupled_levers", *words, every=200)
        lines(p["a"], r["theta_rad.0"], {label: -r["tau_ref_nm.0"]}, "led lever, rad", "felt, Nm", (colour,))
    for stiffness, colour in ((14, RED), (11, BLUE)):
        r = run("coupled_levers_free", "--set", f"stiffness={stiffness}", every=200)
        apart = 1e3 * (r["theta_rad.0"] - r["theta_rad.1"])
        lines(p["b"], 1e3 * r["time_s"], {f"{stiffness} Nm/rad": apart}, "time, ms", "apart, mrad", (colour,))
    return figure


def free_lever():
    figure, p = panels("a", (5.2, 3.4), "Half a swing at 2 Hz; damper of 0.03 Nm s/rad")
    for scene, label, colour in (("damped_lever", "damped", BLUE), ("free_lever", "free", GREY)):
        r = run(scene, every=500)
        on = r["time_s"] > 0.02
        lines(p["a"], r["omega_rad_s"][on], {label: 1e3 * r["hand_torque_nm"][on]}, "speed, rad/s", "hand, mNm", (colour,))
    return figure


def drums():
    r = run("drums", every=1200)
    figure, p = panels("a;b", (8, 4), "A stick of 0.3 m over three drums")
    lines(p["a"], r["time_s"], {"_": 300 * np.sin(r["theta_rad"])}, up="tip over the skins, mm")
    p["a"].set_ylim(-15, 65)
    lines(p["b"], r["time_s"], {"_": 1e3 * r["tau_ref_nm"]}, "time, s", "torque, mNm")
    return figure


FIELDS = ("hardness: a spring", "damping: on the way in", "giving way at 0.1 Nm", "viscosity",
          "spring to an anchor", "constant", "friction: sticks, slips", "vibration, 200 Hz")


def material_fields():
    r, scene = run("material_fields", every=20), runs.scene_file("material_fields")
    begins = [0.0] + [event["at_s"] for event in scene["event"]] + [scene["duration_s"]]
    depth, torque = 1e3 * (r["theta_rad"] - scene["parameters"]["face"]), 1e3 * r["tau_ref_nm"]
    figure, p = panels("abcd;efgh", (10, 5), "Each field of a material alone: torque in mNm over depth in mrad")
    for axes, title, begin, end in zip(p.values(), FIELDS, begins, begins[1:]):
        rows = np.flatnonzero((begin <= r["time_s"]) & (r["time_s"] < end))
        deepest = rows[depth[rows].argmax()]
        for label, part, colour in (("in", rows[rows <= deepest], BLUE), ("out", rows[rows > deepest], RED)):
            lines(axes, depth[part], {label: torque[part]}, colours=(colour,))
        axes.set(title=title, xlim=(-25, 65), ylim=(1.1 * min(torque), 1.1 * max(torque)))
    return figure


def material_stick_slip():
    r = run("material_stick_slip", every=50)
    ms = 1e3 * r["time_s"]
    figure, p = panels("a;b", (7, 4.4), "A lever in friction of 200 mNm static, 150 dynamic, pulled by a spring")
    lines(p["a"], ms, {"friction": -1e3 * r["tau_ref_nm"], "hand's pull": 1e3 * r["hand_torque_nm"]}, up="torque, mNm")
    wanted = 4 * np.maximum(r["time_s"] - 0.01, 0)
    lines(p["b"], ms, {"lever": r["theta_rad"], "where the hand wants it": wanted}, "time, ms", "angle, rad", (BLUE, GREY))
    return figure


def bowed_string():
    figure, p = panels("a", (8, 3), "Bow of 1.8 N and 0.2 m/s, 0.1 of the string from the bridge; law at 40 kHz")
    r = run("bowed_string", every=25)
    on = (r["time_s"] > 0.25) & (r["time_s"] < 0.285)
    lines(p["a"], 1e3 * r["time_s"][on], {"_": 1e3 * r["tau_ref_nm"][on]}, "time, ms", "torque, mNm")
    return figure


def gimbal():
    r = run("gimbal", every=50)
    turned = np.degrees(r["theta_rad.0"])
    figure, p = panels("ab", (10, 3.6), "A handle turned once around")
    for n, (joint, colour) in enumerate((("outer joint", BLUE), ("middle joint", GREY), ("inner joint", RED))):
        lines(p["a"], 1e3 * r["time_s"], {joint: np.degrees(r[f"theta_rad.{n}"])}, "time, ms", "joint, degrees", (colour,))
        lines(p["b"], turned, {"_": r[f"tau_ref_nm.{n}"]}, "outer joint, degrees", "torque asked for, Nm", (colour,))
    half = np.radians(turned) / 2
    closed = -2 * runs.scene_file("gimbal")["parameters"]["stiffness"] * np.sin(half) * np.sign(np.cos(half))
    lines(p["b"], turned, {"closed form": closed}, colours=("black",), ls=":")
    return figure


def pantograph_wall():
    figure, p = panels("a", (7.9, 2.9), "The pen on a floor of 50 N/m at 110 mm, at 1 kHz; 0.5 N, after 0.4 s 0.6 N")
    for scene, label in (("pantograph_wall", "as it is"), ("pantograph_wall_filtered", "behind the filters")):
        r = run(scene, every=1000)
        colour = RED if "filtered" in scene else BLUE
        lines(p["a"], r["time_s"], {label: 1e3 * r["pen_y_m"]}, "time, s", "pen, mm", (colour,))
    return figure


def local_plane():
    figure, p = panels("ab;ac", (10, 4.4), "A disc rendered by its tangents")
    for letter, scene, rate in (("b", "plane_circle_slow", "50 Hz"), ("c", "plane_circle", "1 kHz")):
        r = run(scene, every=1)
        new = r["plane_step_n"] > 0
        axes, right = p[letter], p[letter].twinx()
        lines(axes, 1e3 * r["time_s"], {"_": np.degrees(r["plane_tilt_rad"])}, "time, ms", "off the tangent, degrees")
        right.vlines(1e3 * r["time_s"][new], 0, 1e3 * r["plane_step_n"][new], color=RED, lw=1)
        right.set_ylabel("force's step, mN", color=RED)
        axes.set_title(rate)
        if letter == "b":
            x, y, radius = runs.scene_file(scene)["plane"]["circle_m"]
            turn = np.linspace(0, 2 * np.pi, 200)
            path(p["a"], x + radius * np.cos(turn), y + radius * np.sin(turn), "x", "y", colour=GREY)
            path(p["a"], r["pen_x_m"][::100], r["pen_y_m"][::100], "x", "y", "pen, 2 mm deep")
            for nx, ny in zip(r["plane_normal_x"][new], r["plane_normal_y"][new]):
                side = 0.006 * np.array((-1, 1))
                path(p["a"], x + radius * nx - side * ny, y + radius * ny + side * nx, "x", "y", colour=RED, lw=0.9)
            p["a"].legend()
            p["a"].set(xlim=(-36, 36), ylim=(104, 146))
    return figure


def stylus():
    capstan_m = runs.read_toml(runs.ROOT / "vectors/devices/stylus.toml")["lever"]["radius_m"]
    figure, p = panels("ab;ac", (10, 4.4), "Over the edge of a cube, and over a sphere")
    cube = run("stylus_cube", every=20)
    half = runs.scene_file("stylus_cube")["plane"]["cube_m"][3]
    path(p["a"], half * np.array((-1, 1, 1)), half * np.array((1, 1, -1)), "x", "z", "cube", GREY)
    path(p["a"], cube["pen_x_m"], cube["pen_z_m"], "x", "z", "pen, 2 mm deep")
    some = slice(None, None, len(cube["time_s"]) // 60)
    force = [cube[f"tau_ref_nm.{n}"][some] / capstan_m for n in (0, 2)]
    arrows(p["a"], cube["pen_x_m"][some], cube["pen_z_m"][some], force, 0.2, "force, 0.2 N a mm")
    p["a"].set(xlim=(11.5, 25), ylim=(13, 23))
    r = run("stylus_sphere", every=20)
    forces = {axis: r[f"tau_ref_nm.{n}"] / capstan_m for n, axis in enumerate("xyz")}
    lines(p["b"], 1e3 * r["time_s"], forces, up="force, N")
    lines(p["c"], 1e3 * r["time_s"], {"_": np.degrees(r["plane_tilt_rad"])}, "time, ms", "off the tangent, degrees")
    return figure


def texture():
    figure, p = panels("a", (7.9, 3.4), "A pen drawn over a row of an image, a sine of 4 and 16 mm, 1 mm below black")
    surface = np.linspace(-0.018, 0.002, 200)
    path(p["a"], surface, 0.082 - 0.002 * np.sin(2 * np.pi * surface / 0.016), "x", "y", "surface", GREY)
    r = run("texture", every=2000)
    x, y = r["pen_x_m"], r["pen_y_m"]
    path(p["a"], x, y, "x", "y", "pen")
    # Both motors at 0 0, links of 0.1 m: each crank's torque is 0.1 m (cos F_y - sin F_x).
    angles = np.arctan2(y, x) + np.arccos(np.hypot(x, y) / 0.2) * np.array([[-1], [1]])
    turned = 0.1 * np.stack((-np.sin(angles), np.cos(angles)), -1).swapaxes(0, 1)
    torques = np.stack((r["tau_ref_nm.0"], r["tau_ref_nm.1"]), -1)
    force = np.linalg.solve(turned, torques[..., None])[..., 0].T
    arrows(p["a"], x, y, force, 0.5, "force, 0.5 N a mm")
    return figure


PICTURES = {f.__name__: f for f in (coupled_levers, free_lever, drums, material_fields, material_stick_slip,
            bowed_string, gimbal, pantograph_wall, local_plane, stylus, texture)}
PICTURES |= {scene: partial(one_lever, scene) for scene in SCENES}


def main():
    names = PICTURES if sys.argv[1:] == ["all"] else sys.argv[1:]
    if not names or set(names) - PICTURES.keys():
        print(__doc__, "pictures:", *PICTURES)
        return 2
    for name in names:
        write_whole(runs.ROOT / f"docs/images/{name}.svg", plots.finish(PICTURES[name](), name).svg)
    return 0


if __name__ == "__main__":
    sys.exit(main())
