// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The Python interface of encoder edges in memory. Documentation: docs/python.md
#pragma once

#include <string>

#include "apps/python/arrays.hpp"
#include "sim/traces/memory_source.hpp"

namespace feltgate::python {

struct PyRecording {
  std::string name;
  std::int64_t clock_hz = 0;
  traces::Edges edges;
};

}  // namespace feltgate::python
