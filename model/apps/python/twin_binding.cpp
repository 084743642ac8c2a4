// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's twin for Python: a count for each tick in, what its snapshots show out.
// Documentation: docs/python.md
#include <cmath>

#include "apps/python/bindings.hpp"
#include "feltgate/while_armed.hpp"
#include "sim/traces/options.hpp"

namespace feltgate::python {
namespace {

class PyTwin {
 public:
  explicit PyTwin(const std::string& design) : backend_(make_backend(design, "twin")) { reset(); }

  const DesignInfo& design() const { return backend_->design(); }
  void reset() {
    backend_->reset(1, traces::pins_at(0));
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
    check_counts(counts);
    const std::int64_t* wanted = counts.data();
    const auto size = static_cast<std::size_t>(counts.size());
    check(wanted, size);
    std::vector<Snapshot> rows;
    rows.reserve(size);
    {
      const py::gil_scoped_release free;
      for (std::size_t i = 0; i < size; ++i) {
        if (i % 100'000 == 99'999) check_interrupt();
        move(wanted[i]);
        backend_->advance(design().clocks_per_tick, edges_.data(), edges_.data() + edges_.size());
        const auto& shown = backend_->snapshots();
        rows.insert(rows.end(), shown.begin(), shown.end());
      }
    }
    return columns(rows);
  }

 private:
  [[noreturn]] static void refuse(const std::string& what) {
    throw std::runtime_error(what +
                             " cannot change while armed: the torque could jump; disarm() first");
  }

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
  py::dict columns(const std::vector<Snapshot>& rows) const {
    const DesignInfo& d = design();
    const auto real = [&](std::int64_t Snapshot::*raw, Format f, double factor = 1) {
      return column(rows, [=](const Snapshot& s) {
        return factor * std::ldexp(static_cast<double>(s.*raw), -f.fraction);
      });
    };
    return py::dict(
        "position"_a = column(rows, [](const Snapshot& s) { return std::int64_t{s.position}; }),
        "velocity_rad_s"_a = real(&Snapshot::velocity, d.velocity),
        "tau_ref_nm"_a = real(&Snapshot::tau_ref, d.torque),
        "tau_hat_nm"_a = real(&Snapshot::tau_hat, d.torque),
        "torque_nm"_a = real(&Snapshot::current_ref, d.current, d.torque_constant_nm_a),
        "current_a"_a = real(&Snapshot::current_ref, d.current),
        "voltage_v"_a = real(&Snapshot::voltage, d.voltage),
        "duty"_a = column(
            rows, [&](const Snapshot& s) { return static_cast<double>(s.duty) / d.pwm_period; }),
        "limits"_a = column(rows, &Snapshot::limits), "faults"_a = column(rows, &Snapshot::faults),
        "armed"_a = column(rows, [](const Snapshot& s) { return std::uint8_t{s.armed}; }));
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
      .def(py::init<const std::string&>(), "design"_a)
      .def("reset", &PyTwin::reset)
      .def("set", &PyTwin::set, "name"_a, "value"_a)
      .def("control", &PyTwin::control, "scene"_a, "mode"_a, "arm"_a)
      .def("clear_faults", &PyTwin::clear_faults)
      .def("stop", &PyTwin::stop, "pressed"_a)
      .def_property_readonly("count", &PyTwin::count)
      .def("run", &PyTwin::run, "counts"_a);
}

}  // namespace feltgate::python
