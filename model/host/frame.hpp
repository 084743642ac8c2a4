// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Frames of the link: SLIP around bytes that end with a CRC-32. Documentation: docs/link.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace feltgate::host {

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

}  // namespace feltgate::host
