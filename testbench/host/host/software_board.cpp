// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The board's side of the link, written only from docs/link.md. Documentation:
// docs/link.md
#include "software_board.hpp"

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cmath>

#include "feltgate/generated/lever.hpp"
#include "feltgate/while_armed.hpp"

namespace feltgate::test {

namespace {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::uint32_t crc_of(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t crc = 0xffffffff;
  for (std::size_t n = 0; n < size; ++n) {
    crc ^= bytes[n];
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
  }
  return ~crc;
}

std::uint32_t number(const std::vector<std::uint8_t>& bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int n = 0; n < size; ++n) {
    value |= static_cast<std::uint32_t>(bytes[at + static_cast<std::size_t>(n)]) << 8 * n;
  }
  return value;
}

void append(std::vector<std::uint8_t>& bytes, std::uint32_t value, int size) {
  for (int n = 0; n < size; ++n) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * n));
}

bool chance(SplitMix64& random, double share) { return share > 0 && random.uniform() < share; }

constexpr double count_rad = Lever::count_rad, swing = 300, pi = 3.14159265358979323846;
constexpr int slots[] = {0, 1, 6, 9, 11, 14, 23, 26, 28, 34, 40, 46};

std::uint32_t fixed(double value, int fraction) {
  return static_cast<std::uint32_t>(std::llround(std::ldexp(value, fraction)));
}

}  // namespace

SoftwareBoard::SoftwareBoard(int descriptor, Noise noise, std::uint64_t seed)
    : descriptor_(descriptor), noise_(noise), random_(seed), start_ns_(now_ns()) {
  for (const ParameterInfo& p : Lever::parameters) {
    memory_[p.address] = static_cast<std::uint32_t>(p.raw);
  }
  memory_[0x1000] = 0x46454c54;
  memory_[0x1001] = 0x00010000;
  memory_[0x1002] = Lever::design_crc;
  memory_[0x1003] = 50'000'000;
  memory_[0x1004] = 50;
  memory_[0x1005] = 1 | 2 | 4 | 10 << 8 | 8 << 16;
  memory_[0x100a] = 1;
  memory_[0x1024] = 1;
  thread_ = std::thread([this] { run(); });
}

SoftwareBoard::~SoftwareBoard() {
  ends_ = true;
  thread_.join();
  if (descriptor_ >= 0) ::close(descriptor_);
}

void SoftwareBoard::unplug() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ::close(descriptor_);
  descriptor_ = -1;
}

void SoftwareBoard::set_fault(int number) {
  const std::lock_guard<std::mutex> lock(mutex_);
  faults_ |= 1u << number;
  if (first_fault_ == 0) first_fault_ = static_cast<unsigned>(number);
  armed_ = false;
}

void SoftwareBoard::set_design_crc(std::uint32_t crc) {
  const std::lock_guard<std::mutex> lock(mutex_);
  memory_[0x1002] = crc;
}

std::vector<std::pair<int, std::uint32_t>> SoftwareBoard::writes() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return writes_;
}

std::uint32_t SoftwareBoard::word(int address) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return read(address);
}

std::uint32_t SoftwareBoard::frames_bad() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return bad_;
}

bool SoftwareBoard::armed() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return armed_;
}

std::uint64_t SoftwareBoard::kicks() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return kicks_;
}

std::uint32_t SoftwareBoard::now() const {
  return static_cast<std::uint32_t>((now_ns() - start_ns_) / 1000);
}

std::uint32_t SoftwareBoard::status() {
  const std::uint32_t control = memory_[0x200];
  return (armed_ ? 1u << 24 : 1u << 7) | (control >> 2 & 15u) << 20 | (refused_ ? 1u << 28 : 0) |
         (control >> 6 & 3u) << 25;
}

std::uint32_t SoftwareBoard::snapshot(int word, std::uint32_t tick) {
  const double t = tick * 1e-6;
  const double counts = swing * std::sin(2 * pi * t);
  const double rad_s = swing * count_rad * 2 * pi * std::cos(2 * pi * t);
  switch (word) {
    case 0:
      return status();
    case 1:
      return static_cast<std::uint32_t>(std::llround(counts) - zero_);
    case 2:
      return tick;
    case 3:
      return fixed(rad_s, Lever::f.velocity.fraction);
    case 6:
      return fixed(0.01 * rad_s, Lever::f.torque.fraction);
    case 7:
      return faults_ | first_fault_ << 16;
    case 8:
      return fixed(armed_ ? -0.001 * counts : 0, Lever::f.torque.fraction);
    case 9:
      return fixed(armed_ ? -0.03 * counts : 0, Lever::f.current.fraction);
    case 10:
      return fixed(armed_ ? -0.02 * counts : 0, Lever::f.voltage.fraction);
    case 11:
      return fixed(armed_ ? -counts : 0, 0);
    default:
      return 0;
  }
}

