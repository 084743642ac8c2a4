// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of a board, connected to a host by bytes. It runs clock by clock while the host waits,
// so that the load of the machine has no effect. The wire can lose bytes, or be cut.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "feltgate/linked_core.hpp"
#include "feltgate/random.hpp"
#include "host/transport.hpp"

namespace feltgate::test {

/// N axes of design D; with more than one, each lever has its own pins.
template <class D, int N = 1>
class BoardInProcess : public host::Transport {
 public:
  void write(const std::uint8_t* data, std::size_t size) override {
    if (before_write) before_write(std::vector<std::uint8_t>(data, data + size));
    for (std::size_t n = 0; n < size; ++n) {
      if (left == 0) throw host::LinkLost("wire: cut");
      if (left > 0) --left;
      if (lost > 0 && random_.uniform() < lost) continue;
      board.send(data[n]);
    }
    // A host that writes without a pause must wait for the wire.
    while (board.unsent() > 64) run(5000);
  }
  std::size_t read(std::uint8_t* data, std::size_t size, host::Deadline) override {
    if (left == 0) throw host::LinkLost("wire: cut");
    for (int n = 0; n < 40 && received_.empty(); ++n) run(2000);
    const std::size_t got = std::min(size, received_.size());
    std::copy_n(received_.begin(), got, data);
    received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(got));
    return got;
  }
  const std::string& name() const override { return name_; }

  void run(std::int64_t clocks) {
    board.run(in, clocks, [] {});
    now += clocks;
    for (const std::uint8_t byte : board.take_received()) received_.push_back(byte);
  }
  void step(bool up, std::size_t axis = 0) {
    unsigned& at = phase_[axis];
    at += up ? 1U : 3U;
    const EncoderPins pins{(at & 2U) != 0, ((at >> 1 ^ at) & 1U) != 0, false};
    if constexpr (N == 1) {
      in.encoder = pins;
    } else {
      in.axis[axis].encoder = pins;
    }
    run(std::int64_t{4} * D::clocks_per_tick);
  }

  LinkedCore<D, N> board{LinkedOptions{3'000'000, true, 0}};
  typename LinkedCore<D, N>::In in;
  std::int64_t now = 0;    ///< clocks since power-up
  std::int64_t left = -1;  ///< bytes until the wire is cut; -1: not cut
  double lost = 0;         ///< share of bytes to the board that are lost
  std::function<void(const std::vector<std::uint8_t>&)> before_write;

 private:
  std::vector<std::uint8_t> received_;
  SplitMix64 random_{5};
  std::string name_ = "wire";
  std::array<unsigned, N> phase_{};
};

}  // namespace feltgate::test
