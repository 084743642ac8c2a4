// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts between std::vector and numpy, lets Ctrl-C end a long run, and translates C++ errors.
// Documentation: docs/python.md
#pragma once

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "files/toml/toml_reader.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::python {

namespace py = pybind11;
using namespace py::literals;

/// Any sequence of numbers, converted to contiguous doubles.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A contiguous numpy array of `size` values at `data`, or of its own. The stride is given:
/// pybind11 before 2.12 reads the size of an element where numpy 2 no longer has it, and gets a
/// stride of 0.
template <class T>
py::array_t<T> contiguous(std::size_t size, const T* data = nullptr, py::handle owner = {}) {
  return py::array_t<T>({static_cast<py::ssize_t>(size)}, {static_cast<py::ssize_t>(sizeof(T))},
                        data, owner);
}

/// A numpy array that owns the vector; nothing is copied.
template <class T>
py::array_t<T> to_array(std::vector<T>&& values) {
  auto owner = std::make_unique<std::vector<T>>(std::move(values));
  const T* data = owner->data();
  const std::size_t size = owner->size();
  const py::capsule keeper(owner.release(),
                           [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return contiguous(size, data, keeper);
}

/// An array of a member, or a function, of each row.
template <class Rows, class Of>
auto column(const Rows& rows, Of of) {
  std::vector<std::decay_t<decltype(std::invoke(of, *rows.begin()))>> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(std::invoke(of, row));
  return to_array(std::move(values));
}

/// A one-dimensional array of finite numbers as a vector. Throws std::invalid_argument, which names
/// the argument.
inline std::vector<double> to_vector(const Doubles& array, const char* name) {
  if (array.ndim() != 1) {
    throw std::invalid_argument(
        fmt::format("{} has {} dimensions; give a list or an array of one", name, array.ndim()));
  }
  std::vector<double> values(array.data(), array.data() + array.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw std::invalid_argument(
          fmt::format("{}[{}] is {}; give finite numbers", name, i, values[i]));
    }
  }
  return values;
}

/// Throws std::invalid_argument for counts that are no single row.
inline void check_counts(const py::array& counts) {
  if (counts.ndim() == 1) return;
  throw std::invalid_argument(
      fmt::format("counts has {} dimensions; give one count for each tick", counts.ndim()));
}

/// Raises a pending Ctrl-C; for a run that has released the interpreter's lock.
inline void check_interrupt() {
  const py::gil_scoped_acquire hold;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// A progress callback for runs: checks Ctrl-C, then calls the caller's function with 0..1, if any.
inline auto progress_for(const py::object& callback) {
  return [callback](double done) {
    check_interrupt();
    const py::gil_scoped_acquire hold;
    if (!callback.is_none()) callback(done);
  };
}

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
