# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The demo's page while its runs go on: each run is drawn when it ends, and the page is written
again. Documentation: docs/figures.md
"""

import sys
import threading
import time

from outputs import write_whole
from reporting import demo_page


class Growing:
    """Thread-safe. `pool` is a started ProcessPoolExecutor, `shown` the names of runs with a place
    on the page, `page_of(drawn)` its text from {name: Drawn}."""

    EVERY_S = 5  # a page has megabytes

    def __init__(self, pool, shown, path, page_of):
        self.pool, self.shown, self.path, self.page_of = pool, set(shown), path, page_of
        self.drawings = {}
        self.written = None
        self.lock = threading.Lock()

    def take(self, run):
        """A run has ended."""
        if not run.ran or run.job.name not in self.shown:
            return
        drawing = self.pool.submit(demo_page.draw, run)
        with self.lock:
            self.drawings[run.job.name] = drawing
        drawing.add_done_callback(self._write)

    def _write(self, _):
        with self.lock:
            now = time.monotonic()
            if self.written is not None and now - self.written < self.EVERY_S:
                return
            ready = {n: d for n, d in self.drawings.items() if d.done() and not d.cancelled()}
            drawn = {n: d.result() for n, d in ready.items() if d.exception() is None}
            if not any(one.card for one in drawn.values()):
                return
            if self.written is None:
                print(f"demo: the first of the report: {self.path}", file=sys.stderr, flush=True)
            self.written = now
            write_whole(self.path, self.page_of(drawn))

    def result(self):
        """{name: Drawn} of all, once they are drawn; the page is not written any more."""
        found = {name: drawing.result() for name, drawing in self.drawings.items()}
        with self.lock:
            self.written = float("inf")
        return found
