// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A software board, and a host's link to it over a pair of sockets.
#pragma once

#include <sys/socket.h>

#include <csignal>
#include <memory>
#include <stdexcept>

#include "host/link.hpp"
#include "software_board.hpp"

namespace feltgate::test {

struct BoardOnPipe {
  explicit BoardOnPipe(Noise noise = {}, double patience_s = 3, std::uint64_t seed = 1)
      : board(ends[1], noise, seed), link(*transport, options(patience_s)) {}

  static host::LinkOptions options(double patience_s) {
    host::LinkOptions o;
    o.patience_s = patience_s;
    return o;
  }
  struct Ends {
    int fd[2];
    Ends() {
      std::signal(SIGPIPE, SIG_IGN);  // of a socket whose other end is gone; a serial port has none
      if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, fd) != 0) {
        throw std::runtime_error("no pair of sockets");
      }
    }
    int operator[](int n) const { return fd[n]; }
  };
  Ends ends;
  SoftwareBoard board;
  std::unique_ptr<host::Transport> transport = host::open_stream(ends[0], "pipe");
  host::Link link;
};

}  // namespace feltgate::test
