// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Sends lines of text to all programs on this computer that connect. Documentation: docs/host.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::host {

/// Listens only on 127.0.0.1. It never waits: a client that does not accept a complete line is
/// disconnected.
class LineServer {
 public:
  /// Port 0 means any free port. Throws std::invalid_argument when it cannot listen.
  explicit LineServer(int port);
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  int port() const { return port_; }
  /// Accepts the clients that have connected since the last call.
  void poll();
  /// Sends `line`, which includes its line end, to all clients.
  void send(const std::string& line);

 private:
  int listener_ = -1, port_ = 0;
  std::vector<int> clients_;
};

}  // namespace feltgate::host
