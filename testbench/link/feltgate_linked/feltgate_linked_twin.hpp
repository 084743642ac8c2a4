// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/link/feltgate_linked.sv in the form that the lock-step needs. Documentation:
// docs/link.md
#pragma once

#include "feltgate/linked_core.hpp"

namespace feltgate::test {

template <class D, std::int64_t Baud>
class FeltgateLinked : public LinkedCore<D> {
 public:
  using In = LinkedIn;
  using Out = LinkedOut;
  FeltgateLinked() : LinkedCore<D>(LinkedOptions{Baud, false, 0}) {}
};

}  // namespace feltgate::test
