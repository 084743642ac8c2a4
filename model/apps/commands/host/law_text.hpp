// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Texts about a law and its parameters, for the verbs. Documentation: docs/host.md
#pragma once

#include <string>

#include "host/law_engine.hpp"

namespace feltgate::host {

/// A value in the parameter's unit: "0.05 Nm".
std::string law_text(const law::ImageWord& of, double value);
/// The range of a parameter: "0 .. 0.5 Nm".
std::string range_text(const law::ImageWord& of);
/// The name and state of the law that runs.
std::string law_state(LawEngine& laws);

}  // namespace feltgate::host
