# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Blocks and ports that are in no property of a proof, with the reason. If such a block or port is
missing here, campaigns.judges fails. Documentation: docs/testing.md"""

import rtl_sources

# Blocks of which no port is in a property: how they are tested instead.
BLOCKS = {
    "feltgate_checks": "it has no ports; lint.elaboration breaks each constant that it checks",
    **dict.fromkeys(rtl_sources.WIRED_ROOMS, "the proofs of feltgate_core go through it"),
    "current_loop": "lock-step of feltgate_core with a current loop, and seeded defects",
}
ENGINE = (
    "not how an instruction gets its words; proven are what it gives, what programs may write, "
    "both ages and what is cleared"
)
# Blocks of which some ports are in a property: why not all.
SOME_PORTS = {
    "feltgate_core": "only the register port, the snapshot and the clocks to the duty are proven",
    "feltgate_axes": "torque from the ports, where there is no engine: no design has that with several axes",
    "engine": ENGINE,
    "engine_barrel": ENGINE,
    "engine_inputs": "when a thread is due is not proven",
    "engine_lines": ENGINE,
    "engine_mailbox": ENGINE,
    "engine_outputs": ENGINE,
}
