// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder edges in memory, as Python sees them. Documentation: docs/python.md
#pragma once

#include <string>

#include "python/arrays.hpp"
#include "traces/memory_source.hpp"

namespace feltgate::python {

struct PyRecording {
  std::string name;
  std::int64_t clock_hz = 0;
  traces::Edges edges;
};

}  // namespace feltgate::python
