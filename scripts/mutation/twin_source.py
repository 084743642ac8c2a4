# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants of a C++ header, all in one text, chosen at run time (testbench/campaigns/mutate/twin/mutant.hpp).

tree-sitter parses the header. Code that only the compiler evaluates, such as constants and
template arguments, is not changed. Documentation: docs/testing.md
"""

import re

from .twin_places import Places, parsed

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
ASSIGNMENTS = {
    "+=": "-=",
    "-=": "+=",
    "|=": "&=",
    "&=": "|=",
    "*=": "+=",
    "<<=": ">>=",
    ">>=": "<<=",
}
ROUNDINGS = (
    ("Round::truncate", "Round::half_up"),
    ("Round::half_up", "Round::truncate"),
    ("D::rounding", "Round::truncate"),
    ("Overflow::saturate", "Overflow::wrap"),
)


def top_operator(node):
    """The operator of an expression, or what kind of node it is."""
    while node.type == "parenthesized_expression" and node.named_child_count == 1:
        node = node.named_children[0]
    if node.type == "binary_expression":
        return node.child_by_field_name("operator").type
    if node.type == "unary_expression":
        return node.child_by_field_name("operator").type
    return node.type


class Header(Places):
    """A header with its mutants: `result` is its text."""

    def __init__(self, name, text, first, language, dropped=()):
        super().__init__(name, text, first, dropped)
        self.result = self.emit(parsed(name, text, language))

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
            parts.append(self.text[at : child.start_byte].decode())
            field = node.field_name_for_child(index)
            parts.append(instead[field] if field in instead else self.emit(child))
            at = child.end_byte
        parts.append(self.text[at : node.end_byte].decode())
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
            self.new(
                node,
                "comparison" if operator in COMPARISONS else "arithmetic",
                was,
                f"{self.source(left)} {other} {self.source(right)}",
            )
            for other in others
        ]
        arguments = ", ".join(str(-1 if n is None else n) for n in numbers)
        return f"::feltgate_mutant::{function}<{arguments}>({texts[0]}, {texts[1]})"

    def right_of(self, node):
        """The right operand, with a typename that the parser did not see."""
        operator, right = (node.child_by_field_name(f) for f in ("operator", "right"))
        return (
            self.text[operator.end_byte : right.start_byte].decode().strip()
            + " "
            + self.emit(right)
        ).strip()

    def logical(self, node, operator):
        """A chain of one operator: each operand left out, each operator the other one."""
        operands = []
        at = node
        while (
            at.type == "binary_expression" and at.child_by_field_name("operator").type == operator
        ):
            operands.insert(0, at.child_by_field_name("right"))
            at = at.child_by_field_name("left")
        operands.insert(0, at)
        other = "||" if operator == "&&" else "&&"
        texts = []
        for operand in operands:
            text = f"static_cast<bool>({self.emit(operand)})"
            number = self.new(operand, "logic", self.source(operand), f"left out of {operator}")
            if number is not None:
                text = (
                    f"({self.on(number)} || {text})"
                    if operator == "&&"
                    else (f"(!{self.on(number)} && {text})")
                )
            texts.append(text)
        result = texts[0]
        for operand, text in zip(operands[1:], texts[1:]):
            number = self.new(
                operand,
                "logic",
                f"{operator} {self.source(operand)}",
                f"{other} {self.source(operand)}",
            )
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
        up = self.new(node, "constant", self.within(node), f"{text} + 1")
        down = self.new(node, "constant", self.within(node), f"{text} - 1")
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
        number = self.new(node, kind, self.source(node), self.source(argument))
        name = {"!": "invert", "-": "negate", "~": "complement"}[operator]
        return (
            f"::feltgate_mutant::{name}<{-1 if number is None else number}>({self.emit(argument)})"
        )

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
        return (
            "("
            + self.children(node, condition=self.condition(node.child_by_field_name("condition")))
            + ")"
        )

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
        number = self.new(
            node,
            "arithmetic",
            self.source(node),
            f"{self.source(left)} {other} {self.source(right)}",
        )
        return self.choice(number, f"void({texts[0]} {other} {texts[1]})", f"void({plain})")

    def emit_update_expression(self, node):
        text = self.source(node)
        other = (
            text.translate(str.maketrans("+-", "-+"))
            if re.fullmatch(r"[-+]*[\w.]+[-+]*", text)
            else text
        )
        if other == text:
            return self.children(node)
        return self.choice(self.new(node, "arithmetic", text, other), other, text)

    def emit_return_statement(self, node):
        if node.named_child_count == 0:
            return self.guard(self.new(node, "statement", "return", "removed"), "return;")
        value = node.named_children[0]
        if not self.returns_bool(node) or top_operator(value) in (
            *COMPARISONS,
            "!",
            "true",
            "false",
        ):
            return self.children(node)
        number = self.new(value, "negation", self.source(value), "its opposite")
        return f"return {self.negated(number, self.emit(value))};"

    def returns_bool(self, node):
        """Whether the function that a node is in returns one."""
        while node is not None and node.type not in ("function_definition", "lambda_expression"):
            node = node.parent
        if node is None or node.type != "function_definition":
            return False
        kind = node.child_by_field_name("type")
        return kind is not None and self.source(kind) == "bool"

    def leave(self, node):
        return self.guard(
            self.new(node, "statement", self.source(node).rstrip(";"), "removed"), self.source(node)
        )

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
            return (
                f"::feltgate_mutant::swapped<{number}>"
                f"([&](auto&& a_, auto&& b_) -> decltype({call}) "
                f"{{ return {call}; }}, {texts[0]}, {texts[1]})"
            )
        plain = self.emit(arguments)
        result = called + plain
        if called != was:
            return result
        for old, new in ROUNDINGS:
            if old in was and "<" in was:
                other = was.replace(old, new)
                number = self.new(node, "rounding", f"{old} of {self.source(node)}", new)
                if number is not None and old != "Overflow::saturate" and given:
                    ask = (
                        f"::feltgate_mutant::rounds<decltype({self.source(node)})>"
                        f"({number}, {self.source(given[0])})"
                    )
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
        return (
            len(given) == 2
            and "<" not in was
            and not was.startswith(("std::", "typename"))
            and all(c.type != "initializer_list" for c in given)
            and self.function(node) != "members"
        )
