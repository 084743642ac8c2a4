# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Seeded defects: patches, and files with all defects of a test. Command: scripts/defects.py."""