std::uint32_t SoftwareBoard::read(int address) {
  if (address >= 0x2000) {
    const int row = (address - 0x2000) / 8;
    int column = address & 7;
    for (int k = 0; k < words; ++k) {
      if ((memory_[0x1022] >> k & 1) == 0 || column-- > 0) continue;
      // The ring has wrapped: its oldest row is at capture_first.
      const auto nth = static_cast<std::uint32_t>((row - 700 + rows) % rows);
      return snapshot(k, capture_trigger_ + (nth - memory_[0x1023]) * memory_[0x1024]);
    }
    return 0;
  }
  for (int k = 0; k < words; ++k) {
    if (address == 0x300 + slots[k]) return snapshot(k, frozen_ ? frozen_tick_ : now());
  }
  switch (address) {
    case 0x1006:
      return good_;
    case 0x1007:
      return bad_;
    case 0x1008:
      return last_sequence_;
    case 0x1021:
      return static_cast<std::uint32_t>(capture_state_);
    case 0x1028:
      return 700;
    case 0x1029:
      return capture_state_ == 4 ? rows : 0;
    case 0x201:
      return 0;
    default:
      return memory_.count(address) != 0 ? memory_[address] : 0;
  }
}

void SoftwareBoard::write(int address, std::uint32_t value) {
  writes_.emplace_back(address, value);
  if (address < 0x200) {
    refused_ = armed_ && while_armed(address, static_cast<int>(memory_[0x200] >> 2 & 15)) ==
                             WhileArmed::refused;
    if (!refused_) memory_[address] = value;
  } else if (address == 0x200) {
    const bool asked = (value & 3) == 3, before = (memory_[0x200] & 3) == 3;
    armed_ = asked && (armed_ || !before) && faults_ == 0;
    memory_[0x200] = value & 0x7fff;
  } else if (address == 0x201) {
    if ((value & 1) != 0) zero_ = std::llround(swing * std::sin(2 * pi * now() * 1e-6));
    if ((value & 2) != 0 && (memory_[0x200] & 2) == 0) faults_ = first_fault_ = 0;
    if ((value & 4) != 0) ++kicks_;
    if ((value & 8) != 0 && !frozen_) {
      frozen_ = true;
      frozen_tick_ = now();
    }
    if ((value & 16) != 0) frozen_ = false;
    if ((value & 32) != 0) {
      faults_ |= 1u << 6;
      first_fault_ = first_fault_ == 0 ? 6 : first_fault_;
      armed_ = false;
    }
  } else if (address == 0x1011) {
    memory_[address] = value;
    next_frame_ = now() + value;
  } else if (address == 0x1020) {
    if ((value & 2) != 0) capture_state_ = 0;
    if ((value & 1) != 0) {
      capture_state_ = 1;
      capture_start_ = now();
    }
    if ((value & 4) != 0 && capture_state_ == 2) {
      capture_trigger_ = now();
      capture_state_ = 3;
    }
  } else if (address < 0x1030) {
    memory_[address] = value;
  }
}

void SoftwareBoard::follow_capture() {
  const std::uint32_t period = memory_[0x1024], before = memory_[0x1023];
  if (capture_state_ == 1 && now() - capture_start_ >= before * period) {
    capture_state_ = 2;
    looked_ = now();
  }
  const auto word = static_cast<int>(memory_[0x1025]);
  while (capture_state_ == 2 && looked_ != now()) {
    const std::uint32_t was = snapshot(word, looked_), is = snapshot(word, looked_ + 1);
    const auto level = static_cast<std::int32_t>(memory_[0x1027]);
    const auto a = static_cast<std::int32_t>(was), b = static_cast<std::int32_t>(is);
    const std::uint32_t mode = memory_[0x1026];
    const bool hit = (mode == 1 && a < level && b >= level) ||
                     (mode == 2 && a >= level && b < level) ||
                     (mode == 3 && (is & memory_[0x1027]) != 0);
    ++looked_;
    if (!hit) continue;
    capture_trigger_ = looked_;
    capture_state_ = 3;
  }
  if (capture_state_ == 3 && now() - capture_trigger_ >= (rows - before) * period) {
    capture_state_ = 4;
  }
}

