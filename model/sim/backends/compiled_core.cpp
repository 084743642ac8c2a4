// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// FeltgateCore, alone and with an engine, compiled once for this repository's programs.
// Documentation: docs/library.md
#include "feltgate/feltgate_axes.hpp"
#include "feltgate/feltgate_core_steps.hpp"

namespace feltgate {

template class FeltgateAxes<1, true>;

}  // namespace feltgate
