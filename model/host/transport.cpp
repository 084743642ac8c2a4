// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Transports over Boost.Asio, one call at a time. Documentation: docs/host.md
#include "host/transport.hpp"

#include <unistd.h>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/serial_port.hpp>

namespace feltgate::host {

namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using boost::system::error_code;

constexpr double write_patience_s = 1.0;

/// A transport over an Asio stream; one operation at a time.
template <class Stream>
class StreamTransport final : public Transport {
 public:
  explicit StreamTransport(std::string name) : name_(std::move(name)), stream_(io_) {}
  ~StreamTransport() override {
    if (exclusive_) (void)::ioctl(stream_.native_handle(), TIOCNXCL);
  }
  Stream& stream() { return stream_; }
  void set_exclusive() { exclusive_ = ::ioctl(stream_.native_handle(), TIOCEXCL) == 0; }
  const std::string& name() const override { return name_; }

  void write(const std::uint8_t* data, std::size_t size) override {
    const Deadline deadline = within(write_patience_s);
    while (size > 0) {
      const std::size_t done = wait(deadline, [&](auto handler) {
        stream_.async_write_some(asio::buffer(data, size), handler);
      });
      if (done == 0) {
        throw LinkLost(fmt::format(
            "{}: takes no bytes for {:g} s; is the cable in, and nothing else in the way?", name_,
            write_patience_s));
      }
      data += done;
      size -= done;
    }
  }
  std::size_t read(std::uint8_t* data, std::size_t size, Deadline deadline) override {
    return wait(deadline,
                [&](auto handler) { stream_.async_read_some(asio::buffer(data, size), handler); });
  }

 private:
  /// Starts an operation and waits for its end; cancels it at the deadline. Returns the bytes
  /// transferred.
  template <class Start>
  std::size_t wait(Deadline deadline, Start start) {
    error_code error;
    std::size_t bytes = 0;
    bool over = false;
    start([&](const error_code& e, std::size_t n) {
      error = e;
      bytes = n;
      over = true;
    });
    io_.restart();
    io_.run_until(deadline);
    if (!over) {
      stream_.cancel();
      io_.restart();
      io_.run();
    }
    if (error && error != asio::error::operation_aborted) {
      throw LinkLost(fmt::format(
          "{}: the port went away ({}); was it unplugged, or has the board's program ended? "
          "Plug it in, then start again",
          name_, error == asio::error::eof ? "end of file" : error.message()));
    }
    return bytes;
  }

  std::string name_;
  asio::io_context io_;
  Stream stream_;
  bool exclusive_ = false;
};

/// A sentence that lists the existing ports.
std::string what_there_is() {
  std::string text;
  for (const FoundPort& port : found_ports()) {
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", port.path,
                        port.about.empty() ? "" : " (" + port.about + ")");
  }
  return text.empty() ? "no serial port was found on this machine; plug the board in, or start one "
                        "without hardware: feltgate board"
                      : "serial ports found: " + text;
}

[[noreturn]] void refuse_busy(const std::string& path) {
  const std::string holders = holders_of(path);
  throw PortError(
      fmt::format("{}: is in use by {}; end it first: two hosts on one link would take "
                  "each other's answers",
                  path, holders.empty() ? "another program" : holders));
}

[[noreturn]] void refuse_to_open(const std::string& path, const error_code& error) {
  switch (error.value()) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
    case EIO:
      throw PortError(fmt::format("{}: there is no such port; {}", path, what_there_is()));
    case EACCES:
    case EPERM:
      throw PortError(fmt::format(
          "{}: no permission; join the group that owns it (sudo adduser $USER dialout), then log "
          "in again",
          path));
    case EBUSY:
      refuse_busy(path);
    default:
      throw PortError(
          fmt::format("{}: is no serial port ({}); {}", path, error.message(), what_there_is()));
  }
}

