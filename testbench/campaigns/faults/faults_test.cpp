// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Tests a part of the fault campaign, the separation of its classes, and the listed cases.
// docs/testing.md defines each fault and the limits of the classes.
#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "campaigns/faults/faults.hpp"
#include "campaigns/faults/world.hpp"
#include "catch.hpp"
#include "feltgate/generated/causes.hpp"
#include "mismatch.hpp"

using namespace feltgate::faults;

namespace {

const std::string root = FELTGATE_ROOT;

/// Flips that are tried in one run, so that the way to an act's faults is gone once.
class Flips {
 public:
  using Check = std::function<void(const Outcome&)>;

  void add(const StateFault& fault, Check check) { all_.emplace_back(fault, std::move(check)); }
  void run(const StateCampaign& campaign) {
    // In the order of the campaign: by act and tick.
    std::stable_sort(all_.begin(), all_.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first.act, a.first.tick) < std::tie(b.first.act, b.first.tick);
    });
    std::vector<StateFault> faults;
    for (const auto& one : all_) faults.push_back(one.first);
    std::size_t n = 0;
    const std::int64_t mismatches = feltgate::faults::run(
        campaign, faults, [&](const StateResult& r) { all_[n++].second(r.outcome); });
    CHECK(mismatches == 0);  // RTL against twin, in the ticks without a fault
    CHECK(n == all_.size());
  }

 private:
  std::vector<std::pair<StateFault, Check>> all_;
};

std::size_t bit_of(const std::string& name, int bit) {
  const auto bits = state_bits();
  for (std::size_t n = 0; n < bits.size(); ++n) {
    if (bits[n].name == name && bits[n].bit == bit) return n;
  }
  FAIL("no register " << name);
  return 0;
}

/// A fault in the scene wall, at a tick at which the wall pushes.
StateFault at_the_wall(const std::string& name, int bit) {
  StateFault f;
  f.tick = 105'000;
  f.clock = 17;
  f.bits = {bit_of(name, bit)};
  return f;
}

}  // namespace

TEST_CASE("faults: every state bit has a name and a group") {
  std::map<std::string, int> groups;
  for (const StateBit& b : state_bits()) {
    INFO(b.name);
    REQUIRE_FALSE(b.group.empty());
    ++groups[b.group];
  }
  CHECK(groups["pwm"] > 50);
  CHECK(groups["monitors"] > 200);
  CHECK(groups["arming and stop"] > 30);
  CHECK(groups["position"] > 100);
  CHECK(groups["encoder inputs"] > 20);
  CHECK(groups["parameter RAM"] > 1500);
}

TEST_CASE("faults: flips end safely, what is broken is seen, and the listed cases end as listed") {
  const bool whole = feltgate::test::whole_run();
  StateCampaign campaign;
  campaign.root = root;
  campaign.seed = 7;
  campaign.flips_per_bit = 1;
  campaign.acts = whole ? 3 : 2;
  Flips flips;

  const auto bits = state_bits();
  const auto all = plan(campaign);
  const std::size_t every = whole ? 23 : 92;
  std::size_t share = 0;
  int unsafe = 0, silent = 0, detected = 0;
  for (std::size_t n = 5; n < all.size(); n += every, ++share) {
    const bool safety = bits[all[n].bits[0]].safety;
    flips.add(all[n], [&, safety](const Outcome& o) {
      unsafe += o.is == Class::unsafe;
      silent += o.is == Class::silent && safety;
      detected += o.is == Class::detected;
    });
  }

  // A bit of count or zero closes the gates.
  const auto word = 1u << static_cast<unsigned>(feltgate::Fault::word);
  for (int bit = 0; bit < 32; ++bit) {
    for (const char* name : {"u_quad_decoder.count_q", "u_quad_decoder.zero_q"}) {
      flips.add(at_the_wall(name, bit), [=](const Outcome& o) {
        INFO(name << " " << bit);
        CHECK(o.is == Class::detected);
        CHECK((o.flagged & word) != 0);
        CHECK(o.off_after <= 1);
      });
    }
  }

  StateFault stuck = at_the_wall("u_pwm.gate_hi_q", 0);
  stuck.stuck = true;
  flips.add(stuck, [](const Outcome& o) {
    CHECK(o.is == Class::unsafe);
    CHECK(o.both_clocks > 1);
  });
  // An accepted level of the encoder: a count too many, for ever.
  flips.add(at_the_wall("u_quad_decoder.level_q", 0), [](const Outcome& o) {
    CHECK(o.is == Class::silent);
    CHECK(o.why == "position");
  });
  // A register that the next tick writes anew.
  flips.add(at_the_wall("u_observer.tau_hat_o", 3), [](const Outcome& o) {
    CHECK(o.is <= Class::transient);
    CHECK(o.peak_nm < 0.025);
  });
  StateFault reset = at_the_wall("u_pwm.wanted_q", 0);
  reset.bits.clear();
  reset.reset_clocks = 40;
  flips.add(reset, [](const Outcome& o) {
    CHECK(o.is == Class::off);
    CHECK(o.flagged == 0);
  });

  std::ifstream list(root + "/vectors/faults/cases.jsonl");
  REQUIRE(list);
  std::uint64_t lines = 0;
  int cases = 0;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#' || !feltgate::test::tried(lines++, 6)) continue;
    ++cases;
    const CaseLine c = read_case(line);
    const auto check = [line, c](const Outcome& o) {
      INFO(line);
      CHECK(name_of(o.is) == c.expected);
    };
    if (c.pins) {
      check(run_pin_fault(root, c.kind, c.seed, c.design).outcome);
    } else {
      flips.add(c.state, check);
    }
  }
  CHECK(lines >= 40);
  CHECK(cases >= (whole ? 40 : 8));

  flips.run(campaign);
  CHECK(share > 5000 / every);
  CHECK(unsafe == 0);
  CHECK(silent <= 3);
  CHECK(detected > 700 / static_cast<int>(every));
}

