# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Seeded defects: patches, and the files that hold all of a test's. Command: scripts/defects.py."""
