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

from docs_picture import BLUE, RED, columns, files, plt, save

FROM_MS, TO_MS = 250, 285


def over_time(axes, begin, column, scale, suffix=""):
    for name, colour, width, label in (
        (f"{begin[1]}{suffix}.csv", RED, 1.0, "1 kHz"),
        (f"{begin[0]}{suffix}.csv", BLUE, 0.9, "40 kHz"),
    ):
        rows = columns(name, ("time_s", column))
        axes.step([1e3 * t for t in rows["time_s"]], [scale * v for v in rows[column]],
                  where="post", color=colour, lw=width, label=label)
    axes.set(xlim=(FROM_MS, TO_MS))


def diagram(axes, path):
    names = ("place", "force_n", "least_n", "most_n", "helmholtz")
    place, force, least, most, helmholtz = columns(path, names).values()
    for is_one, colour, size, label in (
        (1, BLUE, 14, "one slip a period"), (0, "#cccccc", 5, "something else")):
        at = [i for i, h in enumerate(helmholtz) if h == is_one]
        axes.scatter([place[i] for i in at], [force[i] for i in at], s=size, color=colour,
                     label=label, lw=0)
    line = sorted(set(zip(place, least, most)))
    axes.plot([x[0] for x in line], [x[1] for x in line], color="k", lw=1, ls="--",
              label="Schelleng's limits")
    axes.plot([x[0] for x in line], [x[2] for x in line], color="k", lw=1, ls="--")
    axes.set(xscale="log", yscale="log", ylim=(0.045, 7), xlabel="place of the bow, from the bridge",
             ylabel="force of the bow, N", title="bow at 0.2 m/s")
    axes.set_xticks([0.05, 0.07, 0.1, 0.14, 0.2], ["0.05", "0.07", "0.1", "0.14", "0.2"])
    axes.set_xticks([], minor=True)
    axes.set_yticks([0.05, 0.1, 0.2, 0.5, 1, 2, 4], ["0.05", "0.1", "0.2", "0.5", "1", "2", "4"])
    axes.set_yticks([], minor=True)
    axes.legend(fontsize=8, loc="lower left", framealpha=0.95)


def main():
    *begin, points = files(3, __doc__)
    figure = plt.figure(figsize=(9.5, 4.2))
    grid = figure.add_gridspec(2, 2, width_ratios=(1.35, 1))
    torque, heard = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[1, 0])
    over_time(torque, begin, "tau_ref_nm", 1e3)
    torque.set(ylabel="torque, mNm", title="1.8 N, 0.2 m/s, 0.1 of the string from the bridge")
    torque.set_ylim(-175, 45)
    torque.legend(fontsize=8, loc="upper right", ncols=2, frameon=False)
    over_time(heard, begin, "heard", 1, "_states")
    heard.set(ylabel="at the bridge, m/s", xlabel="time, ms")
    diagram(figure.add_subplot(grid[:, 1]), points)
    for axes in (torque, heard):
        axes.grid(alpha=0.3)
        axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    save(figure, "bowed_string")


if __name__ == "__main__":
    main()
