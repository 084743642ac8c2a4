// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds the processes that have a port open, in /proc. Documentation: docs/host.md
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "host/transport.hpp"

namespace feltgate::host {

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
