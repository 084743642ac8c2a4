// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board's top level around a stub of feltgate_linked: each pin of a current loop, of the bridge's
// driver, of an absolute encoder and of Hall lines reaches its port of that block and no other.
// What the block does with them: testbench/link/feltgate_linked/sensors_test.cpp. Documentation:
// docs/boards/ulx3s.md
#if defined(ULX3S)
#include <Vulx3s.h>
using Top = Vulx3s;
#elif defined(TANG_NANO_9K)
#include <Vtang_nano_9k.h>
using Top = Vtang_nano_9k;
#else
#include <Vde0_nano.h>
using Top = Vde0_nano;
#endif

// The DE0-Nano's ports have capital letters.
#ifdef DE0_NANO
#define PIN(lower, upper) upper
#else
#define PIN(lower, upper) lower
#endif

#include <memory>

#include "catch.hpp"
#include "verilated.h"

#ifdef TANG_NANO_9K  // no other option fits
TEST_CASE("board: the pins of an absolute encoder reach their ports") {
  for (const bool data : {false, true}) {
    const auto top = std::make_unique<Top>();
    top->encoder_data = data;
    top->eval();
    // What the stub shows of its input.
    CHECK(top->encoder_select_n == !data);
    CHECK(top->encoder_clock == data);
    CHECK(top->encoder_command == data);
  }
}
#else
namespace {

struct Inputs {
  bool encoder_data, current_data, driver_fault;
};
struct Outputs {
  int select_n, clock, command, current_clock, heartbeat;
};

Outputs outputs_of(const Inputs& in) {
  const auto top = std::make_unique<Top>();
#ifdef DE0_NANO
  top->ENCODER_DATA = in.encoder_data;
  top->CURRENT_DATA = in.current_data;
  top->DRIVER_FAULT = in.driver_fault;  // behind an inverter; open and pulled up is a fault
  top->eval();
  return {top->ENCODER_SELECT_N, top->ENCODER_CLOCK, top->ENCODER_COMMAND, top->CURRENT_CLOCK,
          top->HEARTBEAT};
#else
  top->encoder_data = in.encoder_data;
  top->current_data = in.current_data;
  top->driver_fault_n = !in.driver_fault;  // nFAULT; open and pulled down is a fault
  top->eval();
  return {top->encoder_select_n, top->encoder_clock, top->encoder_command, top->current_clock,
          top->heartbeat};
#endif
}

}  // namespace

TEST_CASE("board: the gates of the third leg and the Hall lines reach their pins") {
  for (unsigned k = 0; k < 64; ++k) {
    const bool a = (k & 1u) != 0, b = (k & 2u) != 0, z = (k & 4u) != 0;
    const auto top = std::make_unique<Top>();
    top->PIN(enc_a, ENC_A) = a;
    top->PIN(enc_b, ENC_B) = b;
    top->PIN(enc_z, ENC_Z) = z;
    top->PIN(hall, HALL) = static_cast<unsigned char>(k >> 3);
    top->eval();
    const unsigned high = top->PIN(gate_c_hi, GATE_C_HI), low = top->PIN(gate_c_lo, GATE_C_LO);
    // What the stub shows of the encoder and of the lines.
    const auto line = [&](unsigned n) { return k >> (3 + n) & 1u; };
    CHECK(high == ((a && z) ^ line(0) ^ line(2)));
    CHECK(low == ((b && z) ^ line(1) ^ line(2)));
  }
}

TEST_CASE("board: the second modulator has a pin where the design has two shunts, and its clock") {
  for (unsigned k = 0; k < 4; ++k) {
    const bool first = (k & 1u) != 0, second = (k & 2u) != 0;
    const auto top = std::make_unique<Top>();
    top->PIN(encoder_data, ENCODER_DATA) = 1;
    top->PIN(current_data, CURRENT_DATA) = first;
    top->PIN(current_data_b, CURRENT_DATA_B) = second;
    top->eval();
    const unsigned clock = top->PIN(current_clock, CURRENT_CLOCK);
    CHECK((top->PIN(encoder_command, ENCODER_COMMAND) != 0) ==
          first);  // the stub: of the first alone
    CHECK((clock != 0) == (MODULATORS == 2 ? first != second : first));
    CHECK(top->PIN(current_clock_b, CURRENT_CLOCK_B) == clock);
  }
}

TEST_CASE("board: the pins of the options reach their ports") {
  for (int k = 0; k < 8; ++k) {
    const Inputs in{(k & 1) != 0, (k & 2) != 0, (k & 4) != 0};
    const Outputs out = outputs_of(in);
    INFO("encoder_data " << in.encoder_data << ", current_data " << in.current_data
                         << ", a fault of the driver " << in.driver_fault);
    // What the stub shows of its inputs.
    CHECK(out.select_n == !in.encoder_data);
    CHECK(out.clock == in.encoder_data);
    CHECK(out.command == (in.encoder_data && in.current_data));
    CHECK(out.current_clock == in.current_data);
    CHECK(out.heartbeat == in.driver_fault);
  }
}
#endif
