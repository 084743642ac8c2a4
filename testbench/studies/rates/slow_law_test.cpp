// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws at other rates: by the divider, and held for several runs.
#include "studies/rates/slow_law.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "law/evaluate.hpp"

using namespace feltgate;
using namespace feltgate::rates;

namespace {

const LawSource membrane{std::string(FELTGATE_ROOT) + "/rtl/laws/membrane.law", ""};

}  // namespace

TEST_CASE("a held law changes in every n-th run and is the law there") {
  const law::Law plain = read(membrane, 1e6);
  const law::Law slow = held(plain, 5, law::Target{});
  law::Evaluation<double> a(plain), b(slow);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position(0.3, 0.9);
  int pushes = 0;
  double before = 0;
  for (int run = 0; run < 5000; ++run) {
    const std::vector<double> in{position(random)};
    b.run(in);
    if (run % 5 == 0) {
      a.run(in);
      REQUIRE(b.outputs().front() == a.outputs().front());
      pushes += a.outputs().front() != 0 ? 1 : 0;
    } else {
      REQUIRE(b.outputs().front() == before);
    }
    before = b.outputs().front();
  }
  CHECK(pushes > 200);
  CHECK(pushes < 800);
}

TEST_CASE("a rate is the engine's divider, and more than its most is held") {
  const law::Target target;
  const law::Compiled fast = fastest(membrane, target);
  CHECK(fast.divider == 2);
  const law::Compiled one = at_rate(membrane, target, 1000);
  CHECK(one.divider == 1000);
  CHECK(one.rate_hz == 1000);
  CHECK(one.law.states.size() == fast.law.states.size());
  const law::Compiled two = at_rate(membrane, target, 6940);
  CHECK(two.divider == 3470);
  CHECK(two.law.states.size() == fast.law.states.size() + 2);
  CHECK(at_rate(membrane, target, 10000).divider == 2500);  // three does not divide it, four does
}

TEST_CASE("every shipped law of one axis can be held") {
  for (const char* name :
       {"wall", "ceiling", "charge", "charge_far", "damper", "detent", "spring"}) {
    CAPTURE(name);
    const LawSource law{std::string(FELTGATE_ROOT) + "/rtl/laws/" + name + ".law", ""};
    CHECK(at_rate(law, law::Target{}, 6940).divider == 3470);
    CHECK(at_rate(law, law::Target{}, 20000).divider == 4000);
  }
}

TEST_CASE("filters follow the rate; a law that counts runs is refused") {
  const LawSource filtered{"filtered", "out torque = 0.1 Nm * lowpass(position, 100 Hz)\n"};
  CHECK(at_rate(filtered, law::Target{}, 1000).rate_hz == 1000);
  const LawSource echo{"echo",
                       "rate = 10 kHz\nline past[20] in -1 .. 1\nnext past = sin(position)\n"
                       "out torque = 0.1 Nm * past[20]\n"};
  CHECK_THROWS_WITH(at_rate(echo, law::Target{}, 1000),
                    Catch::Contains("echo:2") && Catch::Contains("counts runs"));
}