void SoftwareBoard::take(const Bytes& f) {
  if (f.empty()) return;
  const bool whole = f.size() == 12 && crc_of(f.data(), 8) == number(f, 8, 4) && !spoilt_;
  const std::uint32_t address = whole ? number(f, 2, 2) : 0, word = whole ? number(f, 4, 4) : 0;
  const bool reads = whole && f[0] == 1 && word >= 1 && word <= 64;
  const bool writes = whole && f[0] == 2;
  if (address >= 0x4000 || !(reads || writes)) {
    ++bad_;
    return;
  }
  ++good_;
  Bytes reply{static_cast<std::uint8_t>(f[0] | 0x80), f[1], f[2], f[3]};
  if (writes) {
    if (last_sequence_ != f[1]) write(static_cast<int>(address), word);
    last_sequence_ = f[1];
    append(reply, status(), 4);
  } else {
    for (std::uint32_t n = 0; n < word; ++n) append(reply, read(static_cast<int>(address + n)), 4);
  }
  if (noise_.delay_s > 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(noise_.delay_s));
  }
  if (chance(random_, noise_.other)) {
    Bytes other = reply;
    other[2 + (random_.bits() & 1)] ^= 1;
    other.back() ^= 0xff;
    send(other);
  }
  send(reply);
}

void SoftwareBoard::receive(std::uint8_t byte) {
  if (chance(random_, noise_.drop)) return;
  if (chance(random_, noise_.flip)) byte ^= static_cast<std::uint8_t>(1u << (random_.bits() & 7));
  if (byte == 0xc0) {
    const Bytes frame = std::move(frame_);
    frame_.clear();
    spoilt_ = spoilt_ || in_escape_;
    take(frame);
    spoilt_ = in_escape_ = false;
  } else if (in_escape_) {
    in_escape_ = false;
    spoilt_ = spoilt_ || (byte != 0xdc && byte != 0xdd);
    frame_.push_back(byte == 0xdc ? 0xc0 : 0xdb);
  } else if (byte == 0xdb) {
    in_escape_ = true;
  } else if (frame_.size() < 64) {
    frame_.push_back(byte);
  }
}

void SoftwareBoard::send(const Bytes& payload) {
  if (silent_ || descriptor_ < 0) return;
  Bytes all = payload;
  append(all, crc_of(payload.data(), payload.size()), 4);
  Bytes wire;
  if (chance(random_, noise_.junk)) {
    for (int n = 0; n < 7; ++n) wire.push_back(static_cast<std::uint8_t>(random_.bits()));
  }
  wire.push_back(0xc0);
  for (const std::uint8_t byte : all) {
    if (byte == 0xc0 || byte == 0xdb) wire.push_back(0xdb);
    wire.push_back(byte == 0xc0 ? 0xdc : byte == 0xdb ? 0xdd : byte);
  }
  wire.push_back(0xc0);
  if (chance(random_, noise_.halve)) wire.resize(wire.size() / 2);
  Bytes sent;
  for (std::uint8_t byte : wire) {
    if (chance(random_, noise_.drop)) continue;
    if (chance(random_, noise_.flip)) byte ^= static_cast<std::uint8_t>(1u << (random_.bits() & 7));
    sent.push_back(byte);
  }
  std::size_t done = 0;
  while (done < sent.size()) {
    const ssize_t n = ::write(descriptor_, sent.data() + done, sent.size() - done);
    if (n <= 0) return;  // no reader: these bytes are lost, as on a wire
    done += static_cast<std::size_t>(n);
  }
}

void SoftwareBoard::send_stream() {
  const std::uint32_t period = memory_[0x1011];
  if (period == 0 || static_cast<std::int32_t>(now() - next_frame_) < 0) return;
  // A wire needs half a millisecond per frame; frames that are too late are dropped.
  const std::uint32_t late = (now() - next_frame_) / period;
  frame_counter_ = static_cast<std::uint8_t>(frame_counter_ + late);
  memory_[0x1012] += late;
  next_frame_ += late * period;
  const std::uint32_t mask = (memory_[0x1010] | 4) & 0xfff;
  Bytes frame{0x40, frame_counter_++, static_cast<std::uint8_t>(mask),
              static_cast<std::uint8_t>(mask >> 8)};
  for (int k = 0; k < words; ++k) {
    if ((mask >> k & 1) != 0) append(frame, snapshot(k, next_frame_), 4);
  }
  next_frame_ += period;
  send(frame);
}

void SoftwareBoard::run() {
  while (!ends_) {
    int descriptor = -1;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      descriptor = descriptor_;
    }
    if (descriptor < 0) return;
    pollfd waits{descriptor, POLLIN, 0};
    (void)::poll(&waits, 1, 1);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (descriptor_ < 0) return;
    if ((waits.revents & POLLIN) != 0) {
      std::uint8_t buffer[512];
      const ssize_t got = ::read(descriptor_, buffer, sizeof buffer);
      for (ssize_t n = 0; n < got; ++n) receive(buffer[n]);
    } else if ((waits.revents & (POLLHUP | POLLERR)) != 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // the other end is not open
    }
    follow_capture();
    send_stream();
  }
}

}  // namespace feltgate::test
