// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate board: a board without hardware. Documentation: docs/host.md
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "apps/commands/commands.hpp"
#include "files/output_file.hpp"
#include "host/board/board.hpp"
#include "host/board/serve.hpp"
#include "sim/backends/backend.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/plant_file.hpp"

namespace {

using namespace feltgate;
using namespace feltgate::board;

std::atomic<bool> ended{false};
static_assert(std::atomic<bool>::is_always_lock_free);
extern "C" void note_end(int) { ended = true; }

struct Arguments {
  Setup setup;
  bool rtl = false, twin = false, unpaced = false;
  std::string link, record, replay;
  double for_s = 0;
};

/// Who holds a board where --hand does not say: nobody, or the hand of the first scene of the
/// device.
std::string default_hand(const std::string& design, std::size_t axes) {
  if (axes == 1 || design == "pantograph_law") return "free";
  const std::string line = fmt::format("device = \"{}\"", design.substr(0, design.rfind("_law")));
  for (const std::string& scene : names_in("vectors/scenes")) {
    std::ifstream in(repository() + "/vectors/scenes/" + scene + ".toml");
    for (std::string text; std::getline(in, text);) {
      if (text == line) return scene;
    }
  }
  throw std::invalid_argument(fmt::format("--hand: {} needs a scene file of its device", design));
}

/// Sets hand and plant where none is given.
std::unique_ptr<Board> make_board(Setup& setup, const std::string& kind) {
  BoardOptions options;
  options.baud = setup.baud;
  auto core = make_core(setup.design, kind, options);
  if (setup.hand.empty()) setup.hand = default_hand(setup.design, core->axes());
  if (core->axes() > 1) {
    if (!setup.plant.empty()) {
      throw std::invalid_argument(fmt::format(
          "--plant {}: is for levers; {} has the device of --hand", setup.plant, setup.design));
    }
    return make_axes_board(std::move(core), setup, find_file);
  }
  if (setup.plant.empty()) setup.plant = default_plant(core->design());
  return std::make_unique<LeverBoard>(
      std::move(core), plant::read_plant_file(find_file(setup.plant, "vectors/plants")),
      hand_named(setup.hand, repository() + "/vectors/scenes"), setup);
}

std::string pace_text(const Board& board, const Pace& p) {
  return fmt::format(
      "{}: simulated {:.2f} s in {:.2f} s, {:.2f} x real time where it need not wait{}",
      board.core().kind(), p.simulated_s, p.wall_s, p.factor(),
      p.real_time() ? "" : "; slower than real time here");
}

std::string outcome_text(const Outcome& o) {
  return fmt::format("{} ticks {:016x}, sent {} bytes {:016x}", o.ticks, o.tick_sum, o.bytes,
                     o.byte_sum);
}

void say(const std::string& text) {
  std::fputs((text + "\n").c_str(), stdout);
  std::fflush(stdout);
}

int run_replay(const Arguments& a, const std::string& kind) {
  Recording recording = read_recording(a.replay);
  auto board = make_board(recording.setup, kind);
  Progress progress("replay " + a.replay, false);
  const Pace pace = board::replay(
      *board, recording, [] { return !ended; }, [&](double done) { progress.update(done); });
  progress.finish();
  if (ended) return exit_signal + SIGINT;
  const Outcome outcome = board->outcome();
  say(outcome_text(outcome));
  say(pace_text(*board, pace));
  if (outcome == recording.outcome) {
    say("identical to the recording");
    return exit_ok;
  }
  say("DIFFERS from the recording: " + outcome_text(recording.outcome));
  return exit_failed;
}

int run_board(Arguments& a, const std::string& kind) {
  auto board = make_board(a.setup, kind);
  files::Outputs outputs;
  files::OutputFile* record = outputs.open("--record", a.record);
  std::optional<RecordingWriter> writer;
  if (record != nullptr) writer.emplace(record->handle(), a.setup);
  PseudoTerminal terminal(a.link);
  say(a.link.empty() ? terminal.name() : a.link + " -> " + terminal.name());
  const bool tty = isatty(STDERR_FILENO) == 1;
  ServeOptions o;
  o.for_s = a.for_s;
  o.paced = !a.unpaced;
  if (writer) o.record = &*writer;
  o.go_on = [] { return !ended; };
  if (tty) {
    o.tell = [&](const Pace& p) {
      std::fputs(
          fmt::format("\r\033[K{} SIMULATED, {:.1f} s, {}, {}", board->core().kind(), p.simulated_s,
                      p.real_time() ? "in real time"
                                    : fmt::format("{:.3g} x real time", p.simulated_s / p.wall_s),
                      terminal.connected() ? "host connected" : "no host")
              .c_str(),
          stderr);
      std::fflush(stderr);
    };
  }
  const Pace pace = serve(*board, terminal, o);
  if (tty) std::fputs("\r\033[K", stderr);
  say(outcome_text(board->outcome()));
  say(pace_text(*board, pace));
  if (writer) writer->finish(board->outcome());
  outputs.commit();
  return exit_ok;
}

int run(Arguments& a) {
  if (a.rtl && a.twin) throw std::invalid_argument("--rtl and --twin: give one of them");
  if (!a.replay.empty() && !(a.record.empty() && a.link.empty())) {
    throw std::invalid_argument(
        "--replay has no line and records nothing; leave --record and "
        "--link out");
  }
  struct sigaction end {};
  end.sa_handler = note_end;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &end, nullptr);
  const std::string kind = a.rtl ? "rtl" : "twin";
  return a.replay.empty() ? run_board(a, kind) : run_replay(a, kind);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"feltgate board: a board without hardware, behind a pseudo-terminal"};
  app.name("feltgate board");
  app.footer(
      R"(Prints the name of a terminal; behind it are the UART's pins, link, core, bridge, motor,
lever and hand. A host cannot tell it from a board, except by the bit `simulated` of its
features.
  feltgate board                              then, in another window,
  feltgate host /dev/pts/7 info               with the name that was printed
  feltgate board --link /tmp/lever --hand swing --scene wall --arm
  feltgate board --rtl                        the RTL by Verilator, slower than real time
  feltgate board --record day.board           and again:  feltgate board --replay day.board
  feltgate board --for 5 --unpaced            how fast it can go
Ctrl-C ends it. Exit code: 0 all well, 1 a replay differs, 2 unusable input.
docs/host.md teaches.)");
  Arguments a;
  a.setup.hand.clear();
  app.add_flag("--twin", a.twin, "the bit-exact twin; the default");
  app.add_flag("--rtl", a.rtl, "the RTL of core and link, compiled by Verilator, at 1 Mbaud");
  defaulted(app, "--design", a.setup.design, "DESIGN", "a name in rtl/designs");
  option(app, "--plant", a.setup.plant, "PLANT",
         "motor and lever: a name in vectors/plants or a path; default: p24, for three "
         "phases gimbal_motor, for Hall lines hall_motor");
  option(app, "--hand", a.setup.hand, "HAND",
         "who holds the lever: free, locked, hold, swing, or a scene file whose [hand] it is; "
         "default: free, with a stylus, a gimbal or two levers the first scene of the device");
  defaulted(app, "--scene", a.setup.scene, "SCENE", "what the panel's switches choose");
  app.add_flag("--arm", a.setup.arm, "the panel's arm switch goes on after 10 ms");
  defaulted(app, "--baud", a.setup.baud, "BAUD", "bits per second on the wire",
            checks::whole(9600, 3'000'000));
  option(app, "--bad-line", a.setup.bad_line, "SHARE",
         "share of bytes that the line loses, doubles or turns a bit of, each way",
         checks::number(0, 1, ""));
  defaulted(app, "--seed", a.setup.seed, "SEED", "of the bad line", checks::seed());
  option(app, "--link", a.link, "NAME", "a symbolic link to the terminal while the board runs");
  option(app, "--for", a.for_s, "SECONDS", "end after so much simulated time; else Ctrl-C ends it",
         checks::seconds());
  app.add_flag("--unpaced", a.unpaced, "do not wait for the clock on the wall");
  option(app, "--record", a.record, "FILE", "write all that came, with its clock, to this file");
  option(app, "--replay", a.replay, "FILE",
         "run a recording again, without a terminal: the ticks must be the same",
         checks::no_folder());
  int exit_code = exit_ok;
  app.callback([&] {
    if (a.replay.empty()) a.setup.design = built_design(a.setup.design);
    exit_code = run(a);
  });
  return run_command_line(app, argc, argv, exit_code);
}
