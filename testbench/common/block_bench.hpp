// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lock-step of a Verilated block and its twin: random inputs of every kind, every output before and
// after every edge and between the edges. A twin is
//   struct Twin : BlockTwin<ports::NAME> { void clock(const In&); Out out(const In&) const; };
// and may have
//   reset(const In&)              a clock with the reset, where it is not a twin as at the begin
//   legal(In&, Random&)           makes inputs that the block is not made for into legal ones
//   holds, strobes(In&, clock)    of a tick block: its inputs hold for so many clocks from 0 on
//   between(const In&)            for inputs that act without a clock
//   asynchronous(In&, const In&)  keeps inputs that may not change between the edges
// docs/testing.md
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "block_design.hpp"
#include "catch.hpp"
#include "feltgate/axis/clocked.hpp"
#include "mismatch.hpp"
#include "random.hpp"
#include "sim/backends/rtl_model.hpp"

namespace feltgate::test {

/// An output of which the twin knows nothing in this clock.
constexpr std::int64_t any_value = std::numeric_limits<std::int64_t>::min();

namespace ports {

inline std::uint64_t mask(int width) { return ~std::uint64_t{0} >> (64 - width); }
inline std::int64_t in_format(std::uint64_t bits, int width, bool is_signed) {
  bits &= mask(width);
  if (is_signed && (bits >> (width - 1) & 1) != 0) bits |= ~mask(width);
  return static_cast<std::int64_t>(bits);
}

/// Bits of a port, which is a word or of several words of 32 bits.
template <int Low, int Width, class Port, class Value>
void put(Port& port, Value value) {
  const std::uint64_t bits = static_cast<std::uint64_t>(value) & mask(Width);
  if constexpr (std::is_integral_v<Port>) {
    port = static_cast<Port>((port & ~(mask(Width) << Low)) | bits << Low);
  } else {
    for (int at = Low; at < Low + Width;) {
      const int place = at % 32, n = std::min(32 - place, Low + Width - at);
      const auto of_word = static_cast<std::uint32_t>(mask(n) << place);
      port[at / 32] = (port[at / 32] & ~of_word) |
                      (static_cast<std::uint32_t>(bits >> (at - Low) << place) & of_word);
      at += n;
    }
  }
}
template <int Low, int Width, bool Signed, class Port>
std::int64_t get(const Port& port) {
  std::uint64_t bits = 0;
  if constexpr (std::is_integral_v<Port>) {
    bits = std::uint64_t{port} >> Low;
  } else {
    for (int at = Low; at < Low + Width; at += 32 - at % 32) {
      bits |= std::uint64_t{port[at / 32] >> at % 32} << (at - Low);
    }
  }
  bits &= mask(Width);
  return Signed ? sign_extend<Width>(bits) : static_cast<std::int64_t>(bits);
}

}  // namespace ports

template <class BlockPorts>
struct BlockTwin {
  using Block = BlockPorts;
  using In = typename Block::In;
  using Out = typename Block::Out;
};

/// Of a law that runs once a tick: Clocked computes at start, and its inputs hold until valid.
template <class Ports, class Law>
struct TickTwin : BlockTwin<Ports> {
  static constexpr int holds = Law::latency;
  static void strobes(typename Ports::In& in, int clock) { in.start = clock == 0; }
  bool valid() const { return block.valid(Law::latency); }

  Law law{design()};
  axis::Clocked<Law> block;
};

/// Inputs as the design has them: the words of p.
template <class In>
In at_home() {
  In in{};
  in.each([](const std::string& name, auto& field, int, bool) {
    for (const Word& w : design().words) {
      if (name == "p." + w.name) field = static_cast<std::decay_t<decltype(field)>>(w.reset);
    }
  });
  return in;
}

namespace detail {
#define FELTGATE_HAS(NAME, EXPRESSION) \
  template <class Twin, class = void>  \
  struct NAME : std::false_type {};    \
  template <class Twin>                \
  struct NAME<Twin, std::void_t<decltype(EXPRESSION)>> : std::true_type {};
FELTGATE_HAS(HasReset, std::declval<Twin&>().reset(std::declval<const typename Twin::In&>()))
FELTGATE_HAS(HasLegal, std::declval<Twin&>().legal(std::declval<typename Twin::In&>(),
                                                   std::declval<Random&>()))
FELTGATE_HAS(HasAsynchronous, Twin::asynchronous(std::declval<typename Twin::In&>(),
                                                 std::declval<const typename Twin::In&>()))
FELTGATE_HAS(HasBetween, std::declval<Twin&>().between(std::declval<const typename Twin::In&>()))
FELTGATE_HAS(HasStrobes, Twin::strobes(std::declval<typename Twin::In&>(), 0))
#undef FELTGATE_HAS
}  // namespace detail

/// Random inputs: for some thousand draws each field has a habit of its own (swarm testing).
template <class Block>
class Swarm {
 public:
  using In = typename Block::In;
  Swarm(std::uint64_t seed, In home) : random_(seed) {
    home.each([this](const char*, auto& f, int, bool) {
      homes_.push_back(static_cast<std::int64_t>(f));
    });
  }

