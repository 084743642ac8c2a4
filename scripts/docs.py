#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The pages as a static site with search, and the generated tables that no page of docs/ has: help of all
commands, list of proofs, results of each block, areas, figures that tests measured, extremes, claims."""

import argparse
import http.server
import functools
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import block_results
import check_blocks
import command_line
import synth_budget
import synth_report

EPILOG = """  feltgate docs              writes build/docs/site/index.html
  feltgate docs --serve      the same, at http://localhost:8000
Exit code: 0 written, 2 unusable input, or mkdocs failed."""


def proofs(root):
    done = subprocess.run([sys.executable, "-B", root / "scripts/prove.py", "--list"], check=True, text=True,
                          stdout=subprocess.PIPE, env=os.environ | {"FELTGATE_ROOT": str(root)})
    return f"What `./feltgate prove` proves; each property must fail with the defect named.\n\n```text\n{done.stdout}```\n"


def results(root):
    names = [block.name for block in check_blocks.find_blocks(root)]
    return "What was measured of each block.\n\n" + "\n".join(block_results.table(root, names))


def figures(root):
    tables = (root / "testbench/studies/controllers/tables.md").read_text(encoding="utf-8")
    measured = (root / "testbench/campaigns/figures.md").read_text(encoding="utf-8").partition("\n\n")[2]
    return f"{measured}\n## tables\n\n{tables}"


def tables(root):
    """{name: (title, text)} of the generated pages."""
    def text(path):
        return (root / path).read_text(encoding="utf-8").partition("\n")[2]

    yield "commands", "Commands", text("scripts/help.txt").partition("\n")[2]
    yield "proofs", "Proofs", proofs(root)
    yield "results", "Results of each block", results(root)
    yield "areas", "Areas and clocks", synth_report.generated(synth_budget.read(root / synth_budget.FILE))
    yield "figures", "Figures of the tests", figures(root)
    yield "extremes-table", "Extremes, every case", text("testbench/campaigns/extremes/table.md")
    if (root / "testbench/studies/claims/claims.md").exists():
        yield "claims-table", "Claims, every row", text("testbench/studies/claims/claims.md")


def own_links(text, page, folder):
    """The text with the links that leave the site as plain words."""
    def link(found):
        target = found[2].partition("#")[0]
        inside = not target or "://" in target or (page.parent / target).resolve().is_relative_to(folder.resolve())
        there = not target or "://" in target or (page.parent / target).exists()
        return found[0] if inside and there else f"`{found[1]}`" if "`" not in found[1] else found[1]

    return re.sub(r"(?<!!)\[([^\]\[]+)\]\(([^)\s]+)\)", link, text)


def write_pages(root, folder):
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(root / "docs", folder, ignore=shutil.ignore_patterns("verification", "*.ipynb"))
    listed = ["# Generated tables\n"]
    for name, title, text in tables(root):
        (folder / f"{name}.md").write_text(f"# {title}\n\n{text}", encoding="utf-8")
        listed.append(f"- [{title}]({name}.md)")
    index = folder / "index.md"
    index.write_text(index.read_text(encoding="utf-8") + "\n" + "\n".join(listed).replace("# G", "## G") + "\n", encoding="utf-8")
    for page in folder.rglob("*.md"):
        page.write_text(own_links(page.read_text(encoding="utf-8"), page, folder), encoding="utf-8")


def run(options):
    root = command_line.root()
    folder = options.output or Path(os.environ.get("FELTGATE_BUILD", root / "build"), "docs")
    pages, site = (folder / "pages").resolve(), (folder / "site").resolve()
    write_pages(root, pages)
    where = os.environ | {"FELTGATE_DOCS": str(pages), "FELTGATE_SITE": str(site)}
    words = ["mkdocs", "--quiet", "build", "--clean", "--strict", "--config-file", str(root / "scripts/mkdocs.yml")]
    if subprocess.run(words, env=where, check=False).returncode:
        raise command_line.Refused("mkdocs failed; its message is above")
    print(site / "index.html")
    if options.serve:
        handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=site)
        print("http://localhost:8000, until Ctrl-C", flush=True)
        http.server.ThreadingHTTPServer(("localhost", 8000), handler).serve_forever()
    return 0


def main():
    parser = argparse.ArgumentParser(prog="feltgate docs", description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, metavar="DIR", help="folder of pages/ and site/ (default: docs in the build folder)")
    parser.add_argument("--serve", action="store_true", help="serve the site on this machine")
    options = parser.parse_args()
    return command_line.ended("docs", lambda: run(options))


if __name__ == "__main__":
    sys.exit(main())
