# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Faults: the effect of a flipped bit or a broken wire. Command: scripts/faults.py."""
