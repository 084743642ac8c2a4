// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law's text through the compiler, for the default target. docs/laws.md
#pragma once

#include <string>

#include "law/compile.hpp"

namespace feltgate::law {

/// Errors: LawError, with x.law as the file.
inline Compiled compiled(const std::string& text) { return compile_text(text, "x.law", Target{}); }

}  // namespace feltgate::law
