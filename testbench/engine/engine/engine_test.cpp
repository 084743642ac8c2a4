// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// engine: RTL against twin on every clock with random programs, hosts and resets.
// Documentation: docs/blocks/engine.md
#include "feltgate/engine.hpp"

#include "catch.hpp"
#include "engine_device.hpp"
#include "random_programs.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// Random stimulus: random programs and data in all memories, ticks, a host that writes and reads
/// any address, commits, CRCs, arming, locks.
class Life {
 public:
  Life(std::uint64_t seed, bool busy) : random_(seed), busy_(busy) {
    memory_ = random_memory(random_);
    host_.load(memory_);
    start();
  }

  Twin::In operator()(std::int64_t clock, const Twin::Out& out) {
    if (clock < 8) return in_;  // reset
    in_.enter = random_.one_in(9000);
    in_.crc_start = random_.one_in(60'000);
    if (random_.one_in(4000)) in_.armed = !in_.armed;
    if (loaded_ && random_.one_in(5000)) in_.locked = !in_.locked;
    in_.tick = ++since_ >= period_;
    if (in_.tick) next_tick();
    loaded_ = loaded_ || host_.queue.empty();
    if (host_.queue.empty()) more();
    host_.drive(in_, out);
    host_.read.clear();
    return in_;
  }

 private:
  void start() {
    using H = EngineMap::H;
    for (int n = 0; n < 4; ++n) {
      host_.write(H::divider0 + n, random_.one_in(2) ? random_.below(3) : random_.below(9));
    }
    host_.write(H::max_age, random_.below(12));
    host_.write(H::mailbox_first, random_.one_in(3) ? 32 : random_.below(40));
    host_.write(H::mailbox_age, random_.below(5));
    host_.write(H::run, random_.one_in(5) ? random_.below(16) : 15);
  }
  void next_tick() {
    since_ = 0;
    period_ = random_.one_in(8) ? 3 + static_cast<int>(random_.below(90)) : 50;
    // Sometimes jumps to the next step of the mailbox's age.
    in_.tick_count += random_.one_in(8) ? 64 - in_.tick_count % 64 : 1;
    for (std::size_t n = 0; n < AXES; ++n) {
      in_.position[n] = corner(random_);
      in_.velocity[n] = corner(random_);
      in_.tau_hat[n] = corner(random_);
    }
  }
  void more() {
    using H = EngineMap::H;
    if (!busy_ && !random_.one_in(500)) return;
    switch (random_.below(10)) {
      case 0:
        host_.ask(static_cast<int>(random_.below(0xa20)));
        break;
      case 1:
        host_.ask(H::status);
        break;
      case 2:
        host_.ask(H::event_count + static_cast<int>(random_.below(5)));
        break;
      case 3:
        host_.write(H::commit, random_.below(4));
        break;
      case 4: {  // a whole set of parameters, in or just outside their ranges
        for (int n = 0; n < 32; ++n) {
          const bool beyond = random_.one_in(300);
          host_.write(H::data + EngineMap::D::parameter + n + (random_.one_in(2) ? 32 : 0),
                      static_cast<std::uint32_t>(inside(n)) + (beyond ? 1U << 30 : 0U));
        }
        host_.write(H::commit, 1);
        host_.ask(H::refused_word);
        break;
      }
      case 5:
        host_.write(static_cast<int>(0x200 + random_.below(0x820)), random_word());
        break;
      case 6: {
        const std::uint64_t w = random_instruction(random_);
        host_.write(H::high, static_cast<std::uint32_t>(w >> 32));
        host_.write(H::program + static_cast<int>(random_.below(512)),
                    static_cast<std::uint32_t>(w));
        break;
      }
      case 7:
        host_.write(H::data + static_cast<int>(random_.below(random_.one_in(150) ? 512 : 384)),
                    random_word());
        break;
      case 8:
        host_.write(H::table + static_cast<int>(random_.below(512)), random_word());
        break;
      default:
        if (random_.one_in(4)) start();
    }
  }
  std::int32_t inside(int n) {
    const std::int64_t lower = memory_.data_at(EngineMap::D::lower + n);
    const std::int64_t upper = memory_.data_at(EngineMap::D::upper + n);
    const std::int64_t part = static_cast<std::int64_t>(random_.below(9));
    return static_cast<std::int32_t>(lower + (upper - lower) / 8 * part);
  }
  std::uint32_t random_word() { return static_cast<std::uint32_t>(corner(random_)); }

  Random random_;
  bool busy_, loaded_ = false;
  EngineMemory memory_;
  Host host_;
  Twin::In in_;
  int since_ = 0, period_ = 50;
};

/// Counts the states reached; a count that is too low fails the test.
struct Reached {
  std::int64_t fresh = 0, late = 0, events = 0, lost = 0, refused = 0, banks = 0, overrun = 0,
               crc = 0;
  std::int64_t limits = 0, busy = 0, mailbox_late = 0, jumps = 0;
  std::uint32_t before = 0;
};

}  // namespace

TEST_CASE("engine: random programs, hosts and resets, RTL against twin") {
  Reached total;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Bench bench("engine", seed);
    Reached* r = &total;
    const auto count = [r](const Twin::In& in, const Vengine&, const Twin& twin,
                           bool) -> const char* {
      Twin::In status = in;
      status.addr = EngineMap::H::status;
      const Twin::Out out = twin.peek(status);
      using S = EngineMap::S;
      const std::uint32_t rise = out.rdata & ~r->before;
      const auto rose = [rise](int bit) { return static_cast<std::int64_t>(rise >> bit & 1U); };
      r->refused += rose(S::status_refused);
      r->overrun += rose(S::status_overrun);
      r->late += rose(S::status_late);
      r->banks += rose(S::status_bank);
      r->crc += rose(S::status_crc_busy);
      r->mailbox_late += rose(S::status_mailbox_late);
      r->jumps += out.changed;
      r->before = out.rdata;
      r->fresh += out.fresh;
      r->events += out.event_valid;
      r->busy += out.busy;
      r->limits += out.fresh && (out.torque[0] == (1 << 20) - 1 || out.torque[0] == -(1 << 20));
      return nullptr;
    };
    bench.run(Life(seed, seed % 2 == 0), scaled_clocks(50'000), {seed % 3 == 0 ? 30'000U : 0U},
              count);
  }
  CAPTURE(total.fresh, total.late, total.events, total.refused, total.banks, total.overrun,
          total.crc, total.limits, total.mailbox_late, total.jumps);
  CHECK(total.fresh > 1000 / AXES / AXES / AXES);
  CHECK(total.late > 8);
  CHECK(total.events > 1000);
  CHECK(total.refused > 10);
  CHECK(total.banks > 10);
  CHECK(total.overrun > 10);
  CHECK(total.crc > 5);
  CHECK(total.limits > 10);
  CHECK(total.mailbox_late > 10);
  CHECK(total.jumps > 20);
}
