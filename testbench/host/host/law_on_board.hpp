// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board with an engine in this process, the host's library on its wire, and laws for it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "design/engine_map.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/linked_core.hpp"
#include "feltgate/random.hpp"
#include "host/capture.hpp"
#include "host/law_engine.hpp"
#include "host/transport.hpp"
#include "law/compile.hpp"
#include "twins.hpp"

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

  test::LinkedOf<D, N> board{LinkedOptions{3'000'000, true, 0}};
  typename test::LinkedOf<D, N>::In in;
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

using host::LawEngine;

template <class D>
const design::Elaborated& elaborated() {
  static const host::KnownDesign known = host::read_known_design(
      FELTGATE_ROOT, std::string(FELTGATE_ROOT "/rtl/designs/") + D::name + ".toml");
  return known.design;
}

inline law::Image compiled(const std::string& text, const std::string& name = "test") {
  return law::compile_text(text, name, design::law_target(elaborated<LeverLaw>())).image;
}

inline const law::Image& spring() {
  static const law::Image image = compiled(
      "param stiffness = 0.25 Nm/rad in 0 .. 1 Nm/rad\n"
      "param rest = 0 rad in -1 .. 1 rad\n"
      "event beyond(position) when position > 0.01\n"
      "event below(velocity) when position < -0.01\n"
      "out torque = -stiffness * (position - rest)\n",
      "spring");
  return image;
}
inline const law::Image& damper() {
  static const law::Image image = compiled(
      "param damping = 0.01 Nm s/rad in 0 .. 0.1 Nm s/rad\n"
      "out torque = -damping * velocity\n",
      "damper");
  return image;
}

template <class D>
struct OnWire {
  std::unique_ptr<BoardInProcess<D>> wire = std::make_unique<BoardInProcess<D>>();
  host::Link link{*wire};
  host::Device device{link, host::read_board(link), elaborated<D>()};
};
struct OnBoard : OnWire<LeverLaw> {
  LawEngine engine{device};

  void arm() {
    device.set("self_test_pulse", 0);
    device.set("watchdog_ticks", 100000000);
    device.arm("law", false);
  }
  bool armed() { return wire->board.out().core.armed; }
  double torque() {
    return std::ldexp(wire->board.out().core.tau_ref, -LeverLaw::f.torque.fraction);
  }
  /// Runs until a ramp has ended.
  void settle() { wire->run(10'000 * std::int64_t{LeverLaw::clocks_per_tick}); }
};

inline std::string told(const std::function<void()>& run) {
  try {
    run();
    return "nothing";
  } catch (const std::exception& e) {
    return e.what();
  }
}

constexpr double count_rad = 2 * 3.14159265358979 / 4096;

}  // namespace feltgate::test
