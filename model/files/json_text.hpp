// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// JSON as text that can always be written. Documentation: docs/json.md
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace feltgate::files {

/// Pretty-printed, ends with a newline. JSON is UTF-8; what is not, such as a file's name in
/// Latin-1, is written with U+FFFD in place of each wrong byte.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace feltgate::files
