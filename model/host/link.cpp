// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Requests and answers of the link. Documentation: docs/host.md, docs/link.md
#include "host/link.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <boost/crc.hpp>

#include "feltgate/generated/link.hpp"

namespace feltgate::host {

namespace {

using M = LinkMap;

constexpr std::size_t head_bytes = 4;
constexpr std::size_t most_streamed = 100'000;  ///< frames that wait for someone to take them
/// Longest and shortest wait for an answer before the request is repeated; a USB adapter may delay
/// bytes by up to 16 ms.
constexpr double longest_wait_s = 1.0, shortest_wait_s = 0.02;
constexpr double growth_of_wait = 8;  ///< largest growth of the wait, within one request
/// On a bad line short frames get through: smallest number of words in a read, and number of reads
/// without a repetition after which longer ones are tried again.
constexpr int fewest_words = 8, undamaged_reads = 32;
/// write_all() asks for an answer to one write in so many.
constexpr std::size_t answered_writes = 16;
constexpr double quiet_s = 0.02;  ///< garbage is read until nothing came for so long

int bits_of(unsigned mask) {
  int n = 0;
  for (; mask != 0; mask &= mask - 1) ++n;
  return n;
}

Bytes request(std::uint32_t kind, std::uint8_t sequence, int address, std::uint32_t word) {
  Bytes bytes{static_cast<std::uint8_t>(kind), sequence};
  put_le(bytes, static_cast<std::uint32_t>(address), 2);
  put_le(bytes, word, 4);
  return bytes;
}

/// Whether the frame is the answer to this request.
bool answers(const Bytes& frame, const Bytes& asked, std::size_t words) {
  return frame.size() == head_bytes + 4 * words && frame[0] == (asked[0] | M::kind_reply) &&
         std::equal(frame.begin() + 1, frame.begin() + head_bytes, asked.begin() + 1);
}

}  // namespace

Link::Link(Transport& transport, LinkOptions options) : transport_(transport), options_(options) {}

void Link::begin() {
  std::array<std::uint8_t, 4096> waste{};
  const Deadline end = within(0.5);
  while (HostClock::now() < end &&
         transport_.read(waste.data(), waste.size(), within(quiet_s)) > 0) {
  }
  const std::array<std::uint8_t, 2> ends{M::frame_end, M::frame_end};
  transport_.write(ends.data(), ends.size());
  in_step_ = true;
  // Continues the sequence of the last host: the first read must not look like a repetition either.
  const std::uint32_t last = read(M::A::last_write_sequence);
  write_sequence_ = static_cast<std::uint8_t>(last & 0xffu);
}

std::optional<Bytes> Link::listen(Deadline deadline, const Bytes* expected, std::size_t words) {
  std::array<std::uint8_t, 4096> buffer{};
  for (;;) {
    while (auto frame = reader_.next()) {
      if (expected != nullptr && answers(*frame, *expected, words)) return frame;
      if ((*frame)[0] == M::kind_stream) {
        take_stream(*frame);
      } else if (!posted_ || (*frame)[0] != (M::kind_write | M::kind_reply)) {
        ++counts_.stray;
      }
    }
    // Enough frames are here; reading what has arrived keeps the system's buffer from overflowing.
    if (expected == nullptr && !streamed_.empty()) deadline = HostClock::now();
    const std::size_t got = transport_.read(buffer.data(), buffer.size(), deadline);
    if (got == 0) return {};
    reader_.add(buffer.data(), got);
  }
}

void Link::take_stream(const Bytes& frame) {
  if (frame.size() < head_bytes) {
    ++counts_.stray;
    return;
  }
  StreamFrame s;
  s.mask = static_cast<std::uint16_t>(get_le(frame, 2, 2));
  if (frame.size() != head_bytes + 4 * static_cast<std::size_t>(bits_of(s.mask))) {
    ++counts_.stray;
    return;
  }
  for (std::size_t at = head_bytes; at < frame.size(); at += 4) {
    s.words.push_back(get_le(frame, at, 4));
  }
  if (stream_counter_) s.lost = static_cast<std::uint8_t>(frame[1] - *stream_counter_ - 1);
  stream_counter_ = frame[1];
  ++counts_.streamed;
  counts_.lost += s.lost;
  streamed_.push_back(std::move(s));
  if (streamed_.size() > most_streamed) {
    streamed_.pop_front();
    ++counts_.unread;
  }
}

/// Mean and deviation of the answer time, as in TCP, so that a slow board is not asked twice.
void Link::time_taken(double seconds) {
  deviation_s_ += 0.25 * (std::abs(seconds - mean_s_) - deviation_s_);
  mean_s_ += 0.125 * (seconds - mean_s_);
}

Bytes Link::ask(const Bytes& asked, std::size_t words) {
  if (!in_step_) begin();
  ++counts_.requests;
  const Bytes wire = framed(asked);
  const Deadline give_up = within(options_.patience_s);
  double wait_s = std::clamp(mean_s_ + 4 * deviation_s_, shortest_wait_s, longest_wait_s);
  const double most_s = std::min(growth_of_wait * wait_s, longest_wait_s);
  for (bool again = false;; again = true) {
    if (again) ++counts_.retries;
    const Deadline sent = HostClock::now();
    transport_.write(wire.data(), wire.size());
    ++frames_sent_;
    if (auto frame = listen(std::min(within(wait_s), give_up), &asked, words)) {
      const std::chrono::duration<double> taken = HostClock::now() - sent;
      if (!again) time_taken(taken.count());
      return *std::move(frame);
    }
    if (HostClock::now() >= give_up) {
      throw LinkLost(fmt::format(
          "{}: no answer for {:g} s; is the board on and configured, is this its port, and "
          "does --baud fit? {} bytes came, {} good frames",
          transport_.name(), options_.patience_s, reader_.counts().bytes, reader_.counts().good));
    }
    wait_s = std::min(2 * wait_s, most_s);
  }
}

std::vector<std::uint32_t> Link::read(int address, int count) {
  std::vector<std::uint32_t> all;
  while (count > 0) {
    const int words = std::min(count, most_words_);
    const std::uint64_t repeated = counts_.retries;
    const auto size = static_cast<std::size_t>(words);
    const Bytes frame = ask(
        request(M::kind_read, ++read_sequence_, address, static_cast<std::uint32_t>(words)), size);
    for (std::size_t n = 0; n < size; ++n) all.push_back(get_le(frame, head_bytes + 4 * n, 4));
    if (counts_.retries > repeated) {
      most_words_ = std::max(most_words_ / 2, fewest_words);
      undamaged_ = 0;
    } else if (++undamaged_ >= undamaged_reads) {
      most_words_ = std::min(2 * most_words_, static_cast<int>(M::read_words));
      undamaged_ = 0;
    }
    address += words;
    count -= words;
  }
  return all;
}

std::uint32_t Link::write(int address, std::uint32_t value) {
  if (!in_step_) begin();
  return get_le(ask(request(M::kind_write, ++write_sequence_, address, value), 1), head_bytes, 4);
}

void Link::write_all(const std::vector<HostWrite>& writes,
                     const std::function<void(double)>& progress) {
  if (!in_step_) begin();
  for (std::size_t n = 0; n < writes.size(); ++n) {
    const HostWrite& w = writes[n];
    if ((n + 1) % answered_writes == 0 || n + 1 == writes.size()) {
      write(w.address, w.value);
      progress(static_cast<double>(n + 1) / static_cast<double>(writes.size()));
      continue;
    }
    ++counts_.requests;
    const Bytes wire = framed(request(M::kind_write, ++write_sequence_, w.address, w.value));
    transport_.write(wire.data(), wire.size());
    ++frames_sent_;
  }
}

void Link::post(const std::vector<HostWrite>& writes) {
  if (!in_step_) begin();
  Bytes all;
  for (const HostWrite& w : writes) {
    const Bytes wire = framed(request(M::kind_write, ++write_sequence_, w.address, w.value));
    // Two frames share the byte between them.
    all.insert(all.end(), wire.begin() + (all.empty() ? 0 : 1), wire.end());
  }
  posted_ = true;
  counts_.requests += writes.size();
  frames_sent_ += writes.size();
  transport_.write(all.data(), all.size());
}

Link::Taken Link::taken() {
  const std::uint64_t before = frames_sent_;
  const std::uint32_t good = read(M::A::frames_good);
  Taken t;
  if (sent_then_) {
    // The read before was counted after its word was read, and so is this one.
    t.sent = static_cast<std::uint32_t>(before - *sent_then_);
    t.taken = (good - good_then_) & 0xffffU;
  }
  sent_then_ = before;
  good_then_ = good;
  return t;
}

std::optional<StreamFrame> Link::stream(Deadline deadline) {
  listen(deadline, nullptr, 0);
  if (streamed_.empty()) return {};
  StreamFrame s = std::move(streamed_.front());
  streamed_.pop_front();
  return s;
}

LinkCounts Link::counts() const {
  LinkCounts c = counts_;
  c.frames = reader_.counts();
  return c;
}

// Frames of the link.

namespace {

constexpr std::uint8_t slip_end = 0xc0, slip_escape = 0xdb, escaped_end = 0xdc,
                       escaped_escape = 0xdd;
constexpr std::size_t crc_bytes = 4;
/// A reply of 64 words with head and CRC.
constexpr std::size_t longest_frame = 4 + 64 * 4 + crc_bytes;

void put_escaped(Bytes& to, std::uint8_t byte) {
  if (byte == slip_end || byte == slip_escape) {
    to.push_back(slip_escape);
    to.push_back(byte == slip_end ? escaped_end : escaped_escape);
  } else {
    to.push_back(byte);
  }
}

}  // namespace

std::uint32_t frame_crc(const std::uint8_t* data, std::size_t size) {
  boost::crc_32_type crc;
  crc.process_bytes(data, size);
  return crc.checksum();
}

void put_le(Bytes& to, std::uint32_t value, int bytes) {
  for (int n = 0; n < bytes; ++n) to.push_back(static_cast<std::uint8_t>(value >> (8 * n) & 0xffu));
}

std::uint32_t get_le(const Bytes& from, std::size_t at, int bytes) {
  std::uint32_t value = 0;
  for (int n = bytes - 1; n >= 0; --n) value = value << 8 | from[at + static_cast<std::size_t>(n)];
  return value;
}

Bytes framed(const Bytes& payload) {
  Bytes wire{slip_end};
  for (const std::uint8_t byte : payload) put_escaped(wire, byte);
  Bytes crc;
  put_le(crc, frame_crc(payload.data(), payload.size()), crc_bytes);
  for (const std::uint8_t byte : crc) put_escaped(wire, byte);
  wire.push_back(slip_end);
  return wire;
}

void FrameReader::end_frame() {
  const bool was_long = std::exchange(long_, false);
  const bool was_spoilt = std::exchange(spoilt_, false) || std::exchange(escaped_, false);
  Bytes frame = std::exchange(frame_, {});
  if (was_long) {
    ++counts_.too_long;
  } else if (was_spoilt) {
    ++counts_.bad_slip;
  } else if (!frame.empty()) {
    const std::size_t size = frame.size() < crc_bytes ? 0 : frame.size() - crc_bytes;
    if (size == 0 || frame_crc(frame.data(), size) != get_le(frame, size, crc_bytes)) {
      ++counts_.bad_crc;
      return;
    }
    frame.resize(size);
    ++counts_.good;
    ready_.push_back(std::move(frame));
  }
}

void FrameReader::add(const std::uint8_t* data, std::size_t size) {
  counts_.bytes += size;
  for (std::size_t n = 0; n < size; ++n) {
    std::uint8_t byte = data[n];
    if (byte == slip_end) {
      end_frame();
      continue;
    }
    if (escaped_) {
      escaped_ = false;
      spoilt_ = spoilt_ || (byte != escaped_end && byte != escaped_escape);
      byte = byte == escaped_end ? slip_end : slip_escape;
    } else if (byte == slip_escape) {
      escaped_ = true;
      continue;
    }
    if (frame_.size() == longest_frame) {
      long_ = true;
    } else {
      frame_.push_back(byte);
    }
  }
}

std::optional<Bytes> FrameReader::next() {
  if (ready_.empty()) return {};
  Bytes frame = std::move(ready_.front());
  ready_.pop_front();
  return frame;
}

}  // namespace feltgate::host
