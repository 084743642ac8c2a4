# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The proofs to make: testbench/ROOM/BLOCK/proofs/proofs.toml, one table per proof."""

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

from command_line import Refused
import rtl_sources
from seeded_defects import patches

KEYS = {"name", "title", "depth", "cover_depth", "designs", "show",
        "sources", "defines", "cut", "abstract", "slow", "property", "cover"}
ASSERTION = re.compile(r"\b(\w+):\s*assert\b")
COVER = re.compile(r"\b(\w+):\s*cover\b")
INCLUDE = re.compile(r'^ *`include "(\w+\.svh)"\n', re.M)
SHARED = "testbench/campaigns/prove"  # what wrappers of several blocks include


class CatalogError(Refused):
    """A proof that is described wrongly; the message names the file and what to change."""


@dataclass(frozen=True)
class Property:
    name: str
    says: str
    defect: Path  # FILE/NAME of the patch that must break it
    from_any: object  # the defect shows too late after a reset: true, from any state that meets the rest;
    # "next", from any that met the rest up to the clock before; "alone", from any state, where the assertion
    # is inductive without the rest


@dataclass(frozen=True)
class Proof:
    """One wrapper around a block: testbench/ROOM/BLOCK/proofs/NAME.sv, module NAME_proof."""

    block: str
    name: str
    title: str
    depth: int  # of the induction at most, and of the base
    cover_depth: int
    designs: tuple
    show: tuple  # signals printed for a failed step
    sources: tuple  # modules beside those that the wrapper instantiates
    defines: tuple
    cut: tuple  # blocks of which only the ports are read: their outputs may be anything
    abstract: tuple  # selections of cells whose outputs may be anything
    fast: bool  # a test of every run
    properties: tuple
    covers: dict  # name: what it shows
    wrapper: Path

    defect_depth = 60  # of the search for a failure with a defect, which ends with the first

    @property
    def key(self):
        return f"{self.block}.{self.name}"

    @property
    def top(self):
        return f"{self.name}_proof"


def wrapper_text(root, path):
    """A wrapper as Yosys reads it: its includes stand beside it or in testbench/campaigns/prove."""
    def included(match):
        for folder in (path.parent, root / SHARED):
            if (folder / match[1]).is_file():
                return wrapper_text(root, folder / match[1])
        raise CatalogError(f"{path.relative_to(root)}: no {match[1]} beside it or in {SHARED}")

    return INCLUDE.sub(included, path.read_text(encoding="utf-8"))


def defect_path(root, block, name):
    """NAME is a patch beside the proof or of the block, whose folder this is, or BLOCK/NAME of another."""
    where, _, stem = name.rpartition("/")
    folder = rtl_sources.tests_of(root, where) if where else block
    beside = folder / "proofs" / "defects.diff"
    return (beside if stem in sum(patches.names(beside), []) else folder / "defects.diff") / stem


def read_proof(root, block, path, table):
    def wrong(what):
        return CatalogError(f"{path.relative_to(root)}: {what}")

    unknown = table.keys() - KEYS
    if unknown:
        raise wrong(f"unknown key {', '.join(sorted(unknown))}; there are {', '.join(sorted(KEYS))}")
    for key in ("name", "title", "depth", "property"):
        if key not in table:
            raise wrong(f"a proof without '{key}'")
    name = table["name"]
    wrapper = path.with_name(f"{name}.sv")
    if not wrapper.is_file():
        raise wrong(f"'{name}' has no {wrapper.name} beside it")
    text = rtl_sources.code_only(wrapper_text(root, wrapper))
    properties = []
    for label, entry in table["property"].items():
        if label not in ASSERTION.findall(text):
            raise wrong(f"{wrapper.name} has no assertion '{label}'")
        for key in ("says", "defect"):
            if key not in entry:
                raise wrong(f"property '{label}' without '{key}'")
        defect = defect_path(root, path.parents[1], entry["defect"])
        if defect.name not in sum(patches.names(defect.parent), []):
            raise wrong(f"property '{label}': no defect {defect.relative_to(root)}")
        properties.append(Property(label, entry["says"], defect, entry.get("from_any", False)))
    unsaid = [
        name
        for name in ASSERTION.findall(text)
        if name not in table["property"] and not name.startswith("inside_")
    ]
    if unsaid:
        raise wrong(
            f"{wrapper.name} asserts {', '.join(unsaid)}: no property here; say what it means, or "
            "name it inside_..."
        )
    covers = table.get("cover", {})
    if set(covers) != set(COVER.findall(text)):
        raise wrong(f"{wrapper.name} has the covers {', '.join(COVER.findall(text)) or 'none'}")
    if not covers:
        raise wrong(f"'{name}' has no cover: nothing shows that its assumptions can be met")
    return Proof(
        block=block,
        name=name,
        title=table["title"],
        depth=table["depth"],
        cover_depth=table.get("cover_depth", 20),
        designs=tuple(table.get("designs", ["lever"])),
        show=tuple(table.get("show", [])),
        sources=tuple(table.get("sources", [])),
        defines=tuple(table.get("defines", [])),
        cut=tuple(table.get("cut", [])),
        abstract=tuple(table.get("abstract", [])),
        fast=not table.get("slow", False),
        properties=tuple(properties),
        covers=covers,
        wrapper=wrapper,
    )


def read(root):
    """All proofs, block by block in the order of their names."""
    proofs = []
    for path in sorted(root.glob("testbench/*/*/proofs/proofs.toml"), key=lambda p: p.parents[1].name):
        block = path.parents[1].name
        try:
            tables = tomllib.loads(path.read_text(encoding="utf-8"))
        except tomllib.TOMLDecodeError as error:
            raise CatalogError(f"{path.relative_to(root)}: {error}") from error
        proofs += [read_proof(root, block, path, table) for table in tables.get("proof", [])]
    return proofs
