#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Faults: what becomes of a flipped bit, a broken wire or a wrong word, and what the hand would
feel of it.

A core of design lever acts in closed loop with motor, lever and a hand (wall, spring, damper,
membrane, setpoint, charge, free, disarmed). Beside it a sound core sees the same lever. Three
points of injection:

  state       each flip-flop and each word of a parameter flips for one clock, in the Verilated RTL
  pins        encoder channels dead, open, shorted, swapped, glitches, index, over-speed, stop; the
              twin
  words       wrong bits and garbage at the register port while armed; the twin

--design lever_current, lever_absolute, gimbal_motor, gimbal_current or hall_motor breaks what these
have at their pins instead: the current's sensors, the driver, the winding and its gates; the absolute
encoder, a phase, the offset of the electrical angle, Hall lines. There a setpoint acts in a hand
that holds or turns the shaft (a wall too where a position is wrong), and the sound core has a motor
of its own.

Each fault ends in one class:

  masked      no output ever differed, the state is the sound one again
  latent      nothing is wrong that acts, but the state still differs
  transient   outputs differed, too little or too shortly, and are right again
  off         gates off, disarmed, no fault latched
  detected    a fault is latched, the gates are off
  silent      torque off by more than 5 % of the limit for more than 1 ms, or the position wrong for
              ever, unflagged
  unsafe      both switches of a leg on for more than a clock, or the motor's torque beyond 1.2
              times the limit for more than 1 ms

Peak and integral are those of the torque's deviation, from the fault to the gates off. Beside a
zero stands its 95 % bound, about 3/N. With --design, "off us" is the latest time to the gates off
and "motor Nm" the motor's largest torque, means of a PWM period. Results and what this does not
say: docs/testing.md

Exit code: 0 what is promised is kept (none unsafe but where nothing sees the fault, a cut cable
say; at most 1 % of single flips silent, 99 % flagged of the faults that docs/safety.md
says so of; with --clean no alarm; with --replay each case as listed), 1 it is not, 2 when a
program, a file or an argument is wrong.

  feltgate faults                        the whole campaign, more than 10 000 faults
  feltgate faults --flips 1 --pins 200   a smaller one
  feltgate faults --design lever_current   20 faults of each kind at its own pins
  feltgate faults --only u_pwm           flips of registers with this in their name
  feltgate faults --clean                false alarms: ten minutes of device time without a fault
  feltgate faults --clean --long         24 hours of it
  feltgate faults --clean --design lever_current   one minute of it, in closed loop
  feltgate faults --replay vectors/faults/cases.jsonl
