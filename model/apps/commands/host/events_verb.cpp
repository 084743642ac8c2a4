// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT events. Documentation: docs/host.md
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <thread>

#include "apps/commands/host/verbs.hpp"

namespace feltgate::host {

namespace {

constexpr double rest_s = 0.002, look_s = 0.2;

struct EventsArguments {
  std::string arm;
  double seconds = 0;
  int count = 0;
  std::optional<int> tcp;
};

/// Sends lines of text to all programs on this computer that connect; it listens only on 127.0.0.1
/// and never waits: it disconnects a client that does not accept a complete line.
class LineServer {
 public:
  /// Port 0 means any free port. Throws std::invalid_argument when it cannot listen.
  explicit LineServer(int port) {
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
  ~LineServer() {
    for (const int client : clients_) close(client);
    close(listener_);
  }
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  int port() const { return port_; }
  /// Accepts the clients that have connected since the last call.
  void poll() {
    for (;;) {
      const int client = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (client < 0) return;
      clients_.push_back(client);
    }
  }
  /// Sends `line`, which includes its line end, to all clients.
  void send(const std::string& line) {
    const auto gone = [&line](int client) {
      const ssize_t sent = ::send(client, line.data(), line.size(), MSG_NOSIGNAL);
      if (sent == static_cast<ssize_t>(line.size())) return false;
      close(client);
      return true;
    };
    clients_.erase(std::remove_if(clients_.begin(), clients_.end(), gone), clients_.end());
  }

 private:
  int listener_ = -1, port_ = 0;
  std::vector<int> clients_;
};

void check_armed(Device& device) {
  const Tick tick = device.tick();
  if (!device.armed(tick)) throw Refused("the motor is off" + fault_lines(device, tick));
}

int events(Session& session, const EventsArguments& a) {
  Device& device = session.device();
  LawEngine& laws = session.laws();
  std::optional<LineServer> server;
  if (a.tcp) server.emplace(*a.tcp);
  std::fputs(simulated_banner(device.board()).c_str(), stderr);
  if (server) {
    std::fputs(fmt::format("lines also at 127.0.0.1:{}\n", server->port()).c_str(), stderr);
  }
  const Interruptible interruptible;
  Hold hold(device);
  hold.begin(a.arm);
  const Deadline end = within(a.seconds > 0 ? a.seconds : 1e9);
  Deadline look = within(look_s);
  int told = 0;
  std::optional<unsigned> lost_before;
  while (!Interruptible::interrupted() && HostClock::now() < end &&
         (a.count == 0 || told < a.count)) {
    hold.poll();
    if (server) server->poll();
    const auto event = laws.event();
    if (!lost_before) lost_before = laws.events_lost();
    if (event) {
      const std::string line =
          fmt::format("{} {} {:.9g}\n", event->tick, event->name, event->value);
      say(line);
      if (server) server->send(line);
      ++told;
      continue;
    }
    if (hold.holds() && HostClock::now() > look) {
      check_armed(device);
      look = within(look_s);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(hold.next_in_s(), rest_s)));
  }
  hold.release();
  const unsigned lost = laws.events_lost() - lost_before.value_or(laws.events_lost());
  if (lost > 0 || laws.events_lost() == 255) {
    std::fputs(fmt::format("{}{} events found no place on the board meanwhile and are lost\n",
                           laws.events_lost() == 255 ? "at least " : "", lost)
                   .c_str(),
               stderr);
  }
  return exit_ok;
}

}  // namespace

Run add_events(CLI::App& sub) {
  auto a = std::make_shared<EventsArguments>();
  sub.footer(
      R"(  feltgate host /dev/ttyUSB0 events --arm law           arm, hold, tell; Ctrl-C disarms
  feltgate host /dev/ttyUSB0 events --arm law --tcp 4711
  nc 127.0.0.1 4711                                     in another window
A line each: the tick, the name in the law, the value in SI units. The board keeps 16 events until
the host takes them; those beyond are counted and told. One host at a time has the port.
Exit code: 0 done, 1 no engine, or the motor went off, 2 unusable input or port, 3 the link broke
down.)");
  option(sub, "--arm", a->arm, "SCENE", "arm this scene, kick the watchdog, disarm at the end");
  option(sub, "--for", a->seconds, "SECONDS", "end after so long; default: Ctrl-C",
         checks::seconds());
  option(sub, "--count", a->count, "EVENTS", "end after so many events",
         checks::whole(1, 1'000'000'000));
  option(sub, "--tcp", a->tcp, "PORT",
         "send the lines to those who connect to this port of 127.0.0.1 too; 0: any",
         checks::whole(0, 65535));
  return [a](Session& session) { return events(session, *a); };
}

}  // namespace feltgate::host
