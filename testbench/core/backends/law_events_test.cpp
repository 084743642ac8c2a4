// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a law tells the host is compared in the clock in which it is told: a lock-step against an
// RTL that loses an event, makes one up, or tells another number or value. docs/architecture.md
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "Vcore_lever_law.h"
#include "catch.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "sim/backends/lock_step_backend.hpp"
#include "sim/law_loop/scene_law.hpp"

namespace feltgate {
namespace {

enum class Lie { none, lost, made_up, number, value, late };
Lie lie;

/// The RTL, but for what it says of its fourth event.
class Liar : public Vcore_lever_law {
 public:
  using Vcore_lever_law::Vcore_lever_law;
  void eval() {
    Vcore_lever_law::eval();
    if (clk_i == 0 || rst_ni == 0) return;
    const bool told = event_valid_o != 0;
    events_ += told ? 1 : 0;
    if (events_ == 4 && told) {
      if (lie == Lie::lost || lie == Lie::late) event_valid_o = 0;
      if (lie == Lie::number) event_number_o ^= 1;
      if (lie == Lie::value) event_value_o ^= 0x80000000u;
    } else if (events_ == 4 && last_told_) {
      if (lie == Lie::late || lie == Lie::made_up) event_valid_o = 1;
    }
    last_told_ = told;
  }

 private:
  int events_ = 0;
  bool last_told_ = false;
};

std::unique_ptr<SceneLaw> telling_law() {
  const auto path = std::filesystem::temp_directory_path() / "feltgate_law_events.law";
  std::ofstream(path) << "event passed(position) when position > 0.01 rad\n"
                         "event back(position) when position < 0.005 rad\nout torque = 0 Nm\n";
  return make_scene_law(path.string(), design_info<LeverLaw>());
}

/// To and fro, 40 counts each way.
std::vector<EncoderEvent> motion(Clock clocks) {
  std::vector<EncoderEvent> events;
  int phase = 0;
  for (Clock at = 60'000; at < clocks; at += 500) {
    phase += (at / 20'000) % 2 == 0 ? 1 : 3;
    events.push_back({at, {(((phase + 1) >> 1) & 1) != 0, ((phase >> 1) & 1) != 0, false}});
  }
  return events;
}

}  // namespace

TEST_CASE("the lock-step compares what a law tells, in its clock") {
  lie = GENERATE(Lie::none, Lie::lost, Lie::made_up, Lie::number, Lie::value, Lie::late);
  constexpr Clock clocks = 300'000;
  const auto engine = std::make_unique<LockStepBackend<Liar>>(design_info<LeverLaw>());
  engine->reset(3, {});
  for (const auto& [address, word] : telling_law()->load()) engine->write(address, word);
  const auto events = motion(clocks);
  engine->advance(clocks, events.data(), events.data() + events.size());
  INFO("lie " << static_cast<int>(lie) << "; " << engine->first_mismatch());
  REQUIRE(engine->law_events().size() > 8);
  CHECK(engine->mismatches() == (lie == Lie::none ? 0 : lie == Lie::late ? 2 : 1));
  CHECK((engine->first_mismatch().find(", event: rtl ") != std::string::npos) ==
        (lie != Lie::none));
}

}  // namespace feltgate
