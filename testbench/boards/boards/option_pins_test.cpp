// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board of gimbal_current around a stub of feltgate_linked: the pins of the options reach their
// ports, the fault of the bridge's driver with the board's polarity. docs/boards/ulx3s.md
#ifdef ULX3S
#include <Vulx3s.h>
using Top = Vulx3s;
constexpr bool kLow = true;  // nFAULT; open and pulled down is a fault
#else
#include <Vde0_nano.h>
using Top = Vde0_nano;
constexpr bool kLow = false;  // behind an inverter; open and pulled up is a fault
#endif

#include <memory>

#include "catch.hpp"
#include "verilated.h"

TEST_CASE("board: the pins of the options reach their ports") {
  for (unsigned k = 0; k < 16; ++k) {
    const bool data = (k & 1u) != 0, fault = (k & 2u) != 0;
    const unsigned current = k >> 2;
    const auto top = std::make_unique<Top>();
    top->encoder_data_i = data;
    top->driver_fault_i = fault != kLow;
    top->current_data_i = static_cast<unsigned char>(current);
    top->eval();
    // What the stub shows of its inputs.
    CHECK((top->encoder_select_no != 0) == !data);
    CHECK((top->encoder_clock_o != 0) == data);
    CHECK((top->encoder_command_o != 0) == data);
    CHECK((top->heartbeat_o != 0) == fault);
    CHECK(top->gate_c_hi_o * 2u + top->gate_c_lo_o == current);
    CHECK((top->current_clock_o != 0) == (current == 1 || current == 2));
  }
}
