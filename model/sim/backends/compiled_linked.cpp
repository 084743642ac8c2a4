// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// LinkedCore, compiled once for this repository's programs. Documentation: docs/library.md
#include "feltgate/linked_core.hpp"

namespace feltgate {

template class LinkedCore<1>;
template class LinkedCore<1, true>;
template class LinkedCore<2, true>;
template class LinkedCore<3, true>;

}  // namespace feltgate
