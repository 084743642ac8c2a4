// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parts of the extension module feltgate._core; each adds its own. Documentation:
// docs/python.md
#pragma once

#include "apps/python/arrays.hpp"

namespace feltgate::python {

void bind_scenes(py::module_& m);      ///< scene files, hands
void bind_plant(py::module_& m);       ///< the plant by itself
void bind_chain(py::module_& m);       ///< one design in one arithmetic, tick by tick
void bind_twin(py::module_& m);        ///< the core's twin by its pins
void bind_recordings(py::module_& m);  ///< encoder edges
void bind_runs(py::module_& m);        ///< closed loop and replay
void bind_bounds(py::module_& m);      ///< proven bounds

}  // namespace feltgate::python
