# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of a C++ header, all in one text, chosen at run time (testbench/mutate/twin/mutant.hpp).

The header is parsed by tree-sitter. What only the compiler sees, as constants and template
arguments, stays. Documentation: docs/verification.md
"""

import re
from collections import Counter
from dataclasses import dataclass

from .twin_parser import blanked, parsed

OPERATORS = {
    # operator: (function of mutant.hpp, what it becomes)
    "+": ("plus", ("-",)),
    "-": ("minus", ("+",)),
    "*": ("times", ("+",)),
    "/": ("over", ("*",)),
    "%": ("modulo", ("*",)),
    "<<": ("left", (">>",)),
    ">>": ("right", ("<<",)),
    "&": ("bit_and", ("|",)),
    "|": ("bit_or", ("&",)),
    "^": ("bit_xor", ("&",)),
    "<": ("less", ("<=", ">=")),
    "<=": ("less_equal", ("<", ">")),
    ">": ("greater", (">=", "<=")),
    ">=": ("greater_equal", (">", "<")),
    "==": ("equal", ("!=",)),
    "!=": ("unequal", ("==",)),
}
COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
ASSIGNMENTS = {"+=": "-=", "-=": "+=", "|=": "&=", "&=": "|=", "*=": "+=", "<<=": ">>=", ">>=": "<<="}
ROUNDINGS = (
    ("Round::truncate", "Round::half_up"),
    ("Round::half_up", "Round::truncate"),
    ("D::rounding", "Round::truncate"),
    ("Overflow::saturate", "Overflow::wrap"),
)
# Never looked into: what is there is known when the header is compiled, or is no code.
CONSTANT = {
    "template_argument_list", "template_parameter_list", "static_assert_declaration",
    "enumerator_list", "attribute_declaration", "noexcept", "bitfield_clause", "array_declarator",
    "alias_declaration", "using_declaration", "type_descriptor", "decltype", "sizeof_expression",
    "preproc_include", "preproc_def", "preproc_function_def", "preproc_call", "type_definition",
    "trailing_return_type", "comment", "string_literal", "char_literal", "friend_declaration",
}
SHOWN = 70


@dataclass
class Mutant:
    number: int
    header: str
    line: int
    kind: str
    name: str  # "function: was -> is", with " #2" for the second of the same
    risky: bool = False  # may not compile, as a swap of arguments


def shortened(text):
    text = " ".join(text.split())
    if len(text) <= SHOWN:
        return text
    return text[: SHOWN // 2 - 2] + " .. " + text[-SHOWN // 2 + 2:]


def top_operator(node):
    while node.type == "parenthesized_expression" and node.named_child_count == 1:
        node = node.named_children[0]
    if node.type == "binary_expression":
        return node.child_by_field_name("operator").type
    if node.type == "unary_expression":
        return node.child_by_field_name("operator").type
    return node.type


class Header:
    """The mutants of one header; `first` is the number of the first one."""

    def __init__(self, name, text, first, language, constant=(), dropped=()):
        self.name, self.first, self.mutants = name, first, []
        self.constant, self.dropped = set(constant), set(dropped)
        self.names = Counter()
        self.text = blanked(text).encode()
        root = parsed(name, text, language)
        self.result = self.emit(root)

    # Mutants and how they are asked for.

    def new(self, node, kind, was, becomes, risky=False):
        """The number of a new mutant, or None where it has been dropped."""
        name = f"{self.function(node)}: {shortened(was)} -> {shortened(becomes)}"
        self.names[name] += 1
        if self.names[name] > 1:
            name += f" #{self.names[name]}"
        if name in self.dropped:
            return None
        number = self.first + len(self.mutants)
        self.mutants.append(Mutant(number, self.name, node.start_point[0] + 1, kind, name, risky))
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
        return self.text[node.start_byte:node.end_byte].decode()

    def function(self, node):
        while node is not None and node.type != "function_definition":
            node = node.parent
        if node is None:
            return "members"
        declarator = node.child_by_field_name("declarator")
        while declarator is not None and declarator.type != "function_declarator":
            declarator = declarator.child_by_field_name("declarator") or next(
                (c for c in declarator.named_children if c.type.endswith("declarator")), None)
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
        return f"{self.source(node)} in {self.source(at).rstrip(';')}" if at != node else self.source(node)

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
        if node.type in CONSTANT:
            return True
        if node.type == "field_declaration" and self.is_input(node):
            return True
        if node.type in ("declaration", "field_declaration"):
            return any(c.type == "type_qualifier" and self.source(c) in ("constexpr", "consteval")
                       for c in node.children)
        return node.type == "function_definition" and self.function(node) in self.constant

    # Text with its mutants.

    def emit(self, node):
        if self.is_constant(node):
            return self.source(node)
        method = getattr(self, "emit_" + node.type, None)
        return method(node) if method else self.children(node)

    def children(self, node, **instead):
        """The text of a node whose children are emitted; instead: {field: text}."""
        if node.child_count == 0:
            return self.source(node)
        parts, at = [], node.start_byte
        for index, child in enumerate(node.children):
            parts.append(self.text[at:child.start_byte].decode())
            field = node.field_name_for_child(index)
            parts.append(instead[field] if field in instead else self.emit(child))
            at = child.end_byte
        parts.append(self.text[at:node.end_byte].decode())
        return "".join(parts)

    def emit_binary_expression(self, node):
        operator = node.child_by_field_name("operator").type
        if operator in ("&&", "||"):
            return self.logical(node, operator)
        left, right = (node.child_by_field_name(f) for f in ("left", "right"))
        texts = self.emit(left), self.right_of(node)
        if operator not in OPERATORS:
            return f"{texts[0]} {operator} {texts[1]}"
        function, others = OPERATORS[operator]
        was = self.source(node)
        numbers = [
            self.new(node, "comparison" if operator in COMPARISONS else "arithmetic", was,
                     f"{self.source(left)} {other} {self.source(right)}", risky=True)
            for other in others
        ]
        arguments = ", ".join(str(-1 if n is None else n) for n in numbers)
        return f"::feltgate_mutant::{function}<{arguments}>({texts[0]}, {texts[1]})"

    def right_of(self, node):
        """The right operand, with a typename that the parser did not see."""
        operator, right = (node.child_by_field_name(f) for f in ("operator", "right"))
        return (self.text[operator.end_byte:right.start_byte].decode().strip() + " " + self.emit(right)).strip()

    def logical(self, node, operator):
        """A chain of one operator: each operand left out, each operator the other one."""
        operands = []
        at = node
        while at.type == "binary_expression" and at.child_by_field_name("operator").type == operator:
            operands.insert(0, at.child_by_field_name("right"))
            at = at.child_by_field_name("left")
        operands.insert(0, at)
        other = "||" if operator == "&&" else "&&"
        texts = []
        for operand in operands:
            text = f"static_cast<bool>({self.emit(operand)})"
            number = self.new(operand, "logic", self.source(operand), f"left out of {operator}")
            if number is not None:
                text = f"({self.on(number)} || {text})" if operator == "&&" else (
                    f"(!{self.on(number)} && {text})")
            texts.append(text)
        result = texts[0]
        for operand, text in zip(operands[1:], texts[1:]):
            number = self.new(operand, "logic", f"{operator} {self.source(operand)}",
                              f"{other} {self.source(operand)}")
            if number is None:
                result = f"({result} {operator} {text})"
            else:
                on = self.on(number)
                result = f"({on} != (({on} != {result}) {operator} ({on} != {text})))"
        return result

    def emit_number_literal(self, node):
        text = self.source(node)
        if re.search(r"[.pP]|(?<!x)[0-9][eE]", text) and not text.lower().startswith("0x"):
            return text
        up = self.new(node, "constant", self.within(node), f"{text} + 1", risky=True)
        down = self.new(node, "constant", self.within(node), f"{text} - 1", risky=True)
        return self.choice(up, f"({text} + 1)", self.choice(down, f"({text} - 1)", text))

    def truth(self, node):
        text = self.source(node)
        other = "false" if text == "true" else "true"
        return self.choice(self.new(node, "constant", self.within(node), other), other, text)

    emit_true = emit_false = truth

    def emit_unary_expression(self, node):
        operator = node.child_by_field_name("operator").type
        argument = node.child_by_field_name("argument")
        if operator not in ("!", "-", "~"):
            return self.children(node)
        if operator == "-" and argument.type == "number_literal":
            return self.emit_number_literal(node)
        kind = "negation" if operator == "!" else "arithmetic"
        number = self.new(node, kind, self.source(node), self.source(argument), risky=operator != "!")
        name = {"!": "invert", "-": "negate", "~": "complement"}[operator]
        return f"::feltgate_mutant::{name}<{-1 if number is None else number}>({self.emit(argument)})"

    def condition(self, node):
        """Of an if, a loop or a choice."""
        text = self.emit(node)
        if top_operator(node) in (*COMPARISONS, "!", "true", "false") or node.type == "declaration":
            return text
        return self.negated(self.new(node, "negation", self.source(node), "its opposite"), text)

    def emit_if_statement(self, node):
        clause = node.child_by_field_name("condition")
        if any(child.type == "constexpr" for child in node.children):
            return self.children(node, condition=self.source(clause))
        return self.children(node, condition=self.clause(clause))

    def emit_while_statement(self, node):
        return self.children(node, condition=self.clause(node.child_by_field_name("condition")))

    def clause(self, node):
        value = node.child_by_field_name("value")
        if node.type != "condition_clause" or value is None or node.named_child_count != 1:
            return self.emit(node)
        return f"({self.condition(value)})"

    def emit_for_statement(self, node):
        # Without its step a loop only ends by the time limit.
        update = node.child_by_field_name("update")
        return self.children(node, **({"update": self.source(update)} if update else {}))

    def emit_conditional_expression(self, node):
        return "(" + self.children(node, condition=self.condition(node.child_by_field_name("condition"))) + ")"

    def emit_case_statement(self, node):
        value = node.child_by_field_name("value")
        return self.children(node, **({"value": self.source(value)} if value else {}))

    def emit_expression_statement(self, node):
        if node.named_child_count != 1:
            return self.children(node)
        expression = node.named_children[0]
        if expression.type == "comma_expression":
            return self.children(node)  # its parts
        if expression.type not in ("assignment_expression", "update_expression", "call_expression"):
            return self.children(node)
        number = self.new(node, "statement", self.source(expression), "removed")
        return self.guard(number, self.emit(expression) + ";")

    def emit_comma_expression(self, node):
        parts = []
        for field in ("left", "right"):
            part = node.child_by_field_name(field)
            text = self.emit(part)
            if part.type == "assignment_expression":
                number = self.new(part, "statement", self.source(part), "removed")
                text = self.choice(number, "void()", f"void({text})")
            parts.append(text)
        return ", ".join(parts)

    def emit_assignment_expression(self, node):
        operator = node.child_by_field_name("operator").type
        left, right = (node.child_by_field_name(f) for f in ("left", "right"))
        texts = self.emit(left), self.right_of(node)
        plain = f"{texts[0]} {operator} {texts[1]}"
        if operator not in ASSIGNMENTS or node.parent.type != "expression_statement":
            return plain
        other = ASSIGNMENTS[operator]
        number = self.new(node, "arithmetic", self.source(node),
                          f"{self.source(left)} {other} {self.source(right)}", risky=True)
        return self.choice(number, f"void({texts[0]} {other} {texts[1]})", f"void({plain})")

    def emit_update_expression(self, node):
        text = self.source(node)
        other = text.translate(str.maketrans("+-", "-+")) if re.fullmatch(r"[-+]*[\w.]+[-+]*", text) else text
        if other == text:
            return self.children(node)
        return self.choice(self.new(node, "arithmetic", text, other), other, text)

    def emit_return_statement(self, node):
        if node.named_child_count == 0:
            return self.guard(self.new(node, "statement", "return", "removed"), "return;")
        value = node.named_children[0]
        if not self.returns_bool(node) or top_operator(value) in (*COMPARISONS, "!", "true", "false"):
            return self.children(node)
        number = self.new(value, "negation", self.source(value), "its opposite")
        return f"return {self.negated(number, self.emit(value))};"

    def returns_bool(self, node):
        while node is not None and node.type not in ("function_definition", "lambda_expression"):
            node = node.parent
        if node is None or node.type != "function_definition":
            return False
        kind = node.child_by_field_name("type")
        return kind is not None and self.source(kind) == "bool"

    def leave(self, node):
        return self.guard(self.new(node, "statement", self.source(node).rstrip(";"), "removed"),
                          self.source(node))

    emit_break_statement = emit_continue_statement = leave

    def emit_call_expression(self, node):
        function, arguments = (node.child_by_field_name(f) for f in ("function", "arguments"))
        was, called = self.source(function), self.emit(function)
        given = [c for c in arguments.named_children if c.type != "comment"]
        if called == was and self.can_swap(node, was, given):
            texts = [self.emit(argument) for argument in given]
            swapped = f"{was}({self.source(given[1])}, {self.source(given[0])})"
            number = self.new(node, "arguments", self.source(node), swapped)
            if number is None:
                return f"{was}({texts[0]}, {texts[1]})"
            call = f"{was}(static_cast<decltype(a_)>(a_), static_cast<decltype(b_)>(b_))"
            return (f"::feltgate_mutant::swapped<{number}>([&](auto&& a_, auto&& b_) -> decltype({call}) "
                    f"{{ return {call}; }}, {texts[0]}, {texts[1]})")
        plain = self.emit(arguments)
        result = called + plain
        if called != was:
            return result
        for old, new in ROUNDINGS:
            if old in was and "<" in was:
                other = was.replace(old, new)
                number = self.new(node, "rounding", f"{old} of {self.source(node)}", new)
                if number is not None and old != "Overflow::saturate" and given:
                    ask = f"::feltgate_mutant::rounds<decltype({self.source(node)})>({number}, {self.source(given[0])})"
                    result = f"({ask} ? {other + plain} : {result})"
                else:
                    result = self.choice(number, other + plain, result)
        for old, new in (("std::min", "std::max"), ("std::max", "std::min")):
            if was.startswith(old):
                number = self.new(node, "arithmetic", self.source(node), new)
                return self.choice(number, was.replace(old, new) + plain, result)
        return result

    def can_swap(self, node, was, given):
        """Two arguments of a function that is no template, in a function."""
        return (len(given) == 2 and "<" not in was and not was.startswith(("std::", "typename"))
                and all(c.type != "initializer_list" for c in given) and self.function(node) != "members")
