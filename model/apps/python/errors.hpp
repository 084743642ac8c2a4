// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Translates C++ errors to Python exceptions for the extension modules. Documentation:
// docs/python.md
#pragma once

#include <exception>

#include "apps/python/arrays.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/traces/error.hpp"

namespace feltgate::python {

/// An unusable file becomes a ValueError, like every other unusable input.
inline void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const config::ConfigError& e) {
    PyErr_SetString(PyExc_ValueError, e.what());
  } catch (const traces::TraceError& e) {
    PyErr_SetString(PyExc_ValueError, e.what());
  }
}

}  // namespace feltgate::python