  void next(In& in) {
    if (left_-- == 0) choose(in);
    std::size_t n = 0;
    in.each([&](const char*, auto& field, int width, bool is_signed) {
      const Habit& h = habits_[n];
      const std::int64_t at_home = homes_[n++];
      using Field = std::decay_t<decltype(field)>;
      if (!random_.one_in(std::uint64_t{1} << h.hold)) {
        if (h.kind == pulse) field = Field{};
        return;
      }
      field =
          static_cast<Field>(value(h, static_cast<std::int64_t>(field), at_home, width, is_signed));
    });
  }
  /// What the twin takes for legal, within the formats.
  template <class Twin>
  void legal(Twin& twin, In& in) {
    if constexpr (detail::HasLegal<Twin>::value) {
      twin.legal(in, random_);
      in.each([](const char*, auto& f, int width, bool is_signed) {
        const auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(f));
        f = static_cast<std::decay_t<decltype(f)>>(ports::in_format(bits, width, is_signed));
      });
    }
  }

 private:
  enum Kind { anything, small, ends, walk, bit, count, constant, pulse, home, stay };
  struct Habit {
    Kind kind = anything;
    unsigned hold = 0, size = 0;
  };
  void choose(In& in) {
    left_ = 20 + random_.below(random_.coin() ? 200 : 4000);
    habits_.clear();
    const bool at_home = random_.one_in(3);
    in.each([&](const char* name, auto&, int width, bool) {
      Habit h;
      h.hold = random_.below(random_.coin() ? 4 : 11);
      h.kind = static_cast<Kind>(random_.below(stay + 1));
      if (width == 1) h.kind = random_.coin() ? pulse : random_.one_in(6) ? stay : anything;
      if (at_home && std::strncmp(name, "p.", 2) == 0) h.kind = home;
      h.size = random_.below(static_cast<std::uint64_t>(width));
      habits_.push_back(h);
    });
  }
  std::int64_t value(const Habit& h, std::int64_t old, std::int64_t at_home, int width,
                     bool is_signed) {
    const std::uint64_t all = ports::mask(width), top = is_signed ? all >> 1 : all;
    const auto in_format = [&](std::uint64_t w) { return ports::in_format(w, width, is_signed); };
    if (h.kind == home) return at_home;
    if (width == 1) return h.kind == stay ? old : h.kind == pulse ? 1 : old == 0;
    switch (h.kind) {
      case small: {
        const std::uint64_t s = random_.bits() & (all >> h.size);
        return in_format(is_signed && random_.coin() ? 0 - s : s);
      }
      case ends:
        return in_format((random_.coin() ? top : is_signed ? top + 1 : 0) + random_.below(3) - 1);
      case walk:
        return in_format(static_cast<std::uint64_t>(old) +
                         random_.below(std::uint64_t{2} << (h.size / 2)) -
                         (std::uint64_t{1} << (h.size / 2)));
      case bit:
        return in_format(std::uint64_t{1} << random_.below(static_cast<std::uint64_t>(width)));
      case count:
        return in_format(static_cast<std::uint64_t>(old) + 1);
      case constant: {
        constexpr auto n = std::size(Block::constants);
        return in_format(Block::constants[random_.below(n)] +
                         (random_.one_in(4) ? random_.below(3) - 1 : 0));
      }
      case stay:
        return old;
      default:
        return in_format(random_.bits());
    }
  }
  Random random_;
  std::vector<std::int64_t> homes_;
  std::uint32_t left_ = 0;
  std::vector<Habit> habits_;
};

struct BenchOptions {
  std::int64_t clocks = 400'000;
  std::uint64_t seeds = 8;
  std::uint32_t resets = 5000;  ///< mean clocks between resets, of every second seed
  const char* constant = "";    ///< outputs that nothing changes
};

/// Which values the outputs had: of one bit both, of a signed output both signs, of others not 0
/// alone.
template <class Out>
class Reached {
 public:
  static constexpr std::size_t size = sizeof(Out) / sizeof(std::int64_t);
  using Words = std::array<std::int64_t, size>;

  void add(const Words& w) {
    for (std::size_t k = 0; k < size; ++k) {
      least_[k] = std::min(least_[k], w[k]);
      most_[k] = std::max(most_[k], w[k]);
    }
  }
  /// The outputs that were not: name by name.
  std::string missing(const char* constant) const {
    std::string names;
    std::size_t k = 0;
    Out().each([&](const std::string& name, auto&, int width, bool is_signed) {
      const bool reached = most_[k] > 0 && least_[k] < (width == 1 ? 1 : is_signed ? 0 : most_[k]);
      const std::string known = " " + std::string(constant) + " ";
      if (!reached && known.find(" " + name + " ") == std::string::npos) names += " " + name;
      ++k;
    });
    return names;
  }

