// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random frames: requests of a host, and invalid bytes as from a bad wire or another device. A
// separate reader, written only from docs/link.md, tells which frames are requests. Documentation:
// docs/testing.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "feltgate/crc32.hpp"
#include "random.hpp"

namespace feltgate::test {

using Bytes = std::vector<std::uint8_t>;

inline void add_number(Bytes& bytes, std::uint32_t number, int size) {
  for (int k = 0; k < size; ++k) bytes.push_back(static_cast<std::uint8_t>(number >> 8 * k));
}

/// Returns a body in the form sent over the wire.
inline Bytes framed(Bytes body) {
  add_number(body, crc32(body.data(), body.size()), 4);
  Bytes wire{0xc0};
  for (const std::uint8_t byte : body) {
    if (byte == 0xc0 || byte == 0xdb) wire.push_back(0xdb);
    wire.push_back(byte == 0xc0 ? 0xdc : byte == 0xdb ? 0xdd : byte);
  }
  wire.push_back(0xc0);
  return wire;
}

/// Returns the bytes between two ENDs without escapes: the body and its CRC.
inline Bytes unescaped(const Bytes& frame) {
  Bytes body;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const bool escaped = frame[k] == 0xdb && k + 1 < frame.size();
    if (escaped) ++k;
    body.push_back(!escaped ? frame[k] : frame[k] == 0xdc ? 0xc0 : 0xdb);
  }
  return body;
}

/// Returns the words of a body after its head of four bytes, without the CRC.
inline std::vector<std::uint32_t> body_words(const Bytes& body) {
  std::vector<std::uint32_t> words;
  for (std::size_t at = 4; at + 8 <= body.size(); at += 4) {
    std::uint32_t word = 0;
    for (std::size_t b = 4; b-- > 0;) word = word << 8 | body[at + b];
    words.push_back(word);
  }
  return words;
}

inline Bytes request(int kind, int sequence, std::uint32_t address, std::uint32_t value) {
  Bytes body{static_cast<std::uint8_t>(kind), static_cast<std::uint8_t>(sequence)};
  add_number(body, address, 2);
  add_number(body, value, 4);
  return framed(body);
}

/// Reads frames from the wire, byte by byte.
struct WireReader {
  bool engine = false;  ///< the board has an engine, by its features word
  struct Frame {
    bool good = false;
    int kind = 0, sequence = 0;
    std::uint32_t address = 0, value = 0;
  };
  Bytes raw;
  std::int64_t good = 0, bad = 0;

  /// Takes a byte. Returns true at the end of a frame; the frame is then in `last`.
  bool take(std::uint8_t byte) {
    if (byte != 0xc0) {
      raw.push_back(byte);
      return false;
    }
    if (raw.empty()) return false;
    last = read();
    raw.clear();
    ++(last.good ? good : bad);
    return true;
  }
  Frame last;

 private:
  static std::uint32_t number(const Bytes& b, std::size_t at, std::size_t size) {
    std::uint32_t n = 0;
    for (std::size_t k = size; k-- > 0;) n = n << 8 | b[at + k];
    return n;
  }
  Frame read() const {
    Bytes body;
    for (std::size_t k = 0; k < raw.size(); ++k) {
      if (raw[k] != 0xdb) {
        body.push_back(raw[k]);
        continue;
      }
      if (++k == raw.size() || (raw[k] != 0xdc && raw[k] != 0xdd)) return {};
      body.push_back(raw[k] == 0xdc ? 0xc0 : 0xdb);
    }
    if (body.size() != 12 || number(body, 8, 4) != crc32(body.data(), 8)) return {};
    Frame f{true, body[0], body[1], number(body, 2, 2), number(body, 4, 4)};
    const bool read = f.kind == 1 && f.value >= 1 && f.value <= 64;
    const std::uint32_t last_address = f.address + (read ? f.value - 1 : 0);
    const bool of_engine = engine && f.address >= 0x4000;
    f.good = (read || f.kind == 2) && last_address < (of_engine ? 0x8000 : 0x4000);
    return f;
  }
};

/// Makes random requests and invalid frames.
struct RandomFrames {
  explicit RandomFrames(Random r, bool may_stream = true) : random(r), streams(may_stream) {}

  Random random;
  int sequence = 0;

  bool streams = true;  ///< requests may start a stream

  std::uint32_t address() {
    const std::uint32_t any = any_address();
    return any == 0x1011 && !streams ? any + 1 : any;
  }
  std::uint32_t any_address() {
    static constexpr std::uint32_t at[] = {0x1000, 0x1006, 0x1010, 0x1028, 0x2000,
                                           0x3fff, 0x300,  0x0,    0x200,  0xffe};
    if (random.one_in(3)) return at[random.below(10)] + random.below(3);
    return random.one_in(6) ? random.below(0x10000) : random.below(0x400);
  }
  Bytes good_request() {
    if (random.one_in(5)) return request(2, sequence, address(), value());  // the same sequence
    sequence = static_cast<int>(random.below(256));
    if (random.coin()) return request(2, sequence, address(), value());
    const std::uint32_t words = random.one_in(4) ? random.below(70) : 1 + random.below(3);
    return request(1, sequence, address(), words);
  }
  std::uint32_t value() {
    static constexpr std::uint8_t bytes[] = {0xc0, 0xdb, 0xdc, 0xdd, 0x00, 0xff};
    std::uint32_t v = 0;
    for (int k = 0; k < 4; ++k) {
      v = v << 8 | (random.coin() ? bytes[random.below(6)] : random.below(256));
    }
    return random.one_in(3) ? random.below(64) : v;
  }
  Bytes any() {
    if (random.one_in(12)) {  // valid except for kind, length or count
      Bytes body;
      const std::uint32_t size = random.one_in(2) ? 8 : random.below(20);
      for (std::uint32_t k = 0; k < size; ++k) {
        body.push_back(static_cast<std::uint8_t>(random.below(k == 0 ? 5 : 256)));
      }
      return framed(body);
    }
    if (random.one_in(12)) {  // garbage
      Bytes garbage(random.below(30));
      for (auto& byte : garbage) {
        byte = static_cast<std::uint8_t>(random.one_in(6) ? 0xc0 + 27 * random.below(2)
                                                          : random.below(256));
      }
      return garbage;
    }
    Bytes wire = good_request();
    const auto at = [&] { return static_cast<std::ptrdiff_t>(random.below(wire.size())); };
    switch (random.below(8)) {
      case 0:  // one bit is flipped
        wire[static_cast<std::size_t>(at())] ^= static_cast<std::uint8_t>(1U << random.below(8));
        break;
      case 1:  // a byte is lost
        wire.erase(wire.begin() + at());
        break;
      case 2:  // the frame is cut
        wire.resize(static_cast<std::size_t>(at()));
        break;
      case 3:  // one extra byte
        wire.insert(wire.begin() + at(), static_cast<std::uint8_t>(random.below(256)));
        break;
      default:
        break;
    }
    return wire;
  }
};

}  // namespace feltgate::test
