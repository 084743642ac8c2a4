// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Names as the generated files write them. Documentation: docs/designs.md
#pragma once

#include <string>

namespace feltgate::design {

/// a_name as A_NAME.
std::string upper(std::string name);
/// a_name or a-name as AName.
std::string camel(const std::string& name);
/// A double as a literal of C, every bit kept.
std::string real_literal(double v);
/// The licence and "Generated from SOURCES by `feltgate generate`: do not edit. WHAT".
std::string generated_banner(const std::string& sources, const std::string& what);

}  // namespace feltgate::design
