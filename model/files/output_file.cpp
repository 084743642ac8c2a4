// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes files that appear either complete or not at all. Documentation: docs/json.md
#include "files/output_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>

namespace fs = std::filesystem;

namespace feltgate::files {

namespace {

/// A name beside the target's that nobody else has; cut where a file's name would be too long.
std::string part_of(const Destination& d) {
  constexpr std::size_t most = 200;
  static int count = 0;
  const fs::path folder = fs::path(d.target).parent_path();
  return (folder / fmt::format("{}.{}.{}.part", d.name.substr(0, most), getpid(), ++count))
      .string();
}

/// The owner and mode of the file that will be replaced; the owner only where that is allowed.
void take_over(int fd, const struct stat& old) {
  if (fchown(fd, old.st_uid, old.st_gid) != 0) errno = 0;
  if (fchmod(fd, old.st_mode & 07777) != 0) errno = 0;
}

}  // namespace

OutputFile::OutputFile(const std::string& option, const std::string& path)
    : option_(option), path_(path), destination_(find_destination(option, path)) {
  int fd = destination_.in_place;
  if (fd < 0) {
    part_ = part_of(destination_);
    unfinished_ = std::make_unique<Unfinished>(part_, Unfinished::Kind::file);
    fd = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0) {
      throw std::invalid_argument(fmt::format("{}: cannot be written: {}; choose a folder that can",
                                              label(), std::strerror(errno)));
    }
    if (destination_.now) take_over(fd, *destination_.now);
  }
  file_ = fdopen(fd, "w");
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() {
  if (file_ != nullptr) std::fclose(file_);
  file_ = nullptr;
  if (!part_.empty()) unlink(part_.c_str());
  part_.clear();
  unfinished_.reset();
  beside_.reset();
}

const std::string& OutputFile::named() {
  if (in_place()) {
    throw std::invalid_argument(label() + ": takes a file only, no device, pipe or stdout");
  }
  // The writer of waveforms keeps its table of signals beside them until it is closed.
  beside_ = std::make_unique<Unfinished>(part_ + ".hier", Unfinished::Kind::file);
  return part_;
}

void OutputFile::write(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) < text.size() && error_ == 0) error_ = errno;
}

void OutputFile::fail(int error) {
  discard();
  throw std::runtime_error(fmt::format("{}: could not be written whole: {}", label(),
                                       error == 0 ? "is the disk full?" : std::strerror(error)));
}

void OutputFile::commit() {
  if (file_ == nullptr) return;
  errno = 0;
  const bool before = std::ferror(file_) == 0;
  const bool written = std::fflush(file_) == 0 && before;
  int error = error_ != 0 ? error_ : errno;
  const bool closed = std::fclose(file_) == 0;
  if (error == 0) error = errno;
  file_ = nullptr;
  if (!written || !closed) fail(error);
  if (in_place()) return;
  if (beside_ && destination_.now) chmod(part_.c_str(), destination_.now->st_mode & 07777);
  if (std::rename(part_.c_str(), destination_.target.c_str()) != 0) {
    const std::string kept = part_;
    part_.clear();  // the computed file stays
    throw std::runtime_error(fmt::format("{}: could not be given its name: {}; it is whole in {}",
                                         label(), std::strerror(errno), kept));
  }
  part_.clear();
  unfinished_.reset();
  beside_.reset();
}

OutputFolder::OutputFolder(const std::string& option, const std::string& path,
                           const std::string& last) {
  const auto refuse = [&](const std::string& why) {
    for (auto made = made_.rbegin(); made != made_.rend(); ++made) rmdir(made->c_str());
    throw std::invalid_argument(fmt::format("{} {}: {}", option, path, why));
  };
  if (path.empty()) refuse("has no name; give a folder's");
  fs::path so_far;
  for (const fs::path& piece : fs::path(path)) {
    so_far /= piece;
    std::error_code ignored;
    if (fs::is_directory(so_far, ignored)) continue;
    unfinished_.push_back(std::make_unique<Unfinished>(so_far.string(), Unfinished::Kind::folder));
    if (mkdir(so_far.c_str(), 0777) != 0) {
      const int error = errno;
      refuse(fs::exists(so_far, ignored)
                 ? fmt::format("{} is no folder; choose another name", so_far.string())
                 : fmt::format("cannot be made: {}; choose another place", std::strerror(error)));
    }
    made_.push_back(so_far.string());
  }
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    refuse(fmt::format("cannot be written: {}; choose another folder", std::strerror(errno)));
  }
  if (last.empty()) return;
  lock_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool taken = lock_ < 0 || (flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK);
  const bool used = fs::exists(fs::path(path) / last);
  if (taken || used) {
    if (lock_ >= 0) close(lock_);
    refuse(taken ? "another run writes there; choose another folder, or wait for its end"
                 : fmt::format("holds the {} of a run before; choose another folder, or remove it",
                               last));
  }
}

OutputFolder::~OutputFolder() {
  if (lock_ >= 0) close(lock_);
  for (auto made = made_.rbegin(); made != made_.rend(); ++made) rmdir(made->c_str());
}

OutputFile* Outputs::open(const std::string& option, const std::string& path) {
  if (path.empty()) return nullptr;
  auto file = std::make_unique<OutputFile>(option, path);
  const Destination& d = file->destination();
  for (const auto& other : files_) {
    if (d.same(other->destination())) {
      throw std::invalid_argument(fmt::format("{} and {} are the same; give each its own name",
                                              other->label(), file->label()));
    }
  }
  for (const auto& [name, input] : inputs_) {
    if (d.now && d.now->st_dev == input.st_dev && d.now->st_ino == input.st_ino) {
      throw std::invalid_argument(fmt::format(
          "{} would replace {}, which is read; choose another name", file->label(), name));
    }
  }
  if (!file->in_place() && d.same(STDOUT_FILENO)) {
    throw std::invalid_argument(file->label() +
                                " is where stdout goes too; give each its own name");
  }
  files_.push_back(std::move(file));
  return files_.back().get();
}

void Outputs::folder(const std::string& option, const std::string& path, const std::string& last) {
  if (!path.empty()) folders_.push_back(std::make_unique<OutputFolder>(option, path, last));
}

void Outputs::reads(const std::string& path) {
  struct stat found = {};
  if (stat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode)) inputs_.emplace_back(path, found);
}

std::FILE* Outputs::text() const {
  for (const auto& file : files_) {
    if (file->in_place() && file->destination().same(STDOUT_FILENO)) return stderr;
  }
  return stdout;
}

void Outputs::commit() {
  std::string failed;
  for (const auto& file : files_) {
    try {
      file->commit();
    } catch (const std::runtime_error& error) {
      failed += (failed.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!failed.empty()) throw std::runtime_error(failed);
}

}  // namespace feltgate::files

// Resolves the name of an output to its destination.

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

// Signals: a handler may only look at memory that is always there, and unlink.

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
