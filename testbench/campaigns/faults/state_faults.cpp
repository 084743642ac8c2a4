// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bits of the core's state that flip for one clock. Documentation: docs/testing.md
#include "campaigns/faults/faults.hpp"

#include <Vfaults.h>
#include <Vfaults___024root.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <flops.hpp>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "campaigns/faults/world.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"
#include "random.hpp"
#include "sim/backends/rtl_ports.hpp"
#include "twins.hpp"

void Vfaults___024root___eval_settle(Vfaults___024root* vlSelf);

namespace feltgate::faults {

namespace {

using D = Lever;

/// A memory of the axis.
#define FELTGATE_AXIS(NAME) \
  rtl_->rootp->feltgate_core__DOT__gen_lever__DOT__u_top__DOT__u_axis__DOT__##NAME

/// The Verilated core with access to its state. A test can flip a flip-flop or a word of a memory
/// (all logic that depends on it is evaluated again), and copy and compare the whole state.
class RtlState {
 public:
  explicit RtlState(std::uint64_t seed = 1) : rtl_(make(seed)) {
    rtl_->rst_ni = 1;  // so that the first reset is an edge
    low();
    drive(CoreIn{});
    reset(true);
    for (int k = 0; k < 4; ++k) clock();
    low();
    reset(false);
  }
  ~RtlState() { rtl_->final(); }
  RtlState(const RtlState&) = delete;
  RtlState& operator=(const RtlState&) = delete;

  /// Copies the state of another core. Both must be in one program, so that the bytes mean the
  /// same.
  void copy(const RtlState& o) {
    std::memcpy(begin(), o.begin(), size());
    in_ = o.in_;
  }
  bool same_state(const RtlState& o) const { return std::memcmp(begin(), o.begin(), size()) == 0; }

  // Call flips between two clocks.
  void flip(int flop) {
    const Flop& f = kFlops[flop];
    byte_of(f) ^= mask_of(f);
    settle();
  }
  /// Sets the flip-flop to this level, as if it had kept it over the last edge.
  void hold(int flop, bool level) {
    const Flop& f = kFlops[flop];
    if (((byte_of(f) & mask_of(f)) != 0) != level) flip(flop);
  }
  void flip_parameter(int address, int bit) {
    FELTGATE_AXIS(u_host__DOT__u_params__DOT__ram)
    [static_cast<std::size_t>(address)] ^= QData{1} << bit;
    settle();
  }
  void flip_line(int address, int bit) {
    auto& word = FELTGATE_AXIS(
        u_velocity_estimator__DOT__u_window__DOT__line)[static_cast<std::size_t>(address)];
    word = static_cast<SData>(word ^ (1u << bit));
    settle();
  }

  void drive(const CoreIn& in) {
    in_ = in;
    drive_inputs(*rtl_, feltgate::test::port_bits<D>(), in);
  }
  /// One clock with the inputs that were driven.
  void clock() {
    rtl_->stop_i = in_.stop;
    low();
    rtl_->stop_i = false;
    rtl_->clk_i = 1;
    rtl_->eval();
  }
  void reset(bool held) { rtl_->rst_ni = held ? 0 : 1; }
  unsigned gates() const {
    return static_cast<unsigned>(rtl_->gate_a_hi_o | rtl_->gate_a_lo_o << 1 |
                                 rtl_->gate_b_hi_o << 2 | rtl_->gate_b_lo_o << 3);
  }
  CoreOut out() const { return read_outputs(*rtl_, feltgate::test::port_bits<D>()); }

 private:
  unsigned char& byte_of(const Flop& f) {
    return static_cast<unsigned char*>(flop_place(*rtl_->rootp, f.place))[f.place_bit / 8];
  }
  static unsigned char mask_of(const Flop& f) {
    return static_cast<unsigned char>(1u << (f.place_bit % 8));
  }
  /// What Verilator computes before the first clock: all combinational logic, from the registers.
  void settle() { Vfaults___024root___eval_settle(rtl_->rootp); }

  // The whole state of the model lies between its first member and the pointer to its symbols.
  unsigned char* begin() { return reinterpret_cast<unsigned char*>(&rtl_->rootp->clk_i); }
  const unsigned char* begin() const {
    return reinterpret_cast<const unsigned char*>(&rtl_->rootp->clk_i);
  }
  std::size_t size() const {
    return static_cast<std::size_t>(reinterpret_cast<const unsigned char*>(&rtl_->rootp->vlSymsp) -
                                    begin());
  }

