// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The register writes by which a host loads an image into an engine and sets a parameter of a
// running law. Documentation: docs/laws.md
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "feltgate/engine_memory.hpp"
#include "feltgate/generated/engine.hpp"
#include "law/image.hpp"

namespace feltgate::law {

/// One write of the host: an address of the engine's host map, from 0 (docs/engine-isa.md).
struct HostWord {
  int address = 0;
  std::uint32_t data = 0;
  bool operator==(const HostWord& o) const { return address == o.address && data == o.data; }
};

/// Writes that load the complete image, whatever the memories hold. The engine is stopped until the
/// last word. Only a disarmed core accepts them.
std::vector<HostWord> load(const Image& image);

/// The same for an engine whose memories are 0, as after configuration: words that are 0 are left
/// out.
std::vector<HostWord> load_into_zeros(const Image& image);

/// The engine's memories with the image in them.
EngineMemory memory(const Image& image);
/// The reset values of the engine's registers for this image, for an engine that no host loads.
EngineReset reset_words(const Image& image);

/// The host's copy of an image's parameter values: the values set last, rounded to words.
class LoadedParameters {
 public:
  /// Starts with the initial values of `image`, which must outlive this object.
  explicit LoadedParameters(const Image& image);

  /// Takes the values from an engine's 32 parameter words, in place of the image's values.
  void take(const std::vector<std::uint32_t>& words);

  /// The word that is parameter `name`, or nullptr.
  const ImageWord* find(const std::string& name) const;
  /// Sets a value, in the unit of the law's file. Returns the writes that make it and all derived
  /// words take effect together. Throws std::invalid_argument, and sets nothing, for an unknown
  /// name (the message lists the names), for a value out of range (the message shows the range),
  /// and for a requirement that would not hold.
  std::vector<HostWord> set(const std::string& name, double value);
  /// The same for several values with one commit; an empty map writes the current words.
  std::vector<HostWord> set(const std::map<std::string, double>& values);
  /// `value` clamped to what the parameter accepts; for an unknown name, `value` itself.
  double within(const std::string& name, double value) const;
  /// Only throws the errors of set(), except those of the law's requirements.
  void check(const std::string& name, double value) const;
  /// Only throws the errors of set().
  void check(const std::map<std::string, double>& values) const;
  /// The value after rounding to its word, in the unit of the file.
  double value(const std::string& name) const;

 private:
  double rounded_si(const std::string& name, double value) const;
  std::map<std::string, double> with(const std::map<std::string, double>& values) const;

  const Image& image_;
  std::map<std::string, double> si_;
};

}  // namespace feltgate::law
