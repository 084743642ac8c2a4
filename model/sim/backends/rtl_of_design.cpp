// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Adds the Verilated core of a design to the back-ends; compiled once for each of them by
// scripts/cmake/rtl.cmake. Documentation: docs/architecture.md
#include FELTGATE_RTL_HEADER
#include FELTGATE_DESIGN_HEADER
#include "sim/backends/make_axes_cores.hpp"
#include "sim/backends/make_backends.hpp"

namespace feltgate {
namespace {

template <class Rtl, class D>
bool add() {
  if constexpr (D::axes == 1) {
    return add_rtl(D::name, D::design_crc, make_rtl<Rtl>);
  } else {
    return add_rtl_axes(D::name, D::design_crc, make_rtl_axes<Rtl, D::axes>);
  }
}
/// Linked is known: before main().
[[maybe_unused]] const bool known = add<FELTGATE_RTL, FELTGATE_DESIGN>();

}  // namespace
}  // namespace feltgate
