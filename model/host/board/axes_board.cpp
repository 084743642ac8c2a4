// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed loop of a simulated board with several axes. Documentation: docs/host.md
#include "host/board/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/axes_loop/axes_scene.hpp"
#include "sim/axes_loop/homing.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/pantograph/pantograph.hpp"

namespace feltgate::board {

namespace {

constexpr Clock kLongest = 250;  ///< clocks of a step, as in the loop of scenes

template <class Plant>
class AxesBoard : public Board {
 public:
  template <class Setup_>
  AxesBoard(std::unique_ptr<Core> core, const Setup_& device, const plant::Effects& effects,
            const Setup& setup)
      : Board(std::move(core), setup),
        plant_(device.parameters, effects, plant::drive_of(core_->design()), device.hand) {
    home();
  }

 private:
  struct Edge {
    Clock clock;
    std::size_t axis;
    EncoderPins pins;
  };
  /// The core's side of homing: see sim/axes_loop/homing.hpp.
  class Pins {
   public:
    explicit Pins(AxesBoard& board) : board_(board) {}
    const DesignInfo& design() const { return board_.core_->design(); }
    template <class All>
    void reset(std::uint64_t, const All& pins) {
      std::copy(pins.begin(), pins.end(), board_.in_.encoder.begin());
    }
    void edge(std::size_t axis, const EncoderEvent& e) {
      board_.edges_.push_back({e.clock, axis, e.pins});
    }
    void advance(Clock clocks) { board_.run_edges(clocks); }

   private:
    AxesBoard& board_;
  };

  void home() {
    Pins pins(*this);
    homed_ = feltgate::home(pins, plant_, 1, core_->design().pwm_period);
  }
  /// Runs the core to this clock; each edge comes in its own.
  void run_edges(Clock end) {
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const Edge& a, const Edge& b) { return a.clock < b.clock; });
    for (const Edge& e : edges_) {
      run_core(std::clamp(e.clock, now_, end) - now_);
      in_.encoder[e.axis] = e.pins;
    }
    edges_.clear();
    run_core(end - now_);
  }
  void step(Clock corner) override {
    const Clock now = plant_.now();
    // A new duty is in force half a PWM period after the carrier's start.
    const Clock period = core_->design().pwm_period;
    Clock end = std::min(now + std::min<Clock>(kLongest, period), plant_.next_corner());
    end = std::max(std::min(end, corner - homed_), now + 1);
    std::array<plant::Bridge, Plant::axes> bridges;
    for (std::size_t n = 0; n < Plant::axes; ++n) {
      bridges[n] = plant::Bridge::averaged(core_->duty(n) / static_cast<double>(period),
                                           core_->gates_enabled(n));
    }
    plant_.advance(bridges, end - now);
    for (std::size_t n = 0; n < Plant::axes; ++n) {
      for (const EncoderEvent& e : plant_.events(n)) {
        edges_.push_back({e.clock + homed_, n, e.pins});
      }
    }
    run_edges(end + homed_);
  }

  Plant plant_;
  Clock homed_ = 0;
  std::vector<Edge> edges_;
};

/// The default device with a hand by name.
AxesScene pantograph_with(const std::string& hand, const std::string& path) {
  PantographSetup device;
  device.parameters = plant::read_pantograph_file(path);
  plant::PenPhase phase;
  if (hand != "free") phase.kind = plant::PenPhase::Kind::kImpedance;
  if (hand == "swing") {
    constexpr double day_s = 1e5, quarter_rad = 1.5707963267948966;
    plant::Segment s;
    s.kind = plant::Segment::Kind::kSine;
    s.duration_s = day_s;
    s.amplitude = 0.02;
    s.frequency_hz = 1;
    s.phase_rad = -quarter_rad;  // starts at rest
    phase.x.push_back(s);
    phase.duration_s = day_s;
  }
  device.hand.phases = {phase};
  AxesScene scene;
  scene.scenario.effects = device.parameters.effects;
  scene.device = device;
  return scene;
}

}  // namespace

std::unique_ptr<Board> make_axes_board(
    std::unique_ptr<Core> core, const Setup& setup,
    const std::function<std::string(const std::string&, const std::string&)>& find) {
  const auto device = [&](const std::string& name) { return find(name, "vectors/devices"); };
  const bool named = setup.hand == "free" || setup.hand == "hold" || setup.hand == "swing";
  if (named && setup.design != "pantograph_law") {
    throw std::invalid_argument(fmt::format(
        "--hand {}: is for the design pantograph_law; leave it out, or give a scene of the device "
        "of {}",
        setup.hand, setup.design));
  }
  const AxesScene scene = named ? pantograph_with(setup.hand, device("pantograph"))
                                : read_axes_scene(find(setup.hand, "vectors/scenes"), device);
  if (!named && own_design(scene) != setup.design) {
    throw std::invalid_argument(
        fmt::format("--hand {}: is a scene of the device {}, whose design is {}, not {}",
                    setup.hand, device_of(scene), own_design(scene), setup.design));
  }
  return std::visit(
      [&](const auto& s) -> std::unique_ptr<Board> {
        using Plant = typename std::decay_t<decltype(s)>::Plant;
        return std::make_unique<AxesBoard<Plant>>(std::move(core), s, scene.scenario.effects,
                                                  setup);
      },
      scene.device);
}

}  // namespace feltgate::board
