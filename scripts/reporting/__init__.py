# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""What demo.py, figures.py and report.py share: runs, recordings, pictures, pages.

Documentation: docs/figures.md
"""
