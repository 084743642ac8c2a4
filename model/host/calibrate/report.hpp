// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Results of a calibration as text and JSON. Documentation: docs/calibration.md, docs/json.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "design/design.hpp"
#include "host/calibrate/gauge.hpp"

namespace feltgate::host {

// Measured constants as values of a design file.

/// A key of the design file with its new value.
struct Change {
  std::string section, key;
  double value = 0;
  std::string reason;  ///< becomes the comment
};

/// The value or the list, as a design file has it.
std::string toml_of(const Change& change);

/// Text such as "0.4197 (0.4172 to 0.4223)".
std::string text_of(const Interval& i);

/// For a law that models the motor: R and dead voltage. For a law in regions: only R, which its
/// estimated current uses, and only if the torque constant was given.
std::vector<Change> changes_of(const OpenLoop& open, const design::Elaborated& design,
                               double torque_constant_nm_a, bool constant_given,
                               std::vector<std::string>* warnings);
std::vector<Change> changes_of(const ClosedLoop& closed, const design::Elaborated& design,
                               std::vector<std::string>* warnings);

/// The text of the design file at `path` with these values; the layout is kept. Errors:
/// config::ConfigError if the result is not a design that can be built.
std::string changed_design(const std::string& path, const std::string& name,
                           const std::vector<Change>& changes,
                           const design::RegisterMap& registers);

/// A figure, once for text and JSON.
struct Figure {
  std::string name, key, unit;  ///< without a name in no text
  std::optional<Interval> value;
};
std::string figures_text(const std::vector<Figure>& figures);
std::string notes_text(const std::vector<std::string>& notes);

/// One row per reading, with line and residual, then the results.
std::string report_text(const OpenLoop& open, const design::Elaborated& design);
std::string report_text(const ClosedLoop& closed);
/// The values to write into the design, and into the registers to try them at once.
std::string changes_text(const std::vector<Change>& changes);

nlohmann::ordered_json report_json(const Interval& i);
nlohmann::ordered_json report_json(const OpenLoop& open);
nlohmann::ordered_json report_json(const ClosedLoop& closed);
nlohmann::ordered_json report_json(const std::vector<Change>& changes);

}  // namespace feltgate::host
