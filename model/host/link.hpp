// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Words of a board over its link: read, write, stream. Lost requests are repeated; a write is
// executed only once. Documentation: docs/host.md, docs/link.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/transport.hpp"

namespace feltgate::host {

// Frames of the link: SLIP around bytes that end with a CRC-32.

using Bytes = std::vector<std::uint8_t>;

/// CRC-32 as in zlib: IEEE 802.3, reflected, start value and final XOR 0xffffffff.
std::uint32_t frame_crc(const std::uint8_t* data, std::size_t size);

/// Appends the low `bytes` bytes of `value`, low byte first.
void put_le(Bytes& to, std::uint32_t value, int bytes);
/// Reads `bytes` bytes, 1 to 4, from index `at` on; low byte first.
std::uint32_t get_le(const Bytes& from, std::size_t at, int bytes);

/// A payload as sent on the line: END, then payload and CRC with escapes, then END.
Bytes framed(const Bytes& payload);

/// Statistics of the bytes that a FrameReader received.
struct FrameCounts {
  std::uint64_t bytes = 0;
  std::uint64_t good = 0;      ///< good frames returned
  std::uint64_t bad_crc = 0;   ///< frames with a wrong CRC, or shorter than a CRC
  std::uint64_t bad_slip = 0;  ///< frames with an invalid escape
  std::uint64_t too_long = 0;  ///< frames longer than any reply
};

/// Extracts the payloads of good frames, without their CRC, from a stream of bytes. After garbage
/// it synchronises at the next END.
class FrameReader {
 public:
  void add(const std::uint8_t* data, std::size_t size);
  /// The oldest good frame that was not taken yet.
  std::optional<Bytes> next();
  const FrameCounts& counts() const { return counts_; }

 private:
  void end_frame();

  Bytes frame_;
  std::deque<Bytes> ready_;
  bool escaped_ = false, spoilt_ = false, long_ = false;
  FrameCounts counts_;
};

/// A frame of the stream: words of one tick.
struct StreamFrame {
  std::uint16_t mask = 0;            ///< bit k: the k-th word of the snapshot, in order of its slot
  std::vector<std::uint32_t> words;  ///< words in the mask, lowest bit first
  unsigned lost = 0;                 ///< frames missing since the frame before
};

/// A word to write at an address.
struct HostWrite {
  int address = 0;
  std::uint32_t value = 0;
};

/// Statistics of the link since it was opened.
struct LinkCounts {
  std::uint64_t requests = 0;  ///< reads and writes that were asked for
  std::uint64_t retries = 0;   ///< requests that were sent again
  std::uint64_t stray = 0;     ///< good frames that answered no present request
  std::uint64_t streamed = 0;  ///< frames of the stream that came
  std::uint64_t lost = 0;      ///< frames of the stream that are missing, by their counter
  std::uint64_t unread = 0;    ///< frames of the stream that were not taken in time
  FrameCounts frames;
};

/// Options of a link.
struct LinkOptions {
  double patience_s = 3.0;  ///< time for which a request is repeated before the link counts as lost
};

/// The requests of one host on one transport, one at a time. Not for several threads.
class Link {
 public:
  /// `transport` must outlive this object. Nothing is sent before begin() or the first request.
  explicit Link(Transport& transport, LinkOptions options = {});

  /// Synchronises with a board in any state: drops what has arrived, ends a frame that another host
  /// left incomplete, and reads the sequence of the last write. Errors: LinkLost if the board does
  /// not answer; the text says what to check.
  void begin();

  /// Reads `count` words (at least 1) from a word address on. More than 64, or fewer on a bad line,
  /// become several requests. Errors: LinkLost after patience_s without an answer.
  std::vector<std::uint32_t> read(int address, int count);
  std::uint32_t read(int address) { return read(address, 1).front(); }
  /// Writes a word; it is written exactly once even if frames are lost. Returns the core's status
  /// in a tick after the write took effect. Errors: LinkLost, as for read().
  std::uint32_t write(int address, std::uint32_t value);

  /// Writes words as fast as the line allows, without an answer to each. On a bad line some do not
  /// arrive, so the caller must read them back. `progress` is called with 0..1. Errors: LinkLost.
  void write_all(const std::vector<HostWrite>& writes, const std::function<void(double)>& progress);

  /// Writes words at the full rate of the line and waits for none of their answers. What does not
  /// arrive is not repeated; taken() tells how much that was. Errors: LinkLost.
  void post(const std::vector<HostWrite>& writes);
  /// Frames that the board has taken since the last call, modulo 2^16, and how many this host has
  /// sent since then; the first call gives {0, 0}. Neither counts what this call itself sends.
  struct Taken {
    std::uint32_t sent = 0, taken = 0;
  };
  Taken taken();

  /// The oldest frame of the stream that was not taken yet; waits for one until `deadline`.
  std::optional<StreamFrame> stream(Deadline deadline);

  LinkCounts counts() const;
  const std::string& name() const { return transport_.name(); }

 private:
  Bytes ask(const Bytes& request, std::size_t words);
  /// Reads frames until `deadline` or until the answer to `expected` comes.
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
  double mean_s_ = 0.05, deviation_s_ = 0.05;  ///< of the time until an answer
  /// Words per request; fewer while long frames are lost.
  int most_words_ = 64;
  std::uint64_t frames_sent_ = 0;           ///< requests, also repeated ones
  std::optional<std::uint64_t> sent_then_;  ///< at the last call of taken()
  std::uint32_t good_then_ = 0;
  bool posted_ = false;  ///< answers to posted writes may come
  int undamaged_ = 0;    ///< reads since the last repetition
  bool in_step_ = false;
};

}  // namespace feltgate::host
