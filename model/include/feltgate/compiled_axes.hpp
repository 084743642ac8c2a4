// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The instances of FeltgateAxes that the library feltgate_twin_parts has; included by
// feltgate_axes.hpp. Documentation: docs/library.md
#pragma once

#include "feltgate/feltgate_axes.hpp"

namespace feltgate {

extern template class FeltgateAxes<1>;
extern template class FeltgateAxes<2>;
extern template class FeltgateAxes<3>;
extern template class FeltgateAxes<1, true>;
extern template class FeltgateAxes<2, true>;
extern template class FeltgateAxes<3, true>;

}  // namespace feltgate
