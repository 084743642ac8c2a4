// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Errors as texts, for bindings that a browser calls. Documentation: docs/page.md
#pragma once

#include <exception>
#include <string>

namespace feltgate::page {

/// What went wrong as a text for the page; empty: nothing.
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
