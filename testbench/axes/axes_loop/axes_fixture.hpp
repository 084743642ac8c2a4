// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scenes of several axes by name, run by the program's own loop. docs/devices.md
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/axes_loop/axes_run.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"

namespace feltgate::test {

inline std::string device_file(const std::string& name) {
  return std::string(FELTGATE_ROOT) + "/vectors/devices/" + name + ".toml";
}

inline AxesScene scene_named(const std::string& name) {
  return read_axes_scene(std::string(FELTGATE_ROOT) + "/vectors/scenes/" + name + ".toml",
                         device_file);
}

inline std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / name).string();
}

/// The first seven lines of a scene.
inline std::string scene_head(const std::string& device, const std::string& law) {
  return "title = \"t\"\nabout = \"a\"\nduration_s = 0.02\ndevice = \"" + device +
         "\"\n[core]\nscene = \"law\"\nlaw = \"" + law + "\"\n";
}
/// What the text of a scene is refused with, after the name of its file, or "read".
inline std::string refusal(const std::string& text, bool of_one_lever = false) {
  const std::string path = temporary("feltgate_refused_scene.toml");
  std::ofstream(path) << text;
  try {
    if (of_one_lever) {
      (void)read_scenario(path);
    } else {
      (void)read_axes_scene(path, device_file);
    }
  } catch (const config::ConfigError& error) {
    return std::string(error.what()).substr(path.size());
  }
  return "read";
}

/// On the device's own design; `row` and `lead` as in AxesRunOptions.
inline AxesResult run_scene(const AxesScene& scene, const std::string& engine,
                            std::function<void(const std::vector<double>&)> row = nullptr,
                            int row_every = 1,
                            std::function<PenLead(const std::vector<double>&)> lead = nullptr) {
  const std::string design = device_of(scene) + "_law";
  const std::string& named = scene.scenario.law;
  const bool is_file = named.find('/') != std::string::npos;
  const auto law =
      make_axes_law(is_file ? named : std::string(FELTGATE_ROOT) + "/rtl/laws/" + named + ".law",
                    design_named(design), axes_of(scene));
  AxesRunOptions options;
  options.design = design;
  options.engine = engine;
  options.law = law.get();
  options.row = std::move(row);
  options.row_every = row_every;
  options.lead = std::move(lead);
  return run_axes(scene, options);
}

/// Rows of a run with the columns by name.
class Rows {
 public:
  explicit Rows(const AxesScene& scene, int every = 1, const std::string& engine = "twin")
      : names_(axes_columns(scene)) {
    result_ = run_scene(
        scene, engine, [this](const std::vector<double>& row) { rows_.push_back(row); }, every);
  }
  std::size_t size() const { return rows_.size(); }
  double of(std::size_t row, const std::string& name) const {
    const auto at = std::find(names_.begin(), names_.end(), name) - names_.begin();
    return rows_[row].at(static_cast<std::size_t>(at));
  }
  const AxesResult& result() const { return result_; }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> rows_;
  AxesResult result_;
};

}  // namespace feltgate::test
