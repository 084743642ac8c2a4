# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""How each command line of the pages is run by commands_test.py: the first rule that matches."""

import re
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Rule:
    """WHOLE: as it stands, in the sandbox with its short scenes. MORE: with more words, which make
    it shorter. PARSED: a Python script's options are read, then it ends. LAUNCHER: the same for
    the launcher's own subcommand. NAMED: programs that may not be here; the files, scripts and
    CMake options that the line names must be there. BY: the test named in `more` runs it; the
    name may hold what the pattern's group found."""

    pattern: str
    how: str
    more: str = ""
    status: tuple = (0,)

    def of(self, words):
        """The rule for these words, or None where the pattern is another's."""
        found = re.match(rf"(?:\./)?(?:{self.pattern})(?:\s|$)", words)
        return found and replace(self, more=found.expand(self.more))


RULES = (
    # 2: what the page says of this line is that it is refused.
    Rule(r"feltgate run torque_step --set voltage_gain=0\.6", "WHOLE", status=(2,)),
    # The launcher gives this one a design with an engine too.
    Rule(
        r"feltgate run (?:detent|my_scene\.toml --set amplitude\S*)",
        "BY",
        "scene.detent.lever_law",
    ),
    Rule(r"feltgate run texture.*", "BY", "scene.texture.pantograph_law"),
    Rule(r"feltgate run (\w+) --design gimbal_motor --torque-scale 0\.1", "BY", r"scene.\1.gimbal_motor"),
    Rule(r"feltgate run (\w+) --design hall_motor --torque-scale 0\.4", "BY", r"scene.\1.hall_motor"),
    Rule(r"feltgate texture .*--table", "BY", "texture.command"),
    Rule(r"feltgate run plane_floor.*", "BY", "scene.plane_floor.pantograph_law"),
    Rule(r"feltgate run stylus_(?:floor|sphere|cube|edge)", "BY", "stylus_test"),
    Rule(r"feltgate run gimbal", "BY", "gimbal_run_test"),
    Rule(r"feltgate run plane_circle.*", "BY", "local_plane_test"),
    Rule(r"feltgate run (?:pantograph_floor|hidden_shapes).*", "BY", "axes_run_test"),
    Rule(r"feltgate run pantograph_wall.*", "BY", "pantograph_wall_test"),
    Rule(r"feltgate run coupled_levers.*", "BY", "coupled_levers_test"),
    Rule(r"feltgate run material_stone --set dynamic=0\.4", "BY", "tracked_test"),
    Rule(r"feltgate run (?:bowed_string|four_strings|slow\.toml).*--states", "BY", "bowed_string.sound"),
    Rule(r"feltgate run (?:wall|ceiling)_tracked", "BY", "tracked_test"),
    # Scenes of a law, which the launcher gives a design with an engine.
    Rule(
        r"feltgate run (attraction|bowed_string|ceiling|collision|cut_string|drums|end_stops|end_stops_thrown|flywheel"
        r"|four_strings|graded_membrane|lump|material_(?:fields|object|stick_slip|stone)|moved_detents|pendulum"
        r"|scroll_wheel|throttle|turn_switch)",
        "BY",
        r"scene.\1.lever_law",
    ),
    Rule(r"feltgate (?:run|replay|import|design|law|shape|texture)", "WHOLE"),
    Rule(r"feltgate generate", "WHOLE"),
    # 1: of a scene of milliseconds there may be nothing to leave out.
    Rule(r"feltgate trim (detent|coupled_levers)$", "BY", "choose.command"),
    Rule(r"feltgate trim", "MORE", "--unseen 1 --jobs 1", status=(0, 1)),
    Rule(r"feltgate stability (?:SCENE|wall_tracked|ceiling)", "BY", "rates.command"),
    Rule(r"feltgate stability .*--rate", "WHOLE"),
    Rule(r"feltgate stability", "MORE", "--rate 490 --damping 0.002 --no-experiments"),
    Rule(r"feltgate rates", "BY", "rates.command"),
    Rule(r"feltgate controllers", "BY", "controllers.command"),
    Rule(r"feltgate claims", "BY", "claims"),
    Rule(r"feltgate choose", "BY", "choose.command"),
    Rule(r"feltgate extremes", "MORE", "--list"),
    Rule(r"feltgate bench(?: --quick| --engine rtl.*)?$", "BY", "bench.command"),
    Rule(r"feltgate bench", "MORE", "--quick --engine twin_event"),
    Rule(r"feltgate explore page vectors/spaces/trade\.csv", "WHOLE"),
    Rule(
        r"feltgate (?:explore|synth|prove|product|page|mutate|faults|coverage|demo|figures|docs)",
        "PARSED",
    ),
    Rule(r"feltgate touch", "BY", "touch_test"),
    Rule(r"feltgate board", "BY", "board.host"),
    Rule(r"feltgate host .*\b(?:calibrate|identify)", "BY", "calibrate.verbs"),
    Rule(r"feltgate host .*(?: law|/tmp/knob|events)", "BY", "host.laws"),
    Rule(r"feltgate host:?", "BY", "host.verbs"),
    Rule(r"feltgate test", "LAUNCHER"),
    Rule(r"ctest", "MORE", "-N"),
    Rule(r"scripts/check_blocks\.py", "WHOLE"),
    Rule(r"scripts/drums_sound\.py", "BY", "report.drums_sound_test"),
    Rule(r"scripts/bowed_string_sound\.py|sed 's/.*slow\.(?:law|toml)", "BY", "bowed_string.sound"),
    # The first sets FILES, which is left out as of an environment.
    Rule(r"rtl/generated/lever/feltgate_pkg\.sv \$\(sed|verilator|iverilog|yosys|for f in", "BY", "flow.instantiate"),
    # A defect of one's own: the lines that follow copy and build it.
    Rule(r"file=testbench/wave/mult/defects\.diff|\{ printf", "BY", "repository.defects"),
    Rule(r"scripts/defects\.py copy", "BY", "repository.defects"),
    Rule(r"(?:cp|mv|cd|git checkout|quartus_sh|openFPGALoader)", "NAMED"),
    Rule(r"c\+\+ -std=c\+\+17 -Imodel/include docs/examples/tick_loop\.cpp", "WHOLE"),
    Rule(r"a\.out", "WHOLE"),
    Rule(r"cmake -S \. -B build|cmake --preset", "NAMED"),
    Rule(r"cmake -S \. -B build-aarch64", "BY", "aarch64"),
    Rule(r"cmake -S \. -B build-library|cmake --(?:build|install)", "BY", "package"),
    Rule(r"sudo apt-get install", "NAMED"),
    Rule(r"fusesoc .*--target (?:lint|sim)", "BY", "neighbours.fusesoc"),
    Rule(r"python docs/examples/litex_soc\.py", "BY", "neighbours.litex"),
    Rule(r"python docs/examples/cocotb/test_axi\.py", "BY", "neighbours.cocotb"),
    Rule(r"python docs/examples/mujoco_lever\.py", "BY", "plant.mujoco"),
    Rule(r"python3 testbench/apps/page/(?:chromium|string_tab|knob_tab)_test\.py", "NAMED"),
    Rule(r"(?:python3 -m venv|(?:venv/bin/)?pip install)", "BY", "python.pip"),
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
    "texture FILE.png": "vectors/textures/ripples.png",
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
    return next(filter(None, (rule.of(words) for rule in RULES)), None)


def filled(words):
    """The list of words, placeholders replaced by something that is there."""
    done = []
    for word in words:
        pair = f"{done[-1] if done else ''} {word}"
        known = PLACEHOLDERS | ({} if "design" in words else BUILT_ON_DEMAND)
        done.append(known.get(pair, word))
    return done
