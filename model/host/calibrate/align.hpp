// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The alignment of a motor with three phases: angles of its voltage, written with a gain of 0, and
// where the rotor came to rest. Documentation: docs/calibration.md
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "host/calibrate/regression.hpp"
#include "host/calibrate/report.hpp"

namespace feltgate::host {

/// The voltage stood at this angle, and the rotor at this position.
struct AlignReading {
  double offset_turns = 0;  ///< electrical; modulo a turn
  double position_counts = 0;
};

/// Result of the alignment.
struct Alignment {
  double confidence = 0;
  Interval pole_pairs;    ///< as measured; negative: the rotor turns against the voltage
  int whole = 0;          ///< pole pairs, the nearest whole number
  Interval offset_turns;  ///< electrical angle at count 0, for whole pole pairs; 0 to 1
  double rest_turns = 0;  ///< rms of what is left over, electrical
  int freedom = 0;
  std::vector<std::string> warnings;
  bool against() const { return pole_pairs.value < 0; }
};

/// Takes readings over an electrical turn and back, in steps of an eighth: `turn` moves the voltage
/// to an angle in [0, 1) and waits until the rotor rests; false ends it. `position_counts` says
/// where the rotor is.
std::vector<AlignReading> take_readings(const std::function<bool(double turns)>& turn,
                                        const std::function<double()>& position_counts);
/// The readings as the CSV that align_readings() takes.
std::string readings_csv(const std::vector<AlignReading>& readings);

/// Reads the columns commutation_offset (turn) and position (counts), in the order in which they
/// were taken. Errors: MeasurementError.
std::vector<AlignReading> align_readings(const ColumnTable& table);

/// Errors: MeasurementError for readings that do not determine the result, and for a rotor that
/// does not follow the voltage, as with an open phase.
Alignment fit_alignment(const std::vector<AlignReading>& readings, double counts_per_turn,
                        double confidence);

/// Pole pairs and offset; of a rotor that turns against the voltage the polarity alone, since the
/// readings must then be taken again.
std::vector<Change> changes_of(const Alignment& found, const design::Elaborated& design);

std::string report_text(const Alignment& found);
nlohmann::ordered_json report_json(const Alignment& found);

}  // namespace feltgate::host
