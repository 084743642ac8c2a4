// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The host's library with laws in a board's engine (the twin): loading, a cut wire, refusals,
// parameters, torque, events.
#include "catch.hpp"
#include "law_on_board.hpp"

using namespace feltgate;
using namespace feltgate::test;

TEST_CASE("host law: loaded, armed, felt, changed while it runs") {
  OnBoard b;
  CHECK(b.engine.image() == nullptr);
  const host::LoadReport r = b.engine.load(spring());
  CHECK(r.words == 1152);
  CHECK(r.written > 4);
  CHECK(b.engine.holds(spring()));
  CHECK_FALSE(b.engine.holds(damper()));
  CHECK(std::abs(b.engine.get("stiffness") - 0.25) < 1e-4);
  b.arm();
  REQUIRE(b.armed());
  CHECK(b.engine.status().crc_good);
  for (int n = 0; n < 100; ++n) b.wire->step(true);
  b.settle();
  CHECK(std::abs(b.torque() + 0.25 * 100 * count_rad) < 2e-4);

  const auto set = b.engine.set({{"stiffness", 0.5}, {"law.rest", 0.05}});
  CHECK(std::abs(set[0] - 0.5) < 1e-4);
  CHECK(std::abs(set[1] - 0.05) < 1e-4);
  b.settle();
  CHECK(std::abs(b.torque() + 0.5 * (100 * count_rad - 0.05)) < 3e-4);
  // Several sets in a row, because the banks alternate.
  CHECK(std::abs(b.engine.set({{"rest", 0}})[0]) < 1e-9);
  CHECK(std::abs(b.engine.get("stiffness") - 0.5) < 1e-4);
  b.settle();
  CHECK(std::abs(b.torque() + 0.5 * 100 * count_rad) < 3e-4);

  CHECK(told([&] { b.engine.load(damper()); }).find("disarm first") != std::string::npos);
  CHECK(b.engine.holds(spring()));
  b.device.disarm();
  CHECK(b.engine.load(damper()).written > 0);
  CHECK(b.engine.holds(damper()));
  // Loading the same law again writes nothing.
  CHECK(b.engine.load(damper()).written == 0);
  b.device.arm("law", false);
  CHECK(b.armed());
}

