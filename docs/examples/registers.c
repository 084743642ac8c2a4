// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A wall of 0.8 Nm/rad at 0.2 rad by a memory-mapped port, in SI units; what is read back is
// printed. Here the port is an array. docs/other-tools.md
#include <stdio.h>

#include "feltgate.h"

static volatile uint32_t port[FELTGATE_BYTES(0x400) / 4];  // on a chip: the address of the port

static void put(uint32_t address, uint32_t word) { port[address] = word; }

int main(void) {
  const double stiffness = 0.8 * FELTGATE_COUNT_RAD;  // Nm/rad to Nm/count
  put(FELTGATE_WALL_CONTACT, FELTGATE_WALL_CONTACT_WORD(0.2 / FELTGATE_COUNT_RAD));
  put(FELTGATE_WALL_STIFFNESS, FELTGATE_WALL_STIFFNESS_WORD(stiffness));
  put(FELTGATE_CONTROL, FELTGATE_PUT(FELTGATE_CONTROL_HOST, 1) |
                            FELTGATE_PUT(FELTGATE_CONTROL_ARM, 1) |
                            FELTGATE_PUT(FELTGATE_CONTROL_SCENE, FELTGATE_SCENE_WALL));
  port[FELTGATE_TAU_REF] = (uint32_t)-6554;  // what a core would show: -0.1 Nm in this design
  port[FELTGATE_STATUS] = FELTGATE_STATUS_ARMED_MASK | FELTGATE_LIMIT_RAMP;

  printf("contact 0x%08x stiffness 0x%08x control 0x%08x\n", (unsigned)port[FELTGATE_WALL_CONTACT],
         (unsigned)port[FELTGATE_WALL_STIFFNESS], (unsigned)port[FELTGATE_CONTROL]);
  printf("torque %.4f Nm, armed %u, ramping %u\n", FELTGATE_TAU_REF_VALUE(port[FELTGATE_TAU_REF]),
         (unsigned)FELTGATE_GET(FELTGATE_STATUS_ARMED, port[FELTGATE_STATUS]),
         (unsigned)((FELTGATE_GET(FELTGATE_STATUS_LIMITS, port[FELTGATE_STATUS]) &
                     FELTGATE_LIMIT_RAMP) != 0));
  return 0;
}
