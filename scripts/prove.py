#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Properties of blocks, proven for all inputs and all times by k-induction (Yosys, z3).

A proof is a wrapper around a block, NAME.sv in its folder proofs, with assumptions about its
inputs and named assertions. Four kinds of run decide it:

  base        no assertion fails in the first k clocks after a reset
  induction   k clocks in which all hold are followed by one in which they hold, so they always do
  covers      what the assumptions must still allow is reached: the proof is about something
  defect      with a patch of the product (defects.diff beside it) the assertion fails

A counter-example is printed as a table of the wrapper's signals, the failing clock last.
Table, assumptions and what is not proven: docs/testing.md

Exit code: 0 all is proven and every defect is caught, 1 something is not, 2 when a tool, a file or
an argument is wrong.

  feltgate prove                         all proofs
  feltgate prove safety quad_decoder     those of two blocks
  feltgate prove safety.latch            one proof
  feltgate prove --list                  properties, defects and covers; runs nothing
"""

import sys

import command_line
import outputs
from proofs import catalog, record, results, tasks
from proofs.tools import Broken, Tools

SCHEMA = "feltgate-prove/1"


def arguments(argv):
    parser = command_line.parser("prove", __doc__)
    add = command_line
    parser.add_argument(
        "proof", nargs="*", metavar="BLOCK[.NAME]", help="a block or one proof; default: all"
    )
    add.add_flags(
        parser,
        list="what there is; runs nothing",
        fast="only what every test run looks after: short proofs, on their first design",
        changed=f"not those whose inputs are on record as proven, in {record.FILE}",
        record="enter the inputs of proofs that were good into that record",
    )
    what = "only N defects of each proof, spread evenly; 0: base, induction and covers only"
    add.add_number(parser, "--defects", None, what)
    add.add_jobs(parser, "runs")
    add.add_json(parser)
    add.add_keep(parser, "SMT2, logs and VCD")
    add.add_flags(
        parser,
        update="write docs/verification/proofs.json: of all blocks, or of those named here",
    )
    add.add_only_arguments(parser)
    options = parser.parse_args(argv)
    run_only = ("changed", "record", "defects", "keep", "json", "update")
    command_line.refuse_beside(parser, options, "list", *run_only)
    outputs.check(parser, json=options.json)
    command_line.check_keep(parser, options.keep)
    limited = options.fast or options.changed or options.defects is not None
    partly = any("." in name for name in options.proof) or limited
    if options.update and partly:
        parser.error("--update takes whole blocks, with all designs and defects")
    return options


def chosen(proofs, wanted, fast):
    """The proofs of these names, or all; CatalogError where there is none."""

    def unknown(words):
        names = ", ".join(dict.fromkeys(p.block for p in proofs))
        return catalog.CatalogError(f"no proof of {words}; there are those of {names}")

    found = command_line.chosen(proofs, wanted, lambda p: (p.block, p.key), unknown)
    return [p for p in found if p.fast] if fast else found


def print_list(root, proofs):
    """Properties, defects and covers."""
    for proof in proofs:
        designs = ", ".join(proof.designs)
        print(f"{proof.key}  {proof.title} ({designs}){'  [fast]' if proof.fast else ''}")
        for entry in proof.properties:
            print(f"  {entry.name:28} {entry.says}")
            print(f"  {'':28} fails with {entry.defect.relative_to(root)}")
        for name, says in proof.covers.items():
            print(f"  {name:28} is reached: {says}")
    count = sum(len(proof.properties) for proof in proofs)
    print(f"{count} properties in {len(proofs)} proofs of {len({p.block for p in proofs})} blocks")


def prove(options, root, proofs, folder):
    """Runs all tasks; returns the rows of the table."""
    tools = Tools(folder)
    if options.changed:
        known = record.known(root, proofs, options.fast)
        for proof in known:
            print(f"{proof.key}: its inputs are on record as proven")
        proofs = [proof for proof in proofs if proof not in known]
    todo = tasks.plan(proofs, options.defects, options.fast)
    rows = tasks.rows(proofs, options.fast)

    def done(task, result, progress):
        for complaint in tasks.enter(rows, task, result):
            progress.say(complaint)
        return f"{task.proof.key} {task.what}"

    tools.crew.counted("prove", lambda task: task.run(tools, root), todo, options.jobs, done)
    return rows, tools.versions()


def report(options, root, rows, versions):
    """Prints and writes the rows; the exit code."""
    print(results.text_table(rows))
    bad = [row for row in rows if not row.good(options.defects)]
    properties = sum(len(row.proof.properties) for row in rows if row.first)
    print(
        f"{properties} properties, {len(rows)} runs of proofs, {len(bad)} not good; "
        f"{versions['yosys']}, {versions['z3']}"
    )
    result = {"schema": SCHEMA, "tools": versions, "proofs": [row.as_json(root) for row in rows]}
    if options.json:
        outputs.write_json(options.json, result)
    if options.record:
        record.write(root, [row for row in rows if row not in bad], versions)
    if options.update and not bad:
        results.write(root, result)
        print("prove: wrote docs/verification/proofs.json")
    elif options.update:
        print("prove: docs/verification/proofs.json stays as it was, for not all is good")
    return 1 if bad else 0


def run(options):
    """The exit code."""
    root = command_line.root()
    everything = catalog.read(root)
    proofs = chosen(everything, options.proof, options.fast)
    if options.only_arguments:
        return 0
    if options.list:
        print_list(root, proofs)
        return 0
    with outputs.kept_or_temporary(options.keep, "prove") as folder:
        rows, versions = prove(options, root, proofs, folder)
    return report(options, root, rows, versions)


def main(argv=None):
    options = arguments(argv)
    return command_line.ended("prove", lambda: run(options), Broken)


if __name__ == "__main__":
    sys.exit(main())
