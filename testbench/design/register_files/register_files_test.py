#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The register map as C header, SystemRDL and CSV says what rtl/registers.toml and each design say.

register_files_test.py VENV: the folder with systemrdl-compiler. docs/other-tools.md
"""

import csv
import json
import math
import os
import re
import sys
import tomllib
import unittest
from fractions import Fraction
from pathlib import Path

from testing import BUILD, ROOT, Scratch, ran, text_of, weekly

VENV = Path(sys.argv.pop(1))
GENERATED = ROOT / "rtl/generated"
DESIGNS = sorted(path.stem for path in (ROOT / "rtl/designs").glob("*.toml"))
SNAPSHOT = 0x300
COEFFICIENT_BITS = 17

# Prints what systemrdl-compiler makes of a file: [name, address, access, fields] of each register.
RDL = """
import json, sys
from systemrdl import RDLCompiler
compiler = RDLCompiler()
compiler.compile_file(sys.argv[1])
rows = []
tops = [compiler.elaborate().top, compiler.elaborate("feltgate_link").top]
assert tops[0].inst_name == "feltgate"
for r in [*tops[0].registers(), *tops[1].registers()]:
    fields = [[f.inst_name, f.low, f.width, f.get_property("reset"),
               f.get_property("feltgate_format", default=None),
               f.get_property("feltgate_unit", default=None)] for f in r.fields()]
    rows.append([r.inst_name, r.absolute_address, [r.has_sw_readable, r.has_sw_writable], fields])
