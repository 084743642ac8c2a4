#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""check_blocks.py must find what it promises: each test breaks a small complete tree in one way."""

import tempfile
import unittest
from pathlib import Path

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

    def test_defects(self):
        self.put("rtl/core/wave/alpha.sv", RTL.format("alpha", "  assign a = Defect == 1;\n"))
        self.expect("rtl/core/wave/alpha.sv: the word Defect")
        self.put("testbench/wave/alpha/defects.diff", DEFECT.replace("It is inverted.\n", ""))
        self.expect("testbench/wave/alpha/defects.diff/inverted: its first line does not say")
        self.put("testbench/wave/alpha/defects.diff", DEFECT.replace("inverted\n", "inverted (proof)\n"))
        self.put("testbench/wave/alpha/proofs/proofs.toml", 'defect = "other"\n')
        self.expect("testbench/wave/alpha/defects.diff/inverted: no proof tries it")
        self.put("testbench/wave/alpha/defects.diff", DEFECT)
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

    def test_sources_that_the_core_does_not_reach(self):
        self.put("rtl/core/feltgate_core.sv", "module feltgate_core;\n  alpha u_alpha ();\nendmodule\n")
        self.put("rtl/core/wave/stray.sv", "module stray;\nendmodule\n")
        self.expect("rtl/core/wave/stray.sv: the core does not instantiate it")
        found = [line for line in check_blocks.check(self.root) if "does not instantiate" in line]
        self.assertEqual(len(found), 1)

    def test_formatting(self):
        self.put("model/apps/commands/a.cpp", "// fine\nstd::snprintf(s, 9, \"%f\", x);\n")
        self.put("model/apps/commands/b.hpp", "auto s = std::to_string(x);\n")
        self.put("model/include/feltgate/c.hpp", "auto s = std::to_string(3);\n")
        self.expect("model/apps/commands/a.cpp:2: snprintf", "model/apps/commands/b.hpp:1: to_string")
        self.assertNotIn("c.hpp", "".join(check_blocks.check(self.root)))


if __name__ == "__main__":
    unittest.main()
