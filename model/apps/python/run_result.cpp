// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Results for Python. Documentation: docs/python.md
#include "apps/python/run_result.hpp"

namespace feltgate::python {

RowArrays::RowArrays(bool closed_loop, const std::vector<std::string>& engines, std::size_t rows)
    : rows_(rows) {
  const bool several = engines.size() > 1;
  for (const Column& c : row_columns(closed_loop, several ? engines : std::vector<std::string>{})) {
    names_.push_back(c.name);
    if (c.value.is_bits()) {
      bits_.emplace_back(c, rows);
    } else {
      measures_.emplace_back(c, rows);
    }
  }
}

py::dict RowArrays::take() const {
  py::dict out;
  for (const std::string& name : names_) out[name.c_str()] = py::none();  // keeps the order
  const py::slice filled(0, static_cast<py::ssize_t>(count_), 1);
  for (const Measure& m : measures_) out[m.column.name.c_str()] = m.array[filled];
  for (const Bits& b : bits_) out[b.column.name.c_str()] = b.array[filled];
  return out;
}

namespace {

py::dict error_dict(const ErrorFigure& e) {
  py::dict out;
  out["max"] = e.max();
  out["rms"] = e.rms();
  if (e.outside() > 0) {
    out["outside"] = e.max_outside();
    out["ticks_outside"] = e.outside();
  }
  return out;
}

py::dict backend_dict(const BackendFigures& e, const RunResult& r) {
  py::dict out;
  if (e.compared && e.name != r.reference) {
    py::dict errors;
    errors["velocity_rad_s"] = error_dict(e.velocity_rad_s);
    errors["tau_hat_nm"] = error_dict(e.tau_hat_nm);
    errors["torque_nm"] = error_dict(e.torque_nm);
    out["errors"] = errors;
  }
  out["busy_s"] = e.busy_s;
  return out;
}

py::dict peak_dict(const Peak& p) {
  py::dict out;
  out["value"] = p.value;
  out["at_s"] = p.at_s;
  return out;
}

py::dict acted_dict(const std::map<std::string, Acted>& all) {
  py::dict out;
  for (const auto& [name, acted] : all) {
    py::dict one;
    one["seconds"] = acted.seconds;
    one["first_s"] = acted.first_s;
    out[name.c_str()] = one;
  }
  return out;
}

py::dict felt_dict(const RunResult& r) {
  const Felt& f = r.felt;
  py::dict out;
  out["asked_nm"] = peak_dict(f.torque.asked);
  out["commanded_nm"] = peak_dict(f.torque.commanded);
  if (f.closed_loop) {
    out["motor_nm"] = peak_dict(f.torque.motor);
    out["hand_nm"] = peak_dict(f.torque.hand);
    out["motor_error_nm"] = error_dict(f.torque.motor_error);
    out["taken_from_hand_j"] = f.energy.taken_from_hand_j;
    out["given_to_hand_j"] = f.energy.given_to_hand_j;
  }
  out["limits"] = acted_dict(f.limits);
  out["tau_hat_void_s"] = f.tau_hat_void.seconds;
  out["faults"] = acted_dict(f.faults);
  py::list expectations;
  for (const Expected& e : r.expectations) {
    py::dict one;
    one["figure"] = e.figure;
    one["value"] = e.value;
    one["low"] = e.low;
    one["high"] = e.high;
    one["kept"] = e.kept();
    expectations.append(one);
  }
  out["expectations"] = expectations;
  return out;
}

}  // namespace

py::dict bounds_dict(const bounds::ErrorBounds& b) {
  py::dict out;
  out["velocity_rad_s"] = b.velocity_rad_s.against_reference;
  out["tau_ref_nm"] = b.tau_ref_nm.against_reference;
  out["tau_hat_nm"] = b.tau_hat_nm.against_reference;
  out["current_a"] = b.current_a.against_reference;
  out["torque_nm"] = b.torque_nm.against_reference;
  return out;
}

py::dict result_dict(const RunResult& r) {
  py::dict out;
  out["design"] = r.design;
  out["subject"] = r.subject;
  out["ticks"] = r.ticks;
  out["simulated_s"] = r.simulated_s;
  out["reference"] = r.reference.empty() ? py::object(py::none()) : py::str(r.reference);
  py::dict engines;
  for (const BackendFigures& e : r.engines) engines[e.name.c_str()] = backend_dict(e, r);
  out["engines"] = engines;
  out["felt"] = felt_dict(r);
  out["figures"] = r.figures;
  out["broken"] = r.broken;
  py::dict bounds;
  for (const FeltError& e : r.felt.errors) bounds[e.signal.c_str()] = e.bound;
  out["bounds"] = bounds.empty() ? py::object(py::none()) : bounds;
  return out;
}

}  // namespace feltgate::python
