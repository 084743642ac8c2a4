// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The back-ends of the benchmark. Documentation: docs/speed-for-accuracy.md
#include "studies/bench/runner.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "feltgate/generated/lever.hpp"
#include "sim/backends/clocked_backend.hpp"
#include "sim/reference/chain.hpp"

namespace feltgate::bench {

namespace {

/// Runs a chain without pins, tick by tick on sampled counts. All chains run in the same loop, so
/// that only the arithmetic differs. `Access` adapts a chain: write(chain, TickWrite) writes to it,
/// show(chain) returns a tick.
template <class Chain, class Access>
class TickRunner : public Runner {
 public:
  TickRunner(const char* name, Arithmetic arithmetic, std::unique_ptr<Chain> chain)
      : Runner(name, arithmetic), chain_(std::move(chain)) {}

  void prepare(const Work&) override { chain_->reset(); }
  void run(const Work& work) override {
    each_tick(work, [](Chain& chain) {
      // Forces the results into memory after each tick, as if somebody read them.
      asm volatile("" : : "r"(&chain) : "memory");
    });
  }
  void inspect(const Work& work, const Inspector& each) override {
    prepare(work);
    each_tick(work, [&each](Chain& chain) { each(Access::show(chain)); });
  }

 private:
  template <class After>
  void each_tick(const Work& work, After&& after) {
    Chain& chain = *chain_;
    std::size_t tick = 0;
    const auto until = [&](std::size_t end) {
      for (; tick < end; ++tick) {
        chain.tick(work.ticks[tick]);
        after(chain);
      }
    };
    for (const Work::TickWrite& w : work.writes) {
      until(w.tick);
      Access::write(chain, w);
    }
    until(work.ticks.size());
  }

  std::unique_ptr<Chain> chain_;
};

double torque_constant() {
  for (const ParameterInfo& p : Lever::parameters) {
    if (p.address == Lever::A::torque_constant) return p.si;
  }
  throw std::logic_error("the design has no torque constant");
}

/// The laws in policy N.
template <class N>
struct Laws {
  static void write(Chain<N>& chain, const Work::TickWrite& w) {
    if constexpr (N::is_fixed) {
      chain.set_word(w.address, w.data);
    } else {
      chain.set_parameter(w.address, w.value);
    }
  }
  static TickResult show(const Chain<N>& chain) {
    const ChainOut& out = chain.out();
    TickResult r;
    if (const ChainRaw* raw = chain.raw()) {
      r.raw = {raw->velocity, raw->tau_hat, raw->tau_ref, raw->current_ref,
               raw->voltage,  raw->duty,    raw->limits};
    }
    r.velocity_rad_s = out.velocity_rad_s;
    r.tau_hat_nm = out.tau_hat_nm;
    r.torque_nm = torque_constant() * out.current_a;
    return r;
  }
};

template <class N>
std::unique_ptr<Runner> laws(const char* name) {
  return std::make_unique<TickRunner<Chain<N>, Laws<N>>>(
      name, N::is_fixed ? Arithmetic::integer : Arithmetic::real,
      std::make_unique<Chain<N>>(name, design_info<Lever>()));
}

struct Known {
  const char* name;
  std::unique_ptr<Runner> (*make)(const char* name);
};

std::unique_ptr<Runner> pins(const char* name) { return make_pin_runner(name); }

constexpr Known known[] = {
    {"rtl", pins},
    {"twin_clock", pins},
    {"twin_event", pins},
    {"twin_tick", laws<axis::Fixed>},
    {"double", laws<axis::Real<double>>},
    {"float", laws<axis::Real<float>>},
    {"quad", laws<axis::Real<Quad>>},
};

}  // namespace

std::vector<std::string> runner_names() {
  std::vector<std::string> names;
  for (const Known& k : known) names.emplace_back(k.name);
  return names;
}

std::unique_ptr<Runner> make_runner(const std::string& name) {
  std::string list;
  for (const Known& k : known) {
    if (name == k.name) return k.make(k.name);
    list += (list.empty() ? "" : ", ") + std::string(k.name);
  }
  throw std::invalid_argument("engine \"" + name + "\" is unknown; choose among " + list);
}

// Back-ends with pins and a clock.

namespace {

/// The twin in every clock, as lock-step runs it.
class ClockByClock : public ClockedBackend {
 public:
  ClockByClock() : ClockedBackend(design_info<Lever>()) {}
  const char* name() const override { return "twin_clock"; }
  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    ClockedBackend::run(clocks, first, last, [this](const CoreIn& in) {
      core_.clock(in);
      note(core_.out());
      if (last_.snapshot_valid) keep(last_, core_.sampled_travel(), core_.writes());
    });
  }

 private:
  void reset_core(std::uint64_t, EncoderPins) override { core_ = FeltgateCore(info_.data); }
  FeltgateCore core_{info_.data};
};

}  // namespace

void PinRunner::inspect(const Work& work, const Inspector& each) {
  const DesignInfo& d = backend_->design();
  const auto si = [](std::int64_t raw, Format f) {
    return std::ldexp(static_cast<double>(raw), -f.fraction);
  };
  prepare(work);
  TickResult r;
  play(*backend_, work.inputs, [&](const Snapshot& s) {
    r.raw = {s.velocity,
             s.tau_hat,
             s.tau_ref,
             s.current_ref,
             s.voltage,
             s.duty,
             s.limits & ~limits_of_core};
    r.velocity_rad_s = si(s.velocity, d.velocity);
    r.tau_hat_nm = si(s.tau_hat, d.torque);
    r.torque_nm = d.torque_constant_nm_a * si(s.current_ref, d.current);
    each(r);
  });
}

std::unique_ptr<Runner> make_pin_runner(const std::string& name) {
  if (name == "rtl") return std::make_unique<PinRunner>("rtl", make_backend("lever", "rtl"));
  if (name == "twin_clock") {
    return std::make_unique<PinRunner>("twin_clock", std::make_unique<ClockByClock>());
  }
  if (name == "twin_event") {
    return std::make_unique<PinRunner>("twin_event", make_backend("lever", "twin"));
  }
  throw std::invalid_argument("there is no back-end with pins named " + name);
}

}  // namespace feltgate::bench
