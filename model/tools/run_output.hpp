// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A run's figures as JSON and for reading on a terminal. Documentation: docs/json.md
#pragma once

#include <map>
#include <string>
#include <vector>

#include "loop/loop.hpp"
#include "stability/constants.hpp"

namespace feltgate {

/// Help of options that run and replay share.
constexpr const char* engine_help =
    "rtl, twin, float (binary32), double (binary64), quad (binary128), several with commas between "
    "them, or all: RTL and twin in lock-step, the others beside";
constexpr const char* every_help =
    "CSV: only every n-th tick; default: the first of 1, 2, 5, 10, 20, ... that leaves at most "
    "100000 rows";

/// What is said beyond the figures.
struct RunLabels {
  std::string subject_key;  ///< "scene" or "trace"
  std::string plant, probes;
  int step_clocks = 0;                              ///< of the plant
  std::vector<std::string> effects_off = {};        ///< of the plant
  std::vector<stability::Constant> differing = {};  ///< constants in which design and plant differ
  std::string plant_as_named = {};                  ///< by the user, for the command that mends it
  std::vector<std::string> speed_jumps = {};        ///< of the hand, a sentence each
  double never_armed_s = 0;  ///< arm_s of a scene that is over before; 0: none
};

/// The JSON object, pretty-printed.
std::string run_json(const RunResult& result, const RunLabels& labels);

/// The same for reading on a terminal: what ran, engines where several did, and what was felt.
std::string run_text(const RunResult& result, const RunLabels& labels);

/// What was felt, the end of that text.
std::string felt_text(const RunResult& result);

// Parts of it.
std::string acted_text(const std::map<std::string, Acted>& all);
std::string energy_lines(const FeltEnergy& energy);
/// What may look like a law of no torque; empty where its mailbox never was too old.
std::string stale_line(const Acted& stale);
std::string expectation_lines(const std::vector<Expected>& all);

/// NAME=VALUE of --set onto the scene's parameters, the value with or without a unit
/// (law/amount.hpp). `law` may be nullptr. Throws std::invalid_argument.
void apply_settings(const std::vector<std::string>& set, const DesignInfo& design,
                    const SceneLaw* law, Scenario& scenario);
/// The path of the law that a scene names: a path is from the scene's folder.
std::string law_file(const Scenario& scenario);

}  // namespace feltgate
