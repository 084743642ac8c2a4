# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Progress of a sweep on a terminal: points done, rate, time left. Silent elsewhere."""

import time

from reports.progress import RedrawnLine, clock_text

from exploration import chunks


class Meter(RedrawnLine):
    """Counts the points of finished chunks and looks into those under way."""

    def __init__(self, folder, total, what="points", stream=None):
        super().__init__(stream, every_s=0.5)
        self.folder, self.total, self.what = folder, total, what
        self.done = self.skipped = 0

    def skip(self, count):
        """Points that an earlier run has done: they count, but not for the rate."""
        self.skipped += count
        self.done += count

    def finish(self, count):
        self.done += count

    def line(self):
        done = min(self.total, self.done + chunks.points_under_way(self.folder))
        spent = max(1e-9, time.monotonic() - self.began)
        fresh = done - self.skipped
        left = clock_text(spent * (self.total - done) / fresh) if fresh > 0 else "?"
        share = 100 * done / max(1, self.total)
        return (
            f"explore: {share:3.0f} %  {done}/{self.total} {self.what}  "
            f"{60 * fresh / spent:.1f}/min  {clock_text(spent)}, {left} left"
        )
