// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a run gives back to Python: rows as arrays by column, figures as dictionaries.
// Documentation: docs/python.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bounds/error_bounds.hpp"
#include "loop/columns.hpp"
#include "loop/loop.hpp"
#include "python/arrays.hpp"

namespace feltgate::python {

/// Rows of a run, a numpy array for each column of loop/columns.hpp. Made and taken with the GIL
/// held; add() goes without.
class RowArrays {
 public:
  /// Holds up to `rows` rows. Where only one engine runs, the signals of the base are its own.
  RowArrays(bool closed_loop, const std::vector<std::string>& engines, std::size_t rows);
  void add(const Row& row) {
    if (count_ == rows_) throw std::length_error("more ticks than the run is long");
    for (Measure& m : measures_) m.data[count_] = m.column.value(row);
    for (Bits& b : bits_) b.data[count_] = static_cast<std::uint8_t>(b.column.value(row));
    ++count_;
  }
  /// By column name.
  py::dict take() const;

 private:
  /// A column with its array and where that begins.
  template <class T>
  struct Filled {
    Filled(const Column& c, std::size_t rows)
        : column(c), array(static_cast<py::ssize_t>(rows)), data(array.mutable_data()) {}
    Column column;
    py::array_t<T> array;
    T* data;
  };
  using Measure = Filled<double>;
  using Bits = Filled<std::uint8_t>;

  std::vector<std::string> names_;  ///< in the order of the table
  std::size_t rows_, count_ = 0;
  std::vector<Measure> measures_;
  std::vector<Bits> bits_;
};

/// Everything but the rows.
py::dict result_dict(const RunResult& result);
/// Bounds against the reference chain by column name; infinite where nothing can be promised.
py::dict bounds_dict(const bounds::ErrorBounds& bounds);

}  // namespace feltgate::python
