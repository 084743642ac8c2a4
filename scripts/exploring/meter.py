# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Progress of a sweep on a terminal: points done, rate, time left. Silent elsewhere."""

import sys
import threading
import time

from reporting.progress import clock_text

from exploring import chunks


class Meter:
    """Counts the points of finished chunks and looks into those under way."""

    def __init__(self, folder, total, what="points", stream=None):
        self.folder, self.total, self.what = folder, total, what
        self.stream = stream or sys.stderr
        self.done = self.skipped = 0
        self.began = time.monotonic()
        self.stopped = threading.Event()
        self.thread = None

    def __enter__(self):
        if self.stream.isatty():
            self.thread = threading.Thread(target=self._redraw, daemon=True)
            self.thread.start()
        return self

    def __exit__(self, *_):
        self.stopped.set()
        if self.thread:
            self.thread.join()
            self.stream.write("\r\x1b[K")
            self.stream.flush()

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

    def _redraw(self):
        while not self.stopped.wait(0.5):
            self.stream.write("\r" + self.line() + "\x1b[K")
            self.stream.flush()
