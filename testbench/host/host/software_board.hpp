// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board in software for the tests of the host. It has its own code for the link's format, moves
// its lever by a formula, and can lose and corrupt bytes. It contains no core and no twin.
// Documentation: docs/link.md
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "feltgate/random.hpp"

namespace feltgate::test {

/// Errors on the wire, in each direction, as a share of 1.
struct Noise {
  double drop = 0;     ///< of the bytes
  double flip = 0;     ///< of the bytes: one bit of it
  double halve = 0;    ///< of the board's frames: only its first half is sent
  double junk = 0;     ///< of the board's frames: random bytes come before it
  double other = 0;    ///< of the board's replies: one of another address comes before it
  double delay_s = 0;  ///< before every reply
};

/// A board behind a descriptor, in a thread of its own. Its lever swings by 300 counts, once a
/// second.
class SoftwareBoard {
 public:
  /// Takes ownership of the descriptor.
  explicit SoftwareBoard(int descriptor, Noise noise = {}, std::uint64_t seed = 1);
  ~SoftwareBoard();
  SoftwareBoard(const SoftwareBoard&) = delete;
  SoftwareBoard& operator=(const SoftwareBoard&) = delete;

  /// Stops or restarts all answers.
  void set_silent(bool silent) { silent_ = silent; }
  /// Closes the board's end, like a pulled cable.
  void unplug();
  /// Latches this fault and disarms.
  void set_fault(int number);
  void set_design_crc(std::uint32_t crc);

  /// Returns the writes in the order in which they were done.
  std::vector<std::pair<int, std::uint32_t>> writes();
  std::uint32_t word(int address);
  std::uint32_t frames_bad();
  bool armed();
  std::uint64_t kicks();

  static constexpr int words = 12, rows = 1024, columns = 8;
  /// A word of the snapshot, in the order of the slots, `tick` after the reset.
  std::uint32_t snapshot(int word, std::uint32_t tick);

 private:
  using Bytes = std::vector<std::uint8_t>;
  void run();
  void receive(std::uint8_t byte);
  void take(const Bytes& frame);
  void write(int address, std::uint32_t value);
  std::uint32_t read(int address);
  std::uint32_t status();
  std::uint32_t now() const;
  void send(const Bytes& payload);
  void send_stream();
  void follow_capture();

  int descriptor_;
  Noise noise_;
  SplitMix64 random_;
  std::atomic<bool> ends_{false}, silent_{false};
  std::mutex mutex_;
  std::int64_t start_ns_;
  std::map<int, std::uint32_t> memory_;
  std::vector<std::pair<int, std::uint32_t>> writes_;
  Bytes frame_;
  bool in_escape_ = false, spoilt_ = false;
  std::uint32_t last_sequence_ = 0x100, good_ = 0, bad_ = 0;
  bool armed_ = false, refused_ = false;
  unsigned faults_ = 0, first_fault_ = 0;
  std::uint64_t kicks_ = 0;
  std::int64_t zero_ = 0;
  std::uint32_t frozen_tick_ = 0;
  bool frozen_ = false;
  std::uint32_t next_frame_ = 0;
  std::uint8_t frame_counter_ = 0;
  std::uint32_t capture_start_ = 0, capture_trigger_ = 0, looked_ = 0;
  int capture_state_ = 0;
  std::thread thread_;
};

}  // namespace feltgate::test
