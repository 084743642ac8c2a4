#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Chooses design, rate, plant and simulation for a scene or a law, and verifies the choice.

It asks the program's other commands and adds up: no figure is computed here. Documentation:
docs/speed-for-accuracy.md
"""

import json
import sys
import tempfile
import tomllib
from pathlib import Path

import command_line
import outputs
from exploration import choice, choose_text, made_scene
from exploration.choosing import NAME, Choosing, Programs, Question

SCHEMA = "feltgate-choose/1"
RTL_SECONDS = {"block": 1.5, "law": 0.4, "axes": 0.15}  # by default: half a minute of one core
SAME = 1e-9  # sums of the same numbers in another order
LEAST_ARMED_S = 0.001  # of the scene, in RTL
AGREES = 0.05  # bits and eigenvalues, as `feltgate stability` demands
EPILOG = """SCENE is a name in vectors/scenes or a path; LAW a name in rtl/laws or the path of a law file of
your own, which a hand then sweeps. Without a wish the aims are 1% and a margin of 2. The answer is
a design that is built in, with the fewest gates, then the slowest law, that meet all of them; else one
of the explored table, for which a program is built. Its error is the sum of its parts:
encoder, rate, rounding, plant effects left out, each from the command that measures it. It is then
verified: RTL and twin in lock-step, the error, and the margin on the chain's bits.

  feltgate choose wall
  feltgate choose detent --torque-error 5% --margin 4 --fastest
  feltgate choose coupled_levers --chip gw1nr-9        a device with several axes
  feltgate choose my.law --latency 2 -o out            out/ gets scene, law, design, JSON
  feltgate choose wall --margin 8                      cannot be: says why, and the nearest

