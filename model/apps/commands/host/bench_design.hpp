// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design for which a measurement is made: the board's, or a file's if there is no board.
// Documentation: docs/calibration.md
#pragma once

#include <string>
#include <vector>

#include "apps/commands/host/session.hpp"
#include "files/output_file.hpp"
#include "host/calibrate/report.hpp"

namespace feltgate::host {

class BenchDesign {
 public:
  /// With a board: its design, which must be known. PORT "-" means no board: the design of
  /// --design, else lever; throws std::invalid_argument if the verb `needs` a board.
  BenchDesign(Session& session, const std::string& needs);
  const design::Elaborated& design() const { return design_; }
  /// Writes the design file with the changes to `to`, if given. Returns the text to print.
  std::string write(const std::vector<Change>& changes, files::OutputFile* to,
                    const std::string& path) const;

 private:
  design::Elaborated design_;
};

}  // namespace feltgate::host
