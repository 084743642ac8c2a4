// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the commands around a run share: its options, its figures as JSON and as text, its rows as
// CSV. Documentation: docs/json.md, docs/architecture.md
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/axes_loop/axes_run.hpp"
#include "sim/loop/columns.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scene_law.hpp"
#include "studies/stability/constants.hpp"

namespace feltgate {

/// Help texts of options that run and replay share.
constexpr const char* backend_help =
    "rtl, twin, float (binary32), double (binary64), quad (binary128), several with commas between "
    "them, or all: RTL and twin in lock-step, the others beside";
constexpr const char* every_help =
    "CSV: only every n-th tick; default: the first of 1, 2, 5, 10, 20, ... that leaves at most "
    "100000 rows";

/// Texts and values that are printed in addition to the figures.
struct RunLabels {
  std::string subject_key;  ///< "scene" or "trace"
  std::string plant, probes;
  int step_clocks = 0;                              ///< step of the plant
  std::vector<std::string> effects_off = {};        ///< disabled effects of the plant
  std::vector<stability::Constant> differing = {};  ///< constants in which design and plant differ
  std::string plant_as_named = {};                  ///< the user's name of the plant, for the mend
  std::vector<std::string> speed_jumps = {};        ///< speed jumps of the hand, a sentence each
  double never_armed_s = 0;                         ///< arm_s if the scene ends before it; 0: none
  std::string encoder = {};                         ///< what it is, unless A, B and Z are read
  std::vector<std::string> notes = {};              ///< further sentences, for the text only
};

/// The JSON object, pretty-printed.
std::string run_json(const RunResult& result, const RunLabels& labels);

/// The same as text for a terminal: what ran, the back-ends if there are several, what was felt.
std::string run_text(const RunResult& result, const RunLabels& labels);

// Parts of both.
std::string acted_text(const std::map<std::string, Acted>& all);
nlohmann::ordered_json acted_json(const std::map<std::string, Acted>& all);
std::string energy_lines(const FeltEnergy& energy);
nlohmann::ordered_json energy_json(const FeltEnergy& energy);
/// Warns that the law's torque was 0 because its mailbox was too old; empty if it never was.
std::string stale_line(const Acted& stale);
/// The first lines of a run: large errors without a proven bound.
std::string large_error_lines(const SessionResult& r);
/// The expectations that are kept; run_text() and axes_text() end with those that are not.
std::string expectation_line(const std::vector<Expected>& all);
/// How long it was, what differed and from what.
nlohmann::ordered_json session_json(const SessionResult& r);

/// If RTL and twin differed, repeats the run, which is deterministic, with a waveform of the clocks
/// around the first mismatch, and prints where it is. `run` gets the options of the run with it.
void show_mismatch(const SessionResult& result, BackendOptions options,
                   const std::function<void(const BackendOptions& again)>& run);
/// The scene of that run, ended after so many clocks, without expectations.
Scenario cut_after(Scenario scenario, const SessionResult& result, Clock clocks);

/// Applies each NAME=VALUE of --set to the scene's parameters; the value may have a unit
/// (law/units.hpp). `law` may be nullptr. Throws std::invalid_argument.
void apply_settings(const std::vector<std::string>& set, const DesignInfo& design,
                    const SceneLaw* law, Scenario& scenario);
/// A scene that names a device, with its file in vectors/devices.
AxesScene device_scene(const std::string& path);
/// Throws std::invalid_argument: an option that a scene with a device does not have.
[[noreturn]] void refuse_for_device(const std::string& option, const std::string& scene);
/// The path of the law that a scene names; a relative path starts at the scene's folder.
std::string law_file(const Scenario& scenario);

/// Default limit of the rows in a file; the user may choose the ticks instead.
constexpr std::int64_t most_rows = 100'000;

/// The smallest step of 1, 2, 5, 10, 20, ... that selects at most most_rows of `ticks` ticks.
int sane_every(std::int64_t ticks);

/// Header and rows, one value per column.
class CsvWriter {
 public:
  CsvWriter(std::FILE* to, std::vector<Column> columns);
  void add(const Row& row);
  /// The expected file size as one line for the user; every `every`-th of `ticks` ticks has a row.
  std::string forecast(std::int64_t ticks, int every) const;

 private:
  std::FILE* to_;
  std::vector<Column> columns_;
};

/// Options of `feltgate run`.
struct RunArguments {
  std::string scene, design, plant, engine = "all", report, json, csv, fst, record, events, states;
  std::vector<std::string> set;
  std::uint64_t seed = 1;
  int every = 0;            ///< 0: sane_every()
  double torque_scale = 0;  ///< 0: the scene as it is
  bool quiet = false;
  bool columns = false;  ///< only print the names of the columns
};

/// Scenes with a law or a device of several axes: functions that run_axes.cpp, if linked, sets
/// before main(). A program that runs only scenes of the core does not link them.
struct LawScenes {
  /// As make_scene_law().
  std::unique_ptr<SceneLaw> (*law)(const std::string& path, const DesignInfo& design) = nullptr;
  /// Runs the scene of this file and prints the result; returns the exit code.
  int (*axes)(const std::string& scene_path, const RunArguments& arguments) = nullptr;
};
/// The functions of this program.
LawScenes& law_scenes();

}  // namespace feltgate
