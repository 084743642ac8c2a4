// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The design `wide`: the published lever with registers for every Kp. Documentation:
// docs/extremes.md
#pragma once

namespace feltgate::extremes {

/// Registers engines and chains of "wide"; may be called more than once.
void use_wide_design();

}  // namespace feltgate::extremes
