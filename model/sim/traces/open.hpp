// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Opens an encoder recording of any known format as a stream of pin changes.
// Documentation: docs/traces.md
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "feltgate/encoder_source.hpp"
#include "options.hpp"
#include "text.hpp"

namespace feltgate::traces {

/// The recording as encoder pins on the FPGA clock. Memory does not grow with its length. open()
/// and EncoderSource::next() throw TraceError: a damage deep in a file shows only there.
std::unique_ptr<EncoderSource> open(const std::filesystem::path& path, const Options& options);

/// The format found in the file. Throws TraceError when it is none that is known.
FileFormat detect(const std::filesystem::path& path, const Options& options);

/// Names of the signals in a recording, or of the columns of a table.
std::vector<std::string> channels(const std::filesystem::path& path, const Options& options);

}  // namespace feltgate::traces
