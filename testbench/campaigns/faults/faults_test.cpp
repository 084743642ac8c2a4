// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Tests a part of the fault campaign, the separation of its classes, and the listed cases.
// docs/testing.md defines each fault and the limits of the classes.
#include <fstream>
#include <map>
#include <string>

#include "campaigns/faults/clean.hpp"
#include "campaigns/faults/pin_faults.hpp"
#include "campaigns/faults/record.hpp"
#include "campaigns/faults/world.hpp"
#include "catch.hpp"
#include "feltgate/generated/causes.hpp"
#include "mismatch.hpp"

using namespace feltgate::faults;

namespace {

const std::string root = FELTGATE_ROOT;

std::vector<Outcome> outcomes(const StateCampaign& campaign,
                              const std::vector<StateFault>& faults) {
  std::vector<Outcome> found;
  const std::int64_t mismatches =
      run(campaign, faults, [&](const StateResult& r) { found.push_back(r.outcome); });
  CHECK(mismatches == 0);  // RTL against twin, in the ticks without a fault
  return found;
}

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
  CHECK(groups["supervisor"] > 200);
  CHECK(groups["position"] > 100);
  CHECK(groups["encoder inputs"] > 20);
  CHECK(groups["parameter RAM"] > 1500);
}

TEST_CASE("faults: a share of the flips ends safely") {
  StateCampaign campaign;
  campaign.root = root;
  campaign.seed = 7;
  campaign.flips_per_bit = 1;
  campaign.acts = 3;
  std::vector<StateFault> share;
  const auto all = plan(campaign);
  const std::size_t every = feltgate::test::whole_run() ? 23 : 92;
  for (std::size_t n = 5; n < all.size(); n += every) share.push_back(all[n]);
  const auto bits = state_bits();
  int unsafe = 0, silent = 0, detected = 0;
  const auto mismatches = run(campaign, share, [&](const StateResult& r) {
    unsafe += r.outcome.is == Class::unsafe;
    silent += r.outcome.is == Class::silent && bits[r.fault.bits[0]].safety;
    detected += r.outcome.is == Class::detected;
  });
  CHECK(mismatches == 0);
  CHECK(share.size() > 5000 / every);
  CHECK(unsafe == 0);
  CHECK(silent <= 3);
  CHECK(detected > 700 / static_cast<int>(every));
}

TEST_CASE("faults: a bit of count or zero that flips closes the gates") {
  StateCampaign campaign;
  campaign.root = root;
  std::vector<StateFault> faults;
  for (int bit = 0; bit < 32; ++bit) {
    faults.push_back(at_the_wall("u_quad_decoder.count_q", bit));
    faults.push_back(at_the_wall("u_quad_decoder.zero_q", bit));
  }
  const auto word = 1u << static_cast<unsigned>(feltgate::Fault::word);
  const auto found = outcomes(campaign, faults);
  CHECK(found.size() == 64);
  for (const Outcome& o : found) {
    CHECK(o.is == Class::detected);
    CHECK((o.flagged & word) != 0);
    CHECK(o.off_after <= 1);
  }
}

TEST_CASE("faults: what is broken is seen") {
  StateCampaign campaign;
  campaign.root = root;
  SECTION("a gate that is stuck on") {
    StateFault f = at_the_wall("u_pwm.gate_hi_q", 0);
    f.stuck = true;
    const Outcome o = outcomes(campaign, {f})[0];
    CHECK(o.is == Class::unsafe);
    CHECK(o.both_clocks > 1);
  }
  SECTION("a motor that gives more than 1.2 times the limit, and for how long it may") {
    for (const int ticks : {900, 1100}) {
      TorqueJudge judge(motor_of_plant(root), Limits{});
      Outcome o;
      for (int k = 0; k < ticks; ++k) judge.tick({}, {}, 0, 0.61, true, &o);
      CHECK(judge.unsafe(o) == (ticks > 1000));
    }
  }
  SECTION("a torque that is off by more than 5 % of the limit, unflagged") {
    const GateTimes on{3, 47, 0, 50, 0}, off{0, 50, 0, 50, 0};
    for (const bool flagged : {false, true}) {
      TorqueJudge judge(motor_of_plant(root), Limits{});
      Outcome o;
      for (int k = 0; k < 1100; ++k) judge.tick(on, off, 0, 0, flagged, &o);
      CHECK(judge.torque_wrong() == !flagged);
      CHECK(o.peak_nm > 0.025);
    }
  }
  SECTION("an accepted level of the encoder: a count too many, for ever") {
    const Outcome o = outcomes(campaign, {at_the_wall("u_quad_decoder.level_q", 0)})[0];
    CHECK(o.is == Class::silent);
    CHECK(o.why == "position");
  }
  SECTION("a register that the next tick writes anew") {
    const Outcome o = outcomes(campaign, {at_the_wall("u_dob.tau_hat_o", 3)})[0];
    CHECK(o.is <= Class::transient);
    CHECK(o.peak_nm < 0.025);
  }
  SECTION("a reset") {
    StateFault f = at_the_wall("u_pwm.wanted_q", 0);
    f.bits.clear();
    f.reset_clocks = 40;
    const Outcome o = outcomes(campaign, {f})[0];
    CHECK(o.is == Class::off);
    CHECK(o.flagged == 0);
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

TEST_CASE("faults: the listed cases end as listed") {
  constexpr std::uint64_t kShares = 6;
  std::ifstream list(root + "/vectors/faults/cases.jsonl");
  REQUIRE(list);
  std::vector<StateFault> states;
  std::vector<std::string> wanted;
  std::uint64_t lines = 0;
  int cases = 0;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (!feltgate::test::tried(lines++, kShares)) continue;
    ++cases;
    const CaseLine c = read_case(line);
    if (c.pins) {
      INFO(line);
      CHECK(name_of(run_pin_fault(root, c.kind, c.seed, c.design).outcome.is) == c.expected);
    } else {
      states.push_back(c.state);
      wanted.push_back(c.expected);
    }
  }
  StateCampaign campaign;
  campaign.root = root;
  std::size_t compared = 0;
  const auto mismatches = run(campaign, states, [&](const StateResult& r) {
    for (std::size_t n = 0; n < states.size(); ++n) {
      const StateFault& s = states[n];
      if (s.act != r.fault.act || s.tick != r.fault.tick || s.clock != r.fault.clock ||
          s.bits != r.fault.bits)
        continue;
      ++compared;
      INFO("tick " << s.tick << " clock " << s.clock << " act " << s.act);
      CHECK(name_of(r.outcome.is) == wanted[n]);
    }
  });
  CHECK(mismatches == 0);
  CHECK(compared == states.size());
  CHECK(lines >= 40);
  CHECK(cases >= (feltgate::test::whole_run() ? 40 : 8));
}

TEST_CASE("faults: no alarm without a fault") {
  const double seconds = feltgate::test::whole_run() ? 30 : 8;
  const CleanResult r = run_clean(root, seconds, 5, [](double) {});
  CHECK(r.alarms == 0);
  CHECK(r.scenes_s > seconds / 15);
  CHECK(r.recordings_s > seconds / 15);
  CHECK(r.dither_s > seconds / 15);
}

TEST_CASE("faults: no alarm of a current loop or an absolute encoder without a fault") {
  const double seconds = feltgate::test::whole_run() ? 5 : 0.6;
  for (const std::string& design : option_designs()) {
    const CleanResult r = run_option_clean(root, design, seconds, 5, [](double) {});
    INFO(design << ": " << r.first);
    CHECK(r.alarms == 0);
    CHECK(r.scenes_s >= seconds);
  }
}
