// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Seeded changes of an input: bytes, lines, words and numbers. Documentation: docs/testing.md
#pragma once

#include <cstdint>
#include <string>

#include "random.hpp"

namespace feltgate::fuzz {

/// `input` after a few random changes; parts of `other` may get into it.
std::string mutated(std::string input, const std::string& other, test::Random& random);

}  // namespace feltgate::fuzz
