// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes an image as the initial memory contents of the RTL engine, for a board without a host:
// files for $readmemh, and the parameters that name them. Documentation: docs/blocks/engine.md
#pragma once

#include <string>

#include "law/image.hpp"

namespace feltgate::law {

/// The files of a law, by their names in one folder.
struct Content {
  std::string program, data, table;  ///< program.mem, data.mem, table.mem: 512 words, a line each
  std::string parameters;            ///< law.svh: parameters of feltgate_axes or feltgate_linked
};

/// The content of `image`. law.svh puts `folder` before the file names: the path at which the
/// simulator or synthesis finds them.
Content content(const Image& image, const std::string& folder);

}  // namespace feltgate::law
