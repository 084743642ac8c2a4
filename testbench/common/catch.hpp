// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Catch2 version 2 (Debian 12) or version 3 (Debian 13), whichever is installed.
// Documentation: docs/testing.md
#pragma once

#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_approx.hpp>
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>
using Catch::Approx;  // version 2 already does this
#else
#include <catch2/catch.hpp>
#endif
