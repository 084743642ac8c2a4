// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chain of one design in one arithmetic for Python: counts in, arrays out.
// Documentation: docs/python.md, docs/speed-for-accuracy.md
#include "apps/python/bindings.hpp"
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
    check_counts(counts);
    ChainIn in;
    in.armed = armed;
    in.scene = scene_of(design(), scene);
    in.mode = mode_of(mode);
    const auto size = static_cast<std::size_t>(counts.size());
    const std::int32_t* count = counts.data();
    std::vector<ChainOut> rows(size);
    const double period = design().pwm_period;
    {
      const py::gil_scoped_release free;
      for (std::size_t i = 0; i < size; ++i) {
        if (i % 100'000 == 99'999) check_interrupt();
        in.position = count[i];
        in.travel = static_cast<std::int16_t>(
            static_cast<std::uint16_t>(static_cast<std::uint32_t>(count[i]) & 0xffffu));
        chain_->tick(in);
        rows[i] = chain_->out();
      }
    }
    const auto duty = [=](const ChainOut& out) { return out.duty_clocks / period; };
    return py::dict("velocity_rad_s"_a = column(rows, &ChainOut::velocity_rad_s),
                    "tau_hat_nm"_a = column(rows, &ChainOut::tau_hat_nm),
                    "tau_ref_nm"_a = column(rows, &ChainOut::tau_ref_nm),
                    "current_a"_a = column(rows, &ChainOut::current_a),
                    "voltage_v"_a = column(rows, &ChainOut::voltage_v),
                    "duty"_a = column(rows, duty));
  }

 private:
  DesignInfo design_;
  std::unique_ptr<RealChain> chain_;
};

py::dict parameters(const std::string& design) {
  const DesignInfo d = design_named(design);
  py::dict all;
  for (const ParameterInfo& p : d.parameters) {
    all[p.name] = py::dict("value"_a = p.si, "unit"_a = p.unit,
                           "step"_a = std::ldexp(1.0, -p.format.fraction));
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
    return py::dict("velocity_rad_s"_a = widths(d.velocity), "torque_nm"_a = widths(d.torque),
                    "current_a"_a = widths(d.current), "voltage_v"_a = widths(d.voltage));
  });
  m.def("rates", [](const std::string& design) {
    const DesignInfo d = design_named(design);
    return std::make_pair(d.clock_hz, d.tick_hz);
  });
  py::class_<PyChain>(m, "Chain")
      .def(py::init<const std::string&, const std::string&>(), "design"_a, "arithmetic"_a)
      .def_property_readonly("arithmetic", &PyChain::arithmetic)
      .def("reset", &PyChain::reset)
      .def("set", &PyChain::set, "name"_a, "value"_a)
      .def("run", &PyChain::run, "counts"_a, "scene"_a, "mode"_a, "armed"_a);
}

}  // namespace feltgate::python
