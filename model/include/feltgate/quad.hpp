// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The type Quad: IEEE binary128 under one name on every machine. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <cfloat>

namespace feltgate {

/// 113 bits of mantissa: __float128 on x86, long double on AArch64.
#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quad;
#else
static_assert(LDBL_MANT_DIG == 113, "this machine has no binary128");
using Quad = long double;
#endif

}  // namespace feltgate