  // All models share one context: a Verilated scope ends in the context of its thread.
  static std::unique_ptr<Vfaults> make(std::uint64_t seed) {
    static VerilatedContext context;
    context.randReset(2);
    context.randSeed(static_cast<int>(seed % 0x7ffffffeU) + 1);
    return std::make_unique<Vfaults>(&context);
  }
  void low() {
    rtl_->clk_i = 0;
    rtl_->eval();
  }

  std::unique_ptr<Vfaults> rtl_;
  CoreIn in_;
};

/// Counts gates over clocks.
class GateCount {
 public:
  void add(unsigned gates) {
    times_.a_hi += static_cast<int>(gates & 1u);
    times_.a_lo += static_cast<int>((gates >> 1) & 1u);
    times_.b_hi += static_cast<int>((gates >> 2) & 1u);
    times_.b_lo += static_cast<int>((gates >> 3) & 1u);
    const bool both = (gates & 3u) == 3u || (gates & 12u) == 12u;
    run_ = both ? run_ + 1 : 0;
    if (run_ > times_.both) times_.both = run_;
  }
  /// Returns the counts of the clocks since the last call; a run of both gates continues over the
  /// call.
  GateTimes take() {
    const GateTimes t = times_;
    times_ = {};
    return t;
  }

 private:
  GateTimes times_;
  int run_ = 0;
};

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

/// Sets the group of a register, and whether it counts as safety.
void sort_in(StateBit* b) {
  const std::string& n = b->name;
  const auto is = [&](const char* group, bool safety = true) {
    b->group = group;
    b->safety = safety;
  };
  for (const char* shown : {"u_snapshot", "u_host.addr_", "u_host.reg_rdata_o", "u_params.read_"}) {
    if (begins(n, shown)) return is("read-back", false);
  }
  if (begins(n, "u_quad_decoder.")) {
    const std::string r = n.substr(15);
    for (const char* input : {"meta_q", "sync_q", "previous_q", "level_q", "fill_q", "primed_q",
                              "elapsed_q", "g_filter"}) {
      if (begins(r, input)) return is("encoder inputs", false);
    }
    for (const char* shown : {"error_", "rejected_", "index_position_o"}) {
      if (begins(r, shown)) return is("read-back", false);
    }
    return is("position");
  }
  constexpr std::pair<const char*, const char*> groups[] = {{"u_axis.", "position"},
                                                            {"u_velocity_estimator", "velocity"},
                                                            {"u_observer", "observer"},
                                                            {"u_scene", "scenes"},
                                                            {"u_ramp", "torque path"},
                                                            {"u_torque_law", "torque path"},
                                                            {"u_pwm", "pwm"},
                                                            {"u_tick_counter", "ticks"},
                                                            {"u_registers", "words and control"},
                                                            {"u_params", "words and control"},
                                                            {"u_host", "words and control"},
                                                            {"u_arming", "arming and stop"},
                                                            {"u_stop_latch", "arming and stop"},
                                                            {"u_fault_latch", "arming and stop"}};
  for (const auto& [block, group] : groups) {
    if (begins(n, block)) return is(group);
  }
  is("monitors");
}

constexpr int kTick = D::clocks_per_tick;

/// A core in closed loop at the end of a tick.
struct Loop {
  plant::Plant plant;
  GateTimes gates;
};

/// Turns the events of a plant step into pins per clock.
class Pins {
 public:
  Pins(const std::vector<EncoderEvent>& events, Clock from, EncoderPins before)
      : events_(events), at_(from), pins_(before) {}
  /// Returns whether the pins change in this clock.
  bool step(Clock clock) {
    bool changed = false;
    while (next_ < events_.size() && events_[next_].clock <= at_ + clock) {
      pins_ = events_[next_++].pins;
      changed = true;
    }
    return changed;
  }
  const EncoderPins& pins() const { return pins_; }

 private:
  const std::vector<EncoderEvent>& events_;
  Clock at_;
  EncoderPins pins_;
  std::size_t next_ = 0;
};

/// What a fault may change before it is seen.
auto watched(const CoreOut& o) {
  return std::tuple(o.velocity, o.position, o.tau_hat, o.tau_ref, o.current_ref, o.voltage, o.duty,
                    o.duty_active, o.limits, o.faults, o.armed, o.gates_enable);
}

/// Runs an act with a sound core; faults branch off from it.
class Branches {
 public:
  Branches(const StateCampaign& campaign, const Act& act)
      : act_(act),
        motor_(motor_of_plant(campaign.root)),
        loop_{make_plant(campaign.root, act.hand), {}},
        bits_(state_bits()) {
    in_.encoder = loop_.plant.encoder().pins();
    in_.scene = static_cast<std::uint8_t>(act.scene);
  }

