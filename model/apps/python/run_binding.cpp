// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Closed loop, replay and proven bounds for Python: rows as arrays by column, figures as
// dictionaries. Documentation: docs/python.md
#include <algorithm>
#include <optional>

#include "apps/python/bindings.hpp"
#include "sim/loop/columns.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/loop/speed_jumps.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace feltgate::python {
namespace {

/// Rows of a run: a numpy array per column of loop/columns.hpp. Constructor and take() need the
/// GIL; add() does not.
class RowArrays {
 public:
  /// Holds up to `rows` rows. With only one engine, the base signals are those of this engine.
  RowArrays(bool closed_loop, const std::vector<std::string>& engines, std::size_t rows);
  void add(const Row& row) {
    if (count_ == rows_) throw std::length_error("more ticks than the run is long");
    for (Measure& m : measures_) m.data[count_] = m.column.value(row);
    for (Bits& b : bits_) b.data[count_] = static_cast<std::uint8_t>(b.column.value(row));
    ++count_;
  }
  /// The arrays by column name.
  py::dict take() const;

 private:
  /// A column, its array, and the begin of the array's data.
  template <class T>
  struct Filled {
    Filled(const Column& c, std::size_t rows)
        : column(c), array(contiguous<T>(rows)), data(array.mutable_data()) {}
    Column column;
    py::array_t<T> array;
    T* data;
  };
  using Measure = Filled<double>;
  using Bits = Filled<std::uint8_t>;

  std::vector<std::string> names_;  ///< in the order of the table
  std::size_t rows_, count_ = 0;
  std::vector<Measure> measures_;
  std::vector<Bits> bits_;
};

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

py::dict error_dict(const ErrorFigure& e) {
  py::dict out("max"_a = e.max(), "rms"_a = e.rms());
  if (e.outside() > 0) {
    out["outside"] = e.max_outside();
    out["ticks_outside"] = e.outside();
  }
  return out;
}

py::dict backend_dict(const BackendFigures& e, const RunResult& r) {
  py::dict out("busy_s"_a = e.busy_s);
  if (e.compared && e.name != r.reference) {
    out["errors"] = py::dict("velocity_rad_s"_a = error_dict(e.velocity_rad_s),
                             "tau_hat_nm"_a = error_dict(e.tau_hat_nm),
                             "torque_nm"_a = error_dict(e.torque_nm));
  }
  return out;
}

py::dict peak_dict(const Peak& p) { return py::dict("value"_a = p.value, "at_s"_a = p.at_s); }

py::dict acted_dict(const std::map<std::string, Acted>& all) {
  py::dict out;
  for (const auto& [name, acted] : all) {
    out[name.c_str()] = py::dict("seconds"_a = acted.seconds, "first_s"_a = acted.first_s);
  }
  return out;
}

py::dict felt_dict(const RunResult& r) {
  const Felt& f = r.felt;
  py::list expectations;
  for (const Expected& e : r.expectations) {
    expectations.append(py::dict("figure"_a = e.figure, "value"_a = e.value, "low"_a = e.low,
                                 "high"_a = e.high, "kept"_a = e.kept()));
  }
  py::dict out("asked_nm"_a = peak_dict(f.torque.asked),
               "commanded_nm"_a = peak_dict(f.torque.commanded), "limits"_a = acted_dict(f.limits),
               "tau_hat_void_s"_a = f.tau_hat_void.seconds, "faults"_a = acted_dict(f.faults),
               "expectations"_a = expectations);
  if (f.closed_loop) {
    out["motor_nm"] = peak_dict(f.torque.motor);
    out["hand_nm"] = peak_dict(f.torque.hand);
    out["motor_error_nm"] = error_dict(f.torque.motor_error);
    out["taken_from_hand_j"] = f.energy.taken_from_hand_j;
    out["given_to_hand_j"] = f.energy.given_to_hand_j;
  }
  return out;
}

/// The result with its rows.
py::dict result_dict(const RunResult& r, const RowArrays& rows) {
  py::dict engines, bounds;
  for (const BackendFigures& e : r.engines) engines[e.name.c_str()] = backend_dict(e, r);
  for (const FeltError& e : r.felt.errors) bounds[e.signal.c_str()] = e.bound;
  const auto if_any = [](bool any, const py::object& of) { return any ? of : py::none(); };
  return py::dict("design"_a = r.design, "subject"_a = r.subject, "ticks"_a = r.ticks,
                  "simulated_s"_a = r.simulated_s,
                  "reference"_a = if_any(!r.reference.empty(), py::str(r.reference)),
                  "engines"_a = engines, "felt"_a = felt_dict(r), "figures"_a = r.figures,
                  "broken"_a = r.broken, "bounds"_a = if_any(!bounds.empty(), bounds),
                  "columns"_a = rows.take());
}

/// What both kinds of run are told about design and engines.
struct What {
  std::string design, design_path, registers_path, engines;
  int every = 1;
  std::uint64_t seed = 1;

