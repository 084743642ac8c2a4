# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""The options that the mutants of the RTL and of the twin have in common."""

import command_line
import outputs


def mutants_parser(command, text, what, help_text, count):
    """The command line of one of both; `what` is mutated, `count` mutants of each if not said."""
    parser = command_line.parser(command, text)
    parser.add_argument("name", nargs="*", metavar=what, help=f"{help_text}; default: all")
    command_line.add_flags(parser, list="what there is; runs nothing")
    command_line.add_number(parser, "--count", count, "mutants of each, 0: all")
    command_line.add_number(parser, "--seed", 1, "which ones, where --count leaves some out")
    again = "only those that survived in these results of --json and are not listed"
    command_line.add_path(parser, "--again", metavar="RESULTS", what=again)
    command_line.add_jobs(parser, "programs")
    command_line.add_json(parser)
    command_line.add_flags(
        parser,
        survivors="list also what survives for a known reason",
        no_build="run the programs that are there",
    )
    command_line.add_only_arguments(parser)
    return parser


def parsed(parser, argv, required):
    """The options, with --require SHARE and what holds for both."""
    what = f"to be killed, of those not equivalent; default: {required}"
    share = {"type": command_line.share, "default": required, "metavar": "SHARE"}
    parser.add_argument("--require", **share, help=what)
    options = parser.parse_args(argv)
    command_line.refuse_beside(parser, options, "list", "update", "json", "again")
    outputs.check(parser, [options.again], json=options.json)
    return options
