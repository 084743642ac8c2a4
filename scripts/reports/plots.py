# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The look of every picture: one colour per source of a curve, small enough for a phone.

RTL is a broad pale line, and the quad reference is a thin dark line over it, so both are visible
where they agree. Documentation: docs/figures.md
"""

import argparse
import base64
import io
import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import interrupts
import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from outputs import write_whole

# Near Okabe and Ito's colours: told apart by colour-blind eyes too.
COLOURS = {
    "rtl": "#6db8ec",
    "quad": "#b23a00",
    "ideal": "#1d2329",
    "motor": "#008a64",
    "hand": "#b04a8b",
    "reference": "#8c96a0",
    "fault": "#d55e00",
    "paper": "#7d4bb5",
}
STYLES = {
    "rtl": {"linewidth": 3.0, "solid_capstyle": "round"},
    "quad": {"linewidth": 0.8, "zorder": 3},
    "ideal": {"linewidth": 1.0, "linestyle": (0, (5, 6)), "zorder": 4},
    "motor": {"linewidth": 1.0, "zorder": 1.5},
    "hand": {"linewidth": 1.1},
    "reference": {"linewidth": 1.4},
    "paper": {"linewidth": 1.1, "linestyle": ":"},
}
LABELS = {"rtl": "RTL", "quad": "quad reference", "ideal": "ideal", "motor": "motor"}
POINTS = 700  # a line is thinned to about twice this many

matplotlib.rcParams.update(
    {
        "font.size": 9,
        "axes.titlesize": 9.5,
        "axes.titlelocation": "left",
        "axes.labelsize": 8.5,
        "axes.grid": True,
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.edgecolor": "#8c96a0",
        "axes.formatter.useoffset": False,
        "axes.xmargin": 0.01,
        "grid.color": "#e3e7eb",
        "grid.linewidth": 0.7,
        "legend.fontsize": 8,
        "legend.frameon": False,
        "xtick.labelsize": 8,
        "ytick.labelsize": 8,
        "lines.dash_capstyle": "butt",
        "svg.fonttype": "none",
        "svg.hashsalt": "feltgate",
    }
)


@dataclass
class Picture:
    """A drawn picture: SVG for pages, PNG for those who cannot show it."""

    name: str
    caption: str
    svg: str
    png: bytes = b""

    def data_uri(self):
        return "data:image/svg+xml;base64," + base64.b64encode(self.svg.encode()).decode()

    def write(self, folder):
        """Writes NAME.svg, and NAME.png where it was drawn; returns the names."""
        folder = Path(folder)
        write_whole(folder / f"{self.name}.svg", self.svg)
        if not self.png:
            return [f"{self.name}.svg"]
        write_whole(folder / f"{self.name}.png", self.png)
        return [f"{self.name}.svg", f"{self.name}.png"]


def figure(size, title=""):
    """An empty figure of this size in inches."""
    made = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(made)
    made.get_layout_engine().set(h_pad=0.04, w_pad=0.04)
    if title:
        made.suptitle(title, fontsize=10, fontweight="bold", x=0.01, ha="left")
    return made


def stacked(title, heights, apart=0, width=5.4):
    """A figure and its axes one below the other; `heights` in inches. All share the x axis but the
    last `apart`."""
    made = figure((width, sum(heights) + 0.45), title)
    axes = made.subplots(len(heights), 1, squeeze=False, gridspec_kw={"height_ratios": heights})[
        :, 0
    ]
    shared = axes[: len(heights) - apart]
    for axis in shared[1:]:
        axis.sharex(shared[0])
    for axis in shared[:-1]:
        axis.tick_params(labelbottom=False)
    return made, list(axes)


def finish(figure, name, caption="", png=False):
    svg = io.StringIO()
    figure.savefig(svg, format="svg", metadata={"Date": None, "Creator": "feltgate"})
    # The prologue is of no use inside a page; coordinates need no six decimals.
    text = svg.getvalue()[svg.getvalue().index("<svg") :]
    text = re.sub(r' d="[^"]*"', lambda d: re.sub(r"(\.\d\d)\d+", r"\1", d[0]), text)
    picture = Picture(name, caption, text)
    if png:
        raster = io.BytesIO()
        figure.savefig(raster, format="png", dpi=160)
        picture.png = raster.getvalue()
    return picture


def thinned(x, y, points=POINTS):
    """Only the smallest and largest value of each of `points` slices of x: peaks stay."""
    if len(x) <= 2 * points:
        return x, y
    edges = np.linspace(0, len(x), points + 1).astype(int)
    keep = {0, len(x) - 1}
    for low, high in zip(edges[:-1], edges[1:], strict=True):
        part = y[low:high]
        keep.add(low + int(part.argmin()))
        keep.add(low + int(part.argmax()))
    index = np.array(sorted(keep))
    return x[index], y[index]


def draw(axes, x, y, kind, label=None, **more):
    """A line in its kind's colour. label None: the kind's own; "": none."""
    text = LABELS.get(kind, kind) if label is None else label
    x, y = thinned(np.asarray(x), np.asarray(y))
    style = {"color": COLOURS[kind], **STYLES[kind], **more}
    return axes.plot(x, y, label=text or "_nolegend_", **style)


def legend(axes, columns=None):
    """Above the axes, where no data can be."""
    handles, labels = axes.get_legend_handles_labels()
    if not handles:
        return
    axes.legend(
        handles,
        labels,
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=columns or min(4, len(labels)),
        borderaxespad=0.1,
        handlelength=2.0,
        columnspacing=1.0,
        handletextpad=0.5,
    )


def at_least(axes, span):
    """Opens the y axis to `span`, so that noise of one bit does not fill it."""
    low, high = axes.get_ylim()
    if high - low < span:
        middle = 0.5 * (low + high)
        axes.set_ylim(middle - span / 2, middle + span / 2)


def main(what, command, schemas, draw):
    """The exit code of a script that draws the JSON of feltgate COMMAND: draw(data, options), if it has one
    of these schemas; 2 and a line that names the file where it cannot be read, drawn or written."""
    parser = argparse.ArgumentParser(description=what.splitlines()[0])
    parser.add_argument("json", type=Path, help=f"what feltgate {command} --json wrote")
    parser.add_argument("to", type=Path, help="picture, or folder of pictures, to be written")
    options = parser.parse_args()
    interrupts.end_on_signals()
    try:
        data = json.loads(options.json.read_text(encoding="utf-8"))
        if data.get("schema") not in schemas:
            raise ValueError(f"schema is {data.get('schema')!r}, not {' or '.join(schemas)}")
        draw(data, options)
    except (OSError, ValueError, KeyError) as error:
        print(f"{Path(sys.argv[0]).stem}: {options.json}: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt as interrupt:
        return interrupts.tell(command, interrupt)
    return 0