 private:
  Words least_{}, most_{};
};

/// Compares a block and its twin. Inputs also change between the edges.
template <class Twin>
void lock_step(const Twin& prototype, const BenchOptions& o = {},
               const typename Twin::In& home = at_home<typename Twin::In>()) {
  using Block = typename Twin::Block;
  using In = typename Twin::In;
  using Out = typename Twin::Out;
  using Words = typename Reached<Out>::Words;
  static_assert(std::is_trivially_copyable_v<Out>);
  using Rtl = typename Block::Rtl;
  Reached<Out> reached;
  // The first difference in so many clocks; with a waveform all of them, the last 220 in it.
  const auto run = [&](std::uint64_t seed, std::int64_t clocks, const std::string& waveform) {
    RtlModel<Rtl> rtl(seed);
    if (!waveform.empty()) rtl.trace(waveform, "1ns");
    Twin twin = prototype;
    Swarm<Block> swarm(seed, home), other(seed + 1000, home);
    Random random(seed ^ 0x726573);
    In in = home, fresh = home, noise = home, between = home;
    int reset = 4, of_tick = 0, gap = 0;
    Check check;
    std::int64_t clock = 0;
    const auto look = [&](const char* instant, const In& at) {
      const Out seen = Out::of(*rtl), known = twin.out(at);
      Words a, b;
      std::memcpy(a.data(), &seen, sizeof a);
      std::memcpy(b.data(), &known, sizeof b);
      reached.add(a);
      if (a == b || check.failed()) return;
      std::size_t k = 0;
      Out().each([&](const char* name, auto&, int, bool) {
        if (b[k] != any_value) check(name, a[k], b[k]);
        ++k;
      });
      check.first().cycle = clock;
      check.first().instant = instant;
    };
    const auto dump = [&](std::int64_t time) {
      if (rtl.tracing() && clock >= clocks - 220) rtl.dump(static_cast<std::uint64_t>(time));
    };
    for (; clock < clocks && (!check.failed() || rtl.tracing()); ++clock) {
      if (reset > 0) {
        --reset;
      } else if (seed % 2 == 0 && random.one_in(o.resets)) {
        reset = 1 + static_cast<int>(random.below(8));
      }
      if constexpr (detail::HasStrobes<Twin>::value) {
        if (of_tick == 0 || of_tick >= Twin::holds) swarm.next(of_tick == 0 ? fresh : noise);
        if (of_tick == 0) swarm.legal(twin, fresh);
        in = of_tick < Twin::holds ? fresh : noise;
        Twin::strobes(in, of_tick);
        if (of_tick == 0) gap = static_cast<int>(random.below(random.coin() ? 2 : 30));
        of_tick = of_tick + 1 < Twin::holds + gap ? of_tick + 1 : 0;
        if (reset > 0) of_tick = 0;
      } else {
        swarm.next(in);
        swarm.legal(twin, in);
      }
      constexpr bool resets_itself = detail::HasReset<Twin>::value;
      if constexpr (!resets_itself) {
        if (reset > 0) twin = prototype;
      }
      rtl->rst_ni = reset > 0 ? 0 : 1;
      if (reset == 0 && random.one_in(4)) {
        other.next(between);
        In now = between;
        if constexpr (detail::HasAsynchronous<Twin>::value) Twin::asynchronous(now, in);
        if constexpr (detail::HasBetween<Twin>::value) twin.between(now);
        now.apply_to(*rtl);
        rtl.low();
        look("between the edges", now);
      }
      in.apply_to(*rtl);
      rtl.low();
      if (reset == 0 || !resets_itself) look("before the edge", in);
      dump(20 * clock);
      rtl.high();
      if (reset == 0) twin.clock(in);
      if constexpr (resets_itself) {
        if (reset > 0) twin.reset(in);
      }
      look("after the edge", in);
      dump(20 * clock + 10);
    }
    return check;
  };
  const auto clocks = scaled_clocks(o.clocks) / static_cast<std::int64_t>(o.seeds);
  for (std::uint64_t seed = 1; seed <= o.seeds; ++seed) {
    Check check = run(seed, clocks, "");
    if (!check.failed()) continue;
    std::string waveform;
    if (feltgate::detail::HasTrace<Rtl>::value && waveform_wanted()) {
      waveform = mismatch_file(Block::name);
      run(seed, check.first().cycle + 20, waveform);
    }
    fail_with(Block::name, seed, check.first(), waveform);
  }
  if (waveform_wanted()) CHECK(reached.missing(o.constant) == "");
}

}  // namespace feltgate::test