print(json.dumps(rows))
"""
# Reads every register that LiteX's own reader of csr.csv finds; the port says the address.


def need_venv(module):
    found = list(VENV.glob(f"lib/python3*/site-packages/{module}"))
    return unittest.skipUnless(
        found or os.environ.get("CI"), f"no {module}; ./feltgate test fetches it"
    )


def in_venv(program, path):
    done = ran(VENV / "bin/python", "-c", program, path)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def package(folder):
    """The numbers of the package that the generator wrote there."""
    text = Path(folder, "cfg.sv").read_text(encoding="utf-8")
    return {n: int(v) for n, v in re.findall(r"localparam int (\w+) = (-?\d+);", text)}


def register_map():
    return tomllib.loads(text_of("rtl/registers.toml"))


def values(design, folder):
    """{parameter: (address, integer, exact)} as the generator prints them."""
    program = [BUILD / "feltgate_generate", ROOT]
    source = ROOT / "rtl/designs" / f"{design}.toml"
    ran(*program, "--design", source, "-o", folder, check=True)
    rows = (line.split() for line in (Path(folder) / "values.txt").read_text().splitlines())
    return {r[0]: (int(r[1]), int(r[2]), float(r[3])) for r in rows}


def truth(folder):
    """{name: (address, reads, writes, fields, (sign, width, fraction) or None, unit)}."""
    numbers, listed, words = package(folder), register_map(), {}
    scenes = {s["name"]: s["number"] for s in listed["scene"]}
    for p in listed["parameter"]:
        name, kind = p["name"], p["kind"]
        if p.get("option") == "three_phases" and numbers["PHASES"] != 3:
            continue
        fraction = numbers.get(f"P_{name.upper()}_F")
        if kind in ("signal", "limit"):
            signal = p["format"].upper()
            sign = 0 if p["format"] in ("current_squared", "i2t", "charge") else 1
            form = (sign, numbers[f"{signal}_W"], numbers[f"{signal}_F"])
        else:
            form = {
                "coefficient": (0, COEFFICIENT_BITS, fraction),
                "signed": (1, COEFFICIENT_BITS + 1, fraction),
                "counts": (1, 26, 8),
                "integer": (0, 31 if p.get("saturates") else p.get("bits"), 0),
                "angle": (0, 32, 32),
            }[kind]
        address = p["slot"] + 32 * scenes[p["scene"]] if "scene" in p else p["slot"]
        words[name] = (address, True, True, [], form, p["unit"])
    for c in listed["control"]:
        words[c["name"]] = (c["address"], c["name"] == "control", True, c["fields"], None, "")
    slots = {p["name"]: p["slot"] for p in listed["parameter"]}
    for n in listed["snapshot"]:
        address = SNAPSHOT + (slots[n["with"]] if "with" in n else n["slot"])
        form = None
        if "format" in n:
            signal = n["format"].upper()
            form = (1, numbers[f"{signal}_W"], numbers[f"{signal}_F"])
        words[n["name"]] = (address, True, False, n.get("fields", []), form, n.get("unit", ""))
    return words


def link():
    """The same of what only the link has."""
    return {
        f"link_{w['name']}": (
            w["address"], True, w.get("access") == "write", w.get("fields", []), None, "",
        )
        for w in register_map()["link_word"]
    }


def nearest(value, form):
    """The word of a value: halves away from 0, the nearer end beyond the range."""
    sign, width, fraction = form
    high = (1 << (width - sign)) - 1
    low = -high - 1 if sign else 0
    if math.isnan(value):
        return 0
    if math.isinf(value):
        return high if value > 0 else low
    scaled = Fraction(value) * Fraction(2) ** fraction
    whole = math.floor(abs(scaled) + Fraction(1, 2))
    return max(low, min(high, whole if scaled >= 0 else -whole))


def tried(form, default):
    """Values of which the words are compared."""
    step = 2.0 ** -form[2]
    ends = [2.0 ** (form[1] - form[0] - form[2]), 1e300, float("inf")]
    some = [default, 0.0, step, 0.5 * step, 1.5 * step, 0.49999999999999994 * step, 1000.25 * step]
    return [s * v for v in [*some, *ends, ends[0] - step] for s in (1, -1)] + [float("nan")]


def c_text(value):
    if math.isnan(value):
        return "(0.0 / zero)"
    if math.isinf(value):
        return "(1.0 / zero)" if value > 0 else "(-1.0 / zero)"
    return value.hex()


class RegisterFiles(Scratch):
    maxDiff = None

    def test_c_header(self):
        for design in ("lever", "paper", "gimbal_current", "two_levers_law"):
            with self.subTest(design):
                self.check_c(design, self.folder)

    def check_c(self, design, folder):
        given = values(design, folder)
        words = truth(folder) | link()
        self.assertEqual(text_of("rtl/generated/feltgate_map.h"), Path(folder, "feltgate_map.h").read_text())
        rows, wanted = [], []

        def row(text, number):
            rows.append(text)
            wanted.append(number)

        for name, (address, _, writes, fields, form, _) in words.items():
            c = f"FELTGATE_{name.upper()}"
            row(c, address)
            for field in fields:
                f, width = f"{c}_{field['name'].upper()}", field.get("width", 1)
                ones = (1 << width) - 1
                row(f"{f}_BIT", field["bit"])
                row(f"{f}_MASK", ones << field["bit"])
                row(f"FELTGATE_GET({f}, 0xa5c37e19u)", 0xA5C37E19 >> field["bit"] & ones)
                row(f"FELTGATE_PUT({f}, 0xffffffffu)", ones << field["bit"])
            if form is not None and writes:
                self.assertEqual(given[name][0], address)
                row(f"{c}_WORD({c}_DEFAULT)", given[name][1])
                row(f"{c}_RESET", given[name][1])
                for value in tried(form, given[name][2]):
                    row(f"{c}_WORD({c_text(value)})", nearest(value, form))
            if form is not None:  # a word and back, in steps
                top = 1 << (form[1] - 1)
                for word in (0, 1, top - 1, top, 2 * top - 1):
                    steps = word - 2 * top if form[0] and word >= top else word
                    junk = 0xFFFFFFFF & ~(2 * top - 1)
                    for bits in (word, word | junk):
                        text = f"{c}_VALUE({bits}u) * {math.ldexp(1.0, form[2]).hex()}"
                        row(f"(uint32_t)(int64_t)({text})", steps)
        for kind, prefix, key in (("scene", "SCENE_", "number"), ("fault", "FAULT_", "number"),
                                  ("constant", "", "value"), ("limit", "LIMIT_", "bit"),
                                  ("link_constant", "LINK_FORMAT_", "value")):
            for c in register_map()[kind]:
                number = 1 << c[key] if kind == "limit" else c[key]
                row(f"FELTGATE_{prefix}{c['name'].upper()}", number)
        # FELTGATE_PARAMETERS lists the words that every design has.
        of_all = len(given) - sum("option" in p and p["name"] in given for p in register_map()["parameter"])
        source = Path(folder, "try.c")
        lines = "".join(f'  printf("%lu\\n", (unsigned long)({r}));\n' for r in rows)
        source.write_text(
            '#include <stdio.h>\n#include "feltgate.h"\nstatic volatile double zero;\n'
            "#define ONE(name, NAME) +1\nint main(void) {\n"
            f"{lines}  return (0 FELTGATE_PARAMETERS(ONE)) - {of_all};\n}}\n"
        )
        strict = ["-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror", "-I", folder]
        program = Path(folder, "try")
        ran("gcc", "-std=c99", *strict, source, "-o", program, check=True, capture_output=False)
        found = [int(line) for line in ran(program, check=True).stdout.split()]
        wrong = [
            (r, hex(f), w) for r, f, w in zip(rows, found, wanted, strict=True)
            if f != w & 0xFFFFFFFF
        ]
        self.assertEqual(wrong[:5], [])

    def test_example(self):
        program = self.folder / "registers"
        strict = ["-std=c99", "-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror"]
        source = ROOT / "docs/examples/registers.c"
        strict += ["-I", GENERATED, "-I", GENERATED / "lever"]
        ran("gcc", *strict, source, "-o", program, check=True, capture_output=False)
        said = ran(program, check=True).stdout
        self.assertIn(said, text_of("docs/other-tools.md"))
        self.assertIn("-0.1000 Nm, armed 1, ramping 1", said)

    def compare(self, rows):
        """Differences between the truth and rows {name: (address, reads, writes)}."""
        both = truth(self.folder) | link()
        words = {n: (4 * w[0], w[1], w[2]) for n, w in both.items()}
        return {n for n in words.keys() | rows.keys() if words.get(n) != rows.get(n)}

    def csv_rows(self, path):
        with open(path, encoding="utf-8", newline="") as file:
            lines = [r for r in csv.reader(file) if not r[0].startswith("#")]
        self.assertEqual({len(r) for r in lines}, {5})
        registers = [r for r in lines if r[0] == "csr_register"]
        rows = {
            r[1].removeprefix("feltgate_"): (int(r[2], 16), r[4] != "wo", r[4] != "ro")
            for r in registers
        }
        self.assertEqual(len(rows), len(registers))
        return rows, {r[1]: r[2] for r in lines if r[0] == "constant"}

    def test_csv(self):
        for design in DESIGNS:
            with self.subTest(design):
                values(design, self.folder)
                rows, constants = self.csv_rows(self.folder / "csr.csv")
                self.assertEqual(self.compare(rows), set())
                self.assertEqual(constants["feltgate_design"], design)
                for name, (_, _, _, _, form, unit) in truth(self.folder).items():
                    if form is not None:
                        self.assertEqual(constants[f"feltgate_{name}_fraction"], str(form[2]))
                        self.assertEqual(constants[f"feltgate_{name}_unit"], unit)

    @need_venv("systemrdl")
    @weekly(3)
    def test_systemrdl(self):
        for design in DESIGNS:
            with self.subTest(design):
                given = values(design, self.folder)
                rows = in_venv(RDL, self.folder / "feltgate.rdl")
                found = {n: (a, r, w) for n, a, (r, w), _ in rows}
                self.assertEqual(len(found), len(rows))
                self.assertEqual(self.compare(found), set())
                for name, _, _, fields in rows:
                    _, _, writes, wanted, form, unit = (truth(self.folder) | link())[name]
                    if wanted:
                        self.assertEqual(
                            sorted((f[0], f[1], f[2]) for f in fields),
                            sorted((f["name"], f["bit"], f.get("width", 1)) for f in wanted),
                        )
                        continue
                    ((_, low, width, reset, text, its_unit),) = fields
                    sign, bits, fraction = form or (0, 32, 0)
                    self.assertEqual((low, width), (0, bits), name)
                    if form:
                        self.assertEqual(text, f"[{sign},{bits - sign - fraction},{fraction}]")
                        self.assertEqual(its_unit, unit)
                    if writes and name in given:
                        self.assertEqual(reset, given[name][1] & ((1 << bits) - 1), name)


if __name__ == "__main__":
    unittest.main()
