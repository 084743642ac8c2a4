#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What five papers claim, beside a closed form and a simulation, with a verdict.

Each claim comes with its place in the paper, the closed form with the paper's own numbers, a
simulation where one can judge it, and a verdict from the figures: holds, holds if, cannot be had."""
import difflib
import re
import sys

import command_line
import outputs
from paper_claims import lever, others

EPILOG = """  feltgate claims                          every claim, in ten seconds
  feltgate claims window half_nm_of_7_a    only these
  feltgate claims --markdown > claims.md
Exit code: 0 whatever the verdicts, 2 unusable input."""
# By the first word of a claim's place.
PAPERS = {
    "Lever": ("The Haptic Lever", "A. G. Rodríguez Ramírez et al., *Haptic Augmentation Towards a Smart Learning Environment*"),
    "Wrist": ("A wrist device", "*Virtual Reality Haptics*: a wearable haptic device, shown on a virtual drum kit"),
    "Hunt": ("Haptic Hunt", "A. Aranzola et al., *Haptic Hunt: a pantograph rendering of complex shapes*, 2026"),
    "TouchWorld": ("TouchWorld", "A. Sadirova et al., *Haptic Exploration of AI-Generated 3D Environments*, 2026"),
    "DIMPLE": ("DIMPLE and textures", "A report on work from March to September 2008: DIMPLE, ERGOS, bowing, textures")}
PAGE = """# What five papers claim, and what their own numbers say

Written by `./feltgate claims --markdown`. A row's simulation is the twin of the core in closed loop with the plant,
unless the row says otherwise; nothing ran on a board. A dash: no simulation can judge the claim. **Holds if**: under the
condition of the last column, which the paper does not state.
"""


# A claim is a function. Its docstring has its texts, and what it gives as `what | unit | what is asked`. It returns a value
# for each of these: the closed form, or (closed form, simulation), of which one may be None; or these and the width of near.
CLAIMS = {name: thing for name, thing in {**vars(lever), **vars(others)}.items()
          if callable(thing) and (thing.__doc__ or "").startswith("claim: ")}


def texts_of(name):
    """The docstring of a claim by its keys; the first word of `where` is the paper."""
    parts = re.split(r"(?m)^ *(claim|where|closed_form|simulation|why|gives): ", CLAIMS[name].__doc__)
    texts = {"name": name} | {key: " ".join(text.split()) for key, text in zip(parts[1::2], parts[2::2])}
    texts["paper"], _, texts["where"] = texts["where"].partition(", ")
    return texts, filter(None, texts.pop("gives", "").split("; "))


def figures_of(name):
    figures = []
    for entry, value in zip(texts_of(name)[1], CLAIMS[name](), strict=True):
        what, unit, asked = ([word.strip() for word in entry.split("|")] + ["", ""])[:3]
        closed, simulated, *width = value if isinstance(value, tuple) else (value, None)
        figures.append({"what": what, "unit": unit, "closed_form": closed, "simulated": simulated, "asked": "nothing"})
        if asked:
            condition, kind, limit, within = re.fullmatch(r"(if )?(near|at most|at least) (\S+)(?: ± (.*))?", asked).groups()
            limit, within = float(limit), float(within or sum(width))
            met = [abs(x - limit) <= within if kind == "near" else x <= limit if kind == "at most" else x >= limit
                   for x in (closed, simulated) if x is not None]
            figures[-1] |= {"asked": kind.replace(" ", "_"), "value": limit, "within": within, "conditional": bool(condition),
                            "agrees": bool(met) and all(met)}
    return figures


def verdict(figures):
    """It holds if all figures without a condition agree, else "holds if" where all of those with one do."""
    for conditional, name in ((False, "holds"), (True, "holds if")):
        agree = [f["agrees"] for f in figures if f.get("conditional") is conditional]
        if agree and all(agree):
            return name
    return "cannot be had"


def told(name, figures):
    """The texts, with the verdict and the figures of both columns."""
    texts = texts_of(name)[0] | {"verdict": verdict(figures)}
    for column, digits in (("closed_form", 5), ("simulation", 4)):
        key = column.replace("simulation", "simulated")
        values = [f"{f['what']}: {f[key]:.{digits}g} {f['unit']}".strip() for f in figures if f[key] is not None]
        texts[column] = ". ".join(part for part in (texts[column], "; ".join(values)) if part)
    return texts


def text_of(name, figures):
    text = "{name}: {verdict}\n  claim       {claim} ({where})\n  closed form {closed_form}\n  simulation  {simulation}\n" \
        "  why         {why}\n".format(**told(name, figures))
    return re.sub(r"\[([^\]]*)\]\(([^)#]*)[^)]*\)", r"\1 (docs/\2)", text)  # a link of the page becomes a path


def summary(found):
    verdicts = [verdict(figures) for figures in found.values()]
    hold, hold_if, rest = (verdicts.count(name) for name in ("holds", "holds if", "cannot be had"))
    return f"{len(verdicts)} claims: {hold} hold, {hold_if} hold under a condition, {rest} cannot be had."


def page(found):
    lines = [PAGE, summary(found)]
    for paper, (title, source) in PAPERS.items():
        lines += [f"\n## {title}\n\n{source}\n\n| claim | where | closed form | simulation | verdict |\n|---|---|---|---|---|"]
        lines += ["| `{name}`: {claim} | {where} | {closed_form} | {simulation} | **{verdict}**{colon} {why} |".format(
            colon="" if texts["verdict"] == "holds if" else ":", **texts)
                  for texts in (told(*row) for row in found.items()) if texts["paper"] == paper]
    return "\n".join(lines)


def as_json(found):
    rows = [texts_of(name)[0] | {"verdict": verdict(figures), "figures": figures} for name, figures in found.items()]
    return {"schema": "feltgate-claims/1", "claims": [row | {"paper": PAPERS[row["paper"]][0]} for row in rows]}


def work(options):
    for name in options.claims:
        if name not in CLAIMS:
            hint = "".join(f"did you mean {close}? " for close in difflib.get_close_matches(name, CLAIMS, 1))
            raise command_line.Refused(f'claim "{name}" is unknown; {hint}choose among {", ".join(CLAIMS)}')
    found = {name: figures_of(name) for name in CLAIMS if name in options.claims or not options.claims}
    print(page(found) if options.markdown else "\n".join([*(text_of(*row) for row in found.items()), summary(found)]))
    if options.json:
        outputs.write_json(options.json, as_json(found))
    return 0


def main():
    parser = command_line.parser("claims", __doc__, EPILOG)
    parser.add_argument("claims", nargs="*", metavar="CLAIM", help="claims; all when none is named")
    command_line.add_path(parser, "--json", what="the table as JSON (docs/json.md)")
    command_line.add_flags(parser, markdown="print a page of all claims instead")
    options = parser.parse_args()
    if options.markdown and options.claims:
        parser.error("--markdown prints all claims: leave their names away")
    outputs.check(parser, json=options.json)
    return command_line.ended("feltgate claims", lambda: work(options))


if __name__ == "__main__":
    sys.exit(main())
