// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What verbs say of a law and its parameters. Documentation: docs/host.md
#pragma once

#include <string>

#include "host/law_engine.hpp"

namespace feltgate::host {

/// A value in the parameter's unit: "0.05 Nm".
std::string law_text(const law::ImageWord& of, double value);
/// "0 .. 0.5 Nm".
std::string range_text(const law::ImageWord& of);
/// Which law runs, and how it is.
std::string law_state(LawEngine& laws);

}  // namespace feltgate::host
