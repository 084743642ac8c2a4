// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board's netlist beside its RTL, every pin in both halves of every clock: keys, switches, a
// lever that is turned, stops, an encoder that is pulled out, and a host. The PLL is a wire in
// both. Panel times are short ones: testbench/boards/CMakeLists.txt. The board is the ULX3S,
// or with FELTGATE_TANG_NANO_9K that. Documentation: docs/boards/ulx3s.md,
// docs/boards/tang_nano_9k.md
#include <Vpair.h>

#include <cstdint>
#include <cstring>
#include <deque>
#include <iostream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "feltgate/crc32.hpp"
#include "mismatch.hpp"
#include "pair_fields.hpp"
#include "random.hpp"

namespace {

constexpr std::int64_t kBaud = 3'000'000;  // as the netlist is built
// The clock, the pins' names, what the pins are while nothing is pressed, on or lit, and pictures
// of lamps that are seen at least.
#ifdef FELTGATE_TANG_NANO_9K
constexpr std::int64_t kClockHz = 54'000'000;
constexpr const char *kKey = "key_n", *kSwitches = "sw_n", *kLamps = "led_n";
constexpr const char *kFromHost = "uart_rx", *kToHost = "uart_tx";
constexpr std::uint64_t kReleased = 1, kOff = 15, kDark = 63;
constexpr std::size_t kPictures = 12;
#else
constexpr std::int64_t kClockHz = 50'000'000;
constexpr const char *kKey = "btn", *kSwitches = "sw", *kLamps = "led";
constexpr const char *kFromHost = "ftdi_txd", *kToHost = "ftdi_rxd";
constexpr std::uint64_t kReleased = 0, kOff = 0, kDark = 0;
constexpr std::size_t kPictures = 30;
#endif

static_assert(kInputBits <= 64 && kOutputBits <= 64, "pins are one integer in Verilator's class");

template <int N>
const Field& named(const Field (&fields)[N], const char* name) {
  for (const Field& f : fields) {
    if (std::strcmp(f.name, name) == 0) return f;
  }
  throw std::runtime_error(name);
}

class Board {
 public:
  explicit Board(std::uint64_t seed) : random_(seed) {
#ifdef FELTGATE_TANG_NANO_9K
    put("reset_n", 1);
#endif
    put(kKey, kReleased);
    put("estop", 0);
    put("enc_loop", 0);
    put(kSwitches, 7 ^ kOff);
    put(kFromHost, 1);
    // Before the first edge Verilator has registers at 0 that an FPGA configures to their reset.
    for (int k = 0; k < 8; ++k) half(k % 2 != 0);
  }

  void put(const char* name, std::uint64_t value) {
    const Field& f = named(kInputs, name);
    const std::uint64_t mask = ((std::uint64_t{1} << f.width) - 1) << f.first;
    pins_ = (pins_ & ~mask) | ((value << f.first) & mask);
  }

  std::uint64_t pin(const char* name) const {
    const Field& f = named(kFields, name);
    return (static_cast<std::uint64_t>(pair_->rtl_o) >> f.first) &
           ((std::uint64_t{1} << f.width) - 1);
  }

  /// Half a clock; the name of the first pin that differs, or "".
  std::string half(bool clock) {
    pair_->clk = clock;
    pair_->in_i = static_cast<std::decay_t<decltype(pair_->in_i)>>(pins_);
    pair_->eval();
    for (const Field& f : kFields) {
      for (int n = f.first; n < f.first + f.width; ++n) {
        if ((pair_->rtl_o >> n & 1U) != (pair_->netlist_o >> n & 1U)) return f.name;
      }
    }
    return "";
  }

  /// What hands do in this clock.
  void act(std::int64_t clock) {
    if (clock % 400 == 0) turn();
    if (clock == key_due_) {
      key_down_ = !key_down_;
      put(kKey, (key_down_ ? 1 : 0) ^ kReleased);
      const bool is_long = random_.below(4) == 0;
      key_due_ = clock + (key_down_ ? (is_long ? 300 : 60) : 2000 + random_.below(40'000));
    }
    if (clock == switch_due_) {
      put(kSwitches, static_cast<std::uint64_t>(random_.below(16)) ^ kOff);
      switch_due_ = clock + 20'000 + random_.below(20'000);
    }
    talk(clock);
    if (clock == event_due_) {
      put(random_.coin() ? "estop" : "enc_loop", event_ ? 0 : 1);
      if (event_) put("estop", 0), put("enc_loop", 0);
      event_ = !event_;
      event_due_ = clock + (event_ ? 30 : 60'000 + random_.below(30'000));
    }
  }

