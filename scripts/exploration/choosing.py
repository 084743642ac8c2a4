# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What `feltgate choose` asks the other commands about a scene, and the alternatives that follow.

Documentation: docs/speed-for-accuracy.md
"""

import csv
import itertools
import json
import os
import re
import shlex
import tomllib
from pathlib import Path

import building
import command_line
import interrupts
import synth_budget
from command_line import Refused
from exploration import choice, made_scene
from exploration.design_text import described, design_text, own_program

NAME = "choose"
TABLE = "vectors/spaces/trade.csv"
BENCH = "docs/images/bench.json"
RATES = {"law": "490,1000,10000,40000,100000", "block": "1000,10000"}  # the fastest is always added
TRIM_S = 60  # of the search; a trim of most scenes takes 5 to 30
TICK_HZ = 1_000_000  # of `lever`


class Programs:
    """The C++ program, its answers as JSON."""

    numbers = itertools.count()  # of all answers

    def __init__(self, folder, quiet, environment=()):
        self.folder, self.quiet = Path(folder), quiet
        self.environment, self.about = os.environ | dict(environment), ""
        self.name = "feltgate_lever_law"

    def ask(self, command, *words, codes=(0, 1)):
        """The JSON of a command; what it refuses is refused here, in its words."""
        program = command_line.build_folder() / self.name
        if not program.exists():
            raise Refused(f"{program} is not built; start this as ./feltgate choose, which builds it")
        answer = self.folder / f"{command}{next(self.numbers)}.json"
        words = [program, command, *map(str, words), "--json", answer]
        if not self.quiet:
            command_line.say(NAME, shlex.join([command, *map(str, words[2:-2])]))
        done = interrupts.run(words, env=self.environment, **interrupts.CAPTURED)
        if done.returncode not in codes or not answer.exists():
            said = (done.stderr or done.stdout).strip().removeprefix("feltgate: ")
            # Of a file that is made for the moment, the place means nothing to a user.
            said = re.sub(rf"{re.escape(str(self.folder))}/[^\s:]+(:\d+)*: ", f"{self.about}: ", said)
            raise Refused(said or f"{command} ended with {done.returncode}")
        return json.loads(answer.read_text(encoding="utf-8"))

    def put(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path


class Question:
    """A scene, read; for a law without one, the scene in which a hand sweeps it."""

    def __init__(self, given, programs):
        root, programs.about = command_line.root(), given
        self.path, self.made = self._find(given, root, programs)
        try:
            self.scene = tomllib.loads(self.path.read_text(encoding="utf-8"))
            self.law = made_scene.law_path(root, self.path, self.scene)
        except KeyError as error:
            missing = f"it has no table [{error.args[0]}]"
            raise Refused(f"{self.path}: not a scene file: {missing}; docs/scenes.md explains one") from error
        except (OSError, ValueError, TypeError, AttributeError) as error:
            raise Refused(f"{self.path}: not a scene file: {error}; docs/scenes.md explains one") from error
        self.device = self.scene.get("device")
        self.name = self.path.stem
        if self.law and not self.law.is_file():
            raise Refused(f"{self.path}: there is no law {self.law}; name one in rtl/laws, or a file")
        if self.device:
            programs.name = f"feltgate_{self.device}_law"
            # The launcher builds the program of a scene's device; it does not know that of a law.
            build = command_line.build_folder()
            if (build / "build.ninja").exists() and self.path.stem != given and self.path != Path(given):
                building.make(NAME, build, [programs.name], os.cpu_count())

    def _find(self, given, root, programs):
        """(path of the scene, whether it was made for a law)."""
        scene, law = made_scene.named(given)
        if scene:
            return scene, False
        for scene in sorted(root.glob("vectors/scenes/*.toml")):  # one that renders a shipped law
            if law.stem == given and f'\nlaw = "{given}"' in scene.read_text(encoding="utf-8"):
                return scene, False
        told = programs.ask("law", law)
        if any(o["axis"] > 0 for o in told["outputs"]):
            raise Refused(
                f"{given}: a law of several axes, and a law file names no device; write a scene with "
                "device = and law = (docs/scenes.md) and give its path"
            )
        text = made_scene.SWEEP.format(name=law.stem, law=law.resolve())
        return programs.put(f"{law.stem}.toml", text), True

    def of_block(self):
        return self.law is None

    def kind(self):
        return "block" if self.of_block() else "law"

    def uses_velocity(self, report):
        """Whether the velocity estimator is in the torque."""
        if report["damping_nm_s_rad"] > 0:
            return True
        return self.law is not None and "velocity" in self.law.read_text(encoding="utf-8")


def rounding_part(programs, scene, design):
    """(rms, worst) of the rounding behind the law. The rms at any rate: the measured one, and the
    worst of the ticks for which a bound is proven. The worst: the bound, or what exceeds it outside."""
    run = programs.ask("run", scene, "--design", design, "--engine", "twin,quad", "--quiet")
    errors = run["engines"]["twin"]["torque_nm"]
    worst = max(errors["max_error"], errors.get("max_error_outside", 0.0))
    return min(errors["rms_error"] + errors["max_error"], worst), max(errors["bound"] or 0.0, worst)


class Choosing:
    """What the commands found out about a question, and the alternatives that follow."""

    def __init__(self, question, programs, wishes):
        self.question, self.programs, self.wishes = question, programs, wishes
        root = command_line.root()
        self.base = tomllib.loads((root / "rtl/designs/lever.toml").read_text(encoding="utf-8"))
        with open(root / TABLE, newline="", encoding="utf-8") as file:
            self.table = list(csv.DictReader(file))
        self.budget = synth_budget.read(root / synth_budget.FILE)
        self.design = "lever" if question.of_block() else f"{question.device or 'lever'}_law"
        self.left_out, self.trim = [], None

    def leave_out(self, part, why):
        self.left_out.append({"part": part, "why": why})

    def measure(self):
        """First the plant, then the scene at all rates on what is left of it."""
        ask, q = self.programs.ask, self.question
        self.path, self.scene = q.path, made_scene.moved(q.scene, q.path.parent)
        trimmed = self.programs.folder / f"{q.name}_trimmed.toml"
        share = f"{self.wishes['torque_error']:.6g}"
        limits = ("--tolerance", share, "--search-limit", str(TRIM_S))
        self.trim = ask("trim", q.path, *limits, "-o", trimmed, "--quiet")
        if trimmed.is_file():
            effects = tomllib.loads(trimmed.read_text(encoding="utf-8"))
            self.path, self.scene = trimmed, self.scene | effects
        else:
            self.trim = None
            told = f"`feltgate trim` finds none in {TRIM_S} s that the wished error allows: all stay on"
            self.leave_out("plant effects", told)
        if q.law:
            self.scene["core"]["law"] = str(q.law.resolve())
        self.kept_designs()
        self.report = self.rates(self.path)
        self.largest_nm = self.report["largest_nm"]
        if self.report["counts_alone_rms_nm"] is None or self.largest_nm <= 0:
            raise Refused(f"{q.path}: the law asks for no torque on this motion; give a scene that meets it")
        self.whole = self.rates(q.path) if self.trims_the_loop() else self.report

    def rates(self, path):
        """The scene's `rates`, with each velocity estimate of the table's designs beside that of `lever`."""
        self.loops = {json.dumps(row.loop()): row.loop() for row in self.kept if row.loop()}
        files = []
        for number, loop in enumerate(self.loops.values()):
            text = design_text(command_line.root(), {"base": "lever", "set": loop})
            files.append(str(self.programs.put(f"beside{number}.toml", text)))
        beside = ("--beside", ",".join(files)) if files else ()
        rates = RATES[self.question.kind()]
        return self.programs.ask("rates", path, "--rate", rates, *beside, "--quiet")["scenes"][0]

    def trims_the_loop(self):
        """Whether the linear loop lost a part of the scene's plant; the margins keep it."""
        if not self.trim:
            return False
        own, off = self.trim["full"]["effects_off"], self.trim["trimmed"]["effects_off"]
        linear = {"inductance", "back_emf"} | ({"viscous"} if self.question.device else set())
        return bool(linear & (set(off) - set(own)))

    def kept_designs(self):
        """The designs of the table that may render the scene, or the device's own alone."""
        q = self.question
        scene = q.scene["core"]["scene"] if q.of_block() else None
        self.kept, left = choice.designs(self.table, self.base, scene)
        self.own_row = next(row for row in self.kept if not row.change)
        if q.device:
            left = {"for one lever: a device has a design of its own": len(self.table) - 1}
            self.kept = [self.own_row]
        elif "velocity_a1" in q.scene.get("parameters", {}):
            left["the scene sets the cut-off of `lever` itself"] = len(self.kept) - 1
            self.kept = [self.own_row]
        self.designs_left = left

    def of_loop(self, report, row):
        """(counts alone, margins) of a design's velocity estimate."""
        keys = ("counts_alone_rms_nm", "counts_alone_max_nm")
        if not row.loop():
            return [report[key] for key in keys], [r.get("margin") for r in report["rates"]]
        found = report["beside"][list(self.loops).index(json.dumps(row.loop()))]
        return [found[key] for key in keys], found["margins"]

    def rounding(self):
        """(rms, worst) behind the law, of the built design; None for several axes."""
        q = self.question
        if q.device:
            self.leave_out("rounding behind the law", "not measured apart for several axes")
            self.leave_out("delay of PWM and winding", "`feltgate stability` takes one lever")
            return None
        self.plant = self.programs.put("linear_viscous.toml", made_scene.linear_plant(q.scene))
        words = ("--linear-plant", self.plant, "--damping", 0, "--rate", 1e6, "--no-bits")
        self.actuator_s = self.programs.ask("stability", "lever", *words)["actuator_delay_s"]
        return rounding_part(self.programs, self.path, self.design)

    def core(self, row):
        """(what, gates) of a design's core."""
        if self.question.device:
            name = f"{self.report['axes']} axes"
            return f"core, {name}", self.budget["figures"]["lever"][name]
        if self.question.of_block():
            return "core, its scenes", row.figures
        alone = self.budget["figures"]["lever_law"]["core without read-back"]
        own = self.own_row.figures
        more = {k: int(row.figures[k]) - int(own[k]) for k in ("lut4_equivalents", "mult18", "bram")}
        return "core, set-point alone", {k: alone[k] + more[k] for k in more}

    def delays(self, row):
        parts = {"core: from the sample to the duty": float(row.figures["latency_us"]) / 1e6}
        if not self.question.device:
            parts["PWM and winding"] = self.actuator_s
        if self.question.uses_velocity(self.report):
            parts["velocity estimate"] = float(row.figures["delay_s"])
        return {"clock_hz": self.base["clock"]["clock_hz"], "parts": parts}

    def alternatives(self):
        """All of them, as the JSON has them."""
        rounding = self.rounding()
        plant = choice.plant_part(self.trim, self.largest_nm) if self.trim else None
        cells = self.budget["figures"]["lever"]["core without read-back"]
        cells_per_lut4 = cells["cyclone_cells"] / cells["lut4_equivalents"]
        engine = ("engine", self.budget["figures"]["lever"]["axes_engine"])
        by = "block" if self.question.of_block() else "engine"
        found = []
        for row in self.kept:
            counts, _ = self.of_loop(self.report, row)
            gates = choice.gates_of(self.core(row), engine if by == "engine" else None)
            for i, rate in enumerate(self.report["rates"]):
                if rate["by"] != by or rate["error_rms_nm"] is None or rate["fault"]:
                    continue
                tick_hz = row.get(choice.TICK)
                if by == "block":
                    rate = rate | {"rate_hz": tick_hz}
                elif rate["rate_hz"] > 1.001 * tick_hz:
                    continue
                margin = self.margin(row, i)
                parts = self.error_parts(row, rate, counts, rounding, plant)
                found.append({
                    "design": self.name_of(row),
                    "cutoff_rad_s": row.get(choice.CUTOFF),
                    "set": row.change,
                    "built": row.in_registers(),
                    "own_motion": not row.change,
                    "table_id": row.figures["id"],
                    "by": by,
                    "rate_hz": rate["rate_hz"],
                    "ticks": max(1, round(tick_hz / rate["rate_hz"])),
                    "clocks": [rate.get("clocks_used", 0), rate.get("clocks_available", 0)],
                    "error": choice.error_of(parts, self.largest_nm),
                    "margin": margin,
                    "margin_by": self.margin_by(margin),
                    "latency": choice.latency_of(rate, self.delays(row)),
                    "gates": gates,
                    "chips": {n: choice.fit(c, gates, cells_per_lut4) for n, c in choice.CHIPS.items()},
                    "broken": rate.get("broken", []),
                    "cpu_s_per_s": rate["cpu_s_per_s"],
                })  # fmt: skip
        if not found:
            path = self.question.path
            raise Refused(f"{path}: a fault opens the gates at every rate; see `feltgate rates`")
        return found

    def name_of(self, row):
        if not row.change:
            return self.design
        own = f"{row.get(choice.CUTOFF):g}" if row.in_registers() else row.figures["id"][:6]
        return f"{self.design}_{own}"

    def error_parts(self, row, rate, counts, rounding, plant):
        """Of a design and a rate: what the rate adds is measured on `lever`."""
        own, _ = self.of_loop(self.report, self.own_row)
        more = choice.added(rate, own)
        if not row.change:
            return choice.error_parts(counts, more, rounding, plant)
        table = [float(row.figures[key]) for key in ("torque_error_max_nm", "bound_torque_nm")]
        rounding = [max(pair) for pair in zip(rounding, table, strict=True)]
        return choice.error_parts(counts, more, rounding, plant, "explore: largest measured, and bound")

    def margin(self, row, i):
        """From the fastest rate on `lever` to this rate and this design, of the scene's whole plant."""
        _, own = self.of_loop(self.whole, self.own_row)
        _, here = self.of_loop(self.whole, row)
        return choice.margin_of(own[-1], own[i], here[i])

    def margin_by(self, margin):
        notes = [n for n in self.report["notes"] if n.startswith("no margin")]
        if margin is None:
            return notes[0] if notes else "no margin: the motion met the law nowhere stiff"
        fastest = margin["parts"][0]["margin"]
        held = "the rate" if fastest >= self.wishes["margin"] else "the law's own stiffness and damping"
        return f"{held}: {fastest:.3g} at the fastest"

    def scene_of(self, best):
        """The scene on what is left of the plant; a cut-off that a register of `lever` holds is in it."""
        if not best["set"] or not best["built"]:
            return made_scene.with_values(self.scene)
        return made_scene.with_values(self.scene, velocity_a1=choice.word(best["cutoff_rad_s"], TICK_HZ))

    def of_chain(self, best, design):
        """The design for `feltgate stability`: a file is `lever` with the cut-off of the choice."""
        if not best["built"]:
            return design
        text = design_text(command_line.root(), {"base": "lever", "set": best["set"]})
        return self.programs.put("chain.toml", text)

    def text_of(self, best):
        """The choice as a design file."""
        point = {"base": self.design, "set": best["set"]}
        return described(design_text(command_line.root(), point), point)

    def row_of(self, best, scene):
        """(report, row) of `rates` for the choice."""
        programs, design = self.programs_of(best)
        own = () if best["built"] else ("--design", design)
        words = ("--rate", f"{best['rate_hz']:.9g}", *own, "--quiet")
        report = programs.ask("rates", scene, *words)["scenes"][0]
        rows = [r for r in report["rates"] if r["by"] == best["by"]]
        return report, min(rows, key=lambda r: abs(r["rate_hz"] - best["rate_hz"]))

    def run_itself(self, best):
        """A hand that gives way moves another design otherwise, even where the law has no speed: each
        part is the larger of that on the motion of `lever` and on its own."""
        text = made_scene.toml_text([], self.scene_of(best))
        scene = self.programs.put(f"{self.question.name}.toml", text)
        report, row = self.row_of(best, scene)
        programs, design = self.programs_of(best)
        counts = [report[key] for key in ("counts_alone_rms_nm", "counts_alone_max_nm")]
        found = (counts, choice.added(row, counts), rounding_part(programs, scene, design))
        for part, own in zip(best["error"]["parts"], found, strict=False):
            part["rms_nm"], part["worst_nm"] = max(part["rms_nm"], own[0]), max(part["worst_nm"], own[1])
        best["error"] = choice.error_of(best["error"]["parts"], self.largest_nm)
        best["own_motion"] = True

    def programs_of(self, best):
        """The programs that run the choice, and the design's name there."""
        if best["built"]:
            return self.programs, self.design
        environment = own_program(NAME, best["design"], self.text_of(best))
        programs = Programs(self.programs.folder, self.programs.quiet, environment)
        programs.name = f"feltgate_{best['design']}"
        return programs, best["design"]

    def simulation(self, best):
        """The engine: the fastest whose bits are the RTL's, by the committed benchmark."""
        bench = json.loads((command_line.root() / BENCH).read_text(encoding="utf-8"))
        speeds = {n: e["simulated_s_per_s"]["median"] for n, e in bench["engines"].items()}
        errors = {n: e.get("torque_error_nm", {"max": 0.0})["max"] for n, e in bench["engines"].items()}
        told = {"engine": "twin", "core_times_faster_than_rtl": speeds["twin_event"] / speeds["rtl"]}
        told |= {"double_times_faster_in_the_core": speeds["double"] / speeds["twin_event"]}
        told |= {"double_loses_nm": errors["twin_event"], "bench": f"{bench['machine']}, {bench['date']}"}
        if self.trim:
            full, least = self.trim["full"], self.trim["trimmed"]
            told |= {"effects_off": least["effects_off"], "step_clocks": least["step_clocks"]}
            told |= {"cpu_s_per_s": least["cpu_s_per_s"], "full_cpu_s_per_s": full["cpu_s_per_s"]}
            told["faster"] = self.trim["faster"]
        else:
            told |= {"effects_off": None, "step_clocks": None, "cpu_s_per_s": best["cpu_s_per_s"]}
        return told

    def for_a_host(self):
        """Of a scene of the core: the slowest rate at which a host's law would meet error and margin."""
        if not self.question.of_block():
            return None
        plant = choice.plant_part(self.trim, self.largest_nm) if self.trim else (0.0, 0.0)
        for row in self.report["rates"]:
            if row["by"] == "block" or row["error_rms_nm"] is None:
                continue
            share = (row["error_rms_nm"] + plant[0]) / self.largest_nm
            margin = row.get("margin")
            if share <= self.wishes["torque_error"] and (margin is None or margin >= self.wishes["margin"]):
                return row["rate_hz"]
        return None
