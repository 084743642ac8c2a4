// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine of AXES axes in lock-step. Documentation: docs/blocks/engine.md
#pragma once

#include "engine_adapter.hpp"
#include "lock_step.hpp"

namespace feltgate::test {

using Twin = EngineTwin<AXES>;
using Bench = LockStep<Vengine, Twin, EngineAdapter<AXES>>;
using Host = EngineHost;

}  // namespace feltgate::test
