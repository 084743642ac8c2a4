// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Proven bounds for Python. Documentation: docs/python.md, docs/error-bounds.md
#include "apps/python/bindings.hpp"
#include "apps/python/design_names.hpp"
#include "apps/python/run_result.hpp"
#include "design/design.hpp"
#include "design/generate.hpp"
#include "sim/backends/backend.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace feltgate::python {

void bind_bounds(py::module_& m) {
  m.def("laws",
        [](const std::string& design_path) { return design::read_design(design_path).scenes; });
  m.def("require_current", [](const std::string& design, const std::string& design_path,
                              const std::string& registers_path) {
    design::require_current(elaborated_files(design_path, registers_path),
                            design_named(design).file_sum,
                            "run ./feltgate generate and install the package again (pip install .)");
  });
  m.def(
      "bounds",
      [](const std::string& design_path, const std::string& registers_path,
         const std::string& scene, double velocity_rad_s) {
        if (!(velocity_rad_s >= 0)) {
          throw std::invalid_argument(fmt::format(
              "velocity_rad_s is {}; give a largest speed, or 0 for any at all", velocity_rad_s));
        }
        const auto elaborated = elaborated_files(design_path, registers_path);
        bounds::InputRegion region;
        region.velocity_rad_s = velocity_rad_s;
        region.scene = scene;
        return bounds_dict(bounds::error_bounds(elaborated, region));
      },
      py::arg("design_path"), py::arg("registers_path"), py::arg("scene"),
      py::arg("velocity_rad_s"));
}

}  // namespace feltgate::python
