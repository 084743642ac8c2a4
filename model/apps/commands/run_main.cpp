// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The program of a first scene: run, replay and import of the design lever, without laws, studies
// and other designs. feltgate_run has the RTL, feltgate_twin has not. Documentation:
// docs/architecture.md
#include "apps/commands/commands.hpp"

int main(int argc, char** argv) {
  using namespace feltgate;
  CLI::App app{
      "feltgate: an open fixed-point DSP core for haptic devices, with its bit-exact twin"};
  app.name("feltgate");
  app.require_subcommand(1);
  int exit_code = exit_ok;
  add_run(app, &exit_code);
  add_replay(app, &exit_code);
  add_import(app, &exit_code);
  return run_command_line(app, argc, argv, exit_code);
}
