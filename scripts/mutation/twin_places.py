# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""How tree-sitter reads a C++ header, where it has mutants, what they are called, and how the header
asks for them (testbench/campaigns/mutate/twin/mutant.hpp). docs/testing.md
"""

import glob
import re
import sys
from collections import Counter
from pathlib import Path

from command_line import Refused

from .runs import Mutant
from .twin_programs import HEADERS

# Never looked into: what is there is known when the header is compiled, or is no code.
CONSTANT = frozenset("""
    template_argument_list template_parameter_list static_assert_declaration enumerator_list
    attribute_declaration noexcept bitfield_clause array_declarator alias_declaration
    using_declaration type_descriptor decltype sizeof_expression preproc_include preproc_def
    preproc_function_def preproc_call type_definition trailing_return_type comment string_literal
    char_literal friend_declaration
""".split())
SHOWN = 70


def shortened(text):
    """At most SHOWN letters, the middle left out."""
    text = " ".join(text.split())
    if len(text) <= SHOWN:
        return text
    return text[: SHOWN // 2 - 2] + " .. " + text[-SHOWN // 2 + 2 :]


class SourceError(Refused):
    """A header that is not understood."""


def blanked(text):
    """Comments become spaces: not one column moves."""
    text = re.sub(r"//[^\n]*", lambda m: " " * len(m[0]), text)
    text = re.sub(r"/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=re.S)
    return text


def for_parser(text):
    """What tree-sitter does not know, in as many columns."""
    text = re.sub(r"= \{\}(?=[,)])", "= no", text)  # a default argument
    text = re.sub(r"\bFELTGATE_INLINED(?= {)", " " * 16, text)
    text = re.sub(r"\bdecltype\((\w+)\)(?=\{)", r"decltype_\1_", text)
    return re.sub(
        r"(?<=::|->)template (?=\w)|(?<=\.)template (?=\w)|\btypename (?=\w)", " " * 9, text
    )


def parsed(name, text, language):
    """The root of a header's tree; SourceError where there is no sense in it."""
    import tree_sitter

    root = tree_sitter.Parser(language).parse(for_parser(blanked(text)).encode()).root_node
    bad = [n for n in walk(root) if n.is_error or n.is_missing]
    if bad:
        raise SourceError(f"{name}:{bad[0].start_point[0] + 1}: not understood by tree-sitter")
    return root


def walk(node):
    yield node
    for child in node.children:
        yield from walk(child)


def cpp_language(venv=None):
    """C++ for tree-sitter, from this folder where Python itself has it not."""
    sys.path += glob.glob(str(Path(venv or "") / "lib/python3*/site-packages")) if venv else []
    try:
        import tree_sitter
        import tree_sitter_cpp
    except ImportError as error:
        raise SourceError(
            f"{error}: ./feltgate mutate --twin fetches tree-sitter from PyPI"
        ) from None
    return tree_sitter.Language(tree_sitter_cpp.language())


class Places:
    """The mutants of one header; `first` is the number of the first one."""

    def __init__(self, name, text, first, dropped):
        self.name, self.first, self.mutants, self.kinds = name, first, [], {}
        self.dropped, self.names = set(dropped), Counter()
        self.text = blanked(text).encode()

    # Mutants and how they are asked for.

    def new(self, node, kind, was, becomes):
        """The number of a new mutant, or None where it has been dropped. It is called "function: was
        -> is", with " #2" for the second of the same."""
        what = f"{self.function(node)}: {shortened(was)} -> {shortened(becomes)}"
        self.names[what] += 1
        if self.names[what] > 1:
            what += f" #{self.names[what]}"
        if what in self.dropped:
            return None
        number = self.first + len(self.mutants)
        where = f"{HEADERS}/{self.name}.hpp:{node.start_point[0] + 1}"
        self.mutants.append(Mutant(number, what, [where]))
        self.kinds[number] = kind
        return number

    @staticmethod
    def on(number):
        return f"::feltgate_mutant::on({number})"

    def choice(self, number, mutated, text):
        return text if number is None else f"({self.on(number)} ? {mutated} : {text})"

    def guard(self, number, statement):
        return statement if number is None else f"{{ if (!{self.on(number)}) {statement} }}"

    def negated(self, number, text):
        return text if number is None else f"({self.on(number)} != static_cast<bool>({text}))"

    # Places.

    def source(self, node):
        return self.text[node.start_byte : node.end_byte].decode()

    def function(self, node):
        """The name of the function that a node is in, else "members"."""
        while node is not None and node.type != "function_definition":
            node = node.parent
        if node is None:
            return "members"
        declarator = node.child_by_field_name("declarator")
        while declarator is not None and declarator.type != "function_declarator":
            declarator = declarator.child_by_field_name("declarator") or next(
                (c for c in declarator.named_children if c.type.endswith("declarator")), None
            )
        if declarator is None:
            return "members"
        name = self.source(declarator.child_by_field_name("declarator"))
        return " ".join(name.split()).rsplit("::", 1)[-1]

    def within(self, node):
        """A literal and where it stands."""
        at = node.parent
        while at.type in ("parenthesized_expression", "argument_list", "initializer_list"):
            at = at.parent
        if at.type.endswith("statement") and at.type != "return_statement":
            at = node
        return (
            f"{self.source(node)} in {self.source(at).rstrip(';')}"
            if at != node
            else self.source(node)
        )

    def is_input(self, node):
        """A member of a struct for inputs or words: whoever fills it sets it."""
        name = node.child_by_field_name("declarator")
        while node is not None and node.type != "struct_specifier":
            if node.type == "class_specifier":
                return False
            node = node.parent
        if node is None or name is None or self.source(name).endswith("_"):
            return False
        kind = node.child_by_field_name("name")
        return kind is not None and self.source(kind) in ("In", "Words", "Tick")

    def is_constant(self, node):
        """Whether only the compiler evaluates it, so that it has no mutants."""
        if node.type in CONSTANT:
            return True
        if node.type == "field_declaration" and self.is_input(node):
            return True
        if node.type in ("declaration", "field_declaration"):
            return any(
                c.type == "type_qualifier" and self.source(c) in ("constexpr", "consteval")
                for c in node.children
            )
        return False
