// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_fuzz READER ROOT RUNS SEED CORPUS...: replays the corpus, then reads RUNS changed
// inputs. feltgate_fuzz_sanitized does so under the sanitizers, and there an input that reaches
// code that none before it reached joins the corpus of this run. The same seed gives the same
// inputs. Of corpus.txt the sections of the reader are taken. Documentation: docs/testing.md
#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "fuzz.hpp"

namespace fs = std::filesystem;

extern "C" const char __executable_start;  // NOLINT: given by the linker

namespace {

unsigned char reached[1U << 18U];
bool reached_new = false;

}  // namespace

/// The compiler calls this in every branch of the readers (-fsanitize-coverage=trace-pc).
extern "C" void __sanitizer_cov_trace_pc() {
  const auto pc = reinterpret_cast<std::size_t>(__builtin_return_address(0)) -
                  reinterpret_cast<std::size_t>(&__executable_start);
  unsigned char& place = reached[(pc ^ (pc >> 18U)) % sizeof reached];
  reached_new = reached_new || place == 0;
  place = 1;
}

#ifdef __SANITIZE_ADDRESS__
extern "C" void __sanitizer_set_death_callback(void (*callback)());
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=512:handle_abort=1:detect_stack_use_after_return=0";
}
extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1"; }
#endif

