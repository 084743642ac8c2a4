// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/axes/feltgate_axes.sv: one to three cores as axes of one device. Every output of
// every core equals the RTL's in each clock. Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "feltgate/axes_engine.hpp"
#include "feltgate/feltgate_core.hpp"

namespace feltgate {

/// N axes of design D, each a core. The device adds the signals between the cores, the register
/// port, and with WithEngine the engine; its torque then replaces the inputs law_...
template <class D, int N, bool ReadBack = true, bool WithEngine = false>
class FeltgateAxes {
 public:
  static_assert(N >= 1 && N <= 3, "one to three axes");
  using Core = FeltgateCore<D, ReadBack>;
  using Glue = std::conditional_t<WithEngine, AxesEngine<D, N>, NoAxesEngine<D, N>>;
  using In = AxesIn<N>;
  using Out = AxesOut<N>;

  FeltgateAxes() { show({}); }

  /// The parameter RAMs keep their words, as in the RTL.
  void reset() {
    for (Core& core : cores_) core.reset();
    glue_.reset();
    taken_ = {};
    done_ = {};
    show({});
  }

  void clock(const In& in) {
    std::array<CoreIn, N> each = inputs(in);
    clock_all(in, each);
    show(in);
  }

  /// Advances `clocks` clocks with the inputs held; reg_write and the axes' set_zero must be low.
  /// Equals so many calls of clock(), but goes from event to event where no axis can affect the
  /// others. `on_snapshot()` is called whenever out() holds a valid snapshot. A watcher gets
  /// `event(clock, number)` for each event of a program, where clock 0 is the first of these
  /// clocks, and `words()` when core(0) has all words of a tick.
  template <class OnSnapshot>
  void run(const In& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    NoWatcher none;
    run(in, clocks, on_snapshot, none);
  }
  template <class OnSnapshot, class Watcher>
  void run(const In& in, std::int64_t clocks, OnSnapshot&& on_snapshot, Watcher& watcher) {
    std::int64_t at = 0;
    while (at < clocks) {
      std::array<CoreIn, N> each = inputs(in);
      bool snapshot = false;
      int step = pass(in, each, at, clocks, &snapshot, watcher);
      if (step == 0) {
        step = 1;
        if (glue_.event_valid()) watcher.event(at, glue_.event_number());
        one_clock(in, each);
        snapshot = out_.axis[0].snapshot_valid;
        if (snapshot) watcher.words();
      }
      if (snapshot) on_snapshot();
      at += step;
    }
    show(in);
  }

  const Out& out() const { return out_; }
  const Core& core(int n) const { return cores_[static_cast<std::size_t>(n)]; }
  Core& core(int n) { return cores_[static_cast<std::size_t>(n)]; }
  /// The next clock's number in its tick; the same for all axes.
  int clock_of_tick() const { return cores_[0].clock_of_tick(); }
  /// Whether in the next clock position, velocity and tau_hat of all axes are those of this tick.
  bool measured() const { return cores_[0].measured(); }
  /// The engine; only with WithEngine.
  auto& engine() { return glue_.engine(); }
  /// The logic between engine and cores.
  const Glue& glue() const { return glue_; }
  Glue& glue() { return glue_; }
  /// Whether for `clocks` clocks neither a duty in force nor a gate enable changes; see
  /// FeltgateCore::calm().
  bool calm(const In& in, std::int64_t clocks) {
    const std::array<CoreIn, N> each = inputs(in);
    if (clock_of_tick() != 0 || !glue_.by_runs(in, cores_, each) || !glue_.may_tick(kMeasured)) {
      return false;
    }
    for (std::size_t n = 0; n < N; ++n) {
      if (!taken_[n].holds(each[n]) || !cores_[n].calm(each[n], clocks)) return false;
    }
    return true;
  }

 private:
  /// The clocks of a tick in which the cores take torques, and in which they have measured.
  static constexpr int kTakes = Core::sample_clock, kMeasured = Core::measured_clock;

  /// What an axis takes with the position and holds for a tick, as in axes_member.sv.
  struct Taken {
    std::int32_t torque = 0;
    bool late = false, waits = false;
    /// An input changes nothing but the torque.
    bool holds(const CoreIn& c) const { return c.law_late == late && c.axis_waits == waits; }
    void give(CoreIn& c) const {
      c.law_torque = torque;
      c.law_late = late;
      c.axis_waits = waits;
    }
    void take(const CoreIn& c) { *this = {c.law_torque, c.law_late, c.axis_waits}; }
  };

  struct NoWatcher {
    void event(std::int64_t, int) {}
    void words() {}
  };

  // Out of line, like pass(): flattened into an engine's advance() it takes a minute to compile and
  // is no faster.
  [[gnu::noinline]] void one_clock(const In& in, std::array<CoreIn, N>& each) {
    clock_all(in, each);
    for (std::size_t n = 0; n < N; ++n) out_.axis[n] = cores_[n].out();
    show_snapshot();
  }
  void clock_all(const In& in, std::array<CoreIn, N>& each) {
    glue_.clock(in, cores_, each);
    const bool takes = clock_of_tick() == kTakes, last = clock_of_tick() == D::clocks_per_tick - 1;
    for (std::size_t n = 0; n < N; ++n) {
      const CoreIn now = each[n];
      taken_[n].give(each[n]);
      if (takes) taken_[n].take(now);
      done_[n] = !last && (done_[n] || cores_[n].out().snapshot_valid);
      cores_[n].clock(each[n]);
    }
  }
  /// A snapshot waits for the duties of all axes.
  void show_snapshot() {
    bool any = false, all = true;
    for (std::size_t n = 0; n < N; ++n) {
      const bool valid = cores_[n].out().snapshot_valid;
      any |= valid;
      all &= valid || done_[n];
    }
    for (std::size_t n = 0; n < N; ++n) out_.axis[n].snapshot_valid = any && all;
  }

