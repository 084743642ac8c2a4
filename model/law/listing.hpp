// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Describes a compiled law as a page of text. Documentation: docs/laws.md
#pragma once

#include <string>

#include "law/compile.hpp"
#include "law/image.hpp"
#include "law/measure.hpp"

namespace feltgate::law {

/// The report: parameters with their words, rate, bound, measured error, strips, tables.
std::string report(const Compiled& compiled, const Measured& measured);

/// The listing: every instruction with its operands, format, range and error.
std::string listing(const Compiled& compiled);

/// An operand as the listing names it: "position", "contact", "#12", "t3".
std::string name_of(const Compiled& compiled, const Operand& operand);

// Writes an image as the initial memory contents of the RTL engine, for a board without a host:
// files for $readmemh, and the parameters that name them.

/// The files of a law, by their names in one folder.
struct Content {
  std::string program, data, table;  ///< program.mem, data.mem, table.mem: 512 words, a line each
  std::string parameters;            ///< law.svh: parameters of feltgate_axes or feltgate_linked
};

/// The content of `image`. law.svh puts `folder` before the file names: the path at which the
/// simulator or synthesis finds them.
Content content(const Image& image, const std::string& folder);

}  // namespace feltgate::law
