// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Results of a calibration as text and JSON. Documentation: docs/calibration.md, docs/json.md
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/calibrate/closed_loop.hpp"
#include "host/calibrate/design_changes.hpp"
#include "host/calibrate/open_loop.hpp"

namespace feltgate::host {

/// One row per reading, with line and residual, then the results.
std::string report_text(const OpenLoop& open, const design::Elaborated& design);
std::string report_text(const ClosedLoop& closed, const design::Elaborated& design);
/// The values to write into the design, and into the registers to try them at once.
std::string changes_text(const std::vector<Change>& changes);

nlohmann::ordered_json report_json(const Interval& i);
nlohmann::ordered_json report_json(const OpenLoop& open);
nlohmann::ordered_json report_json(const ClosedLoop& closed);
nlohmann::ordered_json report_json(const std::vector<Change>& changes);

}  // namespace feltgate::host
