// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parts of the extension module feltgate._core, each of which adds its own; and what several of
// them know: names of a design, plant, encoder edges. Documentation: docs/python.md
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/python/arrays.hpp"
#include "design/design.hpp"
#include "feltgate/encoder_source.hpp"
#include "sim/backends/backend.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::python {

void bind_scenes(py::module_& m);      ///< scene files, hands
void bind_plant(py::module_& m);       ///< the plant by itself
void bind_chain(py::module_& m);       ///< one design in one arithmetic, tick by tick
void bind_twin(py::module_& m);        ///< the core's twin by its pins
void bind_recordings(py::module_& m);  ///< encoder edges
void bind_runs(py::module_& m);        ///< closed loop, replay and proven bounds

/// Elaborates the files of a compiled-in design; a coarse resolution is accepted. Throws
/// config::ConfigError.
design::Elaborated elaborated_files(const std::string& design_path,
                                    const std::string& registers_path);

/// The following functions throw std::invalid_argument for an unknown name.
const ParameterInfo& parameter_of(const DesignInfo& design, const std::string& name);
int scene_of(const DesignInfo& design, const std::string& name);
/// closed_loop, open_loop or voltage: the mode of the control word.
int mode_of(const std::string& name);

/// The plant: constants by name, and a motor that the caller drives.
class PyPlant {
 public:
  /// Keys of `set` are "section.key" of the plant file. Throws config::ConfigError as for a file.
  PyPlant(const std::string& path, const std::map<std::string, double>& set,
          const std::string& design, const plant::Hand& hand);

  const plant::Parameters& constants() const { return constants_; }
  /// Every number of the file, by "section.key".
  std::map<std::string, double> parameters() const;
  void reset();
  /// Applies each duty for `step_clocks`; returns the plant's values at the end of each step.
  py::dict run(const Doubles& duty, Clock step_clocks, bool gates_on);
  double theta_rad() const { return plant_->observables().theta_rad; }
  std::int64_t counts() const { return plant_->encoder().count(); }
  double time_s() const { return static_cast<double>(plant_->now()) / drive_.clock_hz; }

 private:
  toml::table table_;
  plant::Parameters constants_;
  plant::Drive drive_;
  plant::Hand hand_;
  std::unique_ptr<plant::Plant> plant_;
};

/// The pins before the first edge, the edges in order of time, and where it ends.
struct Edges {
  EncoderPins initial;
  std::vector<EncoderEvent> events;
  Clock length = 0;  ///< clocks
};

/// Reads `edges`, which must outlive it, from the start.
class MemorySource final : public EncoderSource {
 public:
  explicit MemorySource(const Edges& edges) : edges_(edges) {}
  EncoderPins initial() const override { return edges_.initial; }
  std::optional<EncoderEvent> next() override {
    if (next_ == edges_.events.size()) return std::nullopt;
    return edges_.events[next_++];
  }
  Clock length() const override { return edges_.length; }

 private:
  const Edges& edges_;
  std::size_t next_ = 0;
};

/// `source` to its end.
inline Edges read_all(EncoderSource& source) {
  Edges edges;
  edges.initial = source.initial();
  while (const auto event = source.next()) edges.events.push_back(*event);
  edges.length = source.length();
  return edges;
}

struct PyRecording {
  std::string name;
  std::int64_t clock_hz = 0;
  Edges edges;
  std::vector<std::string> warnings;
};

}  // namespace feltgate::python
