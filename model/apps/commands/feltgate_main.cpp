// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The feltgate program. Documentation: README.md
#include "apps/commands/commands.hpp"

int main(int argc, char** argv) {
  using namespace feltgate;
  CLI::App app{
      "feltgate: an open fixed-point DSP core for haptic devices, with its bit-exact twin"};
  app.name("feltgate");
  app.set_version_flag("--version", std::string("feltgate ") + FELTGATE_VERSION);
  app.require_subcommand(1);
  int exit_code = exit_ok;
  add_run(app, &exit_code);
  add_replay(app, &exit_code);
  add_import(app, &exit_code);
  add_design(app, &exit_code);
  add_law(app, &exit_code);
  add_shape(app, &exit_code);
  add_texture(app, &exit_code);
  add_trim(app, &exit_code);
  add_stability(app, &exit_code);
  add_rates(app, &exit_code);
  add_controllers(app, &exit_code);
  add_scripts(app, &exit_code);
  return run_command_line(app, argc, argv, exit_code);
}
