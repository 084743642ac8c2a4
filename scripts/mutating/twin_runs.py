# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Runs test cases with one mutant each. Documentation: docs/verification.md

First every test case runs once without a mutant and notes which ones it reaches. A mutant is then only
tried by those that reach it, the shortest first, until one fails.
"""

import contextlib
import os
import resource
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass

from .twin_programs import BuildError, list_cases

SLOWER, MORE_S = 2, 1  # a mutant may take this many times the CPU time, and these seconds more


@dataclass
class Verdict:
    mutant: object
    how: str  # killed, hangs, crashes, survives, unreached, exact (nothing to round, or no such call)
    by: str = ""  # program: test case
    seconds: float = 0.0


class Runs:
    def __init__(self, folder, jobs):
        self.folder, self.jobs = folder, jobs
        self.lock = threading.Lock()
        self.alive = set()
        self.ended = False

    def environment(self, **more):
        kept = {k: v for k, v in os.environ.items() if not k.startswith("FELTGATE_")}
        return kept | {"FELTGATE_MISMATCH_DIR": str(self.folder / "mismatch" / str(threading.get_ident()))} | more

    def run(self, case, limit=None, **environment):
        """(exit status, seconds of CPU); a signal ends it when that is more than the limit."""
        name = case.name.replace("\\", "\\\\").replace(",", "\\,").replace("[", "\\[")
        with self.lock:
            if self.ended:
                raise KeyboardInterrupt
            process = subprocess.Popen(
                [case.program.path, "--abort", name], env=self.environment(**environment),
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                start_new_session=True)
            self.alive.add(process)
        with contextlib.suppress(ProcessLookupError):  # it may be over already
            resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))
            if limit:
                resource.prlimit(process.pid, resource.RLIMIT_CPU, (limit, limit))
        deadline = threading.Timer(60 + 20 * limit, process.kill) if limit else None
        if deadline:
            deadline.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        finally:
            if deadline:
                deadline.cancel()
            with self.lock:
                self.alive.discard(process)
        process.returncode = os.waitstatus_to_exitcode(status)
        return process.returncode, usage.ru_utime + usage.ru_stime

    def end_all(self):
        with self.lock:
            self.ended = True
            for process in self.alive:
                process.kill()

    def survey(self, programs, report):
        """Times and what is reached, of every test case."""
        cases = [case for program in programs for case in list_cases(program)]

        def one(number, case):
            file = self.folder / f"reached{number}"
            status, case.seconds = self.run(case, FELTGATE_MUTANTS_REACHED=str(file))
            if status != 0:
                raise BuildError(f"{case.program.target}: '{case.name}' fails without any mutant")
            lines = [line.split() for line in file.read_text(encoding="ascii").splitlines()]
            case.reached = {int(words[0]) for words in lines if len(words) == 1}
            case.exact = {int(words[0]) for words in lines if len(words) == 2}
            return case

        done = self.each([(one, (n, case)) for n, case in enumerate(cases)], report)
        return sorted(done, key=lambda case: case.seconds)

    def each(self, work, report):
        results = []
        with ThreadPoolExecutor(self.jobs) as pool:
            pending = [pool.submit(function, *given) for function, given in work]
            try:
                for number, future in enumerate(as_completed(pending), 1):
                    results.append(future.result())
                    report(number, len(work), results[-1])
            except BaseException:
                self.end_all()
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        return results

    def try_mutant(self, mutant, cases):
        spent, reached = 0.0, False
        for case in cases:
            if mutant.number not in case.reached:
                continue
            reached = True
            limit = int(SLOWER * case.seconds + MORE_S) + 1
            status, seconds = self.run(case, limit, FELTGATE_MUTANT=str(mutant.number))
            spent += seconds
            if status != 0:
                how = "killed"
                if status < 0:
                    how = "hangs" if seconds > limit - 1 else "crashes"
                return Verdict(mutant, how, f"{case.program.target}: {case.name}", spent)
        if not reached and any(mutant.number in case.exact for case in cases):
            return Verdict(mutant, "exact", "", spent)
        return Verdict(mutant, "survives" if reached else "unreached", "", spent)

    def try_all(self, mutants, cases, report):
        return self.each([(self.try_mutant, (m, cases)) for m in mutants], report)


class Progress:
    """The time that is left: one line on a terminal, otherwise one every so often."""

    EVERY_S = 30

    def __init__(self, stream, what):
        self.stream, self.what, self.start = stream, what, time.monotonic()
        self.next = self.start + self.EVERY_S

    def __call__(self, done, total, _=None):
        now = time.monotonic()
        left = (now - self.start) / done * (total - done)
        text = f"{self.what}: {done} of {total}, {left:.0f} s left"
        if self.stream.isatty():
            self.stream.write("\r\033[K" + (text if done < total else ""))
        elif now >= self.next and done < total:
            self.next = now + self.EVERY_S
            self.stream.write(f"mutate: {text}\n")
        self.stream.flush()
