// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host, a program of its own: it needs no simulation. Documentation: docs/host.md
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "apps/commands/host/verbs.hpp"

namespace {

using namespace feltgate;

/// A verb adds its options to `sub` and returns what runs it.
struct Verb {
  const char* name;
  const char* about;
  host::Run (*add)(CLI::App& sub);
};

/// In the order of the help.
const Verb verbs[] = {
    {"info", "what the board is, its design, faults and status in words", host::add_info},
    {"get", "values in their units", host::add_get},
    {"set", "parameters in their units", host::add_set},
    {"law", "load a force law from its file, or say which one runs", host::add_law},
    {"events", "what the law tells as it runs: lines, also over TCP", host::add_events},
    {"scene", "choose what the motor renders", host::add_scene},
    {"arm", "turn the motor on", host::add_arm},
    {"disarm", "turn it off", host::add_disarm},
    {"stop", "the fault stop: gates off at once, until clear", host::add_stop},
    {"clear", "forget faults whose cause is gone; the zero stays", host::add_clear},
    {"zero", "the position is 0 here", host::add_zero},
    {"watch", "values as they change: sparklines, lines, or for Teleplot", host::add_watch},
    {"capture", "1024 ticks around a trigger, every tick: CSV, plot, encoder trace",
     host::add_capture},
    {"record", "the stream into a file: CSV, encoder trace for replay", host::add_record},
    {"calibrate", "constants from a gauge and a blocked shaft, or from a file",
     host::add_calibrate},
    {"identify", "constants from voltage and position, or from files", host::add_identify},
};

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
  app.footer(R"(  feltgate host /dev/ttyUSB0 info                       what is there, and how it is
  feltgate host /dev/ttyUSB0 set torque_limit=0.1Nm     in units
  feltgate host /dev/ttyUSB0 watch --arm wall           arm, hold, see it live; Ctrl-C disarms
  feltgate host /dev/ttyUSB0 capture --trigger 'velocity>5' --csv fast.csv
'feltgate host PORT VERB --help' explains a verb; docs/host.md teaches.
Exit code: 0 done, 1 the board refused or a fault stands, 2 unusable input or no such port,
3 the link broke down or nothing answers.)");
  host::Session session;
  session.options.baud = 1'000'000;
  session.options.patience_s = 3;
  option(app, "port", session.options.port, "PORT",
         "serial port, or the name that feltgate board prints")
      ->required();
  defaulted(app, "--baud", session.options.baud, "BAUD", "bits per second, as the board was built",
            checks::whole(1200, 4'000'000));
  option(app, "--design", session.options.design, "DESIGN",
         "name in rtl/designs or a path; default: the one with the board's CRC");
  option(app, "--law", session.options.law, "LAW",
         "file of the law that the board runs; default: known where it was loaded from here");
  defaulted(app, "--patience", session.options.patience_s, "SECONDS",
            "so long requests are repeated before the link counts as lost",
            checks::positive(3600, "s"));
  app.require_subcommand(1);
  app.fallthrough();
  int exit_code = exit_ok;
  for (const Verb& verb : verbs) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.about);
    sub->fallthrough();
    const auto run = verb.add(*sub);
    sub->callback(
        [&session, &exit_code, run] { exit_code = guarded([&] { return run(session); }); });
  }
  return run_command_line(app, argc, argv, exit_code);
}
