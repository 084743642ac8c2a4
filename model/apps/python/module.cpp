// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The extension module feltgate._core. Documentation: docs/python.md
#include "apps/python/bindings.hpp"
#include "apps/python/errors.hpp"
#include "apps/python/extra_designs.hpp"
#include "sim/backends/backend.hpp"

namespace feltgate::python {

PYBIND11_MODULE(_core, m) {
  m.doc() = "The C++ side of the package feltgate.";
  py::register_exception_translator(translate);
  m.attr("version") = FELTGATE_VERSION;
  m.attr("extra_designs") = add_extra_designs();
  m.def("design_names", &design_names);
  bind_scenes(m);
  bind_plant(m);
  bind_chain(m);
  bind_twin(m);
  bind_recordings(m);
  bind_bounds(m);
  bind_runs(m);
}

}  // namespace feltgate::python
