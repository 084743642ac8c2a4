#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Draws docs/images/bowed_string.svg: the string at 40 kHz and at 1 kHz, and the forces that play it.

  ./feltgate run bowed_string --engine twin --csv fast.csv --every 25 --states fast_states.csv
  sed 's/^rate = 40 kHz/rate = 1 kHz/' rtl/laws/bowed_string.law > slow.law
  sed 's/"bowed_string"/"slow.law"/; /^.\[expect/,$d' vectors/scenes/bowed_string.toml > slow.toml
  ./feltgate run slow.toml --engine twin --csv slow.csv --every 25 --states slow_states.csv
  build/testbench/sim/bowed_string/bowed_string_test "[.diagram]" | grep , > diagram.csv
  scripts/bowed_string_picture.py fast slow diagram.csv
"""

from docs_picture import BLUE, RED, columns, draw, np, plt

FROM_MS, TO_MS = 250, 285


def over_time(axes, fast, slow, column, scale, suffix=""):
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


def picture(fast, slow, points):
    figure = plt.figure(figsize=(9.5, 4.2))
    grid = figure.add_gridspec(2, 2, width_ratios=(1.35, 1))
    torque, heard = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[1, 0])
    over_time(torque, fast, slow, "tau_ref_nm", 1e3)
    torque.set(ylabel="torque, mNm", title="1.8 N, 0.2 m/s, 0.1 of the string from the bridge")
    torque.set_ylim(-175, 45)
    torque.legend(fontsize=8, loc="upper right", ncols=2, frameon=False)
    over_time(heard, fast, slow, "heard", 1, "_states")
    heard.set(ylabel="at the bridge, m/s", xlabel="time, ms")
    diagram(figure.add_subplot(grid[:, 1]), points)
    figure.tight_layout()
    return figure


if __name__ == "__main__":
    draw(__doc__, bowed_string=picture)
