// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs boards in real time. Documentation: docs/host.md
#include "host/board/serve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <thread>

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

}  // namespace feltgate::board
