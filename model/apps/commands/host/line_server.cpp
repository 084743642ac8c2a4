// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lines over TCP. Documentation: docs/host.md
#include "apps/commands/host/line_server.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace feltgate::host {

LineServer::LineServer(int port) {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(static_cast<std::uint16_t>(port));
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int yes = 1;
  socklen_t size = sizeof at;
  auto* const address = reinterpret_cast<sockaddr*>(&at);
  if (listener_ < 0 || setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      bind(listener_, address, size) != 0 || listen(listener_, 4) != 0 ||
      getsockname(listener_, address, &size) != 0) {
    const int error = errno;
    if (listener_ >= 0) close(listener_);
    throw std::invalid_argument(
        fmt::format("--tcp {}: {}; give another port, or 0 for any", port, std::strerror(error)));
  }
  port_ = ntohs(at.sin_port);
}

LineServer::~LineServer() {
  for (const int client : clients_) close(client);
  close(listener_);
}

void LineServer::poll() {
  for (;;) {
    const int client = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (client < 0) return;
    clients_.push_back(client);
  }
}

void LineServer::send(const std::string& line) {
  const auto gone = [&line](int client) {
    const ssize_t sent = ::send(client, line.data(), line.size(), MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(line.size())) return false;
    close(client);
    return true;
  };
  clients_.erase(std::remove_if(clients_.begin(), clients_.end(), gone), clients_.end());
}

}  // namespace feltgate::host
