# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Progress on a terminal: one line, redrawn, with the time left; elsewhere a line now and then."""

import shutil
import sys
import threading
import time


def clock_text(seconds):
    seconds = max(0, round(seconds))
    return f"{seconds // 60}:{seconds % 60:02d}"


class Steps:
    """Work that is counted, inside `with`: a line that is drawn anew on a terminal; elsewhere one every half a minute."""

    EVERY_S, SILENT_S = 0.2, 30

    def __init__(self, name, total):
        self.name, self.total = name, total
        self.done, self.last = 0, ""
        self.began = self._said = time.monotonic()
        self._stopped, self._drawing = threading.Event(), threading.Lock()
        self._thread = threading.Thread(target=self._redraw, daemon=True) if sys.stderr.isatty() else None

    def __enter__(self):
        if self._thread:
            self._thread.start()
        return self

    def __exit__(self, *_):
        self._stopped.set()
        if self._thread:
            self._thread.join()
            self._write("")

    def _write(self, text):
        sys.stderr.write(f"\r{text[: shutil.get_terminal_size().columns - 1]}\x1b[K")
        sys.stderr.flush()

    def _redraw(self):
        while not self._stopped.wait(self.EVERY_S):
            with self._drawing:
                self._write(self.text())

    def say(self, text):
        """Prints something to stdout while the work goes on."""
        with self._drawing:
            if self._thread:
                self._write("")
            print(text, flush=True)

    def step(self, last, done=None):
        """One more is done, or `done` are by now; `last` says what this was."""
        self.done = self.done + 1 if done is None else done
        self.last = last
        now = time.monotonic()
        if not self._thread and now - self._said > self.SILENT_S:
            self._said = now
            print(self.text(), file=sys.stderr, flush=True)

    def text(self):
        """How far it is; without a share where nobody knows how much there is (total None)."""
        spent = time.monotonic() - self.began
        if self.total is None:
            return f"{self.name}: {self.done} done, {clock_text(spent)}  {self.last}"
        share = min(1.0, self.done / self.total) if self.total else 1.0
        left = clock_text(spent * (1 / share - 1)) if share > 0 else "?"
        return f"{self.name}: {100 * share:3.0f} %, {clock_text(spent)}, {left} left  {self.last}"
