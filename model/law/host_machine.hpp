// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Applies a host's parameter writes to the interpreter. Documentation: docs/laws.md
#pragma once

#include <cstdint>
#include <vector>

#include "law/engine/machine.hpp"
#include "law/image.hpp"
#include "law/load.hpp"

namespace feltgate::law {

/// Applies the writes of LoadedParameters::set(): words of parameter memory, and their commit.
inline void write(Machine& machine, const std::vector<HostWord>& words) {
  constexpr int first = EngineMap::H::data + Image::parameter_base;
  for (const HostWord& w : words) {
    if (w.address == EngineMap::H::commit) {
      machine.commit();
    } else {
      machine.set_parameter(w.address - first, static_cast<std::int32_t>(w.data));
    }
  }
}

}  // namespace feltgate::law
