# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Parts of `feltgate explore`: spaces, plans, chunks, engines, the front and its page.

Documentation: docs/explore.md
"""
