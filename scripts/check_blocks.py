#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Each block has one name everywhere: fails when a block lacks one of its files.

Every block beside the core (rtl/link/<b>.sv and so on) has a twin, testbench/<room>/<b>/<b>_test.cpp,
at least one seeded defect, and a page that links its RTL; blocks that help one another share a page. The twin is
the class with the block's name. It is in model/include/feltgate/<b>.hpp if the product uses it, else in the test, or
beside it in <b>_twin.hpp where several tests use it; then the law that it evaluates, if any, is in the former.
Further checks: the lists made from the blocks are up to date: the sources in rtl/*.f, feltgate.core and the
boards' .qsf.

  check_blocks.py           check; one line 'path: what; mend' for each finding, status 1
  check_blocks.py --write   write the lists again, then check
"""

import argparse
import os
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from seeded_defects import patches
import rtl_sources

BOARD_DESIGN = "lever"
PARTS = ("axes_member",)  # of a block whose twin and test are theirs too
BEGIN = "# sources: written by scripts/check_blocks.py --write"
END = "# end of sources"
MEND_LIST = "run scripts/check_blocks.py --write"


@dataclass(frozen=True)
class Block:
    """Paths are relative to the root and need not exist."""

    name: str
    room: str
    rtl: Path
    law: Path  # None where it has none, or where the twin is in the same file
    twin: Path
    test: Path
    doc: Path
    defects: tuple

    @property
    def folder(self):
        return Path("testbench", self.room, self.name)


def class_name(name):
    return "".join(part.capitalize() for part in name.split("_"))


def has_class(path, name):
    return path.is_file() and re.search(rf"\bclass {class_name(name)}\b", path.read_text(encoding="utf-8"))


def page_links(root):
    """{page: files that it links}, pages of blocks first."""
    found = [*sorted(root.glob("docs/blocks/*.md")), *sorted(root.glob("docs/*.md"))]
    found = [path.relative_to(root) for path in found]
    return {page: linked_files(root, page) for page in found}


def page_of(pages, rtl):
    """The page that links the RTL, else its folder; None where there is none."""
    for path in (rtl, rtl.parent):
        for page, links in pages.items():
            if path in links:
                return page
    return None


def find_blocks(root):
    blocks, pages = [], page_links(root)
    for name, path in rtl_sources.module_files(root).items():
        rtl = root / "rtl" / path
        if path.split("/")[0] in (*rtl_sources.CORE_FOLDERS, "options") or name in PARTS:
            continue
        if path.startswith("engine/") and name != "engine":
            continue  # a part: twin, test, page and defects are the engine's
        room = rtl_sources.room_of(path)
        folder = Path("testbench", room, name)
        test = folder / f"{name}_test.cpp"
        public = Path(f"model/include/feltgate/{name}.hpp")
        places = (test, folder / f"{name}_twin.hpp")
        beside = next((path for path in places if has_class(root / path, name)), None)
        blocks.append(
            Block(
                name=name,
                room=room,
                rtl=rtl.relative_to(root),
                law=public if beside and (root / public).exists() else None,
                twin=beside or public,
                test=test,
                doc=page_of(pages, rtl.relative_to(root)),
                defects=tuple(patches.names(root / folder / "defects.diff")[0]),
            )
        )
    return blocks


def check_block(root, block):
    for what, path in (("twin", block.twin), ("test", block.test)):
        if not (root / path).exists():
            yield f"{path}: missing, the {what} of {block.rtl}; write it"
    if (root / block.twin).exists() and not has_class(root / block.twin, block.name):
        yield f"{block.twin}: no class {class_name(block.name)} in it; name the class as the block"
    rtl = (root / block.rtl).read_text(encoding="utf-8")
    if not re.search(rf"\bmodule\s+{block.name}\b", rtl):
        yield f"{block.rtl}: no module {block.name} in it; name the module as the file"
    if block.doc is None:
        yield f"{block.rtl}: no page of docs or docs/blocks links it; describe it on one"
    file = block.folder / "defects.diff"
    if not block.defects:
        yield f"{file}: no seeded defect of {block.rtl}; add one, docs/testing.md says how"
    if re.search(r"\bDefect\b", rtl):
        yield f"{block.rtl}: the word Defect; what breaks it is a patch in {file}"


def check_defects(root):
    """Each defect is well-formed, and a test is built with it; those for proofs are in their list."""
    for file in sorted(root.glob("testbench/**/*.diff")):
        rules = file.parent / "CMakeLists.txt"
        proofs = file.parent / ("" if file.parent.name == "proofs" else "proofs") / "proofs.toml"
        proven = proofs.read_text(encoding="utf-8") if proofs.exists() else ""
        room = file.parents[1] / "CMakeLists.txt"
        if not rules.exists() and room.exists():
            rules = room
        text = rules.read_text(encoding="utf-8") if rules.exists() else ""
        built = "WITH_DEFECTS|feltgate_defect_"
        if rules == room:  # it names the file, or a module does; or its calls for the block say so; or it names the defect
            beside = (*file.parent.glob("*.cmake"), *file.parent.glob("*_test.py"))
            modules = "".join(module.read_text(encoding="utf-8") for module in beside)
            own = rf"feltgate_block_test\((?:{file.parent.name}|\$\{{block\}})\s[^)]*"
            calls = "".join(re.findall(own, text))
            if f"{file.parent.name}/{file.name}" in text or f"/{file.name}" in modules:
                built = ""
            else:
                text, built = (calls, built) if calls else (text, "(?!)")
        try:
            for patch in patches.every(file):
                patches.touched(patch)
                if patch.name in patches.names(file)[1]:
                    if f'"{patch.name}"' not in proven:
                        where = proofs.relative_to(root)
                        yield f"{patch.relative_to(root)}: no proof tries it; name it in {where}"
                elif not re.search(rf"{built}|\b{patch.name}\b", text):
                    where = rules.relative_to(root)
                    yield f"{patch.relative_to(root)}: no test is built with it; name it in {where}"
        except patches.DefectError as error:
            yield str(error).replace(f"{root}/", "")


