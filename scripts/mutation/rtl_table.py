# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The results of the RTL's mutants, for a terminal."""

from reports.columns import aligned

from . import rtl

HEAD = (
    "test",
    "database",
    "mutants",
    "killed",
    "by proof",
    "proven same",
    "argued same",
    "gaps",
    "not listed",
    "killed of rest",
    "s of CPU",
)


def table(rows):
    """The rows, for a terminal."""
    lines = [HEAD]
    for row in rows:
        lines.append(
            (
                row.test.name,
                row.test.database,
                row.tried(),
                row.count(*rtl.DEAD),
                row.of(rtl.BY_PROOF),
                row.equivalent(),
                row.of(rtl.ARGUED),
                row.of(rtl.GAP),
                row.of(""),
                f"{100 * row.share():.1f} %",
                f"{row.seconds:.0f}",
            )
        )
    return aligned(lines)


def print_survivors(rows, known):
    """Those that are not listed, or all (`known`), with the lines of their source."""
    for row in rows:
        for mutant in row.survivors():
            kind, why = row.listed.entry(mutant)
            if kind and not known:
                continue
            verdict, said = row.proofs.get(mutant["number"], ("not tried", ""))
            print(
                f"{row.test.name} {mutant['number']}: {rtl.says(mutant)}; {verdict}, {said}"
                f"{f'; {kind}: {why}' if kind else ''}"
            )
            for line in rtl.where(row.listed.root, mutant):
                print(f"    {line}")
