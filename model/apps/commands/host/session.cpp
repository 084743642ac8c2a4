// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Port, board, design. Documentation: docs/host.md
#include "apps/commands/host/session.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "apps/commands/commands.hpp"
#include "design/engine_map.hpp"
#include "law/compile.hpp"

namespace feltgate::host {

namespace {

std::atomic<bool> was_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);
// SIGPIPE: what reads the output has gone, and the motor must still be disarmed.
constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
struct sigaction before[std::size(signals)];

extern "C" void note_signal(int) { was_interrupted = true; }

}  // namespace

Link& Session::link() {
  if (!link_) {
    transport_ = open_serial(options.port, options.baud);
    LinkOptions how;
    how.patience_s = options.patience_s;
    link_.emplace(*transport_, how);
    link_->begin();
  }
  return *link_;
}

const BoardInfo& Session::board() {
  if (!board_) board_ = read_board(link());
  return *board_;
}

const KnownDesign* Session::design_if_known() {
  if (!looked_) {
    looked_ = true;
    if (!options.design.empty()) {
      KnownDesign given = read_known_design(repository(), find_file(options.design, "rtl/designs"));
      if (given.crc == board().design_crc) {
        design_ = std::move(given);
      } else {
        const auto right = design_by_crc(repository(), board().design_crc);
        throw std::invalid_argument(fmt::format(
            "--design {}: its CRC is 0x{:08x}, the board's 0x{:08x}{}; values would have wrong "
            "units",
            options.design, given.crc, board().design_crc,
            right ? fmt::format(", which is {}: leave --design out", right->name())
                  : "; give the file that the board was built from"));
      }
    } else {
      design_ = design_by_crc(repository(), board().design_crc);
    }
  }
  return design_ ? &*design_ : nullptr;
}

const KnownDesign& Session::design() {
  if (const KnownDesign* known = design_if_known()) return *known;
  throw std::invalid_argument(
      fmt::format("{}: the board's design (CRC 0x{:08x}) is none of rtl/designs as they are now; "
                  "give its file: --design FILE",
                  options.port, board().design_crc));
}

Device& Session::device() {
  if (!device_) device_.emplace(link(), board(), design().design);
  return *device_;
}

law::Image Session::image_of(const std::string& law) {
  const std::string path = std::filesystem::path(law).extension() == ".img" ? law : find_law(law);
  if (std::filesystem::path(path).extension() != ".img") {
    return law::compile_file(path, design::law_target(design().design)).image;
  }
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::invalid_argument(path + ": cannot be read; check the path");
  if (text.str().empty()) {
    throw std::invalid_argument(
        path + ": is empty, no law's image; make one: `feltgate law NAME --design " +
        design().design.design.name + " -o NAME.img`");
  }
  try {
    return law::read_image(text.str());
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(path + ": " + e.what());
  }
}

LawEngine& Session::laws() {
  if (!laws_) {
    laws_.emplace(device());
    if (!options.law.empty()) {
      laws_->attach(image_of(options.law));
    } else {
      (void)laws_->recognise(laws_folder());
    }
  }
  return *laws_;
}

LawEngine* Session::laws_if_any() { return board().has_engine ? &laws() : nullptr; }

Interruptible::Interruptible() {
  was_interrupted = false;
  struct sigaction note {};
  note.sa_handler = note_signal;
  for (std::size_t n = 0; n < std::size(signals); ++n) {
    (void)sigaction(signals[n], &note, &before[n]);
  }
}

Interruptible::~Interruptible() {
  for (std::size_t n = 0; n < std::size(signals); ++n) {
    (void)sigaction(signals[n], &before[n], nullptr);
  }
}

bool Interruptible::interrupted() { return was_interrupted; }

Hold::~Hold() {
  try {
    release();
  } catch (const std::exception& e) {
    std::fputs(fmt::format("feltgate host: the disarm did not reach the board: {}\n"
                           "  its watchdog disarms it, watchdog_ticks after the last kick\n",
                           e.what())
                   .c_str(),
               stderr);
  }
}

void Hold::arm(const std::string& scene) {
  keep_.arm(scene, [] { return !Interruptible::interrupted(); });
}

std::string fault_lines(const Device& device, const Tick& tick) {
  std::string text;
  for (const std::string& words : device.in_words(tick)) {
    if (words.rfind("fault", 0) == 0) text += "\n  " + words;
  }
  return text;
}

void say(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

std::string simulated_banner(const BoardInfo& board) {
  return board.simulated ? "*** SIMULATED: no board, no motor; these values come from a model ***\n"
                         : "";
}

std::string link_troubles(const LinkCounts& c) {
  const std::uint64_t bad = c.frames.bad_crc + c.frames.bad_slip + c.frames.too_long;
  if (c.retries + bad + c.unread == 0) return "";
  return fmt::format(
      "link: {} of {} requests repeated, {} damaged frames, {} frames of the stream lost\n",
      c.retries, c.requests, bad, c.lost + c.unread);
}

}  // namespace feltgate::host
