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


class RedrawnLine:
    """A line() that is drawn anew on a terminal while the work inside `with` goes on; silent
    elsewhere."""

    def __init__(self, stream=None, every_s=0.2):
        self.stream = stream or sys.stderr
        self.live = self.stream.isatty()
        self.every_s = every_s
        self.began = time.monotonic()
        self._stopped = threading.Event()
        self._thread = None
        self._drawing = threading.Lock()

    def __enter__(self):
        if self.live:
            self._thread = threading.Thread(target=self._redraw, daemon=True)
            self._thread.start()
        return self

    def __exit__(self, *_):
        self._stopped.set()
        if self._thread:
            self._thread.join()
            self.stream.write("\r\x1b[K")
            self.stream.flush()

    def _redraw(self):
        while not self._stopped.wait(self.every_s):
            with self._drawing:
                self.stream.write("\r" + self.line() + "\x1b[K")
                self.stream.flush()

    def say(self, text):
        """Prints something to stdout while the work goes on."""
        with self._drawing:
            if self.live:
                self.stream.write("\r\x1b[K")
                self.stream.flush()
            print(text, flush=True)


class Steps(RedrawnLine):
    """Work that is counted. Where there is no terminal it says a line every half a minute."""

    SILENT_S = 30

    def __init__(self, name, total, stream=None):
        super().__init__(stream)
        self.name, self.total = name, total
        self.done, self.last = 0, ""
        self._said = self.began

    def step(self, last, done=None):
        """One more is done, or `done` are by now; `last` says what this was."""
        self.done = self.done + 1 if done is None else done
        self.last = last
        now = time.monotonic()
        if not self.live and now - self._said > self.SILENT_S:
            self._said = now
            self.stream.write(self.text() + "\n")
            self.stream.flush()

    def text(self):
        """How far it is; without a share where nobody knows how much there is (total None)."""
        if self.total is None:
            return f"{self.name}: {self.done} done, {clock_text(self._spent())}  {self.last}"
        share = min(1.0, self.done / self.total) if self.total else 1.0
        spent = self._spent()
        left = clock_text(spent * (1 / share - 1)) if share > 0 else "?"
        return f"{self.name}: {100 * share:3.0f} %, {clock_text(spent)}, {left} left  {self.last}"

    def _spent(self):
        return time.monotonic() - self.began

    def line(self):
        return self.text()[: shutil.get_terminal_size().columns - 1]
