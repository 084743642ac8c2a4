// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs boards in real time. Documentation: docs/host.md
#include "host/board/serve.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>
#include <sys/stat.h>

namespace feltgate::board {

namespace {

constexpr double kSlice_s = 0.5e-3;   ///< simulated time between two reads of the line
constexpr double kLag_s = 0.05;       ///< delay that may be caught up
constexpr std::size_t kQueue = 1024;  ///< bytes that may wait for the rx pin
constexpr double kTell_s = 1;

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of this thread; time taken by other processes does not count.
double worked_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void sleep_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

}  // namespace

Pace serve(Board& board, PseudoTerminal& terminal, const ServeOptions& o) {
  const double clock_hz = static_cast<double>(board.core().design().clock_hz);
  const Clock slice = std::llround(kSlice_s * clock_hz);
  // A board of several axes has homed already.
  const Clock start = board.now();
  const Clock end = o.for_s > 0 ? start + std::llround(o.for_s * clock_hz) : INT64_MAX;
  Pace pace;
  const double begin_s = wall_s();
  // Wall-clock times: when board.now() is due; when `tell` was called.
  double due_s = begin_s, told_s = begin_s;
  while (board.now() < end && o.go_on()) {
    const Clock from = board.now();
    const double work_s = worked_s();
    board.run_to(std::min(end, from + slice));
    terminal.write(board.take_sent());
    const double done_s = wall_s();
    pace.busy_s += worked_s() - work_s;
    pace.simulated_s = static_cast<double>(board.now() - start) / clock_hz;
    due_s += static_cast<double>(board.now() - from) / clock_hz;
    double wait_s = o.paced ? due_s - done_s : 0;
    if (wait_s < -kLag_s) {
      pace.behind_s -= wait_s;
      due_s = done_s;
    }
    // The line is read only between slices, so that a recording has the same clocks.
    const std::size_t room = kQueue - std::min(kQueue, board.core().unsent());
    const auto bytes = terminal.read(room);
    if (!bytes.empty()) {
      if (o.record != nullptr) o.record->add({board.now(), bytes});
      board.receive(bytes);
      wait_s = o.paced ? due_s - wall_s() : 0;
    }
    if (wait_s > 0) sleep_s(wait_s);
    pace.wall_s = wall_s() - begin_s;
    if (o.tell && wall_s() - told_s >= kTell_s) {
      told_s = wall_s();
      o.tell(pace);
    }
  }
  return pace;
}

Pace replay(Board& board, const Recording& recording, const std::function<bool()>& go_on,
            const std::function<void(double done)>& progress) {
  const double clock_hz = static_cast<double>(board.core().design().clock_hz);
  const Clock slice = std::llround(kSlice_s * clock_hz), end = recording.outcome.clocks;
  Pace pace;
  const double begin_s = wall_s(), work_s = worked_s();
  auto next = recording.arrivals.begin();
  while (board.now() < end && go_on()) {
    board.run_to(std::min(end, board.now() + slice));
    (void)board.take_sent();
    while (next != recording.arrivals.end() && next->clock <= board.now()) {
      board.receive((next++)->bytes);
    }
    progress(static_cast<double>(board.now()) / static_cast<double>(end));
  }
  pace.simulated_s = static_cast<double>(board.now()) / clock_hz;
  pace.wall_s = wall_s() - begin_s;
  pace.busy_s = worked_s() - work_s;
  return pace;
}

// Pseudo-terminals on POSIX.

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(fmt::format("no pseudo-terminal: {}: {}", what, std::strerror(errno)));
}

/// Sets raw mode: no echo, no lines, no translations.
void make_raw(int descriptor) {
  termios mode{};
  if (tcgetattr(descriptor, &mode) != 0) fail("tcgetattr");
  cfmakeraw(&mode);
  if (tcsetattr(descriptor, TCSANOW, &mode) != 0) fail("tcsetattr");
}

/// Throws unless `link` may be replaced: it must not exist, or be a link whose target is gone, as a
/// killed board leaves it.
void refuse_to_replace(const std::string& link) {
  struct stat now {};
  if (lstat(link.c_str(), &now) != 0) return;
  if (S_ISLNK(now.st_mode)) {
    if (stat(link.c_str(), &now) != 0) return;
    throw std::invalid_argument(
        fmt::format("--link {}: is a link to what is there, such as a board that runs; end that, "
                    "remove the link or give another name",
                    link));
  }
  throw std::invalid_argument(
      fmt::format("--link {}: is there and no symbolic link; give another name", link));
}

}  // namespace

PseudoTerminal::PseudoTerminal(const std::string& link) {
  if (!link.empty()) refuse_to_replace(link);
  master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (master_ < 0) {
    throw std::runtime_error(
        fmt::format("no pseudo-terminal can be opened: {}; in a container, mount devpts: mount -t "
                    "devpts devpts /dev/pts",
                    std::strerror(errno)));
  }
  char name[128];
  if (grantpt(master_) != 0 || unlockpt(master_) != 0 ||
      ptsname_r(master_, name, sizeof name) != 0) {
    fail("ptsname");
  }
  name_ = name;
  // Opened and closed once; from then on a hang-up shows that nobody has it open.
  const int other = open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (other < 0) fail(name_);
  make_raw(other);
  close(other);
  if (fcntl(master_, F_SETFL, O_NONBLOCK) != 0) fail("fcntl");
  if (link.empty()) return;
  (void)unlink(link.c_str());
  if (symlink(name, link.c_str()) != 0) {
    const int error = errno;
    close(master_);
    throw std::invalid_argument(
        fmt::format("--link {}: cannot be made: {}; give a name in a "
                    "folder that can be written",
                    link, std::strerror(error)));
  }
  link_ = link;
}

PseudoTerminal::~PseudoTerminal() {
  char there[256];
  if (!link_.empty()) {
    // Another board may have replaced the link since.
    const ssize_t size = readlink(link_.c_str(), there, sizeof there);
    if (size > 0 && std::string(there, static_cast<std::size_t>(size)) == name_) {
      (void)unlink(link_.c_str());
    }
  }
  close(master_);
}

bool PseudoTerminal::connected() const {
  pollfd p{master_, POLLIN, 0};
  return poll(&p, 1, 0) >= 0 && (p.revents & POLLHUP) == 0;
}

std::vector<std::uint8_t> PseudoTerminal::read(std::size_t most) {
  std::vector<std::uint8_t> bytes(most);
  const ssize_t size = most > 0 ? ::read(master_, bytes.data(), bytes.size()) : 0;
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return bytes;
}

void PseudoTerminal::write(const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) return;
  std::size_t done = 0;
  while (connected() && done < bytes.size()) {
    const ssize_t size = ::write(master_, bytes.data() + done, bytes.size() - done);
    if (size <= 0) break;
    done += static_cast<std::size_t>(size);
  }
  lost_ += bytes.size() - done;
}

}  // namespace feltgate::board