Exit code: 0 all wishes are met and the choice is verified, 1 one is not, 2 unusable input."""


def number(least, most, unit):
    def read(text):
        share = unit == "share" and text.endswith("%")
        try:
            value = float(text.removesuffix("%" if share else "")) / (100 if share else 1)
        except ValueError:
            value = float("nan")
        if not least <= value <= most:
            kind = "a share, such as 1% or 0.01, " if unit == "share" else "a number "
            limits = f"{100 * least:g}% to {100 * most:g}%" if unit == "share" else f"{least:g} to {most:g}"
            raise command_line.argparse.ArgumentTypeError(f"{text} is not {kind}from {limits}")
        return value

    return read


def arguments_of(words):
    parser = command_line.parser(NAME, __doc__.splitlines()[0], EPILOG)
    parser.add_argument("scene", metavar="SCENE|LAW", help="what is to be felt")
    parser.add_argument(
        "--torque-error",
        type=number(1e-5, 1, "share"),
        metavar="SHARE",
        help="rms error of the torque, as a share of the law's largest; aim: 1%%",
    )
    parser.add_argument(
        "--margin",
        type=number(1, 1000, ""),
        metavar="RATIO",
        help="largest stable stiffness over the law's; aim: 2",
    )
    parser.add_argument("--chip", choices=tuple(choice.CHIPS), help="it must fit there")
    parser.add_argument(
        "--latency",
        type=number(1e-3, 1000, ""),
        metavar="MS",
        help="mean time from a motion to the torque that answers it, in ms",
    )
    objective = parser.add_mutually_exclusive_group()
    for name, what in (
        ("fastest", "the least latency"),
        ("smallest", "the fewest gates"),
        ("stiffest", "the largest margin"),
    ):
        told = f"of what meets the wishes, {what}"
        objective.add_argument(f"--{name}", dest="objective", action="store_const", const=name, help=told)
    parser.add_argument(
        "--rtl-seconds",
        type=number(1e-3, 100, ""),
        metavar="S",
        help="how much of the scene the RTL runs; default: 1.5 s of a block, 0.4 s of a law, 0.15 s "
        "of several axes",
    )
    command_line.add_path(
        parser, "-o", "--output", metavar="DIR", what="the files; default: choose/NAME in the build folder"
    )
    command_line.add_json(parser)
    command_line.add_flags(parser, quiet="print nothing but errors")
    command_line.add_only_arguments(parser)
    options = parser.parse_args(words)
    outputs.check(parser, json=options.json)
    outputs.check_folder(parser, "--output", options.output)
    try:
        made_scene.named(options.scene)
    except command_line.Refused as error:
        parser.error(str(error))
    return options



def wishes_of(options):
    named = {"torque_error": options.torque_error, "margin": options.margin}
    named |= {"chip": options.chip, "latency": options.latency}
    stated = [name for name, value in named.items() if value is not None]
    aims = {"torque_error": 0.01, "margin": 2.0}
    taken = {name: aims.get(name) if value is None else value for name, value in named.items()}
    return taken | {"stated": stated, "objective": options.objective}


class Files:
    """What the answer leaves to go on with."""

    def __init__(self, folder, choosing, best):
        self.folder, self.best = Path(folder), best
        q = choosing.question
        self.folder.mkdir(parents=True, exist_ok=True)
        self.scene_path = self.folder / f"{q.name}.toml"
        scene = choosing.scene_of(best)
        if q.law:
            self.law_path = self.folder / f"{q.law.stem}.law"
            law = q.law.read_text(encoding="utf-8")
            fastest = best["rate_hz"] == choosing.report["rates"][-1]["rate_hz"]
            self._put(self.law_path, law if fastest else made_scene.law_at(law, best["rate_hz"]))
            scene["core"]["law"] = self.law_path.name
        head = [f"{q.name} as `feltgate choose` chose it: {choose_text.in_words(best)}."]
        self.scene = scene
        self._put(self.scene_path, made_scene.toml_text(head, scene))
        self.design_path = best["design"]
        if best["set"]:
            self.design_path = self.folder / f"{best['design']}.toml"
            self._put(self.design_path, choosing.text_of(best))

    def _put(self, path, text):
        outputs.write_whole(path, text)

    def commands(self, choosing):
        """What a user may go on with."""
        q, scene = choosing.question, self.scene_path
        if not self.best["built"]:  # a program of its own, as docs/designs.md has it
            first = [f"cp {self.design_path} rtl/designs/", "./feltgate generate"]
            return [*first, f"./feltgate run {scene} --design {self.best['design']}"]
        found = [f"./feltgate run {scene} --report REPORT" if not q.device else f"./feltgate run {scene}"]
        if not q.device:
            found.append(f"./feltgate design {self.design_path}")
            found.append(f"./feltgate product verilog --design {self.design_path}")
        if q.of_block():
            found.append(f"./feltgate design {self.design_path} --for {scene}")
        else:
            found.append(f"./feltgate law {self.law_path}")
        return found


def armed_check(scene, seconds):
    """Before it is armed, RTL and twin agree about a torque of 0: that verifies nothing."""
    armed_s = max(seconds - scene["core"].get("arm_s", 0.0), 0.0)
    said = {"what": "RTL armed, at least, s", "measured": armed_s, "limit": LEAST_ARMED_S}
    return said | {"holds": armed_s >= LEAST_ARMED_S}


def verified(choosing, files, best, seconds):
    """The choice in RTL and twin: [{what, measured, limit, holds}], and what was run."""
    q = choosing.question
    programs, design = choosing.programs_of(best)
    ask = programs.ask
    kind = "axes" if q.device else q.kind()
    seconds = min(seconds or RTL_SECONDS[kind], files.scene["duration_s"])
    short = files.folder / f".{q.name}_rtl.toml"
    checks = []

    def check(what, measured, limit, holds):
        checks.append({"what": what, "measured": measured, "limit": limit, "holds": bool(holds)})

    short.write_text(made_scene.toml_text([], made_scene.cut(files.scene, seconds)), encoding="utf-8")
    try:
        engines = "rtl" if q.device else "rtl,twin,quad"
        run = ask("run", short, "--design", design, "--engine", engines, "--quiet")
    finally:
        short.unlink()
    check("mismatches between RTL and twin", run["mismatches"], 0, run["mismatches"] == 0)
    checks.append(armed_check(files.scene, seconds))
    _, row = choosing.row_of(best, files.scene_path)
    rms, worst = row["error_rms_nm"], row["error_max_nm"]
    if not q.device:
        core = run["engines"]["rtl"]["torque_nm"]
        held, bound = core["max_error"], core["bound"]
        if bound is None:
            choosing.leave_out("bound of the rounding", "none for this motion; docs/error-bounds.md")
        else:
            check("rounding in the RTL, worst, Nm", held, bound, held <= bound)
        rms, worst = rms + core["rms_error"], worst + max(held, core.get("max_error_outside", 0.0))
    error = best["error"]
    for what, measured, said in (("rms", rms, error["rms_nm"]), ("worst", worst, error["worst_nm"])):
        check(f"torque error, {what}, Nm", measured, said, measured <= said * (1 + SAME))
    if best["margin"] is not None and q.device:
        check("expectations of the scene broken", len(row["broken"]), 0, not row["broken"])
        why = "for several axes it is by eigenvalues alone; the scene's expectations stand beside it"
        choosing.leave_out("margin on the bits", why)
    elif best["margin"] is not None and not best["built"] and best["by"] == "engine" and best["ticks"] == 1:
        choosing.leave_out("margin on the bits", "in each tick only on designs that are built in")
    elif best["margin"] is not None and choosing.report["rates"][-1].get("border_of") == "stiffness":
        words = ("--linear-plant", choosing.plant, "--rate", f"{best['rate_hz']:.9g}")
        words += ("--damping", f"{choosing.report['damping_nm_s_rad']:.9g}")
        border = ask("stability", choosing.of_chain(best, design), *words)["borders"][0]["bits_nm_rad"]
        bits = (border or 0.0) / choosing.report["stiffness_nm_rad"]
        said = best["margin"]["margin"]
        check("margin on the chain's bits", bits, said, abs(bits / said - 1) <= AGREES)
    elif best["margin"] is not None and not best["built"]:
        choosing.leave_out("margin on the bits", "of a law with states only on the designs that are built in")
    elif best["margin"] is not None and choosing.report["rates"][-1].get("border_of") == "torque":
        # Of the law at rest, which may be beside the place of the motion that the margin is for.
        gains = ask("stability", files.scene_path)["scenes"][0].get("gains", [{"bits": None, "why": "none at rest"}])
        bits, linear = gains[0]["bits"], gains[0].get("linear", 0.0)
        if not gains[0].get("large") and not gains[0].get("disagrees"):
            choosing.leave_out("margin on the bits", gains[0]["why"] or "too small a swing to compare")
        else:
            check("margin at rest on the core's bits", bits or 0.0, linear, abs((bits or 0.0) / linear - 1) <= AGREES)
    else:
        why = "the law is nowhere stiff, and it is that of its damping"
        why = best["margin_by"] if best["margin"] is None else why
        choosing.leave_out("margin on the bits", why)
    return {"rtl_s": seconds, "clocks": run["clocks"], "checks": checks}


def answer_of(options, folder):
    programs = Programs(folder, options.quiet)
    wishes = wishes_of(options)
    question = Question(options.scene, programs)
    choosing = Choosing(question, programs, wishes)
    choosing.measure()
    all_of = choosing.alternatives()
    best, front = choice.choose(all_of, wishes)
    while best["set"] and not best["own_motion"]:  # what is recommended runs by itself first
        choosing.run_itself(best)
        best, front = choice.choose(all_of, wishes)
    out = options.output or command_line.build_folder() / "choose" / question.name
    files = Files(out, choosing, best)
    told = {"schema": SCHEMA, "scene": question.name, "title": question.scene["title"]}
    told |= {"law": choosing.report["law"], "made_motion": question.made, "wishes": wishes}
    asked = ("plant", "device", "axes", "largest_nm", "stiffness_nm_rad", "damping_nm_s_rad", "jump_nm")
    told |= {"asked": {k: choosing.report[k] for k in asked if k in choosing.report}}
    told |= {"designs": {"in_table": len(choosing.table), "left_out": choosing.designs_left}}
    told |= {"simulation": choosing.simulation(best), "choice": best, "front": front}
    told |= {"measured": len(all_of), "why_not": choice.why_not(all_of, best, wishes)}
    told |= {"slowest_for_a_host": choosing.for_a_host()}
    told["verified"] = verified(choosing, files, best, options.rtl_seconds)
    told["left_out"] = choosing.left_out
    told["files"] = [str(p) for p in sorted(files.folder.iterdir()) if p.suffix in (".toml", ".law")]
    told["commands"] = files.commands(choosing)
    told["files"].append(str(files.folder / "choose.json"))
    whole = json.dumps(told, indent=1) + "\n"
    outputs.write_whole(files.folder / "choose.json", whole)
    return told, whole


def main(words):
    options = arguments_of(words)
    if options.only_arguments:
        return 0

    def work():
        with tempfile.TemporaryDirectory(prefix="feltgate-choose-") as folder:
            told, whole = answer_of(options, folder)
        if not options.quiet:
            print(choose_text.text(told), flush=True)
        if options.json:
            try:
                outputs.write_whole(options.json, whole)
            except OSError as error:
                raise command_line.Refused(f"--json {options.json}: {error.strerror}; give another file") from error
        unmet = [w for w in told["why_not"] if w["stated"]]
        unverified = [c for c in told["verified"]["checks"] if not c["holds"]]
        return 1 if unmet or unverified else 0

    return command_line.ended(f"feltgate {NAME}", work, tomllib.TOMLDecodeError)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
