// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Returns errors as texts for the page. Documentation: docs/page.md
#pragma once

#include <exception>
#include <string>

namespace feltgate::page {

/// Calls `act`; returns the text of its error, or an empty text.
template <class Do>
std::string said(Do&& act) {
  try {
    act();
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace feltgate::page
