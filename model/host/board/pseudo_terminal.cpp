// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Pseudo-terminals on POSIX. Documentation: docs/host.md
#include "host/board/pseudo_terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace feltgate::board {

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
