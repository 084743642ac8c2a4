// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A host loads a law and a lever moves in it. The twin runs at once; play() then runs the RTL
// beside a twin. Documentation: docs/link.md
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "feltgate/design_info.hpp"
#include "frames.hpp"
#include "law/compile.hpp"
#include "law/load.hpp"
#include "linked_adapter.hpp"

namespace feltgate::test {

using H = EngineMap::H;
constexpr int kTick = D::clocks_per_tick;

/// The image of a spring with an event at a position.
inline const law::Image& image() {
  static const law::Image made = [] {
    const char* text =
        "param stiffness = 0.25 Nm/rad in 0 .. 1 Nm/rad\n"
        "event beyond(position) when position > 0.01\n"
        "out torque = -stiffness * position\n";
    return law::compile_text(text, "test", law::target_of(design_info<D>())).image;
  }();
  return made;
}

/// A host and a lever at the twin's pins. Their actions are recorded; the RTL runs them later.
class Life {
 public:
  LinkedIn in;

  const LinkedOut& out() const { return twin_->out(); }
  std::vector<int> event_clocks;  ///< clock of the tick for each event
  void clocks(std::int64_t count) {
    for (; count > 0; --count) {
      in.uart_rx = line_.level();
      line_.clock(twin_->out().uart_tx);
      inputs_.push_back(in);
      if (twin_->device().event_valid()) event_clocks.push_back(twin_->device().clock_of_tick());
      twin_->clock(in);
    }
  }
  void ticks(int n) { clocks(std::int64_t{n} * kTick); }
  void send(const Bytes& wire) {
    for (const std::uint8_t byte : wire) line_.send(byte);
  }
  /// Returns the words of the reply; empty if the line stays silent.
  std::vector<std::uint32_t> ask(const Bytes& wire) {  // the sequence number is not escaped
    send(wire);
    for (int wait = 0; wait < 700 || line_.unsent() > 0; ++wait) {
      clocks(100);
      for (const std::uint8_t byte : line_.take_received()) {
        wait = 0;
        if (byte != LinkMap::frame_end) {
          frame_.push_back(byte);
          continue;
        }
        const Bytes frame = std::exchange(frame_, {});
        // Earlier requests may be answered too.
        if (frame.size() > 2 && frame[1] == wire[2]) return body_words(unescaped(frame));
      }
    }
    return {};
  }
  std::vector<std::uint32_t> read(std::uint32_t address, std::uint32_t words) {
    const auto got = ask(request(1, ++sequence_ & 255, address, words));
    REQUIRE(got.size() == words);
    return got;
  }
  void write(std::uint32_t address, std::uint32_t word) {
    REQUIRE(ask(request(2, ++sequence_ & 255, address, word)).size() == 1);
  }
  std::vector<std::uint32_t> engine(int address, std::uint32_t words = 1) {
    return read(static_cast<std::uint32_t>(EngineMap::port_first + address), words);
  }
  /// Sends all frames but the last at the full rate of the wire: each acts when its frame is
  /// complete.
  void write_engine(const std::vector<law::HostWord>& words) {
    for (std::size_t k = 0; k < words.size(); ++k) {
      const auto address = static_cast<std::uint32_t>(EngineMap::port_first + words[k].address);
      if (k + 1 == words.size()) {
        write(address, words[k].data);
      } else {
        send(request(2, ++sequence_ & 255, address, words[k].data));
      }
    }
  }
  void control(bool arm) {
    write(D::C::control, static_cast<std::uint32_t>(D::control_reset) | 1U << D::C::control_host |
                             std::uint32_t{arm} << D::C::control_arm |
                             static_cast<std::uint32_t>(D::S::law) << D::C::control_scene);
  }
  void arm() {
    control(false);
    write(D::A::self_test_pulse, 0);
    write(D::A::ramp_step, 0x7ffffff);
    write(D::C::command, 1U << D::C::command_clear_faults);
    control(true);
    for (int k = 0; k < 3000 && !out().core.armed; ++k) ticks(1);
  }
  /// Moves by one count.
  void turn(bool up) {
    phase_ += up ? 1U : 3U;
    in.encoder = pins_at(phase_, in.encoder.z);
  }
  /// Moves by one count and runs four ticks.
  void step(bool up) {
    turn(up);
    ticks(4);
  }
  /// Runs the recorded actions on the RTL beside a twin.
  void play() {
    Bench bench("feltgate_linked", 7);
    const std::vector<LinkedIn>& inputs = inputs_;
    bench.run(
        [&inputs](std::int64_t clock) {
          const std::int64_t k = clock - Bench::kFirstReset;
          return k < 0 ? LinkedIn{} : inputs[static_cast<std::size_t>(k)];
        },
        static_cast<std::int64_t>(inputs.size()) + Bench::kFirstReset);
  }

 private:
  std::unique_ptr<Twin> twin_ = std::make_unique<Twin>();
  UartLine line_{D::clock_hz, BAUD};
  std::vector<LinkedIn> inputs_;
  Bytes frame_;
  int sequence_ = 0;
  unsigned phase_ = 0;
};

}  // namespace feltgate::test
