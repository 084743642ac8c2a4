// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// current_sense behind a second-order modulator: noise, and what the ripple of a PWM leaves.
// Documentation: docs/blocks/current_sense.md
#include "catch.hpp"
