// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Recordings of the bytes that a board received. Documentation: docs/host.md
#include "host/board/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

namespace feltgate::board {

namespace {

constexpr const char* kFirstLine = "feltgate-board/1";

/// Converts the whole text to a number.
template <class T>
T number(const std::string& text, int base = 10) {
  std::size_t used = 0;
  T value{};
  if constexpr (std::is_floating_point_v<T>) {
    value = std::stod(text, &used);
  } else if constexpr (std::is_unsigned_v<T>) {
    value = std::stoull(text, &used, base);
  } else {
    value = std::stoll(text, &used, base);
  }
  if (used != text.size()) throw std::invalid_argument(text);
  return value;
}

std::vector<std::uint8_t> bytes_of(const std::string& hex) {
  if (hex.empty() || hex.size() % 2 != 0) throw std::invalid_argument(hex);
  std::vector<std::uint8_t> bytes;
  for (std::size_t k = 0; k < hex.size(); k += 2) {
    bytes.push_back(static_cast<std::uint8_t>(number<std::uint64_t>(hex.substr(k, 2), 16)));
  }
  return bytes;
}

}  // namespace

RecordingWriter::RecordingWriter(std::FILE* to, const Setup& s) : to_(to) {
  fmt::print(to_,
             "{}\n# written by feltgate board --record; lines of a clock and the bytes that came\n"
             "design {}\nplant {}\nhand {}\nscene {}\narm {:d}\nbaud {}\nbad_line "
             "{}\nseed {}\n",
             kFirstLine, s.design, s.plant, s.hand, s.scene, s.arm, s.baud, s.bad_line, s.seed);
}

void RecordingWriter::add(const Arrival& a) {
  std::string line = fmt::format("{} ", a.clock);
  for (const std::uint8_t byte : a.bytes) line += fmt::format("{:02x}", byte);
  std::fputs((line + "\n").c_str(), to_);
}

void RecordingWriter::finish(const Outcome& o) {
  fmt::print(to_, "end {}\nticks {} {:016x}\nsent {} {:016x}\n", o.clocks, o.ticks, o.tick_sum,
             o.bytes, o.byte_sum);
}

Recording read_recording(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::invalid_argument(path + ":0: cannot be read; check the path");
  Recording r;
  std::string line, key, value, more;
  int number_of_line = 0;
  const auto fail = [&](std::string what, const std::string& mend) {
    // A line of the file may have any bytes.
    std::replace_if(
        what.begin(), what.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    throw std::invalid_argument(fmt::format("{}:{}: {}; {}", path, number_of_line, what, mend));
  };
  const std::map<std::string, std::function<void()>> keys{
      {"design", [&] { r.setup.design = value; }},
      {"plant", [&] { r.setup.plant = value; }},
      {"hand", [&] { r.setup.hand = value; }},
      {"scene", [&] { r.setup.scene = value; }},
      {"arm", [&] { r.setup.arm = number<std::int64_t>(value) != 0; }},
      {"baud", [&] { r.setup.baud = number<std::int64_t>(value); }},
      {"bad_line", [&] { r.setup.bad_line = number<double>(value); }},
      {"seed", [&] { r.setup.seed = number<std::uint64_t>(value); }},
      {"end", [&] { r.outcome.clocks = number<std::int64_t>(value); }},
      {"ticks",
       [&] {
         r.outcome.ticks = number<std::int64_t>(value);
         r.outcome.tick_sum = number<std::uint64_t>(more, 16);
       }},
      {"sent",
       [&] {
         r.outcome.bytes = number<std::int64_t>(value);
         r.outcome.byte_sum = number<std::uint64_t>(more, 16);
       }},
  };
  while (std::getline(in, line)) {
    ++number_of_line;
    if (number_of_line == 1 && line != kFirstLine) {
      fail("no recording of a board", "give a file that feltgate board --record wrote");
    }
    if (number_of_line == 1 || line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    key = value = more = {};
    words >> key >> value >> more;
    try {
      const auto known = keys.find(key);
      if (known != keys.end()) {
        known->second();
      } else {
        const Clock clock = number<std::int64_t>(key);
        if (!r.arrivals.empty() && clock < r.arrivals.back().clock) {
          fail("time runs back", "record again");
        }
        r.arrivals.push_back({clock, bytes_of(value)});
      }
    } catch (const std::invalid_argument& e) {
      if (std::string(e.what()).find(path) == 0) throw;
      fail("\"" + line.substr(0, 40) + "\" is no line of a recording", "record again");
    } catch (const std::out_of_range&) {
      fail("a number is too large", "record again");
    }
  }
  if (r.outcome.ticks == 0 || r.outcome.clocks == 0) {
    fail("it has no end",
         "the board was killed while it wrote; record again and end it by Ctrl-C "
         "or --for");
  }
  return r;
}

}  // namespace feltgate::board
