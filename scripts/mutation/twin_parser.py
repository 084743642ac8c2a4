# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""C++ headers as tree-sitter reads them. Documentation: docs/testing.md"""

import glob
import re
import sys
from pathlib import Path

from command_line import Refused


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
