// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// FeltgateAxes of several axes, compiled once for this repository's programs. Documentation:
// docs/library.md
#include "feltgate/feltgate_axes.hpp"

namespace feltgate {

template class FeltgateAxes<1>;
template class FeltgateAxes<2>;
template class FeltgateAxes<3>;
template class FeltgateAxes<2, true>;
template class FeltgateAxes<3, true>;

}  // namespace feltgate
