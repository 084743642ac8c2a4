// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The table of verbs. Documentation: docs/host.md
#include "apps/commands/host/verbs.hpp"

#include "apps/commands/host/session.hpp"

namespace feltgate::host {

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {
      {"info", "what the board is, its design, faults and status in words", add_info},
      {"get", "values in their units", add_get},
      {"set", "parameters in their units", add_set},
      {"law", "load a force law from its file, or say which one runs", add_law},
      {"events", "what the law tells as it runs: lines, also over TCP", add_events},
      {"scene", "choose what the motor renders", add_scene},
      {"arm", "turn the motor on", add_arm},
      {"disarm", "turn it off", add_disarm},
      {"stop", "the fault stop: gates off at once, until clear", add_stop},
      {"clear", "forget faults whose cause is gone; the zero stays", add_clear},
      {"zero", "the position is 0 here", add_zero},
      {"watch", "values as they change: sparklines, lines, or for Teleplot", add_watch},
      {"capture", "1024 ticks around a trigger, every tick: CSV, plot, encoder trace", add_capture},
      {"record", "the stream into a file: CSV, encoder trace for replay", add_record},
      {"calibrate", "constants from a gauge and a blocked shaft, or from a file", add_calibrate},
      {"identify", "constants from voltage and position, or from files", add_identify},
  };
  return all;
}

}  // namespace feltgate::host
