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
#include <utility>

#include "feltgate/axes_engine.hpp"
#include "feltgate/feltgate_core.hpp"

namespace feltgate {

/// N axes of a design, each a core. The device adds the signals between the cores, the register
/// port, and with WithEngine the engine; its torque then replaces the inputs law_... What a core
/// takes of the program, and whether an axis before it tests itself, is sampled with the position.
template <int N, bool WithEngine = false>
class FeltgateAxes {
 public:
  static_assert(N >= 1 && N <= 3, "one to three axes");
  using Core = FeltgateCore;
  using Glue = std::conditional_t<WithEngine, AxesEngine<N>, NoAxesEngine<N>>;
  using In = AxesIn<N>;
  using Out = AxesOut<N>;
  using Tell = Callback<>;
  using OnEvent = Callback<std::int64_t, int>;

  /// `reads`: a host reads the words of the axes.
  explicit FeltgateAxes(const axis::Design& d, bool reads = true)
      : cores_(make_cores(Core(d, reads), std::make_index_sequence<N>())), glue_(d) {
    show({});
  }

  /// A clock with the reset. The parameter RAMs keep their words, as in the RTL.
  void reset(const In& in = {}) {
    const std::array<CoreIn, N> each = inputs(in);
    for (std::size_t n = 0; n < N; ++n) cores_[n].reset(each[n]);
    glue_.reset();
    taken_ = {};
    duties_ = 0;
    show({});
  }

  void clock(const In& in) {
    one_clock(in, inputs(in));
    show(in);
  }

  /// Advances `clocks` clocks with the inputs held; reg_write and the axes' set_zero must be low.
  /// Equals so many calls of clock(), but goes from event to event where no axis can affect the
  /// others. `on_snapshot()` is called whenever out() holds a valid snapshot; `on_event(clock,
  /// number)` for each event of a program, where clock 0 is the first of these clocks;
  /// `on_tick_end()` before a tick's last clock, when all is known of the runs that began in it.
  void run(const In& in, std::int64_t clocks, Tell on_snapshot, OnEvent on_event = {},
           Tell on_tick_end = {}) {
    go(in, clocks, {on_snapshot, on_event, on_tick_end}, false);
    settle();
    show(in);
  }
  /// As run(), with out() as after FeltgateCore::advance().
  void advance(const In& in, std::int64_t clocks, Tell on_snapshot, OnEvent on_event = {},
               Tell on_tick_end = {}) {
    go(in, clocks, {on_snapshot, on_event, on_tick_end}, true);
  }

  const Out& out() const { return out_; }
  const Core& core(int n) const { return cores_[static_cast<std::size_t>(n)]; }
  Core& core(int n) { return cores_[static_cast<std::size_t>(n)]; }
  /// The next clock's number in its tick; the same for all axes.
  int clock_of_tick() const { return cores_[0].clock_of_tick(); }
  /// Whether the next clock is the last of its tick.
  bool last() const { return clock_of_tick() == cores_[0].clocks_per_tick() - 1; }
  /// Whether in the next clock position, velocity and tau_hat of all axes are those of this tick.
  bool measured() const { return cores_[0].measured(); }
  /// The logic between engine and cores; with WithEngine it has the engine.
  const Glue& glue() const { return glue_; }
  Glue& glue() { return glue_; }

 private:
  template <std::size_t... Axis>
  static std::array<Core, N> make_cores(const Core& core, std::index_sequence<Axis...>) {
    return {(static_cast<void>(Axis), core)...};
  }

  static constexpr int kSample = Core::sample_clock, kMeasured = Core::measured_clock;
  static constexpr unsigned kAll = (1U << N) - 1;
  /// What the cores have taken with the position.
  struct Taken {
    Program<N> program;
    std::array<bool, N> waits{};
  };

  struct Watcher {
    Tell snapshot;
    OnEvent event;
    Tell tick_ends;
  };

  /// `amid`: a core may be left amid a tick.
  void go(const In& in, std::int64_t clocks, const Watcher& watcher, bool amid) {
    std::int64_t at = 0;
    while (at < clocks) {
      std::array<CoreIn, N> each = inputs(in);
      bool snapshot = false, ends = false;
      int step = pass(in, each, at, clocks, &snapshot, &ends, watcher, amid);
      if (step == 0) {
        step = 1;
        if (glue_.event_valid()) watcher.event(at, glue_.event_number());
        one_clock(in, each);
        snapshot = out_.axis[0].snapshot_valid;
        ends = last();
      }
      if (snapshot) watcher.snapshot();
      if (ends) watcher.tick_ends();
      at += step;
    }
    show(in);
  }
  // Out of line, like pass(): flattened into an engine's advance() it takes a minute to compile and
  // is no faster.
  [[gnu::noinline]] void one_clock(const In& in, const std::array<CoreIn, N>& each) {
    settle();
    const int at = clock_of_tick();
    if (at == kSample) taken_ = take(in, 0);
    duties_ = at == cores_[0].clocks_per_tick() - 1 ? 0 : duties_ | duties();
    glue_.clock(in, cores_, each);
    for (std::size_t n = 0; n < N; ++n) cores_[n].clock(each[n]);
    show_axes();
  }
  void settle() {
    for (Core& core : cores_) core.settle();
  }
  /// The axes whose duty is new, by bit.
  unsigned duties() const {
    unsigned all = 0;
    for (std::size_t n = 0; n < N; ++n) all |= (cores_[n].out().snapshot_valid ? 1U : 0U) << n;
    return all;
  }
  /// A snapshot waits for the duties of all axes.
  void show_axes() {
    const unsigned now = duties();
    for (std::size_t n = 0; n < N; ++n) {
      out_.axis[n] = cores_[n].out();
      out_.axis[n].snapshot_valid = now != 0 && (duties_ | now) == kAll;
    }
  }
  /// What the cores sample in the clock `ahead` clocks from now.
  Taken take(const In& in, int ahead) {
    Taken t{glue_.program(in, ahead), {}};
    for (std::size_t n = 1; n < N; ++n) t.waits[n] = t.waits[n - 1] || cores_[n - 1].testing();
    return t;
  }

