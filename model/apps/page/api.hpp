// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the functions that the page calls share: errors as texts, and values for JavaScript. Only
// Emscripten compiles it. Documentation: docs/page.md
#pragma once

#include <emscripten/val.h>

#include <exception>
#include <string>
#include <vector>

namespace feltgate::page {

using emscripten::val;

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

inline void add_to(val& /*out*/) {}
/// Sets properties of `out`: a name, its value, and so on.
template <class T, class... Rest>
void add_to(val& out, const char* name, const T& value, const Rest&... rest) {
  out.set(name, value);
  add_to(out, rest...);
}
/// object("x", 1.0, "y", 2.0)
template <class... Parts>
val object(const Parts&... parts) {
  val out = val::object();
  add_to(out, parts...);
  return out;
}

/// An array of what `of` makes of each item.
template <class List, class Of>
val array_of(const List& items, Of&& of) {
  val list = val::array();
  for (const auto& item : items) list.call<void>("push", of(item));
  return list;
}
inline val array_of(const std::vector<double>& numbers) {
  return array_of(numbers, [](double number) { return number; });
}

/// Structs of doubles as one array of doubles, valid until the next call.
template <std::size_t values, class Row>
val view_of(const std::vector<Row>& rows) {
  static_assert(sizeof(Row) == values * sizeof(double), "no gaps");
  return val(emscripten::typed_memory_view(rows.size() * values,
                                           reinterpret_cast<const double*>(rows.data())));
}

}  // namespace feltgate::page