TEST_CASE("host law: none is loaded while the host asks for a motor that is not armed yet") {
  OnBoard b;
  b.engine.load(spring());
  // With a wrong CRC the law's check never lets the core arm.
  b.link.write(EngineMap::port_first + EngineMap::H::crc, 0);
  constexpr std::uint32_t asks = 1u << LeverLaw::C::control_host | 1u << LeverLaw::C::control_arm;
  const std::uint32_t control =
      (b.link.read(LeverLaw::C::control) & ~(0xfu << LeverLaw::C::control_scene)) |
      static_cast<std::uint32_t>(LeverLaw::S::law) << LeverLaw::C::control_scene;
  b.link.write(LeverLaw::C::control, control | asks);
  b.wire->run(20'000 * std::int64_t{LeverLaw::clocks_per_tick});
  REQUIRE_FALSE(b.armed());
  CHECK(told([&] { b.engine.load(damper()); }) ==
        "the motor is asked to arm, and its law is locked: disarm first");
  CHECK(b.engine.holds(spring()));
  // One of the two bits alone requests nothing.
  for (const int bit : {LeverLaw::C::control_host, LeverLaw::C::control_arm}) {
    b.link.write(LeverLaw::C::control, (control & ~asks) | 1u << bit);
    b.wire->run(5 * std::int64_t{LeverLaw::clocks_per_tick});
    CHECK(b.engine.load(bit == LeverLaw::C::control_host ? damper() : spring()).written > 0);
  }
}

TEST_CASE("host law: a set of which a word was dropped is not committed, and it is told") {
  OnBoard b;
  b.engine.load(spring());
  constexpr int base = EngineMap::port_first, own = EngineMap::thread_words;
  constexpr int word = base + law::Image::parameter_base;
  // Another program; a run that does not end delays its commit for some time.
  const auto program = static_cast<int>(EngineMap::H::program);
  EngineInstruction loop;
  loop.op = EngineOp::brf;
  loop.mode = 1;
  loop.b = own;
  const std::uint64_t code = engine_encode(loop);
  b.link.write(base + EngineMap::H::high, static_cast<std::uint32_t>(code >> 32));
  b.link.write(base + program + own, static_cast<std::uint32_t>(code));
  const auto meddle = [&b] {
    host::Link other(*b.wire);
    other.write(base + EngineMap::H::run, 3);
    b.wire->run(500);
    other.write(base + EngineMap::H::commit, 1);
    b.wire->run(3000);
    other.write(word, 0);
    other.write(base + EngineMap::H::run, 1);
  };
  // A word dropped earlier has no effect on the next set.
  meddle();
  REQUIRE(b.engine.status().dropped);
  CHECK(std::abs(b.engine.set({{"stiffness", 0.5}})[0] - 0.5) < 1e-4);
  CHECK_FALSE(b.engine.status().dropped);
  // The write comes in the middle of a set.
  b.wire->before_write = [&](const std::vector<std::uint8_t>& frame) {
    const bool first =
        frame.size() > 4 && frame[1] == LinkMap::kind_write && (frame[3] | frame[4] << 8) == word;
    if (!first) return;
    b.wire->before_write = nullptr;
    meddle();
  };
  CHECK(told([&] {
          b.engine.set({{"stiffness", 0.75}});
        }).find("was dropped: another program") != std::string::npos);
  CHECK_FALSE(b.wire->before_write);
  CHECK_FALSE(b.engine.status().dropped);
  CHECK(std::abs(b.engine.get("stiffness") - 0.75) > 0.1);
  CHECK(std::abs(b.engine.set({{"stiffness", 0.75}})[0] - 0.75) < 1e-4);
  CHECK(std::abs(b.engine.get("stiffness") - 0.75) < 1e-4);
}

TEST_CASE("host law: a load that is cut off at any point leaves nothing that arms") {
  std::int64_t whole = 0;
  {
    OnBoard b;
    b.wire->left = 1'000'000;
    b.engine.load(spring());
    whole = 1'000'000 - b.wire->left;
  }
  // Loads into an empty engine, and over another law.
  for (const bool over : {false, true}) {
    const int part = over ? 6 : 2;
    OnBoard b;
    if (over) b.engine.load(damper());
    b.wire->left = whole * part / 7;
    INFO("cut at " << b.wire->left << " of " << whole);
    CHECK(told([&] { b.engine.load(spring()); }) == "wire: cut");
    b.wire->left = -1;
    host::Link again(*b.wire);
    host::Device device(again, host::read_board(again), elaborated<LeverLaw>());
    device.set("self_test_pulse", 0);
    LawEngine engine(device);
    const bool old = over && engine.holds(damper());
    const std::string refused = told([&] { device.arm("law", false); });
    if (old) {
      // No word of the new law had arrived: the old law is there, stopped.
      CHECK(b.torque() == 0);
    } else {
      CHECK(refused.find("CRC does not hold") != std::string::npos);
      CHECK_FALSE(b.armed());
    }
    device.disarm();
    engine.load(spring());
    device.arm("law", false);
    CHECK(b.armed());
  }
}

TEST_CASE("host law: bytes lost on the way are seen and sent again") {
  OnBoard b;
  b.wire->lost = 0.004;
  const host::LoadReport r =
      b.engine.load(compiled("param a = 0.05 Nm in 0 .. 0.5 Nm\n"
                             "out torque = -a * sin(24 * position)\n"));
  b.wire->lost = 0;
  CHECK(r.rounds > 1);
  b.arm();
  CHECK(b.armed());
}

TEST_CASE("host law: names, units and ranges of parameters") {
  OnBoard b;
  CHECK(told([&] { b.engine.set({{"stiffness", 1}}); }).find("no law") == 0);
  b.engine.load(spring());
  const law::ImageWord& rest = *b.engine.find("rest");
  CHECK(b.engine.find("law.rest") == &rest);
  CHECK(b.engine.find("reste") == nullptr);
  CHECK(b.engine.parameters().size() == 2);
  CHECK(std::abs(b.engine.value_in(rest, "10deg") - 0.174533) < 1e-6);
  CHECK(b.engine.value_in(rest, "0.5 rad") == 0.5);
  CHECK(b.engine.value_in(rest, "0.5") == 0.5);
  const law::ImageWord& stiffness = *b.engine.find("stiffness");
  CHECK(b.engine.value_in(stiffness, "50mNm/rad") == Approx(0.05));
  CHECK(told([&] { b.engine.value_in(rest, "1 Nm"); }) ==
        "rest: 1 Nm is not in rad; give it in rad");
  CHECK(told([&] { b.engine.value_in(rest, "far"); }).find("is no number") != std::string::npos);
  CHECK(told([&] { b.engine.value_in(rest, "2rad"); }).find("out of its range") !=
        std::string::npos);
  CHECK(told([&] { b.engine.get("clicks"); }).find("it has ") != std::string::npos);
  // If one of two values is out of range, neither is set.
  CHECK(told([&] { b.engine.set({{"rest", 0.5}, {"stiffness", 7}}); }).find("stiffness = 7") == 0);
  CHECK(b.engine.get("rest") == 0);
}

TEST_CASE("host law: the board refuses a set with a word out of its range, and says which") {
  OnBoard b;
  law::Image wrong = spring();
  const law::ImageWord& word = wrong.words.front();
  // The board has a narrower range than the image; the host does not know it.
  b.engine.load(spring());
  const int upper = EngineMap::H::data + law::Image::upper_base + word.word;
  b.link.write(EngineMap::port_first + upper, 100);
  const double before = b.engine.get(word.name);
  CHECK(told([&] {
          b.engine.set({{word.name, 0.5}});
        }) == "the board refused the set: " + word.name + " is out of its range");
  CHECK(b.engine.get(word.name) == before);
}

TEST_CASE("host law: events by name, each once, whatever is lost on the way") {
  OnBoard b;
  b.engine.load(spring());
  b.arm();
  CHECK_FALSE(b.engine.event());
  const auto swing = [&](int counts) {
    for (int n = 0; n < std::abs(counts); ++n) b.wire->step(counts > 0);
  };
  swing(10);
  swing(-20);
  swing(20);
  b.wire->lost = 0.01;
  std::vector<host::LawEvent> all;
  while (const auto e = b.engine.event()) all.push_back(*e);
  b.wire->lost = 0;
  REQUIRE(all.size() == 3);
  CHECK(all[0].name == "beyond");
  CHECK(all[1].name == "below");
  CHECK(all[2].name == "beyond");
  CHECK(all[0].value > 0.01);
  CHECK(all[0].value < 0.016);  // the lever moves some counts during a run
  CHECK(all[0].tick < all[1].tick);
  CHECK(all[1].tick < all[2].tick);
  CHECK(b.engine.events_lost() == 0);
  for (int n = 0; n < 10; ++n) swing(-20), swing(20);
  (void)b.engine.event();
  CHECK(b.engine.events_lost() == 4);
}

TEST_CASE(
    "host law: an event of a name triggers the capture in its tick, wherever in it it comes") {
  // Events that never come make the run longer: the one that counts comes in another clock of a
  // tick, and from some number on two ticks or more after the inputs.
  OnBoard b;
  for (const int longer : {0, 7}) {
    std::string text =
        "param stiffness = 0.1 Nm/rad in 0 .. 1 Nm/rad\n"
        "event beyond(position) when position > 0.01\n";
    for (int k = 0; k < longer; ++k)
      text += fmt::format("event never{0}(position) when position > {1}\n", k, 100 + k);
    const law::Image image = compiled(
        text + "event below(velocity) when position < -0.01\nout torque = -stiffness * position\n");
    b.device.disarm();
    b.engine.load(image);
    b.arm();
    const auto swing = [&](int counts) {
      for (int n = 0; n < std::abs(counts); ++n) b.wire->step(counts > 0);
    };
    swing(10), swing(-10);
    while (b.engine.event()) continue;
    for (const char* trigger : {"event:below", "event"}) {
      host::CaptureSetup s;
      s.quantities = {"tick"};
      s.rows_before = 5;
      s.trigger = host::parse_trigger(b.device, &b.engine, trigger);
      host::start_capture(b.device, s);
      const bool any = s.trigger.text == "event";
      swing(10);
      CHECK((host::capture_state(b.device) != 2) == any);
      swing(-20), swing(10);
      b.wire->run(1100 * std::int64_t{LeverLaw::clocks_per_tick});
      REQUIRE(host::capture_state(b.device) == 4);
      // Reads only the tick in the row of the trigger.
      const auto row = b.link.read(LinkMap::A::capture_first) + 5;
      const int at = static_cast<int>(LinkMap::memory + row % (1U << LinkMap::rows_log2) * 8);
      const std::uint32_t tick = b.link.read(at);
      const auto beyond = b.engine.event(), below = b.engine.event();
      REQUIRE(below);
      CHECK(below->name == "below");
      INFO(longer << " longer, " << trigger);
      CHECK(tick == (any ? beyond : below)->tick);
      CHECK_FALSE(b.engine.event());
    }
  }
}

TEST_CASE("host law: what is no event, and what law is meant, is said") {
  OnBoard b;
  const auto trigger = [&](const char* text) {
    return told([&] { host::parse_trigger(b.device, &b.engine, text); });
  };
  CHECK(trigger("event:beyond").find("is not known here") != std::string::npos);
  CHECK(trigger("event") == "nothing");
  b.engine.load(spring());
  CHECK(trigger("event:beyond") == "nothing");
  CHECK(trigger("event:beyon").find("did you mean \"beyond\"? choose from beyond, below") !=
        std::string::npos);
  b.engine.load(damper());
  CHECK(trigger("event:beyond").find("damper tells no events") != std::string::npos);
}

TEST_CASE("host law: a law is known again when the port is opened again") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "feltgate_host_law_test";
  fs::remove_all(folder);
  OnBoard b;
  b.engine.load(spring());
  b.engine.set({{"rest", 0.25}});
  LawEngine other(b.device);
  CHECK_FALSE(other.recognise(folder.string()));
  host::keep_law(folder.string(), damper());
  CHECK_FALSE(other.recognise(folder.string()));
  CHECK(told([&] { other.attach(damper()); }).find("does not run the law damper") !=
        std::string::npos);
  host::keep_law(folder.string(), spring());
  REQUIRE(other.recognise(folder.string()));
  CHECK(other.image()->name == "spring");
  CHECK(std::abs(other.get("rest") - 0.25) < 1e-4);
  // Another program with the same numbers must not be taken for this one.
  law::Image twisted = spring();
  twisted.program[0] ^= std::uint64_t{1} << 32;
  CHECK_FALSE(other.holds(twisted));
  fs::remove_all(folder);
}

TEST_CASE("host law: a board without engine, an image of another design") {
  OnWire<Lever> plain;
  CHECK_FALSE(plain.device.board().has_engine);
  CHECK(told([&] { LawEngine none(plain.device); }).find("design lever has no engine") !=
        std::string::npos);
  OnBoard b;
  law::Image other = spring();
  other.design = "lever";
  CHECK(told([&] { b.engine.load(other); }).find("compiled for design lever") != std::string::npos);
  CHECK_THROWS_AS(b.engine.load(other), std::invalid_argument);
  law::Image two = spring();
  two.outputs.push_back({"other", 1});
  CHECK(told([&] {
          b.engine.load(two);
        }).find("a torque for axis 1, and this board has one axis") != std::string::npos);
}