 private:
  /// A host at kBaud: reads of the link and the core, words written whole, commands, now and then a
  /// frame with a wrong byte.
  void talk(std::int64_t clock) {
    if (bits_.empty() && clock >= talk_due_) {
      const auto byte = [&] { return static_cast<std::uint8_t>(random_.below(256)); };
      std::vector<std::uint8_t> body;
      const auto sequence = byte();
      if (random_.below(3) != 0) {
        const unsigned address = std::vector<unsigned>{
            0x1000, 0x1006, 0x1008, 0x300, 0x010, 0x061, 0x061, 0x1027}[random_.below(8)];
        const auto high = static_cast<std::uint8_t>(address >> 8);
        body = {1, sequence, static_cast<std::uint8_t>(address), high, 2, 0, 0, 0};
      } else if (random_.below(2) != 0) {
        // A whole word, which is read above: a face of the membrane, or the level of the trigger.
        const bool face = random_.below(2) != 0;
        const auto low = static_cast<std::uint8_t>(face ? 0x61 : 0x27);
        const auto high = static_cast<std::uint8_t>(face ? 0x00 : 0x10);
        body = {2, sequence, low, high, byte(), byte(), byte(), byte()};
      } else {
        // A command: set_zero, clear_faults or kick.
        body = {2, sequence, 0x01, 0x02, static_cast<std::uint8_t>(1u << random_.below(3)),
                0, 0,        0};
      }
      const std::uint32_t crc = feltgate::crc32(body.data(), body.size());
      for (int k = 0; k < 32; k += 8) body.push_back(static_cast<std::uint8_t>(crc >> k));
      if (random_.below(6) == 0) body[random_.below(body.size())] ^= byte();
      send(0xc0);
      for (const std::uint8_t b : body) {
        if (b == 0xc0 || b == 0xdb) {
          send(0xdb);
          send(b == 0xc0 ? 0xdc : 0xdd);
        } else {
          send(b);
        }
      }
      send(0xc0);
      talk_due_ = clock + 8'000 + random_.below(8'000);
      began_ = clock;
    }
    if (bits_.empty()) return;
    put(kFromHost, bits_.front() ? 1 : 0);
    const std::int64_t since = clock - began_;
    if ((since + 1) * kBaud / kClockHz != since * kBaud / kClockHz) bits_.pop_front();
  }

  void send(std::uint8_t byte) {
    bits_.push_back(false);
    for (int k = 0; k < 8; ++k) bits_.push_back((byte >> k & 1) != 0);
    bits_.push_back(true);
  }

  void turn() {
    if (random_.below(40) == 0) up_ = !up_;
    count_ += up_ ? 1 : 3;
    const unsigned phase = count_ % 4;
    put("enc_a", phase == 1 || phase == 2);
    put("enc_b", phase >= 2);
    put("enc_z", count_ % 4096 == 0);
  }

  std::unique_ptr<Vpair> pair_ = std::make_unique<Vpair>();
  feltgate::test::Random random_;
  std::uint64_t pins_ = 0;
  unsigned count_ = 1;
  bool up_ = true, key_down_ = false, event_ = false;
  std::deque<bool> bits_;
  std::int64_t talk_due_ = 2'000, began_ = 0;
  std::int64_t key_due_ = 500, switch_due_ = 30'000, event_due_ = 90'000;
};

}  // namespace

TEST_CASE("board: the netlist does at every pin what the RTL does") {
  const std::int64_t clocks = feltgate::test::scaled_clocks(150'000);
  std::int64_t armed = 0, driving = 0;
  std::uint64_t answered = 0;
  std::set<std::uint64_t> lamps;
  for (const std::uint64_t seed : {3u, 8u}) {
    Board board(seed);
    std::uint64_t line = 1;
    for (std::int64_t clock = 0; clock < clocks; ++clock) {
      board.act(clock);
      for (const bool high : {false, true}) {
        const std::string found = board.half(high);
        if (!found.empty())
          FAIL("mismatch at clock " << clock << ", pin " << found << " (seed " << seed << ")");
      }
      const std::uint64_t lit = board.pin(kLamps) ^ kDark;
      armed += static_cast<std::int64_t>(lit & 1U);
      driving += board.pin("gate_a_hi") | board.pin("gate_b_hi") ? 1 : 0;
      lamps.insert(lit);
      answered += line & ~board.pin(kToHost) & 1;
      line = board.pin(kToHost);
    }
  }
  std::cout << "the netlist on 2 x " << clocks << " clocks, 0 mismatches; lamp 0 lit in " << armed
            << ", an upper gate on in " << driving << ", " << lamps.size() << " pictures of lamps, "
            << answered << " edges of answers\n";
  REQUIRE(armed > clocks / 5);
  REQUIRE(driving > clocks / 400);
  REQUIRE(lamps.size() > kPictures);
  REQUIRE(answered > 300);
}
