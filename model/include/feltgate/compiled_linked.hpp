// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The instances of LinkedCore that the library feltgate_twin_parts has; included by
// linked_core.hpp. Documentation: docs/library.md
#pragma once

#include "feltgate/linked_core.hpp"

namespace feltgate {

extern template class LinkedCore<1>;
extern template class LinkedCore<1, true>;
extern template class LinkedCore<2, true>;
extern template class LinkedCore<3, true>;

}  // namespace feltgate
