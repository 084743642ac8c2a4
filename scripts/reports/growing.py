# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The demo's page while its runs go on: each run is drawn when it ends, and the page is written
again. Documentation: docs/figures.md
"""

import sys
import threading
import time

from outputs import write_whole
from reports import demo_page


class Growing:
    """Thread-safe. `pool` is a started ProcessPoolExecutor, `shown` the names of runs with a place
    on the page, `page_of(ended, drawn)` its text from {name: Run} and {name: pictures}."""

    EVERY_S = 5  # a page has megabytes

    def __init__(self, pool, shown, path, page_of):
        self.pool, self.shown, self.path, self.page_of = pool, set(shown), path, page_of
        self.ended, self.drawings = {}, {}
        self.written = None  # when, by time.monotonic()
        self.closed, self.error = False, None
        self.lock = threading.Lock()

    def take(self, run):
        """A run has ended."""
        if not run.ran or run.job.name not in self.shown:
            return
        drawing = self.pool.submit(demo_page.draw, run)
        with self.lock:
            self.ended[run.job.name], self.drawings[run.job.name] = run, drawing
        drawing.add_done_callback(self._write)

    def _write(self, _):
        with self.lock:
            now = time.monotonic()
            early = self.written is not None and now - self.written < self.EVERY_S
            if self.closed or self.error or early:
                return
            ready = {n: d for n, d in self.drawings.items() if d.done() and not d.cancelled()}
            drawn = {n: d.result() for n, d in ready.items() if d.exception() is None}
            if not any(drawn.values()):
                return
            if self.written is None:
                print(f"demo: the first of the report: {self.path}", file=sys.stderr, flush=True)
            self.written = now
            try:
                write_whole(self.path, self.page_of({n: self.ended[n] for n in drawn}, drawn))
            except OSError as error:  # told by result(), in the caller's thread
                self.error = error

    def result(self):
        """{name: pictures} of all, once they are drawn; the page is not written any more. OSError
        where it could not be written."""
        found = {name: drawing.result() for name, drawing in self.drawings.items()}
        with self.lock:
            self.closed = True
        if self.error:
            raise self.error
        return found