  design::Elaborated elaborated() const { return elaborated_files(design_path, registers_path); }
  std::size_t rows(double duration_s) const {
    const auto tick_hz = design_named(design).tick_hz;
    return static_cast<std::size_t>(duration_s * static_cast<double>(tick_hz) / every) + 4;
  }
};

py::dict run(Scenario scenario, const PyPlant& plant, const What& what,
             const std::map<std::string, double>& set, std::optional<double> duration_s,
             const plant::Hand* hand, const py::object& progress) {
  const DesignInfo design = design_named(what.design);
  resolve_amounts(scenario, design);
  for (const auto& [name, value] : set) {
    quantise_parameter(parameter_of(design, name), value);
    scenario.parameters[name] = value;
  }
  if (hand != nullptr) scenario.hand = *hand;
  if (duration_s) {
    if (!(*duration_s >= 1e-5 && *duration_s <= 1e5)) {
      throw std::invalid_argument(fmt::format("duration_s is {}; give 1e-5 to 1e5 s", *duration_s));
    }
    scenario.duration_s = *duration_s;
  }
  // What a scene expects, it expects of its own hand, to the end.
  if (hand != nullptr || duration_s) scenario.expectations.clear();
  resolve_effects(scenario, plant.constants().effects);

  RunOptions options;
  options.design = what.design;
  options.engine = what.engines;
  options.seed = what.seed;
  options.row_every = what.every;
  RowArrays rows(true, choose_backends(what.engines).names(), what.rows(scenario.duration_s));
  options.row = [&rows](const Row& r) { rows.add(r); };
  options.progress = progress_for(progress);
  const auto e = what.elaborated();
  RunResult result;
  {
    const py::gil_scoped_release free;
    result = run_within_bounds(e, scenario, plant.constants(), options);
  }
  for (const std::string& jump : speed_jumps(scenario, plant.constants())) {
    if (PyErr_WarnEx(PyExc_UserWarning, jump.c_str(), 1) != 0) throw py::error_already_set();
  }
  return result_dict(result, rows);
}

py::dict replay(const PyRecording& recording, const What& what, const std::string& scene, bool arm,
                const py::object& progress) {
  const auto clock_hz = design_named(what.design).clock_hz;
  if (clock_hz != recording.clock_hz) {
    throw std::invalid_argument(fmt::format(
        "the recording counts {} clocks per second, design {} has {}; read it with clock_hz={}",
        recording.clock_hz, what.design, clock_hz, clock_hz));
  }
  ReplayOptions options;
  options.design = what.design;
  options.engine = what.engines;
  options.scene = scene;
  options.arm = arm;
  options.seed = what.seed;
  options.row_every = what.every;
  const auto length = static_cast<double>(recording.edges.length);
  RowArrays rows(false, choose_backends(what.engines).names(),
                 what.rows(length / static_cast<double>(clock_hz)));
  options.row = [&rows](const Row& r) { rows.add(r); };
  options.progress = [tell = progress_for(progress), length](Clock done) {
    tell(std::min(1.0, static_cast<double>(done) / length));
  };
  const auto e = what.elaborated();
  RunResult result;
  {
    const py::gil_scoped_release free;
    MemorySource source(recording.edges);
    result = replay_within_bounds(e, source, recording.name, options);
  }
  return result_dict(result, rows);
}

}  // namespace

void bind_runs(py::module_& m) {
  py::class_<What>(m, "What")
      .def(py::init<std::string, std::string, std::string, std::string, int, std::uint64_t>(),
           "design"_a, "design_path"_a, "registers_path"_a, "engines"_a, "every"_a, "seed"_a)
      .def_readonly("every", &What::every);
  m.def("run", &run, "scene"_a, "plant"_a, "what"_a, "set"_a, "duration_s"_a, "hand"_a,
        "progress"_a);
  m.def("replay", &replay, "recording"_a, "what"_a, "scene"_a, "arm"_a, "progress"_a);
  m.def("backend_names",
        [](const std::string& engines) { return choose_backends(engines).names(); });
  m.def("laws",
        [](const std::string& design_path) { return design::read_design(design_path).scenes; });
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
        // Against the reference chain; infinite where no bound is proven.
        const bounds::ErrorBounds b = bounds::error_bounds(elaborated, region);
        return py::dict("velocity_rad_s"_a = b.velocity_rad_s.against_reference,
                        "tau_ref_nm"_a = b.tau_ref_nm.against_reference,
                        "tau_hat_nm"_a = b.tau_hat_nm.against_reference,
                        "current_a"_a = b.current_a.against_reference,
                        "torque_nm"_a = b.torque_nm.against_reference);
      },
      "design_path"_a, "registers_path"_a, "scene"_a, "velocity_rad_s"_a);
}

}  // namespace feltgate::python