template <class Option>
void set(asio::serial_port& port, const std::string& path, const Option& option) {
  error_code error;
  port.set_option(option, error);
  if (error) {
    throw PortError(fmt::format("{}: refuses its settings ({})", path, error.message()));
  }
}

bool is_pseudo_terminal(const std::string& path) {
  std::error_code error;
  return fs::canonical(path, error).string().rfind("/dev/pts/", 0) == 0;
}

}  // namespace

Deadline within(double seconds) {
  return HostClock::now() +
         std::chrono::duration_cast<HostClock::duration>(std::chrono::duration<double>(seconds));
}

std::unique_ptr<Transport> open_serial(const std::string& path, int baud) {
  auto transport = std::make_unique<StreamTransport<asio::serial_port>>(path);
  asio::serial_port& port = transport->stream();
  error_code error;
  port.open(path, error);
  if (error) refuse_to_open(path, error);
  // TIOCEXCL does not stop root, and a pseudo-terminal that its board keeps open would keep it
  // forever.
  if (::flock(port.native_handle(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    refuse_busy(path);
  }
  if (!is_pseudo_terminal(path)) transport->set_exclusive();
  using Base = asio::serial_port_base;
  set(port, path, Base::character_size(8));
  set(port, path, Base::parity(Base::parity::none));
  set(port, path, Base::stop_bits(Base::stop_bits::one));
  set(port, path, Base::flow_control(Base::flow_control::none));
  port.set_option(Base::baud_rate(static_cast<unsigned>(baud)), error);
  if (error) {
    throw PortError(
        fmt::format("{}: {} baud is not a rate of this system; choose the board's, such as 1000000",
                    path, baud));
  }
  return transport;
}

std::unique_ptr<Transport> open_stream(int descriptor, const std::string& name) {
  auto transport = std::make_unique<StreamTransport<asio::posix::stream_descriptor>>(name);
  transport->stream().assign(descriptor);
  return transport;
}

std::vector<FoundPort> found_ports() {
  std::vector<FoundPort> ports;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/sys/class/tty", error)) {
    const std::string name = entry.path().filename().string();
    const bool usb = name.rfind("ttyUSB", 0) == 0 || name.rfind("ttyACM", 0) == 0;
    const bool uart = name.rfind("ttyAMA", 0) == 0 || name.rfind("ttySC", 0) == 0;
    if (usb || uart) ports.push_back({"/dev/" + name, ""});
  }
  for (const auto& entry : fs::directory_iterator("/dev/serial/by-id", error)) {
    const std::string target = fs::canonical(entry.path(), error).string();
    for (FoundPort& port : ports) {
      if (port.path == target) port.about = entry.path().filename().string();
    }
  }
  return ports;
}

// Finds the processes that have a port open, in /proc.

namespace {

namespace fs = std::filesystem;

bool is_number(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether the process has the port open; false for the owner of a pseudo-terminal's other end.
bool holds(const fs::path& process, const std::string& port) {
  std::error_code error;
  bool found = false;
  for (const auto& entry : fs::directory_iterator(process / "fd", error)) {
    const std::string target = fs::read_symlink(entry.path(), error).string();
    if (target == "/dev/ptmx" || target == "/dev/pts/ptmx") return false;
    found = found || target == port;
  }
  return found;
}

}  // namespace

std::string holders_of(const std::string& path) {
  std::error_code error;
  const std::string port = fs::canonical(path, error).string();
  std::string text;
  for (const auto& entry : fs::directory_iterator("/proc", error)) {
    const std::string pid = entry.path().filename().string();
    if (!is_number(pid) || pid == fmt::format("{}", ::getpid()) || !holds(entry.path(), port)) {
      continue;
    }
    std::string name;
    std::getline(std::ifstream(entry.path() / "comm"), name);
    text += fmt::format("{}{} (pid {})", text.empty() ? "" : ", ", name, pid);
  }
  return text;
}

}  // namespace feltgate::host
