// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design `wide`: the published lever with registers for every Kp. Documentation:
// docs/extremes.md
#pragma once

namespace feltgate::extremes {

/// Makes engines and chains of "wide" known; may be called again.
void use_wide_design();

}  // namespace feltgate::extremes