namespace {

using namespace feltgate;

constexpr int kMostSeconds = 2;  ///< of CPU time, so that a busy machine hangs nothing

std::string finding;  ///< path for the input of a crash or hang
std::string current;  ///< the input being read

/// Keeps the input of a crash or hang. The process is about to end: only plain calls.
void keep_input() {
  const int file = ::open(finding.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
  if (file < 0) return;
  if (::write(file, current.data(), current.size()) < 0) std::perror("write");
  ::close(file);
  std::fprintf(stderr, "the input is kept as %s\n", finding.c_str());
}

void on_hang(int) {
  std::fprintf(stderr, "HANG: more than %d s of CPU time for one input\n", kMostSeconds);
  keep_input();
#ifdef __SANITIZE_ADDRESS__
  std::abort();  // which prints where it hangs
#else
  ::_exit(1);
#endif
}

#ifndef __SANITIZE_ADDRESS__
void on_crash(int signal) {
  std::fprintf(stderr, "CRASH: signal %d\n", signal);
  keep_input();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}
#endif

void arm_timer(int seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The file that a reader gets, written anew for each input.
class InputFile {
 public:
  explicit InputFile(const fs::path& path)
      : file_(::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0644)) {}
  ~InputFile() { ::close(file_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  void hold(const std::string& bytes) const {
    const auto size = static_cast<ssize_t>(bytes.size());
    if (::ftruncate(file_, size) != 0 || ::pwrite(file_, bytes.data(), bytes.size(), 0) != size) {
      throw std::runtime_error("the input cannot be written");
    }
  }

 private:
  int file_;
};

/// The sections of corpus.txt that are of this reader.
void add_sections(const std::string& corpus, const std::string& reader,
                  std::vector<std::string>* inputs) {
  const std::string head = "\n=== ";
  for (std::size_t at = corpus.find(head), end; at != std::string::npos; at = end) {
    end = corpus.find(head, at + 1);
    const std::string section = corpus.substr(at + head.size(), end - at - head.size());
    if (section.rfind(reader + "/", 0) != 0) continue;
    std::string bytes;
    for (std::size_t i = section.find('\n') + 1; i < section.size(); ++i) {
      if (section[i] != '\\') {
        bytes += section[i];
      } else if (section[++i] == '\\') {
        bytes += '\\';
      } else {  // x and two digits
        bytes += static_cast<char>(std::stoi(section.substr(i + 1, 2), nullptr, 16));
        i += 2;
      }
    }
    if (end == std::string::npos) bytes.pop_back();  // the end of the last line
    inputs->push_back(bytes);
  }
}

std::vector<std::string> read_corpus(const std::string& reader, char** first, char** last) {
  std::vector<fs::path> files;
  for (char** at = first; at != last; ++at) {
    if (fs::is_regular_file(*at)) files.emplace_back(*at);
    if (!fs::is_directory(*at)) continue;
    for (const auto& entry : fs::directory_iterator(*at)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> inputs;
  for (const fs::path& file : files) {
    if (file.filename() == "corpus.txt") {
      add_sections(bytes_of(file), reader, &inputs);
    } else {
      inputs.push_back(bytes_of(file));
    }
  }
  if (inputs.empty()) throw std::runtime_error("the corpus holds no file");
  return inputs;
}

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// One reader and its results.
class Session {
 public:
  Session(const fuzz::Reader& reader, fs::path folder)
      : reader_(reader), folder_(std::move(folder)), file_(folder_ / reader.file), input_(file_) {}

  /// False where the ending is a finding; the input is kept then.
  bool read(const std::string& input) {
    current = input;
    input_.hold(reader_.packed(input));
    const double before = cpu_s();
    arm_timer(kMostSeconds);
    fuzz::Ending ending;
    try {
      ending = reader_.use(file_);
    } catch (const std::exception& error) {
      ending.trouble = std::string("an error of no reader came out: ") + error.what();
    }
    arm_timer(0);
    longest_s_ = std::max(longest_s_, cpu_s() - before);
    ++inputs_;
    last_read_ = ending.read;
    ++(ending.read ? read_ : refused_);
    const auto files = std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    if (files != 1) ending.trouble = "the reader wrote a file beside its input";
    if (!ending.read && ending.trouble.empty()) ending.trouble = faults_of(ending.error);
    if (ending.trouble.empty()) return true;
    std::printf("%s: %s\n  %s\n", reader_.name, ending.trouble.c_str(), ending.error.c_str());
    keep_input();
    return false;
  }

  /// Whether the last input ended in a value.
  bool last_read() const { return last_read_; }

  void report(std::uint64_t seed, std::size_t kept) const {
    std::printf(
        "%s: %ld inputs (seed %lu), %ld read, %ld refused with a message; 0 crashes, "
        "0 hangs, 0 files written; the slowest took %.3f s of CPU; %zu reached new code\n",
        reader_.name, inputs_, static_cast<unsigned long>(seed), read_, refused_, longest_s_, kept);
  }

 private:
  /// A message names the file (or one that it names), says what and how to mend it, in one line
  /// that can be printed.
  static std::string faults_of(const std::string& message) {
    if (message.front() != '/' || message.find(": ") == std::string::npos) {
      return "the message does not begin with FILE:";
    }
    if (message.find("; ") == std::string::npos) return "the message has no mend";
    const bool control = std::any_of(message.begin(), message.end(), [](char c) {
      return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    });
    return control ? "the message is not one printable line" : "";
  }

  const fuzz::Reader& reader_;
  fs::path folder_, file_;
  InputFile input_;
  bool last_read_ = false;
  long inputs_ = 0, read_ = 0, refused_ = 0;
  double longest_s_ = 0;
};

int fuzz_reader(const fuzz::Reader& reader, long runs, std::uint64_t seed,
                const std::vector<std::string>& corpus, const fs::path& folder) {
  Session session(reader, folder);
  // Mostly from what can be read: a change of it gets further.
  std::vector<std::string> whole, refused;
  const auto keep = [&](const std::string& input) {
    (session.last_read() ? whole : refused).push_back(input);
  };
  for (const std::string& input : corpus) {
    if (!session.read(input)) return 1;
    keep(input);
  }
  if (whole.empty()) throw std::runtime_error("no file of the corpus can be read");
  test::Random random(seed);
  const auto any = [&]() -> const std::string& {
    const auto& from = refused.empty() || !random.one_in(4) ? whole : refused;
    return from[random.below(from.size())];
  };
  for (long run = 0; run < runs; ++run) {
    const std::string& other = any();
    const std::string input = fuzz::mutated(any(), other, random);
    reached_new = false;
    if (!session.read(input)) return 1;
    if (reached_new) keep(input);
  }
  session.report(seed, whole.size() + refused.size() - corpus.size());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) {
    std::fprintf(stderr, "usage: feltgate_fuzz READER ROOT RUNS SEED CORPUS...\n");
    return 2;
  }
  const auto& all = fuzz::readers();
  const auto reader = std::find_if(all.begin(), all.end(), [&](const fuzz::Reader& r) {
    return std::strcmp(r.name, argv[1]) == 0;
  });
  if (reader == all.end()) {
    std::fprintf(stderr, "%s is no reader\n", argv[1]);
    return 2;
  }
  // In memory where it can be: a million inputs are a million files.
  const fs::path memory = "/dev/shm";
  std::string folder = fs::is_directory(memory) ? memory : fs::temp_directory_path();
  folder += "/feltgate-fuzz-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) return 2;
  finding = (fs::current_path() / (std::string("fuzz-") + argv[1] + ".finding")).string();
#ifdef __SANITIZE_ADDRESS__
  __sanitizer_set_death_callback(keep_input);
#else
  for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(crash, on_crash);
#endif
  std::signal(SIGPROF, on_hang);
  int code = 2;
  try {
    auto corpus = read_corpus(argv[1], argv + 5, argv + argc);
    fuzz::set_root(argv[2]);
    // A write of a reader to a relative path would go to the folder of the input.
    fs::current_path(folder);
    code = fuzz_reader(*reader, std::atol(argv[3]), std::strtoull(argv[4], nullptr, 10), corpus,
                       folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  fs::current_path("/");
  fs::remove_all(folder);
  return code;
}