"""

import json
import os
import sys
from pathlib import Path

import block_results
import command_line
import outputs
import rtl_sources
from fault_campaign import campaign, results
from reports.progress import Steps

SCHEMA = "feltgate-faults/1"
CLEAN_S, DAY_S = 600, 86400
# What tells two cases apart.
CASE = (
    "point design group seed register bit address register_2 bit_2 address_2 "
    "act tick clock reset_clocks"
).split()


def arguments(argv):
    parser = command_line.parser("faults", __doc__)
    add = command_line
    add.add_number(parser, "--flips", 2, "flips of each bit")
    add.add_number(parser, "--doubles", 600, "flips of two bits at once")
    add.add_number(parser, "--pins", 2000, "faults at pins and register port")
    what = "whose pins are broken, lever or one of those above; a hundredth of --pins is of each"
    what += " kind where it is not lever"
    parser.add_argument("--design", default="lever", metavar="DESIGN", help=what)
    what = "flips of registers with this in their name only"
    parser.add_argument("--only", default="", metavar="NAME", help=what)
    add.add_number(parser, "--seed", 1, "of all that is drawn")
    add.add_jobs(parser, "programs")
    add.add_flags(
        parser,
        clean="device time without a fault instead: false alarms",
        long="with --clean: 24 hours, two or three of CPU time; of another design than lever a tenth",
    )
    add.add_path(parser, "--replay", what="the listed cases instead")
    what = "tell of the lines that --save kept; runs nothing"
    add.add_path(parser, "--lines", nargs="+", what=what)
    add.add_path(parser, "--save", what="a line of JSON for each fault")
    add.add_json(parser)
    add.add_path(parser, "--picture", what="what the hand would feel, as SVG or PNG")
    add.add_flags(parser, update=f"put the results into {block_results.FOLDER}/faults.json")
    options = parser.parse_args(argv)
    written = {name: getattr(options, name) for name in ("json", "save", "picture")}
    outputs.check(parser, [options.replay, *(options.lines or ())], **written)
    if options.picture and options.picture.suffix not in (".svg", ".png"):
        parser.error("argument --picture: the name of a file that ends in .svg or .png")
    if options.long and not options.clean:
        parser.error("--long goes with --clean")
    if sum(map(bool, (options.clean, options.replay, options.lines))) > 1:
        parser.error("--clean, --replay and --lines exclude each other")
    if (options.clean or options.replay) and (options.save or options.picture):
        parser.error("--save and --picture tell of a campaign, not of --clean or --replay")
    if options.design != "lever" and (options.replay or options.only):
        parser.error("--replay and --only are of lever: leave --design out")
    if options.update and options.design != "lever":
        parser.error("--update takes a campaign of lever")
    if options.update and (options.only or options.clean or options.replay or not options.flips):
        parser.error("--update takes a campaign of all registers")
    return options


def lines_of(build, arguments_, jobs, total):
    """All lines of feltgate_faults; `total` is about how many, None where nobody knows."""
    program = build / "feltgate_faults"
    if not program.exists():
        raise campaign.CampaignError(
            f"there is no {program}; the build makes it where yosys is installed"
        )
    shares = {}
    with Steps("faults", total) as progress:

        def told(part, line):
            if "done" in line:  # a share of the part's work
                shares[part] = line["done"]
                progress.step("", total * sum(shares.values()) / jobs)
            elif "class" in line:
                progress.step(line["group"])

        return campaign.run(program, arguments_, jobs, told)


def clean(options, build):
    """Device time without a fault; the exit code."""
    seconds = DAY_S if options.long else CLEAN_S
    if options.design != "lever":
        seconds /= 10  # they run clock by clock
    words = ["--clean", seconds, "--seed", options.seed, "--design", options.design]
    lines = lines_of(build, words, options.jobs, 1)
    parts = [line for line in lines if "clean_s" in line]
    if len(parts) != options.jobs:
        raise campaign.CampaignError(
            f"{options.jobs - len(parts)} of {options.jobs} parts said nothing"
        )
    total = {
        key: sum(p[key] for p in parts)
        for key in ("clean_s", "scenes_s", "recordings_s", "dither_s", "alarms")
    }
    print(
        f"{total['clean_s']:.0f} s of device time without a fault: "
        f"{total['scenes_s']:.0f} s of scenes in closed loop, "
        f"{total['recordings_s']:.0f} s of recordings, "
        f"{total['dither_s']:.0f} s of dither, strokes and rest"
    )
    hours = total["clean_s"] / 3600
    print(
        f"{total['alarms']} false alarms"
        + (f" (< {3 / hours:.2g} an hour)" if not total["alarms"] else "")
    )
    for part in parts:
        if part["first"]:
            print(f"  {part['first']}")
    if options.json:
        outputs.write_json(options.json, {"schema": SCHEMA, "clean": total})
    return 1 if total["alarms"] else 0


def replay(options, build):
    """The listed cases again; the exit code."""
    cases = campaign.read(options.replay)
    lines = lines_of(build, ["--replay", options.replay.resolve()], 1, len(cases))

    def key(fault):
        return tuple(str(fault.get(name)) for name in CASE)

    found = {key(line): line["class"] for line in lines if "class" in line}
    differing = [
        (case, found.get(key(case))) for case in cases if found.get(key(case)) != case["class"]
    ]
    for case, now in differing:
        print(f"listed as {case['class']}, now {now}: {json.dumps(case)}")
    print(f"{len(cases)} cases, {len(differing)} other than listed")
    if options.json:
        listed = [{"listed": case, "now": now} for case, now in differing]
        outputs.write_json(
            options.json, {"schema": SCHEMA, "replay": {"cases": len(cases), "differing": listed}}
        )
    return 1 if differing else 0


def report(options, root, faults, seconds):
    """Table, promises and files; the exit code."""
    rows = results.rows_of(faults)
    timed = any("design" in fault for fault in faults)
    print(results.text_table(rows, timed))
    kept = results.promises(faults)
    print()
    for what, count, of, good in kept:
        print(f"{what}: {count} of {of}, {results.bound(count, of)}{'' if good else '   NOT KEPT'}")
    if options.save:
        outputs.write_whole(options.save, "".join(json.dumps(f) + "\n" for f in faults))
    if options.json:
        result = {
            "schema": SCHEMA,
            "seed": options.seed,
            "design": options.design,
            "faults": len(faults),
            "rows": [row.as_json() for row in rows],
            "promises": [{"what": w, "count": c, "of": n, "kept": g} for w, c, n, g in kept],
        }
        outputs.write_json(options.json, result)
    if options.picture:
        from fault_campaign import picture  # matplotlib only where it is asked for

        outputs.write_whole(options.picture, picture.draw(faults, options.picture.suffix[1:]))
    if options.update:
        blocks = {rtl_sources.measured_as(Path(name).stem) for name in rtl_sources.core_files(root)}
        found = results.per_block(faults, blocks)
        if seconds:  # of all faults; what a block's share of it is nobody knows
            found.setdefault("feltgate_core", {})["seconds"] = round(seconds)
        block_results.write(root, "faults", "./feltgate faults --update", found)
        print(f"faults: wrote {block_results.path_of(root, 'faults')}")
    return 0 if all(good for *_, good in kept) else 1


def injected(options, build):
    """(faults, seconds of CPU time) of a campaign."""
    asked = {name: getattr(options, name) for name in ("flips", "doubles", "pins", "seed")}
    if options.design == "lever":
        asked |= {"resets": options.pins // 10} | ({"only": options.only} if options.only else {})
    else:
        asked = {"design": options.design, "pins": options.pins, "seed": options.seed}
    # Near enough for a percentage; how many registers have a name nobody knows before.
    total = 5900 * options.flips + options.doubles + options.pins
    words = [word for name, value in asked.items() for word in (f"--{name}", value)]
    before = os.times()
    known = not options.only and options.design == "lever"
    lines = lines_of(build, words, options.jobs, total if known else None)
    spent = [after - was for after, was in zip(os.times(), before)]
    broken = [line["mismatches"] for line in lines if line.get("mismatches")]
    if broken:
        raise campaign.CampaignError(
            f"RTL and twin differed in {sum(broken)} ticks without any fault"
        )
    return [line for line in lines if "class" in line], spent[2] + spent[3]


def run(options):
    """The exit code."""
    root, build = command_line.root(), command_line.build_folder()
    if options.clean:
        return clean(options, build)
    if options.replay:
        return replay(options, build)
    if options.lines:
        faults, seconds = [f for path in options.lines for f in campaign.read(path)], 0
    else:
        faults, seconds = injected(options, build)
    if not faults:
        raise campaign.CampaignError("no fault was asked for; --flips, --doubles or --pins above 0")
    return report(options, root, faults, seconds)


def main(argv=None):
    options = arguments(argv)
    return command_line.ended("faults", lambda: run(options))


if __name__ == "__main__":
    sys.exit(main())
