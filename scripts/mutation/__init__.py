# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Mutants: small random changes that the tests must notice. Command: scripts/mutate.py."""
