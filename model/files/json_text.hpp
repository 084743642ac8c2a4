// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes JSON as text, without failure for invalid UTF-8. Documentation: docs/json.md
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace feltgate::files {

/// The JSON, pretty-printed, with a final newline. In a text that is not UTF-8, such as a file name
/// in Latin-1, U+FFFD replaces each invalid byte.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace feltgate::files
