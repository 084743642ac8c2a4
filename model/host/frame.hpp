// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Frames of the link: SLIP around bytes with a CRC-32 at their end. Documentation: docs/link.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace feltgate::host {

using Bytes = std::vector<std::uint8_t>;

/// CRC-32 as zlib's: IEEE 802.3, reflected, 0xffffffff in and out.
std::uint32_t frame_crc(const std::uint8_t* data, std::size_t size);

/// Low byte first.
void put_le(Bytes& to, std::uint32_t value, int bytes);
/// `bytes` of them, 1 to 4, from `at` on.
std::uint32_t get_le(const Bytes& from, std::size_t at, int bytes);

/// A payload as it goes over the wire: END, the payload and its CRC with escapes, END.
Bytes framed(const Bytes& payload);

/// What became of the bytes that a FrameReader was given.
struct FrameCounts {
  std::uint64_t bytes = 0;
  std::uint64_t good = 0;      ///< frames handed out
  std::uint64_t bad_crc = 0;   ///< frames whose CRC does not fit, or shorter than a CRC
  std::uint64_t bad_slip = 0;  ///< frames with an escape of nothing
  std::uint64_t too_long = 0;  ///< frames beyond what any reply has
};

/// Bytes in as they come, payloads of good frames out, without their CRC. After garbage it is in
/// step again at the next END.
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
