# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs test cases with one mutant each. Documentation: docs/testing.md

First every test case runs once without a mutant and records which mutants it reaches. A mutant is
then tried only by the cases that reach it, the shortest first, until one fails.
"""

import contextlib
import os
import resource
import signal
import subprocess
import threading
from dataclasses import dataclass

import interrupts
from crew import Crew

from .twin_programs import BuildError, list_cases

SLOWER, MORE_S = 2, 1  # a mutant may take this many times the CPU time, and these seconds more


@dataclass
class Verdict:
    """What became of one mutant."""

    mutant: object
    # killed, hangs, crashes, survives, unreached, exact (nothing to round, or no such call)
    how: str
    by: str = ""  # program: test case
    seconds: float = 0.0


class Runs:
    """Test cases of programs with mutants, side by side."""

    def __init__(self, folder, jobs):
        self.folder, self.jobs, self.crew = folder, jobs, Crew()

    def environment(self, **more):
        """Without what may be set for the project's own programs."""
        kept = {k: v for k, v in os.environ.items() if not k.startswith("FELTGATE_")}
        return (
            kept
            | {"FELTGATE_MISMATCH_DIR": str(self.folder / "mismatch" / str(threading.get_ident()))}
            | more
        )

    def run(self, case, limit=None, **environment):
        """(exit status, None where it took far too long; seconds of CPU time). Beyond the limit of
        these a signal ends it."""
        name = case.name.replace("\\", "\\\\").replace(",", "\\,").replace("[", "\\[")
        process = self.crew.start(
            [case.program.path, "--abort", name],
            env=self.environment(**environment),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        with contextlib.suppress(ProcessLookupError):  # it may be over already
            resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))
            if limit:
                resource.prlimit(process.pid, resource.RLIMIT_CPU, (limit, limit))
        status, seconds = self.crew.wait(process, 60 + 20 * limit if limit else None)
        if status is not None and -status in interrupts.ENDING:  # by somebody else: it says nothing
            raise interrupts.Interrupted(-status)
        return status, seconds

    def survey(self, programs):
        """Times and what is reached, of every test case; the shortest first."""
        cases = [case for program in programs for case in list_cases(program)]

        def one(numbered):
            number, case = numbered
            file = self.folder / f"reached{number}"
            file.unlink(missing_ok=True)
            status, case.seconds = self.run(case, FELTGATE_MUTANTS_REACHED=str(file))
            if status != 0:
                raise BuildError(f"{case.program.target}: '{case.name}' fails without any mutant")
            lines = [line.split() for line in file.read_text(encoding="ascii").splitlines()]
            case.reached = {int(words[0]) for words in lines if len(words) == 1}
            case.exact = {int(words[0]) for words in lines if len(words) == 2}

        self.crew.counted("mutate", one, enumerate(cases), self.jobs, lambda n, *_: n[1].name)
        return sorted(cases, key=lambda case: case.seconds)

    def verdicts(self, work):
        """Of work = [(mutant, the cases that may find it)], by number."""
        found = []

        def note(item, verdict, _):
            found.append(verdict)
            return f"{item[0].header} {verdict.how}"

        self.crew.counted("mutate", lambda item: self.try_mutant(*item), work, self.jobs, note)
        return sorted(found, key=lambda verdict: verdict.mutant.number)

    def try_mutant(self, mutant, cases):
        """Its verdict: the cases that reach it run until one fails."""
        spent, reached = 0.0, False
        for case in cases:
            if mutant.number not in case.reached:
                continue
            reached = True
            limit = int(SLOWER * case.seconds + MORE_S) + 1
            status, seconds = self.run(case, limit, FELTGATE_MUTANT=str(mutant.number))
            spent += seconds
            if status != 0:
                if (
                    status is None
                    or -status == signal.SIGXCPU
                    or (status < 0 and seconds > limit - 1)
                ):
                    how = "hangs"
                else:
                    how = "killed" if status > 0 else "crashes"
                return Verdict(mutant, how, f"{case.program.target}: {case.name}", spent)
        if not reached and any(mutant.number in case.exact for case in cases):
            return Verdict(mutant, "exact", "", spent)
        return Verdict(mutant, "survives" if reached else "unreached", "", spent)
