// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Resolves the name of an output to its destination. Documentation: docs/json.md
#include "files/destination.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace fs = std::filesystem;

namespace feltgate::files {

namespace {

constexpr int most_links = 40;  // as many as the kernel follows

[[noreturn]] void refuse(const std::string& option, const std::string& path,
                         const std::string& why) {
  throw std::invalid_argument(fmt::format("{} {}: {}", option, path, why));
}

std::optional<struct stat> look(const std::string& path) {
  struct stat found = {};
  if (stat(path.c_str(), &found) != 0) return std::nullopt;
  return found;
}

/// N of /dev/fd/N and its other names, or -1.
int descriptor_of(const std::string& path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string prefix : {"/dev/fd/", "/proc/self/fd/"}) {
    const std::string number =
        path.substr(0, prefix.size()) == prefix ? path.substr(prefix.size()) : std::string();
    const bool digits = number.find_first_not_of("0123456789") == std::string::npos;
    if (!number.empty() && number.size() < 6 && digits) return std::stoi(number);
  }
  return -1;
}

/// The path that `path` leads to: links followed one by one, the last may be missing. Stops at a
/// descriptor of ours.
std::string follow(const std::string& option, const std::string& path) {
  fs::path at = path;
  for (int links = 0; links < most_links; ++links) {
    std::error_code error;
    if (descriptor_of(at.string()) >= 0) return at.string();
    const fs::path link = fs::read_symlink(at, error);
    if (error) return at.string();  // no link
    at = at.parent_path() / link;   // an absolute link replaces what is before it
  }
  refuse(option, path, "its symbolic links lead in a circle; choose another name");
}

Destination descriptor(const std::string& option, const std::string& path, int fd) {
  const int flags = fcntl(fd, F_GETFL);
  if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) {
    refuse(option, path, "is not open for writing; redirect it, or give a file's name");
  }
  Destination d;
  d.in_place = fcntl(fd, F_DUPFD_CLOEXEC, 0);
  struct stat found = {};
  if (d.in_place < 0 || fstat(fd, &found) != 0) refuse(option, path, std::strerror(errno));
  d.now = found;
  return d;
}

Destination file(const std::string& option, const std::string& path, const std::string& target) {
  Destination d;
  d.target = target;
  d.now = look(target);
  if (d.now && access(target.c_str(), W_OK) != 0) {
    refuse(option, path, "is write-protected; choose another name, or chmod u+w");
  }
  const fs::path as_path(target);
  d.name = as_path.filename().string();
  if (d.name.empty()) refuse(option, path, "is the name of a folder; add that of a file in it");
  const std::string folder = as_path.has_parent_path() ? as_path.parent_path().string() : ".";
  d.folder = look(folder);
  if (!d.folder) {
    refuse(option, path,
           fmt::format("the folder {} cannot be used: {}; make it, or choose another one", folder,
                       std::strerror(errno)));
  }
  if (!S_ISDIR(d.folder->st_mode)) {
    refuse(option, path, fmt::format("{} is no folder; choose another name", folder));
  }
  return d;
}

bool same_node(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool takes_everything(const struct stat& s) {
  return S_ISCHR(s.st_mode) && s.st_rdev == makedev(1, 3);  // /dev/null
}

}  // namespace

bool Destination::same(const Destination& other) const {
  if (now && other.now && same_node(*now, *other.now)) return !takes_everything(*now);
  return folder && other.folder && same_node(*folder, *other.folder) && name == other.name;
}

bool Destination::same(int fd) const {
  struct stat found = {};
  return now && fstat(fd, &found) == 0 && same_node(*now, found) && !takes_everything(found);
}

Destination find_destination(const std::string& option, const std::string& path) {
  if (path.empty()) refuse(option, "\"\"", "has no name; give a file's, or - for stdout");
  if (const int fd = descriptor_of(path); fd >= 0) return descriptor(option, path, fd);
  const auto found = look(path);
  const int error = errno;
  if (found && S_ISDIR(found->st_mode)) {
    refuse(option, path, "is a folder; add the name of a file in it");
  }
  if (!found && error != ENOENT) {
    refuse(option, path, fmt::format("{}; choose another name", std::strerror(error)));
  }
  const std::string target = follow(option, path);
  if (const int fd = descriptor_of(target); fd >= 0) return descriptor(option, path, fd);
  if (!found || S_ISREG(found->st_mode)) return file(option, path, target);
  Destination d;  // a device or a pipe; that of a pipe waits for its reader
  d.in_place = open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (d.in_place < 0) {
    refuse(option, path, fmt::format("cannot be written: {}", std::strerror(errno)));
  }
  d.now = found;
  return d;
}

}  // namespace feltgate::files