  /// Advances from event to event, at most to the end of the tick, towards clock `clocks` of run(),
  /// of which the present clock is `at`. Returns the clocks passed; 0 where the next one must use
  /// clock().
  [[gnu::noinline]] int pass(const In& in, std::array<CoreIn, N>& each, std::int64_t at,
                             std::int64_t clocks, bool* snapshot, bool* ends,
                             const Watcher& watcher, bool amid) {
    const int tick = cores_[0].clocks_per_tick();
    const int from = clock_of_tick();
    int to = static_cast<int>(std::min<std::int64_t>(tick, from + clocks - at));
    if (WithEngine) {
      if (!glue_.by_runs(in, cores_, each)) return 0;
      for (const Core& core : cores_) {
        if (!core.at_rest()) to = std::min(to, tick - 1);
      }
      if (to == from) return 0;
    }
    if (!in_step()) return 0;
    if (!apart(each, to == tick)) {
      // One clock, before whose end no axis affects another.
      if (!enabled()) return 0;
      to = from + 1;
    }
    const bool samples = from <= kSample && kSample < to;
    const bool measures = from <= kMeasured && kMeasured < to;
    if (measures && !glue_.may_tick(kMeasured - from)) return 0;
    if (samples) {
      const Taken now = take(in, kSample - from);
      if (now.program.late != taken_.program.late) return 0;
      taken_ = now;
      give_taken(each);
    }
    if (to == tick) {
      duties_ = 0;
    } else if (to > cores_[0].duty_clock()) {
      duties_ = kAll;
    }
    for (std::size_t n = 0; n < N; ++n) {
      const auto tell = [&, n] {
        out_.axis[n] = cores_[n].out();
        *snapshot = true;
      };
      if (amid) {
        cores_[n].advance(each[n], to - from, tell);
      } else {
        cores_[n].run(each[n], to - from, tell);
      }
    }
    *ends = from < tick - 1 && to >= tick - 1;
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
      }
    }
    give_taken(each);
    glue_.give(in, cores_, each);
    return each;
  }
  void give_taken(std::array<CoreIn, N>& each) const {
    for (std::size_t n = 0; n < N; ++n) {
      each[n].law_torque = taken_.program.torque[n];
      each[n].law_late = taken_.program.late;
      each[n].axis_waits = taken_.waits[n];
    }
  }

  /// Whether the duties of all axes are new in one clock, with an engine that of a program's
  /// torque.
  bool in_step() const {
    const int clock = WithEngine ? Core::law_duty_clock : cores_[0].duty_clock();
    return std::all_of(cores_.begin(), cores_.end(),
                       [clock](const Core& core) { return core.duty_clock() == clock; });
  }

  bool enabled() const {
    return std::any_of(cores_.begin(), cores_.end(),
                       [](const Core& core) { return core.out().gates_enable; });
  }
  /// Whether no axis affects the others before the tick ends: no gates close, and, if the stretch
  /// ends the tick, no axis asks to be armed.
  bool apart(const std::array<CoreIn, N>& each, bool ends) const {
    if (N == 1) return true;
    if (!enabled()) {
      bool asks = false;
      for (std::size_t n = 0; n < N; ++n) asks |= cores_[n].arm_request(each[n]);
      return !ends || !asks;
    }
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
    show_axes();
    for (std::size_t n = 0; n < N; ++n) {
      out_.reg_rdata |= out_.axis[n].reg_rdata;
      out_.reg_busy |= addressed(n, in.reg_addr) && out_.axis[n].reg_busy;
    }
    glue_.show(in, out_);
  }

  std::array<Core, N> cores_;
  Glue glue_;
  Taken taken_;
  unsigned duties_ = 0;  ///< axes whose duty is of this tick, by bit
  Out out_;
};

}  // namespace feltgate

#ifdef FELTGATE_COMPILED_TWIN
#include "feltgate/compiled_axes.hpp"  // IWYU pragma: export
#endif
