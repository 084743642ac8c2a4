// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Catch2 version 2 (Debian 12) or version 3 (Debian 13), whichever is installed.
// Documentation: docs/testing.md
#pragma once

#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_approx.hpp>
#include <catch2/catch_message.hpp>
#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <string>
using Catch::Approx;  // version 2 already does this
// Its matchers of strings by the names of version 2.
namespace Catch {
namespace Matchers {
inline auto Contains(const std::string& part) { return ContainsSubstring(part); }
}  // namespace Matchers
using Matchers::Contains, Matchers::StartsWith, Matchers::EndsWith;
}  // namespace Catch
#else
#include <catch2/catch.hpp>
#endif
