#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/NAME.svg: scenes with one lever or two, a drum's stick and a bowed string, from the
rows of their runs. The functions below that have the name of a picture say which runs; without a word
this says it too. For the scenes of SCENES:

  feltgate run end_stops --engine twin --csv end_stops.csv --every 100
  scripts/lever_pictures.py end_stops end_stops.csv
"""

from functools import partial
from pathlib import Path

import drums_sound
from docs_picture import BLUE, GREY, RED, columns, draw, np, plt, vectors

SCENES = ("collision", "end_stops", "flywheel", "graded_membrane", "moved_detents", "pendulum",
          "scroll_wheel", "turn_switch")


def over_time(axes, run, title):
    times = 1e3 * run["time_s"]
    axes.plot(times, run["theta_rad"], color=GREY, lw=1.2, label="angle, rad")
    axes.set(xlabel="time, ms", ylabel="angle, rad", title=title)
    torque = axes.twinx()
    torque.plot(times, run["motor_torque_nm"], color=RED, lw=0.8, label="motor's torque, Nm")
    torque.plot(times, run["tau_ref_nm"], color=BLUE, lw=1.2, label="law's torque, Nm")
    torque.set(ylabel="torque, Nm")
    lines = axes.get_lines() + torque.get_lines()
    axes.legend(lines, [line.get_label() for line in lines], fontsize=8, frameon=False,
                loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=3)
    axes.grid(alpha=0.3)


def over_angle(axes, run):
    angle, torque = run["theta_rad"], run["tau_ref_nm"]
    axes.plot(angle, torque, color=BLUE, lw=1.0)
    last = len(angle) - 1
    for i in range((last + 1) // 12, last, (last + 1) // 12):
        to = min(i + (last + 1) // 60 + 1, last)
        if abs(angle[i] - angle[to]) >= 1e-3:
            axes.annotate("", (angle[to], torque[to]), (angle[i], torque[i]),
                          arrowprops={"arrowstyle": "->", "color": BLUE})
    axes.axhline(0, color=GREY, lw=0.6)
    axes.set(xlabel="angle, rad", ylabel="law's torque, Nm", title="torque against angle")
    axes.grid(alpha=0.3)


def one_lever(scene, path):
    """Angle and torque over time, and the torque against the angle."""
    run = columns(path)
    figure, axes = plt.subplots(1, 2, figsize=(9.2, 3.8), layout="constrained")
    over_time(axes[0], run, vectors(f"scenes/{scene}")["title"])
    over_angle(axes[1], run)
    return figure


def felt(axes, path, color, label):
    angle, torque = columns(path, ("theta_rad.0", "tau_ref_nm.0")).values()
    axes.plot(angle, -torque, color=color, lw=1.0, label=label)


def apart(axes, path, color, label):
    times, one, other = columns(path, ("time_s", "theta_rad.0", "theta_rad.1")).values()
    axes.plot(1e3 * times, 1e3 * (one - other), color=color, lw=0.9, label=label)


def coupled_levers(position, observer, below, above):
    """What is felt of a spring that the second lever meets, and two free levers after a push, below
    and above the border, from the rows of four runs.

      ./feltgate run coupled_levers --engine twin --every 200 --set share=0 --csv position.csv
      ./feltgate run coupled_levers --engine twin --every 200 --csv observer.csv
      ./feltgate run coupled_levers_free --engine twin --every 200 --set stiffness=11 --csv below.csv
      ./feltgate run coupled_levers_free --engine twin --every 200 --set stiffness=14 --csv above.csv
      scripts/lever_pictures.py coupled_levers position.csv observer.csv below.csv above.csv
    """
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.2), layout="constrained")
    left.plot([0, 0.3], [0, 0.3], color=GREY, lw=0.8, ls="--", label="the spring, 1 Nm/rad")
    felt(left, position, BLUE, "position to position, 4 Nm/rad")
    felt(left, observer, RED, "the observer's torque")
    left.set(xlabel="led lever [rad]", ylabel="felt [Nm]")
    left.legend(loc="upper left", frameon=False)
    apart(right, above, RED, "14 Nm/rad")
    apart(right, below, BLUE, "11 Nm/rad")
    right.set(xlabel="time [ms]", ylabel="apart [mrad]", title="pushed apart, border 12.4 Nm/rad")
    right.legend(loc="upper left", frameon=False)
    return figure


DESIGNS = {"lever": BLUE, "paper": RED}


def swing(axes, path, color, label):
    times, speed, torque = columns(path, ("time_s", "omega_rad_s", "hand_torque_nm")).values()
    rows = times > 0.02
    axes.plot(speed[rows], 1e3 * torque[rows], color=color, lw=1.0, label=label)


def felt_by_design(path):
    """{design: [(asked, rms, rms by formulas)]}, of the rows without friction of the plant."""
    found = {}
    for line in Path(path).read_text(encoding="utf-8").splitlines():
        cells = [cell.strip(" `") for cell in line.split("|")[1:-1]]
        if len(cells) == 9 and cells[0] in DESIGNS and float(cells[2]) == 0:
            found.setdefault(cells[0], []).append(tuple(float(cells[i]) for i in (1, 3, 4)))
    return found


def free_lever(free, lever, paper, table):
    """The hand's torque against the speed, free and damped, from the rows of three runs, and the felt
    damping over the damping asked for, from the test's table.

      ./feltgate run free_lever --engine twin --every 500 --csv free.csv
      ./feltgate run damped_lever --engine twin --every 500 --csv lever.csv
      ./feltgate run damped_lever --design paper --engine twin --every 500 --csv paper.csv
      FELTGATE_SHOW=1 build/testbench/sim/free_lever_test > table.md
      scripts/lever_pictures.py free_lever free.csv lever.csv paper.csv table.md
    """
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4), layout="constrained")
    swing(left, paper, RED, "damper of 0.03 Nm s/rad, paper")
    swing(left, lever, BLUE, "the same, lever")
    swing(left, free, GREY, "free, lever")
    left.set(xlabel="speed [rad/s]", ylabel="the hand's torque [mNm]", title="half a swing at 2 Hz")
    left.legend(loc="lower right", frameon=False)
    for design, rows in felt_by_design(table).items():
        asked, bits, formulas = zip(*rows, strict=True)
        right.plot(asked, formulas, color=DESIGNS[design], lw=1.0, label=f"{design}, by formulas")
        right.plot(asked, bits, "o", color=DESIGNS[design], ms=4, label=f"{design}, by bits")
    right.set(xlabel="damper asked for [mNm s/rad]", ylabel="felt, rms [mNm]", ylim=(0, None))
    right.legend(loc="upper left", frameon=False)
    for axes in (left, right):
        axes.grid(alpha=0.3)
    return figure


STICK_M = 0.3


def drums(rows, hits):
    """The stick over the drums with the reported hits, from a run.

      ./feltgate run drums --engine twin --csv drums.csv --every 1200 --events hits.txt
      scripts/lever_pictures.py drums drums.csv hits.txt
    """
    time_s, theta_rad, torque_nm = columns(rows, ("time_s", "theta_rad", "tau_ref_nm")).values()
    figure, (tip, torque) = plt.subplots(2, 1, figsize=(8, 4), sharex=True)
    tip.plot(time_s, 1e3 * STICK_M * np.sin(theta_rad), color="k", lw=1)
    tip.axhline(0, color=GREY, lw=0.8)
    tip.fill_between(time_s, -15, 0, color=GREY, alpha=0.15, lw=0)
    for at_s, drum, speed, place in drums_sound.read_hits(hits):
        tip.plot(at_s, 0, "o", color=RED, ms=3 + 4 * speed)
        tip.annotate(f"drum {drum}\n{speed:.2f} m/s\nplace {place:.2f}", (at_s, 40), (-6, 0),
                     textcoords="offset points", fontsize=8, color=RED)
    tip.set(ylabel="tip over the skins, mm", ylim=(-15, 65))
    torque.plot(time_s, 1e3 * torque_nm, color=BLUE, lw=1)
    torque.set(ylabel="torque, mNm", xlabel="time, s")
    for axes in (tip, torque):
        axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    return figure


FIELDS = ("hardness: a spring", "damping: on the way in", "giving way at 0.1 Nm", "viscosity",
          "spring to an anchor", "constant", "friction: sticks, slips", "vibration, 200 Hz")


def material_fields(path):
    """Each field of a material alone, from the rows of the scene.

      feltgate run material_fields --engine twin --csv fields.csv --every 20
      scripts/lever_pictures.py material_fields fields.csv
    """
    run, at = columns(path), vectors("scenes/material_fields")
    # Each pass begins a moment before the event that chooses its field, the first with the scene.
    begins = [0.0] + [event["at_s"] for event in at["event"]] + [at["duration_s"]]
    depth, torque = 1e3 * (run["theta_rad"] - at["parameters"]["face"]), 1e3 * run["tau_ref_nm"]
    figure, panels = plt.subplots(2, 4, figsize=(10, 5), sharex=True, sharey=True,
                                  layout="constrained")
    for n, axes in enumerate(panels.flat):
        rows = np.flatnonzero((begins[n] <= run["time_s"]) & (run["time_s"] < begins[n + 1]))
        deepest = rows[run["theta_rad"][rows].argmax()]
        for color, label, part in ((BLUE, "in", rows[rows <= deepest]),
                                   (RED, "out", rows[rows > deepest])):
            axes.plot(depth[part], torque[part], color=color, lw=1.1, label=label)
        axes.axvline(0, color=GREY, lw=0.6)
        axes.axhline(0, color=GREY, lw=0.6)
        axes.set_title(FIELDS[n], fontsize=9)
        axes.grid(alpha=0.3)
        axes.set_xlim(-25, 65)
    panels[0][0].legend(fontsize=8, frameon=False)
    figure.supxlabel("depth behind the face, mrad", fontsize=9)
    figure.supylabel("law's torque, mNm", fontsize=9)
    return figure


def material_stick_slip(path):
    """A lever in a material's friction, pulled by a spring, from the rows of the scene.

      feltgate run material_stick_slip --engine twin --csv slip.csv --every 50
      scripts/lever_pictures.py material_stick_slip slip.csv
    """
    run = columns(path)
    times = 1e3 * run["time_s"]
    figure, (torque, place) = plt.subplots(2, 1, figsize=(7, 4.4), sharex=True,
                                           layout="constrained")
    torque.plot(times, -1e3 * run["tau_ref_nm"], color=BLUE, lw=1.1, label="friction")
    torque.plot(times, 1e3 * run["hand_torque_nm"], color=RED, lw=1.1, label="hand's pull")
    for level, name in ((200, "static"), (150, "dynamic")):
        torque.axhline(level, color=GREY, lw=0.7, ls="--")
        torque.text(2, level + 3, name, fontsize=8, color=GREY)
    torque.set(ylabel="torque, mNm")
    torque.legend(fontsize=8, frameon=False, loc="lower right")
    place.plot(times, run["theta_rad"], color=BLUE, lw=1.2, label="lever")
    place.plot(times, 4 * np.maximum(times - 10, 0) / 1e3, color=GREY, lw=0.9, ls="--",
               label="where the hand wants it: 4 rad/s")
    place.set(xlabel="time, ms", ylabel="angle, rad")
    place.legend(fontsize=8, frameon=False)
    for axes in (torque, place):
        axes.grid(alpha=0.3)
    return figure


FROM_MS, TO_MS = 250, 285


def strings_over_time(axes, fast, slow, column, scale, suffix=""):
    for name, colour, width, label in (
        (f"{slow}{suffix}.csv", RED, 1.0, "1 kHz"),
        (f"{fast}{suffix}.csv", BLUE, 0.9, "40 kHz"),
    ):
        times, values = columns(name, ("time_s", column)).values()
        axes.step(1e3 * times, scale * values, where="post", color=colour, lw=width, label=label)
    axes.set(xlim=(FROM_MS, TO_MS))
    axes.grid(alpha=0.3)
    axes.spines[["top", "right"]].set_visible(False)


def diagram(axes, path):
    names = ("place", "force_n", "least_n", "most_n", "helmholtz")
    place, force, least, most, helmholtz = columns(path, names).values()
    for is_one, colour, size, label in (
        (1, BLUE, 14, "one slip a period"), (0, "#cccccc", 5, "something else")):
        at = helmholtz == is_one
        axes.scatter(place[at], force[at], s=size, color=colour, label=label, lw=0)
    line = np.array(sorted(set(zip(place, least, most))))
    for limit, label in ((1, "Schelleng's limits"), (2, None)):
        axes.plot(line[:, 0], line[:, limit], color="k", lw=1, ls="--", label=label)
    axes.set(xscale="log", yscale="log", ylim=(0.045, 7), xlabel="place of the bow, from the bridge",
             ylabel="force of the bow, N", title="bow at 0.2 m/s")
    for axis, ticks in ((axes.xaxis, (0.05, 0.07, 0.1, 0.14, 0.2)),
                        (axes.yaxis, (0.05, 0.1, 0.2, 0.5, 1, 2, 4))):
        axis.set_ticks(ticks, [f"{tick:g}" for tick in ticks])
        axis.set_ticks([], minor=True)
    axes.legend(fontsize=8, loc="lower left", framealpha=0.95)


def bowed_string(fast, slow, points):
    r"""The string at 40 kHz and at 1 kHz, and the forces that play it.

      ./feltgate run bowed_string --engine twin --csv fast.csv --every 25 --states fast_states.csv
      sed 's/^rate = 40 kHz/rate = 1 kHz/' rtl/laws/bowed_string.law > slow.law
      sed 's/"bowed_string"/"slow.law"/; /^.\[expect/,$d' vectors/scenes/bowed_string.toml > slow.toml
      ./feltgate run slow.toml --engine twin --csv slow.csv --every 25 --states slow_states.csv
      build/testbench/sim/bowed_string_test "[.diagram]" | grep , > diagram.csv
      scripts/lever_pictures.py bowed_string fast slow diagram.csv
    """
    figure = plt.figure(figsize=(9.5, 4.2))
    grid = figure.add_gridspec(2, 2, width_ratios=(1.35, 1))
    torque, heard = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[1, 0])
    strings_over_time(torque, fast, slow, "tau_ref_nm", 1e3)
    torque.set(ylabel="torque, mNm", title="1.8 N, 0.2 m/s, 0.1 of the string from the bridge")
    torque.set_ylim(-175, 45)
    torque.legend(fontsize=8, loc="upper right", ncols=2, frameon=False)
    strings_over_time(heard, fast, slow, "heard", 1, "_states")
    heard.set(ylabel="at the bridge, m/s", xlabel="time, ms")
    diagram(figure.add_subplot(grid[:, 1]), points)
    figure.tight_layout()
    return figure


if __name__ == "__main__":
    draw(__doc__, coupled_levers, free_lever, drums, material_fields, material_stick_slip, bowed_string,
         **{scene: partial(one_lever, scene) for scene in SCENES})
