// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Words of a board over its link: read, write, stream. What is lost on the way is asked for again;
// a write is done once. Documentation: docs/host.md, docs/link.md
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/frame.hpp"
#include "host/transport.hpp"

namespace feltgate::host {

/// A frame of the stream: words of one tick.
struct StreamFrame {
  std::uint16_t mask = 0;            ///< bit k: the k-th word of the snapshot in order of its slot
  std::vector<std::uint32_t> words;  ///< those of the mask, lowest bit first
  unsigned lost = 0;  ///< frames that are missing between this one and the one before
};

/// A word to write at an address.
struct HostWrite {
  int address = 0;
  std::uint32_t value = 0;
};

/// What happened on the link since it was opened.
struct LinkCounts {
  std::uint64_t requests = 0;  ///< reads and writes that were asked for
  std::uint64_t retries = 0;   ///< requests that had to be sent again
  std::uint64_t stray = 0;     ///< good frames that answered nothing asked now
  std::uint64_t streamed = 0;  ///< frames of the stream that came
  std::uint64_t lost = 0;      ///< frames of the stream that are missing by their counter
  std::uint64_t unread = 0;    ///< frames of the stream that nobody took in time
  FrameCounts frames;
};

struct LinkOptions {
  double patience_s = 3.0;  ///< so long a request is repeated before the link counts as lost
};

/// The requests of one host on one transport, one at a time. Not for several threads.
class Link {
 public:
  /// `transport` outlives this. Nothing is sent before begin() or the first request.
  explicit Link(Transport& transport, LinkOptions options = {});

  /// Comes into step with a board in any state: throws away what has arrived, ends a frame that
  /// another host left half, and asks which sequence the last write had. Throws LinkLost when the
  /// board does not answer; the text says what to look at.
  void begin();

  /// `count` words (1 or more; more than 64, or fewer on a bad line, are several requests) from the
  /// word address on.
  /// Throws LinkLost after patience_s without an answer.
  std::vector<std::uint32_t> read(int address, int count);
  std::uint32_t read(int address) { return read(address, 1).front(); }
  /// Writes a word, once whatever is lost on the way; returns the core's status of a tick after it
  /// acted. Throws LinkLost as read().
  std::uint32_t write(int address, std::uint32_t value);

  /// Writes words as fast as the wire takes them, without an answer to each: on a bad line some do
  /// not arrive, so the caller reads them back. `progress` is called with 0..1. Throws LinkLost.
  void write_all(const std::vector<HostWrite>& writes, const std::function<void(double)>& progress);

  /// The oldest frame of the stream that was not taken yet; waits until `deadline` for one.
  std::optional<StreamFrame> stream(Deadline deadline);

  LinkCounts counts() const;
  const std::string& name() const { return transport_.name(); }

 private:
  Bytes ask(const Bytes& request, std::size_t words);
  /// Reads what comes until `deadline` or, with `expected`, its answer.
  std::optional<Bytes> listen(Deadline deadline, const Bytes* expected, std::size_t words);
  void take_stream(const Bytes& frame);
  void time_taken(double seconds);

  Transport& transport_;
  LinkOptions options_;
  FrameReader reader_;
  LinkCounts counts_;
  std::deque<StreamFrame> streamed_;
  std::optional<std::uint8_t> stream_counter_;
  std::uint8_t read_sequence_ = 0, write_sequence_ = 0;
  double mean_s_ = 0.05, deviation_s_ = 0.05;  ///< of the time that an answer takes
  int most_words_ = 64;                        ///< of a request: fewer while long frames are lost
  int undamaged_ = 0;                          ///< reads since the last repetition
  bool in_step_ = false;
};

}  // namespace feltgate::host
