// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Recordings for Python: files of any known format, and motions that a program made up.
// Documentation: docs/python.md
#include <filesystem>

#include "apps/python/bindings.hpp"
#include "sim/traces/capture.hpp"
#include "sim/traces/open.hpp"
#include "sim/traces/options.hpp"

namespace feltgate::python {
namespace {

PyRecording read(const std::string& path, const traces::Options& options) {
  PyRecording r{std::filesystem::path(path).filename().string(), options.clock_hz, {}, {}};
  traces::Options telling = options;
  telling.warn = [&r](const std::string& what) { r.warnings.push_back(what); };
  const py::gil_scoped_release free;
  r.edges = read_all(*traces::open(path, telling));
  return r;
}

/// Counts at clocks as edges, spread evenly over each interval as docs/traces.md has it.
PyRecording of_counts(const Doubles& times, const Doubles& positions, std::int64_t clock_hz) {
  const auto time_s = to_vector(times, "time_s");
  const auto counts = to_vector(positions, "counts");
  if (time_s.size() != counts.size() || counts.size() < 2) {
    throw std::invalid_argument(
        fmt::format("time_s has {} values and counts has {}; give both the same number, at least 2",
                    time_s.size(), counts.size()));
  }
  constexpr double kMostCounts = 9007199254740992.0, kMostClocks = 4e18;
  PyRecording r{"counts", clock_hz, {}, {}};
  const auto clock_at = [&](std::size_t i) {
    const double clocks = time_s[i] * static_cast<double>(clock_hz);
    if (!(clocks >= 0 && clocks < kMostClocks && std::abs(counts[i]) < kMostCounts)) {
      throw std::invalid_argument(
          fmt::format("row {} (time {} s, {} counts) is out of reach", i, time_s[i], counts[i]));
    }
    return static_cast<Clock>(std::llround(clocks));
  };
  Clock from = clock_at(0);
  std::int64_t count = std::llround(counts[0]);
  r.edges.initial = traces::pins_at(static_cast<unsigned>(count & 3));
  for (std::size_t i = 1; i < counts.size(); ++i) {
    const Clock to = clock_at(i);
    const std::int64_t steps = std::abs(std::llround(counts[i]) - count);
    if (to <= from || steps > to - from) {
      throw std::invalid_argument(fmt::format(
          "{} counts in {} clocks before row {}: times must rise, by a clock per count at least",
          steps, to - from, i));
    }
    const std::int64_t turn = std::llround(counts[i]) > count ? 1 : -1;
    for (std::int64_t k = 1; k <= steps; ++k) {
      count += turn;
      // Before 2^62: a slot's end is a fraction of the interval.
      const auto part = static_cast<long double>(to - from) * static_cast<long double>(k) /
                        static_cast<long double>(steps);
      r.edges.events.push_back(
          {from + static_cast<Clock>(part), traces::pins_at(static_cast<unsigned>(count & 3))});
    }
    from = to;
  }
  r.edges.length = from + 1;
  return r;
}

py::dict arrays(const PyRecording& r) {
  traces::StepCounter counter(r.edges.initial);
  const auto counts = column(r.edges.events, [&](const EncoderEvent& e) {
    counter.add(e);
    return counter.result().position;
  });
  const auto pins = column(r.edges.events, [](const EncoderEvent& e) {
    return static_cast<std::uint8_t>(e.pins.a | e.pins.b << 1 | e.pins.z << 2);
  });
  return py::dict("clock"_a = column(r.edges.events, &EncoderEvent::clock), "counts"_a = counts,
                  "pins"_a = pins, "illegal"_a = counter.result().illegal,
                  "reversals"_a = counter.result().reversals);
}

}  // namespace

void bind_recordings(py::module_& m) {
  py::class_<PyRecording>(m, "Recording")
      .def_static(
          "read",
          [](const std::string& path, const std::vector<std::string>& probes,
             const std::string& step, const std::string& dir, const std::string& time_column,
             const std::string& time_unit, const std::string& count_column,
             const std::string& scale, const std::optional<std::string>& wrap,
             std::int64_t sample_hz, const std::string& format, bool jitter, std::uint64_t seed,
             std::int64_t clock_hz) {
            traces::Options o;
            o.probes = probes;
            o.step = step;
            o.dir = dir;
            o.time_column = time_column;
            o.time_unit = time_unit;
            o.count_column = count_column;
            if (!scale.empty()) o.scale = traces::parse_scale(scale);
            if (wrap) o.wrap = traces::parse_wrap(*wrap);
            o.sample_hz = sample_hz;
            if (!format.empty()) o.format = traces::parse_format(format);
            o.jitter = jitter;
            o.seed = seed;
            o.clock_hz = clock_hz;
            return read(path, o);
          },
          "path"_a, "probes"_a, "step"_a, "dir"_a, "time_column"_a, "time_unit"_a, "count_column"_a,
          "scale"_a, "wrap"_a, "sample_hz"_a, "format"_a, "jitter"_a, "seed"_a, "clock_hz"_a)
      .def_static("of_counts", &of_counts, "time_s"_a, "counts"_a, "clock_hz"_a)
      .def_readonly("name", &PyRecording::name)
      .def_readonly("warnings", &PyRecording::warnings)
      .def_readonly("clock_hz", &PyRecording::clock_hz)
      .def_property_readonly("length_clocks", [](const PyRecording& r) { return r.edges.length; })
      .def("arrays", &arrays);
}

}  // namespace feltgate::python
