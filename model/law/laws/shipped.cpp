// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The shipped laws as compiled C++. Documentation: docs/law-compiler.md
#include "laws/shipped.hpp"

#include "law/engine/law_runner.hpp"

namespace feltgate::law {

namespace {

template <template <class> class Law>
std::unique_ptr<LawRunner> make(const EngineMemory& memory) {
  return std::make_unique<CompiledLaw<Law>>(memory);
}

struct Collect {
  std::vector<CompiledEntry>& entries;
  template <template <class> class Law>
  void law() {
    entries.push_back({Law<Fixed>::name, Law<Fixed>::image_crc, make<Law>});
  }
};

}  // namespace

const std::vector<CompiledEntry>& shipped_laws() {
  static const std::vector<CompiledEntry> entries = [] {
    std::vector<CompiledEntry> all;
    laws::visit_shipped(Collect{all});
    return all;
  }();
  return entries;
}

}  // namespace feltgate::law
