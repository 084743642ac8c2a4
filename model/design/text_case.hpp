// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts names and numbers to the forms used in generated files. Documentation: docs/designs.md
#pragma once

#include <string>

namespace feltgate::design {

/// Converts a_name to A_NAME.
std::string upper(std::string name);
/// Converts a_name or a-name to AName.
std::string camel(const std::string& name);
/// A double as a C literal that keeps every bit.
std::string real_literal(double v);
/// The licence and "Generated from SOURCES by `feltgate generate`: do not edit. WHAT".
std::string generated_banner(const std::string& sources, const std::string& what);

}  // namespace feltgate::design
