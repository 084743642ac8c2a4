// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Signals: a handler may only look at memory that is always there, and unlink. Documentation:
// docs/json.md
#include "files/unfinished.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <stdexcept>

namespace feltgate::files {

namespace {

enum State : int { unused, taken, a_file, a_folder };

struct Slot {
  std::atomic<int> state{unused};
  char path[4096];
};

constexpr int slot_count = 32;
Slot slots[slot_count];
std::atomic<pid_t> child_of_ours{0};

void end(int number) {
  const pid_t child = child_of_ours;
  if (child > 0) {
    kill(child, number == SIGPIPE ? SIGTERM : number);
    waitpid(child, nullptr, 0);
  }
  for (int i = slot_count - 1; i >= 0; --i) {  // a folder came before what is in it
    const int state = slots[i].state;
    if (state == a_file) unlink(slots[i].path);
    if (state == a_folder) rmdir(slots[i].path);
  }
  constexpr char text[] = "\nfeltgate: interrupted\n";
  if (number != SIGPIPE && write(STDERR_FILENO, text, sizeof text - 1) < 0) _exit(128 + number);
  _exit(128 + number);
}

}  // namespace

void end_on_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction now = {};
    sigaction(number, nullptr, &now);
    if (now.sa_handler == SIG_IGN) continue;
    struct sigaction ours = {};
    ours.sa_handler = end;
    // A second one, while a child is waited for, ends at once.
    ours.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
    sigaction(number, &ours, nullptr);
  }
}

Unfinished::Unfinished(const std::string& path, Kind kind) : slot_(0) {
  if (path.size() >= sizeof slots[0].path) throw std::runtime_error(path + ": too long a path");
  for (; slot_ < slot_count; ++slot_) {
    int expected = unused;
    if (slots[slot_].state.compare_exchange_strong(expected, taken)) break;
  }
  if (slot_ == slot_count) throw std::runtime_error(path + ": too many files at a time");
  std::memcpy(slots[slot_].path, path.c_str(), path.size() + 1);
  slots[slot_].state = kind == Kind::file ? a_file : a_folder;
}

Unfinished::~Unfinished() { slots[slot_].state = unused; }

void note_child(pid_t child) { child_of_ours = child; }

}  // namespace feltgate::files