  /// Runs until this many ticks since the beginning have ended.
  void to(std::int64_t tick) {
    for (; tick_ < tick; ++tick_) {
      in_.reg_write = false;
      if (tick_ >= 4 && static_cast<std::size_t>(tick_ - 4) < act_.words.size()) {
        const Word& w = act_.words[static_cast<std::size_t>(tick_ - 4)];
        in_.reg_addr = static_cast<std::uint16_t>(w.address);
        in_.reg_wdata = w.data;
        in_.reg_write = true;
      }
      in_.arm = act_.arm && tick_ >= 40;
      loop_.plant.advance(bridge_of(loop_.gates, kTick), kTick);
      Pins pins(loop_.plant.events(), tick_ * kTick, in_.encoder);
      GateCount gates;
      CoreIn held = in_;
      int waits = 0;  // clocks by which the twin is behind; the inputs in all of them are `held`
      const auto catch_up = [&] {
        if (held.reg_write) {
          twin_.clock(held);
          held.reg_write = false;
          --waits;
        }
        twin_.run(held, waits, [] {});
        waits = 0;
        held = in_;
      };
      golden_.drive(in_);
      for (int c = 0; c < kTick; ++c) {
        if (pins.step(c)) {
          in_.encoder = pins.pins();
          golden_.drive(in_);
          if (waits > 0) catch_up();
          held = in_;
        }
        ++waits;
        golden_.clock();
        gates.add(golden_.gates());
        if (in_.reg_write) {
          in_.reg_write = false;
          golden_.drive(in_);
          catch_up();
        }
      }
      catch_up();
      if (pins.step(kTick)) in_.encoder = pins.pins();
      if (!(golden_.out() == twin_.out())) ++mismatches_;
      loop_.gates = gates.take();
      history_.emplace_back(loop_.gates, loop_.plant.observables().motor_torque_mean_nm);
      if (history_.size() > static_cast<std::size_t>(motor_.period_ticks)) history_.pop_front();
    }
  }

  Outcome branch(const StateFault& fault) {
    Outcome o;
    Loop loop = loop_;
    CoreIn in = in_;
    faulty_.copy(golden_);
    sound_.copy(golden_);
    TorqueJudge judge(motor_, limits_);
    for (const auto& [times, torque_nm] : history_) judge.before(times, torque_nm);
    GateCount faulty_gates, sound_gates;
    GateTimes sound_times = loop.gates;
    bool differed = false, position_wrong = false;
    std::int64_t last_difference = 0;
    int off_for = 0;
    const bool armed_before = sound_.out().gates_enable;
    const double begin_rad = loop.plant.observables().theta_rad;
    for (std::int64_t t = 0; t < longest_ticks; ++t) {
      loop.plant.advance(bridge_of(loop.gates, kTick), kTick);
      Pins pins(loop.plant.events(), (tick_ + t) * kTick, in.encoder);
      faulty_.drive(in);
      sound_.drive(in);
      for (int c = 0; c < kTick; ++c) {
        if (pins.step(c)) {
          in.encoder = pins.pins();
          faulty_.drive(in);
          sound_.drive(in);
        }
        const std::int64_t since = t * kTick + c - fault.clock;
        if (since == 0 && fault.reset_clocks > 0) faulty_.reset(true);
        if (since == fault.reset_clocks && fault.reset_clocks > 0) faulty_.reset(false);
        faulty_.clock();
        if (fault.stuck && since >= 0) {
          faulty_.hold(bits_[fault.bits[0]].at, true);
        } else if (since == 0) {
          flip(fault);
        }
        sound_.clock();
        faulty_gates.add(faulty_.gates());
        sound_gates.add(sound_.gates());
      }
      if (pins.step(kTick)) in.encoder = pins.pins();
      loop.gates = faulty_gates.take();
      sound_times = sound_gates.take();
      const CoreOut f = faulty_.out(), s = sound_.out();
      const bool off =
          closed(f, s.faults, armed_before, t, loop.plant.observables().theta_rad - begin_rad, &o);
      judge.tick(loop.gates, sound_times, loop.plant.observables().omega_rad_s,
                 loop.plant.observables().motor_torque_mean_nm, off, &o);
      position_wrong = f.position != s.position;
      if (watched(f) != watched(s) || !(loop.gates == sound_times)) {
        differed = true;
        last_difference = t;
      }
      if (judge.unsafe(o)) break;
      off_for = off && !loop.gates.on() ? off_for + 1 : 0;
      if (off_for > (fault.reset_clocks > 0 ? still_ticks : 60)) break;
      if (t > 0 && faulty_.same_state(sound_)) {
        same_ = true;
        break;
      }
      same_ = false;
      if (t - last_difference > still_ticks) break;
    }
    settle({judge.unsafe(o), off_for > 0, judge.torque_wrong(), position_wrong, differed}, limits_,
           &o);
    if (o.is == Class::masked && !same_) o.is = Class::latent;
    return o;
  }
  std::int64_t mismatches() const { return mismatches_; }

