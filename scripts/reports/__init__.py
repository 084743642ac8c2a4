# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Shared parts of demo.py, figures.py and report.py: runs, recordings, pictures, pages.

Documentation: docs/figures.md
"""
