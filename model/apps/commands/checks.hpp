// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Checks of numbers on the command line: finite and within a range, which the message names.
// Documentation: README.md
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace feltgate::checks {

/// A finite number from min to max. `unit` follows the range in help and message; it may be empty.
/// With a unit, attach the check by transform(), because a number with another unit of the same
/// quantity is converted (law/units.hpp).
CLI::Validator number(double min, double max, const std::string& unit);
/// A finite number above 0, at most max.
CLI::Validator positive(double max, const std::string& unit);
/// A whole number from min to max, also written as 1e6. Attach it by transform().
CLI::Validator whole(std::int64_t min, std::int64_t max, const std::string& unit = "");
/// A seed: a whole number from 0 to 2^64 - 1.
CLI::Validator seed();
/// A path that is no folder; whether there is a file is not looked at.
CLI::Validator no_folder();
/// A duration that can be simulated: above 0, at most 100000 s.
CLI::Validator seconds();

}  // namespace feltgate::checks
