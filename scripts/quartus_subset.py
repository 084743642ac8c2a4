#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""SystemVerilog that Quartus Standard and Lite refuse, or that they or Yosys are known to build
wrongly; run by a Python that has pyslang.

  quartus_subset.py FILE...      FILE:LINE: the construct, and what to write instead; status 1 when
                                 there is any

It knows only what others have reported: docs/boards/quartus.md names the report behind each rule.
"""

import sys
from pathlib import Path

from pyslang import SourceManager, syntax

INCLUDED = Path(__file__).resolve().parents[1] / "rtl/tops"  # device.svh

Kind = syntax.SyntaxKind

# A construct that is never used, and what to write instead.
BANNED = {
    Kind.InterfaceDeclaration: "an interface; write its signals as ports",
    Kind.ClassDeclaration: "a class; it is not for synthesis",
    Kind.PackageImportDeclaration: "an import; write package::NAME",
    Kind.UnionType: "a union; write two signals",
    Kind.StreamingConcatenationExpression: "a streaming concatenation; write the bits out",
    Kind.InsideExpression: "inside; write the comparisons out",
    Kind.WildcardEqualityExpression: "==?; write the comparison out",
    Kind.WildcardInequalityExpression: "!=?; write the comparison out",
    Kind.ForeachLoopStatement: "foreach; write for",
    Kind.DoWhileStatement: "do; write for",
    Kind.ForeverStatement: "forever; it is not for synthesis",
    Kind.WaitStatement: "wait; it is not for synthesis",
    Kind.ProceduralForceStatement: "force; it is not for synthesis",
    Kind.ProceduralAssignStatement: "assign inside a process; write the assignment",
    Kind.EmptyMember: "a semicolon too many",
    Kind.TypeParameterDeclaration: "a parameter that is a type; write a width",
    Kind.RealType: "a real number; write a whole one",
}
# Beside these Yosys takes the width of what is cast, where both stand in a concatenation.
WIDENED = (
    Kind.BinaryOrExpression,
    Kind.BinaryAndExpression,
    Kind.BinaryXorExpression,
    Kind.AddExpression,
    Kind.LogicalShiftLeftExpression,
    Kind.LogicalShiftRightExpression,
)
GENERATES = (Kind.IfGenerate, Kind.LoopGenerate, Kind.CaseGenerate)
# At a port with a sign Yosys 0.23 derives the module twice and stops.
UNSIZED = ("'0", "'1", "'x", "'z")
FUNCTIONS = ("$clog2", "$signed", "$unsigned", "$bits", "$readmemh", "$readmemb")


def text_of(node):
    return str(node).strip()


def ancestors(node):
    while node.parent is not None:
        node = node.parent
        yield node


def is_in(node, *kinds):
    return any(above.kind in kinds for above in ancestors(node))


def complaints(node, functions):
    """What is wrong with one node; the functions are those of this file by name."""
    kind = node.kind
    if kind in BANNED:
        yield BANNED[kind]
    elif kind in GENERATES:
        if not is_in(node, Kind.GenerateRegion):
            yield "a generate construct outside generate ... endgenerate; put it between them"
        if kind == Kind.LoopGenerate and text_of(node.genvar):
            yield "a genvar declared inside for; declare it before the loop"
    elif kind == Kind.GenerateBlock:
        if node.beginName is None and node.label is None:
            yield "a generate block without a name; write begin : name"
    elif kind == Kind.ImplicitAnsiPort:
        header = node.header
        if (
            not text_of(getattr(header, "direction", ""))
            or header.dataType.kind == Kind.ImplicitType
        ):
            yield "a port without direction and type of its own; write both"
    elif kind == Kind.EnumType:
        if node.baseType is None:
            yield "an enumeration without a type; write enum logic [N:0]"
        for member in node.members:
            value = getattr(member, "initializer", None)
            if value is not None and value.expr.kind == Kind.IntegerLiteralExpression:
                yield "an enumeration's value without a width; write it as N'd..."
    elif kind == Kind.CaseStatement:
        keyword = text_of(node.uniqueOrPriority)
        if keyword == "unique0" or text_of(node.matchesOrInside):
            yield "unique0 case, or case inside; write case"
        if node.expr.kind == Kind.IntegerVectorExpression:
            yield "a case of a constant; write if ... else if"
    elif kind == Kind.ConditionalStatement and text_of(node.uniqueOrPriority):
        yield "unique or priority before if; it is taken before case only"
    elif kind == Kind.SystemName and text_of(node) not in FUNCTIONS:
        yield f"{text_of(node)}; keep it under `ifndef SYNTHESIS"
    elif kind == Kind.CastExpression:
        if node.parent.kind in WIDENED and is_in(node, Kind.ConcatenationExpression):
            yield "a cast beside an operator in a concatenation; give the result a name of its own"
    elif kind == Kind.NamedPortConnection and text_of(node.expr) in UNSIZED:
        yield f"{text_of(node.expr)} at a port; write it with its width"
    elif kind == Kind.InvocationExpression:
        called = text_of(node.left).rpartition("::")[2]
        if called in functions and is_in(node, Kind.FunctionDeclaration):
            yield f"{called} called in a function; write it where the function is called"


def check(path):
    """Complaints of a file, as lines."""
    # In a line of its own before the first: what is for simulation only is not looked at.
    text = "`define SYNTHESIS\n" + path.read_text(encoding="utf-8")
    sources = SourceManager()
    sources.addUserDirectories(str(INCLUDED))
    tree = syntax.SyntaxTree.fromText(text, sources, str(path))
    nodes, functions, found = [], set(), []

    def look(node):
        if isinstance(node, syntax.SyntaxNode):
            nodes.append(node)
            if node.kind == Kind.FunctionDeclaration:
                functions.add(text_of(node.prototype.name))

    tree.root.visit(look)
    for node in nodes:
        for complaint in complaints(node, functions):
            offset = node.getFirstToken().location.offset
            found.append((text.count("\n", 0, offset), complaint))
    return [f"{path}:{line}: {complaint}" for line, complaint in sorted(set(found))]


def main(words):
    if not words or words[0] in ("-h", "--help"):
        print(__doc__)
        return 0 if words else 2
    try:
        found = [line for word in words for line in check(Path(word))]
    except OSError as error:
        print(f"quartus_subset: {error}", file=sys.stderr)
        return 2
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
