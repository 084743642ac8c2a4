// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin for Python: a count for each tick in, what its snapshots show out.
// Documentation: docs/python.md
#include <cmath>

#include "apps/python/bindings.hpp"
#include "apps/python/design_names.hpp"
#include "feltgate/while_armed.hpp"
#include "sim/backends/backend.hpp"
#include "sim/traces/options.hpp"

namespace feltgate::python {
namespace {

class PyTwin {
 public:
  explicit PyTwin(const std::string& design) : backend_(make_backend(design, "twin")) { reset(); }

  const DesignInfo& design() const { return backend_->design(); }
  void reset() {
    backend_->reset(1, traces::pins_at(0));
    backend_->keep_gate_times(false);
    count_ = 0;
    asked_ = false;
  }
  void set(const std::string& name, double value) {
    const ParameterInfo& info = parameter_of(design(), name);
    if (asked_ && while_armed(info.address, 0) == WhileArmed::refused) refuse(name);
    backend_->write(info.address, static_cast<std::uint32_t>(quantise_parameter(info, value)));
  }
  /// The host's control word: what is rendered, and whether.
  void control(const std::string& scene, const std::string& mode, bool arm) {
    const int number = scene_of(design(), scene), mode_bits = mode_of(mode);
    if (asked_ && arm && mode_bits != mode_) refuse("the mode");
    asked_ = arm;
    mode_ = mode_bits;
    backend_->write(design().control_address, control_word(design(), number, mode_bits, arm));
  }
  void clear_faults() {
    backend_->write(design().command_address, 1u << design().command.clear_faults);
  }
  void stop(bool pressed) { backend_->stop(pressed); }
  std::int64_t count() const { return count_; }

  py::dict run(const py::array_t<std::int64_t, py::array::c_style>& counts) {
    if (counts.ndim() != 1) {
      throw std::invalid_argument(
          fmt::format("counts has {} dimensions; give one count for each tick", counts.ndim()));
    }
    const std::int64_t* wanted = counts.data();
    const auto size = static_cast<std::size_t>(counts.size());
    check(wanted, size);
    Columns all;
    {
      const py::gil_scoped_release free;
      all.reserve(size);
      for (std::size_t i = 0; i < size; ++i) {
        if (i % 100'000 == 99'999) check_interrupt();
        move(wanted[i]);
        backend_->advance(design().clocks_per_tick, edges_.data(), edges_.data() + edges_.size());
        for (const Snapshot& s : backend_->snapshots()) keep(all, s);
      }
    }
    return take(all);
  }

 private:
  [[noreturn]] static void refuse(const std::string& what) {
    throw std::runtime_error(what +
                             " cannot change while armed: the torque could jump; disarm() first");
  }

  struct Columns {
    std::vector<double> velocity, tau_hat, tau_ref, torque, current, voltage, duty;
    std::vector<std::int64_t> position;
    std::vector<std::uint16_t> limits, faults;
    std::vector<std::uint8_t> armed;
    void reserve(std::size_t n) {
      for (auto* c : {&velocity, &tau_hat, &tau_ref, &torque, &current, &voltage, &duty}) {
        c->reserve(n);
      }
      position.reserve(n);
      for (auto* c : {&limits, &faults}) c->reserve(n);
      armed.reserve(n);
    }
  };

  /// Edges of a tick come in its first half, so that the next sample sees them all.
  Clock most_steps() const { return design().clocks_per_tick / 2; }

  /// Nothing moves unless all of it can.
  void check(const std::int64_t* wanted, std::size_t size) const {
    std::int64_t before = count_;
    for (std::size_t i = 0; i < size; ++i) {
      if (std::abs(wanted[i]) > 2'147'483'647 || std::abs(wanted[i] - before) > most_steps()) {
        throw std::invalid_argument(
            fmt::format("counts[{}] is {} after {}: at most {} counts in a tick, within 32 bits", i,
                        wanted[i], before, most_steps()));
      }
      before = wanted[i];
    }
  }
  void move(std::int64_t wanted) {
    edges_.clear();
    const std::int64_t steps = std::abs(wanted - count_), turn = wanted > count_ ? 1 : -1;
    for (std::int64_t k = 1; k <= steps; ++k) {
      count_ += turn;
      edges_.push_back({backend_->now() + k * most_steps() / steps,
                        traces::pins_at(static_cast<unsigned>(count_ & 3))});
    }
  }
  void keep(Columns& all, const Snapshot& s) const {
    const auto real = [](std::int64_t raw, Format f) {
      return std::ldexp(static_cast<double>(raw), -f.fraction);
    };
    const DesignInfo& d = design();
    all.position.push_back(s.position);
    all.velocity.push_back(real(s.velocity, d.velocity));
    all.tau_hat.push_back(real(s.tau_hat, d.torque));
    all.tau_ref.push_back(real(s.tau_ref, d.torque));
    all.current.push_back(real(s.current_ref, d.current));
    all.torque.push_back(d.torque_constant_nm_a * all.current.back());
    all.voltage.push_back(real(s.voltage, d.voltage));
    all.duty.push_back(static_cast<double>(s.duty) / d.pwm_period);
    all.limits.push_back(s.limits);
    all.faults.push_back(s.faults);
    all.armed.push_back(s.armed);
  }
  static py::dict take(Columns& all) {
    py::dict out;
    out["position"] = to_array(std::move(all.position));
    out["velocity_rad_s"] = to_array(std::move(all.velocity));
    out["tau_ref_nm"] = to_array(std::move(all.tau_ref));
    out["tau_hat_nm"] = to_array(std::move(all.tau_hat));
    out["torque_nm"] = to_array(std::move(all.torque));
    out["current_a"] = to_array(std::move(all.current));
    out["voltage_v"] = to_array(std::move(all.voltage));
    out["duty"] = to_array(std::move(all.duty));
    out["limits"] = to_array(std::move(all.limits));
    out["faults"] = to_array(std::move(all.faults));
    out["armed"] = to_array(std::move(all.armed));
    return out;
  }

  std::unique_ptr<Backend> backend_;
  bool asked_ = false;  ///< to be armed
  int mode_ = 0;
  std::int64_t count_ = 0;
  std::vector<EncoderEvent> edges_;
};

}  // namespace

void bind_twin(py::module_& m) {
  py::class_<PyTwin>(m, "Twin")
      .def(py::init<const std::string&>(), py::arg("design"))
      .def("reset", &PyTwin::reset)
      .def("set", &PyTwin::set, py::arg("name"), py::arg("value"))
      .def("control", &PyTwin::control, py::arg("scene"), py::arg("mode"), py::arg("arm"))
      .def("clear_faults", &PyTwin::clear_faults)
      .def("stop", &PyTwin::stop, py::arg("pressed"))
      .def_property_readonly("count", &PyTwin::count)
      .def("run", &PyTwin::run, py::arg("counts"));
}

}  // namespace feltgate::python
