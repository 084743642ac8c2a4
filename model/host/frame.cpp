// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Frames of the link. Documentation: docs/link.md
#include "host/frame.hpp"

#include <boost/crc.hpp>
#include <utility>

namespace feltgate::host {

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
