# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
"""Parts of `feltgate page`: the twin compiled for a browser, and the page around it."""
