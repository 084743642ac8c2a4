// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How a host brings an image into an engine, and a parameter into a running law: register writes.
// Documentation: docs/law-compiler.md
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

/// Everything, whatever the memories hold; the engine stands until the last word. Only a disarmed
/// core takes it.
std::vector<HostWord> load(const Image& image);

/// The same into an engine whose memories are 0, as after configuration: what is 0 is left out.
std::vector<HostWord> load_into_zeros(const Image& image);

/// The engine's memories with the image in them.
EngineMemory memory(const Image& image);
/// What its words hold then, for an engine that no host loads.
EngineReset reset_words(const Image& image);

/// The values of an image's parameters as a host keeps them: what was set last, as rounded to
/// words.
class LoadedParameters {
 public:
  /// The values of the image. It must outlive this.
  explicit LoadedParameters(const Image& image);

  /// The values that an engine's 32 parameter words stand for, in place of the image's.
  void take(const std::vector<std::uint32_t>& words);

  /// The word that is parameter `name`, or nullptr.
  const ImageWord* find(const std::string& name) const;
  /// Value in the unit of the law's file; the writes that bring it and all that follows from it
  /// into force together. Errors: std::invalid_argument, for an unknown name with what there is,
  /// for a value out of its range with the range, for a requirement that would not hold; nothing
  /// is set then.
  std::vector<HostWord> set(const std::string& name, double value);
  /// The same of several, by one commit; of none: the words that stand.
  std::vector<HostWord> set(const std::map<std::string, double>& values);
  /// The nearest value that the parameter takes; of an unknown name the value itself.
  double within(const std::string& name, double value) const;
  /// Only the errors of set(), without those of what the law requires.
  void check(const std::string& name, double value) const;
  /// Only the errors of set().
  void check(const std::map<std::string, double>& values) const;
  /// As rounded to its word, in the unit of the file.
  double value(const std::string& name) const;

 private:
  double rounded_si(const std::string& name, double value) const;
  std::map<std::string, double> with(const std::map<std::string, double>& values) const;

  const Image& image_;
  std::map<std::string, double> si_;
};

}  // namespace feltgate::law
