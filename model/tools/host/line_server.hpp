// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lines of text to whoever connects on this computer. Documentation: docs/host.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::host {

/// Listens on 127.0.0.1 alone. Never waits: who does not take a line whole is let go.
class LineServer {
 public:
  /// Port 0: any that is free. Throws std::invalid_argument where it cannot listen.
  explicit LineServer(int port);
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  int port() const { return port_; }
  /// Takes in those who have connected since.
  void poll();
  /// To all that are connected; `line` has its line end.
  void send(const std::string& line);

 private:
  int listener_ = -1, port_ = 0;
  std::vector<int> clients_;
};

}  // namespace feltgate::host
