// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain of one design in one arithmetic for Python: counts in, arrays out.
// Documentation: docs/python.md, docs/speed-for-accuracy.md
#include "apps/python/bindings.hpp"
#include "apps/python/design_names.hpp"
#include "sim/backends/backend.hpp"
#include "sim/reference/real_chain.hpp"

namespace feltgate::python {
namespace {

using Counts = py::array_t<std::int32_t, py::array::c_style>;

class PyChain {
 public:
  PyChain(const std::string& design, const std::string& arithmetic)
      : design_(design_named(design)), chain_(make_real_chain(design, arithmetic)) {}

  const DesignInfo& design() const { return design_; }
  const char* arithmetic() const { return chain_->name(); }
  void reset() { chain_->reset(); }

  void set(const std::string& name, double value) {
    const ParameterInfo& info = parameter_of(design(), name);
    quantise_parameter(info, value);  // what no register holds is refused in every arithmetic
    chain_->set_parameter(info.address, value);
  }

  py::dict run(const Counts& counts, const std::string& scene, const std::string& mode,
               bool armed) {
    if (counts.ndim() != 1) {
      throw std::invalid_argument(
          fmt::format("counts has {} dimensions; give one count for each tick", counts.ndim()));
    }
    ChainIn in;
    in.armed = armed;
    in.scene = scene_of(design(), scene);
    in.mode = mode_of(mode);
    const auto size = static_cast<std::size_t>(counts.size());
    const std::int32_t* count = counts.data();
    std::vector<double> velocity(size), tau_hat(size), tau_ref(size), current(size), voltage(size),
        duty(size);
    {
      const py::gil_scoped_release free;
      const double period = design().pwm_period;
      for (std::size_t i = 0; i < size; ++i) {
        if (i % 100'000 == 99'999) check_interrupt();
        in.position = count[i];
        in.travel = static_cast<std::int16_t>(
            static_cast<std::uint16_t>(static_cast<std::uint32_t>(count[i]) & 0xffffu));
        chain_->tick(in);
        const ChainOut& out = chain_->out();
        velocity[i] = out.velocity_rad_s;
        tau_hat[i] = out.tau_hat_nm;
        tau_ref[i] = out.tau_ref_nm;
        current[i] = out.current_a;
        voltage[i] = out.voltage_v;
        duty[i] = out.duty_clocks / period;
      }
    }
    py::dict out;
    out["velocity_rad_s"] = to_array(std::move(velocity));
    out["tau_hat_nm"] = to_array(std::move(tau_hat));
    out["tau_ref_nm"] = to_array(std::move(tau_ref));
    out["current_a"] = to_array(std::move(current));
    out["voltage_v"] = to_array(std::move(voltage));
    out["duty"] = to_array(std::move(duty));
    return out;
  }

 private:
  DesignInfo design_;
  std::unique_ptr<RealChain> chain_;
};

py::dict parameters(const std::string& design) {
  const DesignInfo d = design_named(design);
  py::dict all;
  for (int i = 0; i < d.parameter_count; ++i) {
    const ParameterInfo& p = d.parameters[i];
    py::dict one;
    one["value"] = p.si;
    one["unit"] = p.unit;
    one["step"] = std::ldexp(1.0, -p.format.fraction);
    all[p.name] = one;
  }
  return all;
}

}  // namespace

void bind_chain(py::module_& m) {
  m.def("parameters", &parameters);
  m.def("count_rad", [](const std::string& design) { return design_named(design).count_rad; });
  m.def("formats", [](const std::string& design) {
    const DesignInfo d = design_named(design);
    const auto widths = [](Format f) { return py::make_tuple(f.sign, f.integer, f.fraction); };
    py::dict all;
    all["velocity_rad_s"] = widths(d.velocity);
    all["torque_nm"] = widths(d.torque);
    all["current_a"] = widths(d.current);
    all["voltage_v"] = widths(d.voltage);
    return all;
  });
  m.def("rates", [](const std::string& design) {
    const DesignInfo d = design_named(design);
    return std::make_pair(d.clock_hz, d.tick_hz);
  });
  py::class_<PyChain>(m, "Chain")
      .def(py::init<const std::string&, const std::string&>(), py::arg("design"),
           py::arg("arithmetic"))
      .def_property_readonly("arithmetic", &PyChain::arithmetic)
      .def("reset", &PyChain::reset)
      .def("set", &PyChain::set, py::arg("name"), py::arg("value"))
      .def("run", &PyChain::run, py::arg("counts"), py::arg("scene"), py::arg("mode"),
           py::arg("armed"));
}

}  // namespace feltgate::python
