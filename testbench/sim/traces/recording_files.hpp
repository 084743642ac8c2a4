// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Small recordings on disk for the tests of the readers, in a folder that goes when the test ends.
// Documentation: docs/traces.md
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/traces/open.hpp"

namespace feltgate::traces::test {

class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// Writes the bytes under this name and returns the whole path.
  std::filesystem::path file(const std::string& name, const std::string& bytes) const;
  /// Writes a zip with these entries in this order, deflated or stored as they are.
  std::filesystem::path zip(const std::string& name,
                            const std::vector<std::pair<std::string, std::string>>& entries,
                            bool stored = false) const;

 private:
  std::filesystem::path path_;
};

std::string bytes_of(const std::filesystem::path& path);

/// All events; throws what the source throws.
std::vector<EncoderEvent> all_events(EncoderSource& source);

/// "clock:AB clock:AB ... end", the pins as 0 and 1; or the message of the TraceError.
std::string told(const std::filesystem::path& path, const Options& options);

/// Metadata of a sigrok session with channels D0, A, B, Z on bits 0 to 3.
std::string metadata(const std::string& rate, int unit_size = 1);

}  // namespace feltgate::traces::test
