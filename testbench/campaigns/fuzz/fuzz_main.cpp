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
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fuzz.hpp"
#include "random.hpp"

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
using test::Random;

constexpr std::size_t kMost = 1U << 16U;  ///< an input never grows beyond this

/// Numbers at the limits of a reader, and texts that are not numbers.
const std::vector<std::string>& numbers() {
  static const std::vector<std::string> all = [] {
    std::istringstream words(
        "0 -0.0 -1 1 2 3 7 40 63 64 65 127 256 1e-9 1e-300 5e-324 1e300 1.8e308 -1e300 1e9 "
        "1e12 1e18 nan -nan inf -inf 1_000 0x7fffffff 2147483648 9223372036854775807 "
        "-9223372036854775808 18446744073709551616 4611686018427387904 0.1 1e-12 00 1e 1. "
        "true 1979-05-27 99999999999999999999999999");
    return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
  }();
  return all;
}

/// Pieces with a meaning in one of the formats.
constexpr const char* kPieces[] = {
    "\n",   "\r\n",    "\"",    "\"\"\"",  "'''",      "\\n",  "\\u0000", "\\",     "[[",
    "]]",   "[",       "]",     "{",       "}",        "=",    "#",       ",",      ";",
    "\t",   " ",       ".",     "-",       "+",        "$end", "$var",    "$scope", "#0",
    "b1 ",  "x",       "z",     "*/",      "/*",       "//",   "\xff",    "\xc3",   "\xef\xbb\xbf",
    "\x7f", "\x1b[2J", "end 9", "probe1=", "logic-1-2"};

std::size_t index_below(Random& random, std::size_t n) { return n == 0 ? 0 : random.below(n); }

bool in_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '.' || c == '-' || c == '+';
}

/// The part of the text around `at` whose characters all satisfy `belongs`.
template <class Belongs>
std::pair<std::size_t, std::size_t> part_at(const std::string& text, std::size_t at,
                                            Belongs belongs) {
  std::size_t begin = at, end = at;
  while (begin > 0 && belongs(text[begin - 1])) --begin;
  while (end < text.size() && belongs(text[end])) ++end;
  return {begin, end - begin};
}

std::string random_part(const std::string& text, Random& random) {
  if (text.empty()) return {};
  const std::size_t begin = index_below(random, text.size());
  return text.substr(begin, 1 + index_below(random, random.coin() ? 8 : 200));
}

std::string random_line(const std::string& text, Random& random) {
  const auto [begin, size] =
      part_at(text, index_below(random, text.size()), [](char c) { return c != '\n'; });
  return text.substr(begin, size) + "\n";
}

std::string random_word(const std::string& text, Random& random) {
  for (int attempt = 0; attempt < 8 && !text.empty(); ++attempt) {
    const std::size_t at = index_below(random, text.size());
    const auto [begin, size] = part_at(text, at, in_word);
    if (size > 0) return text.substr(begin, size);
  }
  return {};
}

/// The word at or after `at`, replaced.
void replace_word(std::string& text, std::size_t at, const std::string& with, bool number) {
  while (at < text.size() && !(number ? text[at] >= '0' && text[at] <= '9' : in_word(text[at]))) {
    ++at;
  }
  if (at >= text.size()) return;
  const auto [begin, size] = part_at(text, at, in_word);
  text.replace(begin, size, with);
}

void change_bytes(std::string& text, std::size_t at, Random& random) {
  if (text.empty()) return;
  char& c = text[at];
  c = static_cast<char>(random.coin() ? random.below(256)
                                      : static_cast<unsigned char>(c) ^ (1U << random.below(8)));
}

void change_once(std::string& text, const std::string& other, Random& random) {
  const std::size_t at = index_below(random, text.size());
  const auto line = [&text](std::size_t i) {
    return part_at(text, i, [](char c) { return c != '\n'; });
  };
  switch (random.below(13)) {
    case 0:
      return change_bytes(text, at, random);
    case 1:
      text.erase(at, 1 + index_below(random, random.coin() ? 4 : 400));
      return;
    case 2:
      text.insert(at, random_part(text, random));
      return;
    case 3:
      text.insert(at, random_part(other, random));
      return;
    case 4:
    case 5:
    case 6:
      return replace_word(text, at, numbers()[index_below(random, numbers().size())], true);
    case 7:
      return replace_word(text, at, random_word(random.coin() ? text : other, random), false);
    case 8: {
      const auto [begin, size] = line(at);
      text.erase(begin, size + 1);
      return;
    }
    case 9: {
      const auto [begin, size] = line(at);
      (void)size;
      text.insert(begin, random_line(random.coin() ? text : other, random));
      return;
    }
    case 10:
      text.insert(at, kPieces[index_below(random, std::size(kPieces))]);
      return;
    case 11:
      return replace_word(text, at, std::to_string(random.between(-300, 300)), true);
    default:
      if (random.one_in(4)) text.resize(at);
  }
}

/// `input` after a few random changes; parts of `other` may get into it.
std::string mutated(std::string input, const std::string& other, Random& random) {
  for (std::uint32_t left = 1 + random.below(random.coin() ? 2 : 6); left > 0; --left) {
    change_once(input, other, random);
  }
  if (input.size() > kMost) input.resize(kMost);
  return input;
}

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
  Random random(seed);
  const auto any = [&]() -> const std::string& {
    const auto& from = refused.empty() || !random.one_in(4) ? whole : refused;
    return from[random.below(from.size())];
  };
  for (long run = 0; run < runs; ++run) {
    const std::string& other = any();
    const std::string input = mutated(any(), other, random);
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
