# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Tables for a terminal and for a page."""


def aligned(lines, left=1):
    """Rows of cells as text: the first `left` columns begin below each other, the others end so."""
    lines = [[str(cell) for cell in line] for line in lines]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  ".join(
            cell.ljust(width) if k < left else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(line, widths, strict=True))
        ).rstrip()
        for line in lines
    )


def markdown(head, rows, left=1):
    """Lines of a table in Markdown, with the same columns."""
    rule = "|" + "---|" * left + "---:|" * (len(head) - left)
    cells = [f"| {' | '.join(map(str, row))} |" for row in (head, *rows)]
    return [cells[0], rule, *cells[1:]]