 private:
  static constexpr std::int64_t longest_ticks = 20000, still_ticks = 1200;

  void flip(const StateFault& fault) {
    for (const std::size_t n : fault.bits) {
      const StateBit& b = bits_[n];
      if (b.kind == StateBit::Kind::flop) faulty_.flip(b.at);
      if (b.kind == StateBit::Kind::parameter) faulty_.flip_parameter(b.at, b.bit);
      if (b.kind == StateBit::Kind::line) faulty_.flip_line(b.at, b.bit);
    }
  }

  const Act& act_;
  TorqueJudge::Motor motor_;
  Limits limits_;
  RtlState golden_, faulty_, sound_;
  test::CoreOf<D> twin_;
  Loop loop_;
  CoreIn in_;
  std::vector<StateBit> bits_;
  std::int64_t tick_ = 0, mismatches_ = 0;
  bool same_ = false;
  std::deque<std::pair<GateTimes, double>> history_;  ///< one PWM period: gates, motor torque
};

}  // namespace

std::vector<StateBit> state_bits() {
  std::vector<StateBit> bits;
  int at = 0;
  for (const Flop& f : kFlops) {
    StateBit b;
    b.name = f.name;
    b.at = at++;
    b.bit = f.bit;
    sort_in(&b);
    bits.push_back(b);
  }
  for (const auto& p : D::parameters) {
    for (int bit = 0; bit < 36; ++bit) {
      bits.push_back({StateBit::Kind::parameter, std::string("parameter ") + p.name, p.address, bit,
                      "parameter RAM", true});
    }
  }
  for (int bit = 0; bit < 16; ++bit) {  // many words are alike: a few stand for all
    for (int k = 0; k < 8; ++k) {
      bits.push_back(
          {StateBit::Kind::line, "velocity line", k * 127 + 5, bit, "velocity line", true});
    }
  }
  return bits;
}

std::vector<StateFault> plan(const StateCampaign& c) {
  const auto all = acts();
  const std::size_t count = std::min(all.size(), c.acts);
  const auto bits = state_bits();
  test::Random random(c.seed);
  std::vector<StateFault> faults;
  const auto add = [&](std::size_t act, std::vector<std::size_t> flipped) {
    const Act& a = all[act];
    const auto from = static_cast<std::int64_t>(a.warm_s * 1e6);
    faults.push_back({act, from + random.below(static_cast<std::uint64_t>(a.window_s * 1e6)),
                      static_cast<int>(random.below(kTick)), std::move(flipped)});
  };
  std::vector<std::size_t> chosen;
  for (std::size_t n = 0; n < bits.size(); ++n) {
    if (c.only.empty() || bits[n].name.find(c.only) != std::string::npos) chosen.push_back(n);
  }
  if (chosen.empty()) {
    throw std::invalid_argument(
        fmt::format("--only {}: no register and no parameter of the core has this in its name; "
                    "u_pwm, for one, takes those of the PWM",
                    c.only));
  }
  std::size_t act = 0;
  for (const std::size_t n : chosen) {
    for (int k = 0; k < c.flips_per_bit; ++k) add(act++ % count, {n});
    ++act;  // the next bit starts with another act
  }
  for (int k = 0; k < c.doubles; ++k) {
    add(act++ % count, {chosen[random.below(chosen.size())], chosen[random.below(chosen.size())]});
  }
  for (int k = 0; k < c.resets; ++k) {
    add(act++ % count, {});
    faults.back().reset_clocks =
        static_cast<int>(std::pow(50'000.0, 1e-6 * random.below(1'000'001)));
  }
  return faults;
}

std::int64_t run(const StateCampaign& campaign, std::vector<StateFault> faults,
                 const std::function<void(const StateResult&)>& each) {
  std::stable_sort(faults.begin(), faults.end(), [](const StateFault& a, const StateFault& b) {
    return a.act != b.act ? a.act < b.act : a.tick < b.tick;
  });
  const auto all = acts();
  std::int64_t mismatches = 0;
  for (std::size_t n = 0; n < faults.size();) {
    const std::size_t act = faults[n].act;
    Branches branches(campaign, all[act]);
    for (; n < faults.size() && faults[n].act == act; ++n) {
      branches.to(faults[n].tick);
      each({faults[n], branches.branch(faults[n])});
    }
    mismatches += branches.mismatches();
  }
  return mismatches;
}

}  // namespace feltgate::faults
