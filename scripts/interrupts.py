# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Signals that end a job: started programs end too, and the exit code is 128 + the signal.

Documentation: docs/json.md
"""

import signal
import subprocess
import sys

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PATIENCE_S = 10


class Interrupted(KeyboardInterrupt):
    """One of these signals, here or in a program that was started."""

    def __init__(self, number=signal.SIGINT):
        super().__init__(f"signal {int(number)}")
        self.number = int(number)


def end_on_signals():
    """From now on they raise Interrupted; one that is ignored, as under nohup, stays ignored."""

    def interrupt(number, _):
        raise Interrupted(number)

    for number in ENDING:
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, interrupt)


def leave_signals_to_the_parent():
    """For the workers of a pool: Ctrl-C reaches the whole group, and the parent says it once."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


def tell(name, error, hint=""):
    """Says it; the exit code. In one piece: another thread may be saying something too."""
    sys.stderr.write(f"{name}: interrupted{hint}\n")
    return 128 + getattr(error, "number", signal.SIGINT)


def ending_signal(status):
    """The signal that ended a program with this status, or 0."""
    return -status if status < 0 else status - 128 if 128 < status <= 192 else 0


def how_it_ended(status):
    """A few words for a person."""
    number = ending_signal(status)
    if number in ENDING:
        return "interrupted"
    if number:
        names = {s.value: s.name for s in signal.Signals}
        return f"killed by {names.get(number, f'signal {number}')}"
    return f"ended with status {status}"


def check(status):
    """Raises Interrupted when a program was ended by one of these signals."""
    if ending_signal(status) in ENDING:
        raise Interrupted(ending_signal(status))


def stop(process):
    """Ends a program that was started here, politely at first."""
    process.terminate()
    try:
        process.wait(PATIENCE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def run(command, **options):
    """subprocess.run without check=; a signal here ends the program, one there is one here."""
    process = subprocess.Popen(command, **options)
    try:
        out, err = process.communicate()
    except BaseException:
        stop(process)
        raise
    check(process.returncode)
    return subprocess.CompletedProcess(command, process.returncode, out, err)


CAPTURED = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
