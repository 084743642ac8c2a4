#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""check_blocks.py must find what it promises: each test breaks a small complete tree in one way."""

import json
import re
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import block_results
import check_blocks

PAGE = "[{0}](../../rtl/core/{2}/{0}.sv) [twin](../../model/include/feltgate/{0}.hpp) [test](../../{1})\n"
RTL = (
    "// docs/blocks/{0}.md\n"
    "module {0};\n{1}endmodule\n"
)
DEFECT = "== inverted\nIt is inverted.\n--- a/x\n+++ b/x\n"
LISTS = f"{check_blocks.BEGIN}\n{check_blocks.END}\n"
CORE = "files:\n" + "".join(f"      {line}\n" for line in LISTS.splitlines())


class CheckBlocks(unittest.TestCase):
    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.add_block("alpha", "testbench/wave/alpha/alpha_test.cpp")
        self.add_block("scene_spring", "testbench/scenes/scene_all/scene_test.cpp")
        self.put("testbench/scenes/scene_all/scene_test.cpp", "SceneSpring twin;\n")
        instance = "  scene_spring #(.N(1)) u_spring ();\n"  # so it is read before alpha
        self.put("rtl/core/wave/alpha.sv", RTL.format("alpha", instance))
        self.put("rtl/generated/lever/feltgate_pkg.sv", "package feltgate_pkg;\nendpackage\n")
        self.put("rtl/boards/toy/toy.sv", "module toy;\nendmodule\n")
        self.put("rtl/boards/toy/toy.qsf", "# head\n" + LISTS)
        self.put("feltgate.core", CORE)
        self.assertEqual(check_blocks.check(self.root, write=True), [])
        self.assertEqual(check_blocks.check(self.root), [])

    def put(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text, encoding="utf-8")

    def add_block(self, name, test):
        room = "scenes" if name.startswith("scene_") else "wave"
        self.put(f"rtl/core/{room}/{name}.sv", RTL.format(name, ""))
        self.put(f"testbench/{room}/{name}/defects.diff", DEFECT)
        self.put(f"testbench/{room}/{name}/CMakeLists.txt", f"feltgate_block_test({name} WITH_DEFECTS)\n")
        class_name = check_blocks.class_name(name)
        self.put(f"model/include/feltgate/{name}.hpp", f"class {class_name} {{}};\n")
        self.put(test, "")
        self.put(f"docs/blocks/{name}.md", PAGE.format(name, test, room))

    def expect(self, *words):
        found = check_blocks.check(self.root)
        for word in words:
            self.assertTrue(any(word in line for line in found), found)

    def test_a_strobe_of_another_clock(self):
        proof, block = "testbench/wave/alpha/proofs/p.sv", "rtl/core/wave/alpha.sv"
        self.put(proof, "\n      .at_x_i(wave[feltgate_map_pkg::EVENT_AT_Y]),\n")
        self.expect(f"{proof}:2: at_x_i at feltgate_map_pkg::EVENT_AT_Y; connect EVENT_AT_X")
        self.put(proof, ".after_x_i(w[feltgate_map_pkg::EVENT_AT_X+1])")
        self.assertEqual(check_blocks.check(self.root), [])
        text = (self.root / block).read_text(encoding="utf-8")
        self.put(block, text + "// .param_next_x_i(wave[feltgate_map_pkg::PARAM_AT_X])\n")
        self.expect("param_next_x_i at feltgate_map_pkg::PARAM_AT_X; connect PARAM_AT_X-1")

    def test_a_drawing_of_another_port(self):
        page = (self.root / "docs/blocks/alpha.md").read_text(encoding="utf-8")
        self.put("docs/blocks/alpha.md", page + '```mermaid\nflowchart LR\n  x(["gone_i"])\n```\n')
        self.expect("docs/blocks/alpha.md: gone_i of the drawing is not in the RTL")

    def test_lists(self):
        table = (self.root / "docs/blocks.md").read_text(encoding="utf-8")
        self.assertIn("| wave | alpha | [alpha.sv](../rtl/core/wave/alpha.sv) |", table)
        self.assertIn("| [alpha.md](blocks/alpha.md) | 1 |", table)
        self.assertNotIn("None", table)
        qsf = (self.root / "rtl/boards/toy/toy.qsf").read_text(encoding="utf-8").splitlines()
        self.assertEqual(
            [line.split()[-1] for line in qsf if line.startswith("set_")],
            [
                "../../generated/lever/feltgate_pkg.sv",
                "../../core/scenes/scene_spring.sv",
                "../../core/wave/alpha.sv",
                "toy.sv",
            ],
        )
        files = (self.root / "rtl/feltgate_core.f").read_text(encoding="utf-8").splitlines()
        self.assertEqual(files[2:], ["core/scenes/scene_spring.sv", "core/wave/alpha.sv"])
        self.assertIn("      - rtl/core/wave/alpha.sv\n", (self.root / "feltgate.core").read_text())

    def test_blocks_beside_the_core(self):
        self.add_block("beta", "testbench/link/beta/beta_test.cpp")
        (self.root / "rtl/link").mkdir()
        (self.root / "rtl/core/wave/beta.sv").rename(self.root / "rtl/link/beta.sv")
        (self.root / "testbench/link").mkdir(exist_ok=True)
        for file in ("defects.diff", "CMakeLists.txt"):
            (self.root / "testbench/wave/beta" / file).rename(self.root / "testbench/link/beta" / file)
        page = PAGE.format("beta", "testbench/link/beta/beta_test.cpp", "wave")
        page = page.replace("rtl/core/wave/beta", "rtl/link/beta")
        self.put("docs/blocks/beta.md", page)
        self.put("rtl/generated/feltgate_link_pkg.sv", "package feltgate_link_pkg;\nendpackage\n")
        self.expect("rtl/feltgate_linked.f: stale")
        self.assertEqual(check_blocks.check(self.root, write=True), [])
        listed = (self.root / "rtl/feltgate_linked.f").read_text(encoding="utf-8").splitlines()[2:]
        self.assertEqual(listed[-2:], ["generated/feltgate_link_pkg.sv", "link/beta.sv"])
        self.assertNotIn("beta", (self.root / "rtl/feltgate_core.f").read_text(encoding="utf-8"))
        qsf = self.root / "rtl/boards/toy/toy.qsf"
        self.assertNotIn("beta", qsf.read_text(encoding="utf-8"))
        self.put("rtl/boards/toy/toy.sv", "module toy;\n  beta u_beta ();\nendmodule\n")
        self.expect("toy.qsf: stale")
        self.assertEqual(check_blocks.check(self.root, write=True), [])
        self.assertIn("../../link/beta.sv", qsf.read_text(encoding="utf-8"))

    def test_results(self):
        results = {"alpha": {"line": [3, 4], "toggle": [9, 9], "seconds": 1.6},
                   "whole core": {"seconds": 2}}
        block_results.write(self.root, "coverage", "measured", results)
        table = "\n".join(block_results.table(self.root, ["alpha", "scene_spring"]))
        self.assertIn("| alpha | - | 3 of 4 | - | 9 of 9 | - | - | - | - | - | 2 |", table)
        self.assertIn("| scene_spring | - |", table)
        self.assertIn("| whole core | - |", table)
        self.assertIn("- coverage: `measured`", table)

    def test_results_keep_the_date_on_which_they_were_measured(self):
        write = {"root": self.root, "kind": "mutants", "command": "measured"}
        old = {"alpha": {"rtl": [1, 2], "twin": [3, 4]}, "scene_spring": {"rtl": [5, 5]}}
        block_results.write(**write, blocks=old, date="2020-01-02")
        block_results.merge(**write, rows={"alpha": {"rtl": [2, 2], "seconds": 1.0}})
        blocks = block_results.read(self.root, "mutants")["blocks"]
        self.assertEqual(blocks["alpha"].pop("sources").keys(), {"rtl", "twin"})
        self.assertEqual(blocks["alpha"], {"rtl": [2, 2], "twin": [3, 4], "seconds": 1.0,
                                           "dates": {"twin": "2020-01-02"}})
        self.assertEqual(blocks["scene_spring"]["dates"], {"rtl": "2020-01-02"})
        lines = block_results.table(self.root, ["alpha", "scene_spring"])
        self.assertIn(f"- mutants: `measured`, 2020-01-02 to {block_results.today()}", lines[-1])
        block_results.merge(**write,
                            rows={"alpha": {"twin": [4, 4]}, "scene_spring": {"rtl": [4, 5]}})
        self.assertNotIn("dates", json.dumps(block_results.read(self.root, "mutants")))

    def test_results_keep_the_machine_on_which_they_were_measured(self):
        write = {"root": self.root, "kind": "mutants", "command": "measured"}
        here = "2 cores, here"
        with mock.patch.object(block_results, "machine", lambda: "1 core, there"):
            block_results.write(**write, blocks={"alpha": {"rtl": [1, 2], "twin": [3, 4]}})
        with mock.patch.object(block_results, "machine", lambda: here):
            block_results.merge(**write, rows={"alpha": {"rtl": [2, 2]}, "beta": {"rtl": [1, 1]}})
            found = block_results.read(self.root, "mutants")
            self.assertEqual(found["machine"], here)
            self.assertEqual(found["blocks"]["alpha"]["machines"], {"twin": "1 core, there"})
            self.assertNotIn("machines", found["blocks"]["beta"])
            day = block_results.today()
            self.assertEqual(block_results.when(found), f"{day}, 1 core, there; {day}, {here}")
            block_results.merge(**write, rows={"alpha": {"twin": [4, 4]}})
        found = block_results.read(self.root, "mutants")
        self.assertEqual(block_results.when(found), f"{day}, {here}")

    def test_results_of_an_earlier_source_are_marked(self):
        write = {"root": self.root, "kind": "mutants", "command": "measured"}
        block_results.write(**write, blocks={"alpha": {"rtl": [1, 2], "twin": [3, 4]}})
        rtl = next(self.root.glob("rtl/core/wave/alpha.sv"))
        text = rtl.read_text(encoding="utf-8")
        rtl.write_text(text.replace(";", "; // the same code", 1), encoding="utf-8")
        self.assertNotIn("*", block_results.table(self.root, ["alpha"])[2])
        rtl.write_text(text.replace("module", "module extra; endmodule module", 1),
                       encoding="utf-8")
        lines = block_results.table(self.root, ["alpha"])
        self.assertIn("| 1 of 2* | 3 of 4 |", lines[2])
        self.assertIn(r"\* measured before the last change of the block's own source.", lines)
        block_results.merge(**write, rows={"alpha": {"twin": [4, 4]}})
        self.assertIn("| 1 of 2* | 4 of 4 |", block_results.table(self.root, ["alpha"])[2])
        block_results.merge(**write, rows={"alpha": {"rtl": [2, 2]}})
        self.assertIn("| 2 of 2 | 4 of 4 |", block_results.table(self.root, ["alpha"])[2])

    def test_wrong_results(self):
        for blocks, said in (
            ({"beta": {}}, "beta, which is no block"),
            ({"alpha": {"lines": [1, 1]}}, "has the key 'lines'"),
            ({"alpha": {"line": [2, 1]}}, "2 of 1"),
            ({"alpha": {"line": "all"}}, "'all' is no number"),
            ({"alpha": {"line": [1, 1], "dates": {"toggle": "2026-01-02"}}}, "dates of toggle"),
        ):
            with self.subTest(said):
                path = block_results.path_of(self.root, "coverage")
                path.parent.mkdir(parents=True, exist_ok=True)
                head = {"schema": block_results.SCHEMA, "kind": "coverage", "blocks": blocks}
                path.write_text(json.dumps(head), encoding="utf-8")
                with self.assertRaisesRegex(block_results.ResultsError, re.escape(said)):
                    block_results.table(self.root, ["alpha", "scene_spring"])

    def test_every_missing_sibling(self):
        for path in (
            "model/include/feltgate/alpha.hpp",
            "testbench/wave/alpha/alpha_test.cpp",
        ):
            with self.subTest(path):
                saved = (self.root / path).read_text(encoding="utf-8")
                (self.root / path).unlink()
                self.expect(f"{path}: missing")
                self.put(path, saved)

    def test_twin_beside_its_test(self):
        public, beside = "model/include/feltgate/alpha.hpp", "testbench/wave/alpha/alpha_twin.hpp"
        self.put(beside, "class Alpha {};\n")
        self.put(public, "struct AlphaLaw {};\n")
        self.expect("blocks.md: stale")
        self.assertEqual(check_blocks.check(self.root, write=True), [])
        table = (self.root / "docs/blocks.md").read_text(encoding="utf-8")
        self.assertIn(f"[alpha.hpp](../{public}) | [alpha_twin.hpp](../{beside})", table)
        self.put(beside, "class Alphabet {};\n")
        self.expect(f"{beside}: no class Alpha in it")
        (self.root / public).unlink()  # a block may have no law
        self.put(beside, "class Alpha {};\n")
        page = PAGE.format("alpha", "testbench/wave/alpha/alpha_test.cpp", "wave")
        self.put("docs/blocks/alpha.md", page.replace(f"../../{public}", f"../../{beside}"))
        self.assertEqual(check_blocks.check(self.root, write=True), [])

    def test_scene_that_no_shared_test_names(self):
        self.put("testbench/scenes/scene_all/scene_test.cpp", "SceneSpringy other;\n")
        self.expect("testbench/scenes/scene_spring/scene_spring_test.cpp: missing")

    def test_defects(self):
        self.put("rtl/core/wave/alpha.sv", RTL.format("alpha", "  assign a = Defect == 1;\n"))
        self.expect("rtl/core/wave/alpha.sv: the word Defect")
        self.put("testbench/wave/alpha/defects.diff", DEFECT.replace("It is inverted.\n", ""))
        self.expect("testbench/wave/alpha/defects.diff/inverted: its first line does not say")
        self.put("testbench/wave/alpha/defects.diff", DEFECT)
        self.put("testbench/wave/alpha/proofs/defects.diff", DEFECT)
        self.put("testbench/wave/alpha/proofs/proofs.toml", 'defect = "other"\n')
        self.expect("testbench/wave/alpha/proofs/defects.diff/inverted: no test is built with it")
        self.put("testbench/wave/alpha/CMakeLists.txt", "feltgate_block_test(alpha)\n")
        self.expect("testbench/wave/alpha/defects.diff/inverted: no test is built with it")
        (self.root / "testbench/wave/alpha/CMakeLists.txt").unlink()
        self.put("testbench/wave/CMakeLists.txt", "feltgate_block_test(other WITH_DEFECTS)\n")
        self.expect("testbench/wave/alpha/defects.diff/inverted: no test is built with it")
        for line in ("feltgate_defect_program(twin FILE alpha/defects.diff)", "feltgate_test(twin DEFECTS inverted)"):
            self.put("testbench/wave/CMakeLists.txt", f"feltgate_block_test(other WITH_DEFECTS)\n{line}\n")
            self.assertFalse([said for said in check_blocks.check(self.root) if "no test is built" in said and "proofs" not in said])
        self.put("testbench/wave/CMakeLists.txt", "feltgate_defect_program(twin FILE other/defects.diff)\n")
        self.expect("testbench/wave/alpha/defects.diff/inverted: no test is built with it")
        (self.root / "testbench/wave/alpha/defects.diff").unlink()
        self.put("rtl/core/wave/alpha.sv", RTL.format("alpha", ""))
        self.expect("testbench/wave/alpha/defects.diff: no seeded defect of rtl/core/wave/alpha.sv")

    def test_module_name_and_page_name(self):
        self.put("rtl/core/wave/alpha.sv", "module beta;\nendmodule\n")
        self.expect("no module alpha")

    def test_links(self):
        self.put("docs/blocks/alpha.md", "no links\n")
        self.expect("rtl/core/wave/alpha.sv: no page of docs or docs/blocks links it")
        self.put("docs/other.md", "[gone](nowhere.md) [far](https://example.org/x)\n")
        self.put("docs/code.md", "```cpp\nauto f = [&](const int& x) { return x; };\n```\n")
        self.expect("docs/other.md: links docs/nowhere.md")
        self.assertFalse([line for line in check_blocks.check(self.root) if "code.md" in line])

    def test_stale_lists(self):
        self.add_block("beta", "testbench/link/beta/beta_test.cpp")
        lists = ("docs/blocks.md", "rtl/feltgate_core.f", "feltgate.core", "rtl/boards/toy/toy.qsf")
        self.expect(*(f"{path}: stale" for path in lists))

    def test_sources_that_the_core_does_not_reach(self):
        self.put("rtl/core/feltgate_core.sv", "module feltgate_core;\n  alpha u_alpha ();\nendmodule\n")
        self.put("rtl/core/wave/stray.sv", "module stray;\nendmodule\n")
        self.expect("rtl/core/wave/stray.sv: the core does not instantiate it")
        found = [line for line in check_blocks.check(self.root) if "does not instantiate" in line]
        self.assertEqual(len(found), 1)

    def test_a_room_that_nobody_has_put_in_order(self):
        self.put("rtl/core/attic/gamma.sv", RTL.format("gamma", ""))
        self.expect("testbench/attic/gamma/gamma_test.cpp: missing", "rtl/feltgate_core.f: stale")

    def test_a_cell_of_one_vendor_has_a_list_of_its_own(self):
        self.put("rtl/core/wave/mult18_ecp5.sv", "module mult18_ecp5;\nendmodule\n")
        check_blocks.check(self.root, write=True)
        self.assertIn("mult18_ecp5.sv\n", (self.root / "rtl/feltgate_ecp5.f").read_text())
        self.assertNotIn("mult18", (self.root / "rtl/feltgate_core.f").read_text())

    def test_lost_markers(self):
        self.put("rtl/boards/toy/toy.qsf", "# head\n")
        self.expect("toy.qsf: no lines")

    def test_long_files(self):
        self.put("model/long.cpp", "\n" * 501)
        self.put("rtl/generated/paper/long.sv", "\n" * 501)
        self.put("build/long.cpp", "\n" * 501)
        found = [line for line in check_blocks.check(self.root) if "lines, more than" in line]
        self.assertEqual(found, ["model/long.cpp: 501 lines, more than 500; split it"])

    def test_formatting(self):
        self.put("model/apps/commands/a.cpp", "// fine\nstd::snprintf(s, 9, \"%f\", x);\n")
        self.put("model/apps/commands/b.hpp", "auto s = std::to_string(x);\n")
        self.put("model/include/feltgate/c.hpp", "auto s = std::to_string(3);\n")
        self.expect("model/apps/commands/a.cpp:2: snprintf", "model/apps/commands/b.hpp:1: to_string")
        self.assertNotIn("c.hpp", "".join(check_blocks.check(self.root)))

    def test_empty_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("no blocks", check_blocks.check(Path(folder))[0])


if __name__ == "__main__":
    unittest.main()