TEST_CASE("faults: a motor that gives more than 1.2 times the limit, and for how long it may") {
  for (const int ticks : {900, 1100}) {
    TorqueJudge judge(motor_of_plant(root), Limits{});
    Outcome o;
    for (int k = 0; k < ticks; ++k) judge.tick({}, {}, 0, 0.61, true, &o);
    CHECK(judge.unsafe(o) == (ticks > 1000));
  }
}

TEST_CASE("faults: a torque that is off by more than 5 % of the limit, unflagged") {
  const GateTimes on{3, 47, 0, 50, 0}, off{0, 50, 0, 50, 0};
  for (const bool flagged : {false, true}) {
    TorqueJudge judge(motor_of_plant(root), Limits{});
    Outcome o;
    for (int k = 0; k < 1100; ++k) judge.tick(on, off, 0, 0, flagged, &o);
    CHECK(judge.torque_wrong() == !flagged);
    CHECK(o.peak_nm > 0.025);
  }
}

TEST_CASE("faults: each kind at the pins ends as it must") {
  const auto& kinds = pin_kinds();
  const int seeds = feltgate::test::whole_run() ? 6 : 2;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const std::string name = kinds[k].name;
    int detected = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const PinResult r = run_pin_fault(root, k, static_cast<std::uint64_t>(seed));
      INFO(kinds[k].name << ", seed " << seed << ": " << r.what);
      if (kinds[k].promise == Promise::unseen) {
        CHECK(r.outcome.flagged == 0);
      } else {
        CHECK(r.outcome.is != Class::unsafe);
      }
      detected += r.outcome.is == Class::detected;
      if (name == "channel dead") CHECK(r.outcome.travel_rad <= 0.08);
    }
    INFO(name);
    // Shorted channels can make every edge illegal. With few edges the count stands still and no
    // fault is flagged: one of the seeds may end so.
    if (kinds[k].promise == Promise::flagged) {
      CHECK(detected >= (name == "channels shorted" ? seeds - 1 : seeds));
    }
  }
}

TEST_CASE("faults: at the pins of the options each kind ends as it must") {
  const std::uint64_t seeds = feltgate::test::whole_run() ? 4 : 1;
  for (const std::string& design : option_designs()) {
    const auto& kinds = pin_kinds(design);
    REQUIRE(kinds.size() > 10);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      if (!feltgate::test::tried(k, 3)) continue;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const PinResult r = run_pin_fault(root, k, seed, design);
        const Outcome& o = r.outcome;
        INFO(design << ", " << kinds[k].name << ", seed " << seed << ": " << r.what);
        if (kinds[k].promise == Promise::unseen) continue;
        CHECK(o.is != Class::unsafe);
        if (kinds[k].promise == Promise::refused) CHECK(o.is == Class::off);
        if (kinds[k].promise != Promise::flagged) continue;
        CHECK(o.is == Class::detected);
        if (kinds[k].within_us > 0) CHECK(o.off_after <= kinds[k].within_us);
      }
    }
  }
}

TEST_CASE("faults: no alarm without a fault") {
  const double seconds = feltgate::test::whole_run() ? 30 : 6;
  const CleanResult r = run_clean(root, seconds, 5, [](double) {});
  CHECK(r.alarms == 0);
  CHECK(r.scenes_s > seconds / 15);
  CHECK(r.recordings_s > seconds / 15);
  CHECK(r.dither_s > seconds / 15);
}

TEST_CASE("faults: no alarm of a current loop or an absolute encoder without a fault") {
  const double seconds = feltgate::test::whole_run() ? 5 : 0.15;
  for (const std::string& design : option_designs()) {
    const CleanResult r = run_option_clean(root, design, seconds, 5, [](double) {});
    INFO(design << ": " << r.first);
    CHECK(r.alarms == 0);
    CHECK(r.scenes_s >= seconds);
  }
}
