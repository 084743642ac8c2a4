// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Results of an identification as text, JSON and values of a design file.
// Documentation: docs/identify.md, docs/json.md
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/calibrate/design_changes.hpp"
#include "host/identify/cogging.hpp"
#include "host/identify/identify.hpp"

namespace feltgate::host {

std::string report_text(const Drive& drive, const std::optional<Coast>& coast, const Constants& c,
                        double confidence);
nlohmann::ordered_json report_json(const Drive& drive, const std::optional<Coast>& coast,
                                   const Constants& c, double confidence);

std::string report_text(const EncoderError& error, double confidence);
nlohmann::ordered_json report_json(const EncoderError& error, double confidence);
std::string report_text(const Cogging& cogging, double confidence);
nlohmann::ordered_json report_json(const Cogging& cogging, double confidence);

/// The design's table with this error; what it has already is in the recording no more, and stays.
std::vector<Change> changes_of(const EncoderError& error, const design::Elaborated& design);

/// The changes to a design that follow from the known constants.
std::vector<Change> changes_of(const Constants& c, const design::Elaborated& design,
                               double confidence);

}  // namespace feltgate::host