  /// Advances from event to event, at most to the end of the tick, towards clock `clocks` of run(),
  /// of which the present clock is `at`. Returns the clocks passed; 0 where the next one must use
  /// clock().
  template <class Watcher>
  [[gnu::noinline]] int pass(const In& in, std::array<CoreIn, N>& each, std::int64_t at,
                             std::int64_t clocks, bool* snapshot, Watcher& watcher) {
    constexpr int tick = D::clocks_per_tick;
    const int from = clock_of_tick();
    int to = static_cast<int>(std::min<std::int64_t>(tick, from + clocks - at));
    if (WithEngine) {
      if (!glue_.by_runs(in, cores_, each)) return 0;
      for (const Core& core : cores_) {
        if (!core.at_rest()) to = std::min(to, tick - 1);
      }
      if (to == from) return 0;
    }
    if (N > 1 && to - from != tick) return 0;
    if (!apart(each, to == tick)) return 0;
    const bool takes = from <= kTakes && kTakes < to;
    const bool measures = from <= kMeasured && kMeasured < to;
    if (measures && !glue_.may_tick(kMeasured - from)) return 0;
    for (std::size_t n = 0; n < N; ++n) {
      if (takes && !taken_[n].holds(each[n])) return 0;
    }
    if (takes) glue_.torques(kTakes - from, each);
    for (std::size_t n = 0; n < N; ++n) {
      if (takes) {
        taken_[n].take(each[n]);
      } else {
        taken_[n].give(each[n]);
      }
      cores_[n].run(each[n], to - from, [&, n] {
        out_.axis[n] = cores_[n].out();
        *snapshot = true;
        if (n == 0) watcher.words();  // once the tick is over they belong to the next
      });
    }
    if (measures) glue_.tick(kMeasured - from, cores_);
    glue_.advance(to - from, cores_,
                  [&](int clock, int number) { watcher.event(at + clock, number); });
    return to - from;
  }

  /// The inputs of each core in the next clock: pins, port, and the signals from the other axes.
  std::array<CoreIn, N> inputs(const In& in) const {
    std::array<CoreIn, N> each;
    for (std::size_t n = 0; n < N; ++n) {
      CoreIn& c = each[n];
      c.encoder = in.axis[n].encoder;
      c.encoder_data = in.axis[n].encoder_data;
      c.arm = in.arm;
      c.stop = in.stop;
      c.set_zero = in.axis[n].set_zero;
      c.scene = in.axis[n].scene;
      c.reg_addr = address_at(n, in.reg_addr);
      c.reg_wdata = in.reg_wdata;
      c.reg_write = in.reg_write;
    }
    for (std::size_t n = 0; n < N; ++n) {
      for (std::size_t other = 0; other < N; ++other) {
        if (other == n) continue;
        const Core& core = cores_[other];
        each[n].axis_fault |= core.out().first_fault != 0;
        each[n].axis_silent |= !core.arm_request(each[other]);
        each[n].axis_blocked |= !core.ready();
        each[n].axis_testing |= core.testing();
        each[n].axis_waits |= other < n && core.testing();
      }
    }
    glue_.give(in, cores_, each);
    return each;
  }

  /// Whether no axis affects the others before the tick ends: no gates close, and, if the stretch
  /// ends the tick, no axis asks to be armed.
  bool apart(const std::array<CoreIn, N>& each, bool ends) const {
    if (N == 1) return true;
    bool enabled = false, asks = false;
    for (std::size_t n = 0; n < N; ++n) {
      enabled |= cores_[n].out().gates_enable;
      asks |= cores_[n].arm_request(each[n]);
    }
    if (!enabled) return !ends || !asks;
    for (std::size_t n = 0; n < N; ++n) {
      if (cores_[n].may_trip(each[n])) return false;
    }
    return true;
  }

  static bool addressed(std::size_t n, std::uint16_t address) { return address / axes_stride == n; }
  /// A port address as axis n sees it; an address for another axis becomes an unused one.
  static std::uint16_t address_at(std::size_t n, std::uint16_t address) {
    const unsigned nowhere = addressed(n, address) ? 0u : 3u * axes_stride;
    return static_cast<std::uint16_t>(nowhere | address % axes_stride);
  }

  void show(const In& in) {
    out_.reg_rdata = 0;
    out_.reg_busy = false;
    for (std::size_t n = 0; n < N; ++n) {
      out_.axis[n] = cores_[n].out();
      out_.reg_rdata |= out_.axis[n].reg_rdata;
      out_.reg_busy |= addressed(n, in.reg_addr) && out_.axis[n].reg_busy;
    }
    show_snapshot();
    glue_.show(in, out_);
  }

  std::array<Core, N> cores_;
  Glue glue_;
  std::array<Taken, N> taken_{};
  std::array<bool, N> done_{};  ///< its duty of this tick is there
  Out out_;
};

}  // namespace feltgate
