// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design that measurements belong to: the board's, or a file's where there is no board.
// Documentation: docs/calibration.md
#pragma once

#include <string>
#include <vector>

#include "files/output_file.hpp"
#include "host/calibrate/design_changes.hpp"
#include "tools/host/session.hpp"

namespace feltgate::host {

class BenchDesign {
 public:
  /// With a board its design, which must be known. PORT "-" is none: the design of --design, else
  /// lever; throws std::invalid_argument where the verb `needs` a board.
  BenchDesign(Session& session, const std::string& needs);
  const design::Elaborated& design() const { return design_; }
  /// Writes the design file with the changes to `to`, if that is given. Returns what to say.
  std::string write(const std::vector<Change>& changes, files::OutputFile* to,
                    const std::string& path) const;

 private:
  design::Elaborated design_;
};

}  // namespace feltgate::host
