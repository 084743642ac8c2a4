// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The result of a run in Python: rows as arrays by column, figures as dictionaries.
// Documentation: docs/python.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/python/arrays.hpp"
#include "sim/loop/columns.hpp"
#include "sim/loop/loop.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace feltgate::python {

/// Rows of a run: a numpy array per column of loop/columns.hpp. Constructor and take() need the
/// GIL; add() does not.
class RowArrays {
 public:
  /// Holds up to `rows` rows. With only one engine, the base signals are those of this engine.
  RowArrays(bool closed_loop, const std::vector<std::string>& engines, std::size_t rows);
  void add(const Row& row) {
    if (count_ == rows_) throw std::length_error("more ticks than the run is long");
    for (Measure& m : measures_) m.data[count_] = m.column.value(row);
    for (Bits& b : bits_) b.data[count_] = static_cast<std::uint8_t>(b.column.value(row));
    ++count_;
  }
  /// The arrays by column name.
  py::dict take() const;

 private:
  /// A column, its array, and the begin of the array's data.
  template <class T>
  struct Filled {
    Filled(const Column& c, std::size_t rows)
        : column(c), array(contiguous<T>(rows)), data(array.mutable_data()) {}
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

/// The result without the rows.
py::dict result_dict(const RunResult& result);
/// Bounds against the reference chain by column name; infinite where no bound is proven.
py::dict bounds_dict(const bounds::ErrorBounds& bounds);

}  // namespace feltgate::python
