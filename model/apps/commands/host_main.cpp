// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host, a program of its own: it needs no simulation. Documentation: docs/host.md
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/host/session.hpp"

namespace {

using namespace feltgate;

/// Runs a verb; returns its exit code, also for errors of board and link.
int guarded(const std::function<int()>& run) {
  try {
    return run();
  } catch (const host::LinkLost& e) {
    std::fputs(fmt::format("feltgate host: {}\n", e.what()).c_str(), stderr);
    return host::exit_link;
  } catch (const host::Refused& e) {
    std::fputs(fmt::format("feltgate host: {}\n", e.what()).c_str(), stderr);
    return exit_failed;
  }
}

/// The usage of a verb names the port, which comes before it.
class UsageWithPort : public CLI::Formatter {
 public:
  std::string make_usage(const CLI::App* app, std::string name) const override {
    constexpr std::string_view program = "feltgate host";
    if (app->get_parent() != nullptr) name.insert(program.size(), " PORT");
    return CLI::Formatter::make_usage(app, name);
  }
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"feltgate host: a board on a serial port, or one that feltgate board simulates"};
  app.name("feltgate host");
  app.formatter(std::make_shared<UsageWithPort>());
  app.footer(
      "  feltgate host /dev/ttyUSB0 info                       what is there, and how it is\n"
      "  feltgate host /dev/ttyUSB0 set torque_limit=0.1Nm     in units\n"
      "  feltgate host /dev/ttyUSB0 watch --arm wall           arm, hold, see it live; Ctrl-C "
      "disarms\n"
      "  feltgate host /dev/ttyUSB0 capture --trigger 'velocity>5' --csv fast.csv\n"
      "'feltgate host PORT VERB --help' explains a verb; docs/host.md teaches.\n"
      "Exit code: 0 done, 1 the board refused or a fault stands, 2 unusable input or no such "
      "port,\n"
      "3 the link broke down or nothing answers.");
  host::Session session;
  session.options.baud = 1'000'000;
  session.options.patience_s = 3;
  app.add_option("port", session.options.port,
                 "serial port, or the name that feltgate board prints")
      ->required()
      ->type_name("PORT");
  app.add_option("--baud", session.options.baud, "bits per second, as the board was built")
      ->type_name("BAUD")
      ->capture_default_str()
      ->transform(checks::whole(1200, 4'000'000));
  app.add_option("--design", session.options.design,
                 "name in rtl/designs or a path; default: the one with the board's CRC")
      ->type_name("DESIGN");
  app.add_option(
         "--law", session.options.law,
         "file of the law that the board runs; default: known where it was loaded from here")
      ->type_name("LAW");
  app.add_option("--patience", session.options.patience_s,
                 "so long requests are repeated before the link counts as lost")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->transform(checks::positive(3600, "s"));
  app.require_subcommand(1);
  app.fallthrough();
  int exit_code = exit_ok;
  for (const host::Verb& verb : host::verbs()) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.about);
    sub->fallthrough();
    const auto run = verb.add(*sub);
    sub->callback(
        [&session, &exit_code, run] { exit_code = guarded([&] { return run(session); }); });
  }
  return run_command_line(app, argc, argv, exit_code);
}