def linked_files(root, page):
    links = set()
    text = (root / page).read_text(encoding="utf-8")
    prose = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)  # a C++ lambda is no link
    for target in re.findall(r"\]\(([^)#\s]+)", prose):
        if "://" not in target:
            links.add(Path(os.path.normpath(page.parent / target)))
    return links


def sources(root):
    """RTL of the core with the boards' design, in order."""
    return [Path(f"rtl/generated/{BOARD_DESIGN}/cfg.sv"), *(Path("rtl", name) for name in rtl_sources.core_files(root))]


def linked_sources(root, board):
    """RTL of a folder beside the core, where the board's own files instantiate something of it."""
    listed = []
    for folder in rtl_sources.FOLDERS:
        files = rtl_sources.folder_files(root, folder)
        names = {Path(path).stem for path in files}
        if any(rtl_sources.instantiated(p.read_text(encoding="utf-8"), names) for p in board):
            listed += [Path("rtl", path) for path in files]
    return listed


def file_list(head, names):
    return "\n".join([f"// {head}; paths are relative to this folder.", f"// {BEGIN[2:]}", *names, ""])


def replace_list(text, lines, indent="", begin=BEGIN):
    """The text with the lines between the two markers replaced; None without markers."""
    pattern = re.compile(
        rf"^{indent}{re.escape(begin)}\n.*?^{indent}{re.escape(END)}$", re.S | re.M
    )
    body = "\n".join([indent + begin, *(indent + line for line in lines), indent + END])
    return pattern.sub(lambda _: body, text) if pattern.search(text) else None


def fusesoc_lists(root, text):
    """feltgate.core with the files of the core, and of each board beside them."""
    text = replace_list(text, [f"- {path}" for path in sources(root)], " " * 6)
    for folder in sorted(root.glob("rtl/boards/*/pins.csv")):
        name = folder.parent.name
        board = sorted([*root.glob("rtl/boards/panel/*.sv"), *folder.parent.glob("*.sv")])
        files = [*linked_sources(root, board), *(p.relative_to(root) for p in board)]
        begin = BEGIN.replace("sources:", f"sources of {name}:")
        text = text and replace_list(text, [f"- {path}" for path in files], " " * 6, begin)
    return text


def fresh_lists(root):
    """(path, wanted text) of everything that is made from the blocks."""
    yield (
        Path("rtl/feltgate_core.f"),
        file_list("The core; a design's cfg.sv comes first", rtl_sources.core_files(root)),
    )
    for folder, name in rtl_sources.FOLDERS.items():
        files = rtl_sources.folder_files(root, folder)
        if files:
            head = f"The core with the blocks of {folder}/; a design's cfg.sv comes first"
            yield Path(f"rtl/{name}.f"), file_list(head, [*rtl_sources.core_files(root), *files])
    core = root / "feltgate.core"
    if core.exists():
        yield core.relative_to(root), fusesoc_lists(root, core.read_text(encoding="utf-8"))
    for qsf in sorted(root.glob("rtl/boards/*/*.qsf")):
        board = sorted([*root.glob("rtl/boards/panel/*.sv"), *qsf.parent.glob("*.sv")])
        files = [*sources(root), *linked_sources(root, board), *(p.relative_to(root) for p in board)]
        lines = [
            "set_global_assignment -name SYSTEMVERILOG_FILE "
            + os.path.relpath(path, qsf.parent.relative_to(root))
            for path in files
        ]
        yield qsf.relative_to(root), replace_list(qsf.read_text(encoding="utf-8"), lines)


def check_lists(root, write):
    for path, wanted in fresh_lists(root):
        if wanted is None:
            yield f"{path}: no lines '{BEGIN}' and '{END}'; put them back"
            continue
        there = (root / path).read_text(encoding="utf-8") if (root / path).exists() else ""
        if there == wanted:
            continue
        if write:
            (root / path).write_text(wanted, encoding="utf-8")
        else:
            yield f"{path}: stale; {MEND_LIST}"


def check(root, write=False):
    blocks = find_blocks(root)
    found = [] if blocks else ["rtl: no blocks; is this the root of the repository?"]
    found += check_lists(root, write)
    ordered, lost = rtl_sources.modules(root)
    for name in lost:
        found.append(f"rtl/{ordered[name]}: no device instantiates it; do, or remove it")
    for block in blocks:
        found += check_block(root, block)
    found += check_defects(root)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write the lists again")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[1])
    arguments = parser.parse_args()
    found = check(arguments.root.resolve(), arguments.write)
    print("\n".join(found) if found else "check_blocks: all blocks complete, all lists fresh")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
