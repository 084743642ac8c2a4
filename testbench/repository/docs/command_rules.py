# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""How each command line of the pages is run by commands_test.py: the first rule that matches."""

import re
from dataclasses import dataclass

from reports import runs


@dataclass(frozen=True)
class Rule:
    """WHOLE: as it stands, in the sandbox with its short scenes. MORE: with more words, which make
    it shorter. PARSED: a Python script's options are read, then it ends. LAUNCHER: the same for
    the launcher's own subcommand. NAMED: programs that may not be here; the files, scripts and
    CMake options that the line names must be there. ELSEWHERE: another test runs it."""

    pattern: str
    how: str
    more: str = ""
    status: tuple = (0,)


RULES = (
    # 2: what the page says of this line is that it is refused.
    Rule(r"feltgate run torque_step --set voltage_gain=0\.6", "WHOLE", status=(2,)),
    # Of designs that are built when they are named: scene.SCENE.DESIGN and the tests of the devices.
    Rule(r"feltgate run .*--(?:torque-scale|states)", "ELSEWHERE"),
    Rule(r"feltgate run my_scene\.toml --set amplitude\S*", "ELSEWHERE"),
    Rule(r"feltgate (?:run|replay|import|design|law|shape|texture|generate)", "WHOLE"),
    # 1: of a scene of milliseconds there may be nothing to leave out.
    Rule(r"feltgate trim (?:detent|coupled_levers)$", "ELSEWHERE"),
    Rule(r"feltgate trim", "MORE", "--unseen 1 --jobs 1", status=(0, 1)),
    Rule(r"feltgate stability (?:SCENE|wall_tracked|ceiling)", "ELSEWHERE"),
    Rule(r"feltgate stability .*--rate", "WHOLE"),
    Rule(r"feltgate stability", "MORE", "--rate 490 --damping 0.002"),
    Rule(r"feltgate extremes", "MORE", "--list"),
    Rule(r"feltgate bench(?: --quick| --engine rtl.*)?$", "ELSEWHERE"),
    Rule(r"feltgate bench", "MORE", "--quick --engine twin_event"),
    Rule(r"feltgate explore page vectors/spaces/trade\.csv", "WHOLE"),
    Rule(r"feltgate (?:explore|synth|prove|product|page|mutate|faults|coverage|demo|figures|docs)", "PARSED"),
    Rule(r"feltgate test", "LAUNCHER"),
    Rule(r"feltgate (?:rates|controllers|claims|choose|touch|board|host):?", "ELSEWHERE"),
    Rule(r"ctest", "MORE", "-N"),
    Rule(r"scripts/check_blocks\.py", "WHOLE"),
    Rule(r"scripts/(?:drums|bowed_string)_sound\.py|sed 's/.*slow\.(?:law|toml)", "ELSEWHERE"),
    # flow.instantiate; the first sets FILES, which is left out as of an environment.
    Rule(r"rtl/generated/lever/cfg\.sv \$\(sed|verilator|yosys|for f in", "ELSEWHERE"),
    Rule(r"scripts/defects\.py copy", "ELSEWHERE"),
    Rule(r"(?:cp|mv|cd|git checkout|quartus_sh|openFPGALoader|sudo apt-get install)", "NAMED"),
    Rule(r"c\+\+ -std=c\+\+17 -Imodel/include docs/examples/tick_loop\.cpp", "WHOLE"),
    Rule(r"a\.out", "WHOLE"),
    Rule(r"cmake -S \. -B build|cmake --preset", "NAMED"),
    Rule(r"cmake -S \. -B build-\w+|cmake --(?:build|install)|fusesoc|python docs/examples/\S+", "ELSEWHERE"),
    Rule(r"python3 testbench/apps/page/\w+_test\.py", "NAMED"),
    Rule(r"(?:python3 -m venv|(?:venv/bin/)?pip install)", "ELSEWHERE"),
)

# Words that stand for something, by the word before them.
PLACEHOLDERS = {
    "design NAME": "lever",
    "design DESIGN": "lever",
    "design FILE": "my_design.toml",
    "design mine.toml": "my_design.toml",
    "--design NAME": "lever",
    "--design D": "lever",
    "--design FILE.toml": "my_design.toml",
    "--output DIR": "out",
    "-o DIR": "out",
    "--report DIR": "out",
    "--record FILE": "recorded.vec",
    "--design my.toml": "my_design.toml",
    "--plant P": "p24",
    "--plant PLANT": "p24",
    "--for-plant PLANT": "p24",
    "--nominal-current AMPERES": "5.77",
    "--for SCENE": "membrane",
    "--for SCENE...": "membrane",
    "run NAME": "wall",
    "law NAME": "wall",
    "law ./fish.law": "wall",
    "shape FILE.svg": "vectors/shapes/square.svg",
    "texture FILE.png": "vectors/textures/valley.png",
    "run SCENE": "wall",
    "point FILE": "my_design.toml",
}
# Engines that the launcher builds when a line names them; here they are not there.
BUILT_ON_DEMAND = {f"stability {name}": "lever" for name in ("lever_absolute", "mine")}
BUILT_ON_DEMAND |= {
    f"--design {name}": "lever"
    for name in ("fast", "balanced", "exact", "first_power", "lever_absolute", "lever_current",
                 "lever_law", "lever_observer", "knob_law", "gimbal_motor", "gimbal_current",
                 "hall_motor", "mine")
}


def rule_of(words):
    """The first rule that matches, or None."""
    scene = re.match(r"(?:\./)?feltgate run (\w+)(?:\s|$)", words)
    if scene and (runs.SCENES / f"{scene[1]}.toml").exists() and runs.design_of(scene[1]) != "lever":
        return Rule("", "ELSEWHERE")
    return next((rule for rule in RULES if re.match(rf"(?:\./)?(?:{rule.pattern})(?:\s|$)", words)), None)


def filled(words):
    """The list of words, placeholders replaced by something that is there."""
    done = []
    for word in words:
        pair = f"{done[-1] if done else ''} {word}"
        known = PLACEHOLDERS | ({} if "design" in words else BUILT_ON_DEMAND)
        done.append(known.get(pair, word))
    return done
