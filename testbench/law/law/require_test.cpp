// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a law requires of its parameters: read, compiled, kept by the host. Documentation:
// docs/laws.md
#include <string>

#include "catch.hpp"
#include "law/compile.hpp"
#include "law/load.hpp"
#include "law/measure.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

Compiled compiled(const std::string& text) { return compile_text(text, "a", Target{}); }

const char* const kTwo =
    "param low = 1 Nm in 0 .. 5 Nm\n"
    "param high = 200 mNm in 0 .. 5000 mNm\n"
    "mailbox place = 0 rad in -1 .. 1 rad max_age 5 ms\n";
const char* const kOut = "\nout torque = if position < place then low else high";

std::string with(const char* requirement) { return std::string(kTwo) + requirement + kOut; }

template <class Call>
std::string told(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "done";
}

}  // namespace

TEST_CASE("require: each comparison, joined by and, a chain") {
  const Law law =
      law_of(with("require high <= low and low < 3 * high + 1 Nm require 0 <= low < 2 Nm"));
  REQUIRE(law.requirements.size() == 4);
  int strict = 0;
  for (const Requirement& r : law.requirements) strict += r.strict ? 1 : 0;
  CHECK(strict == 2);
  CHECK(law_of(with("require not low < high")).requirements.at(0).strict == false);
  CHECK(law_of(with("require not (low < high or low > 4 Nm)")).requirements.size() == 2);
}

TEST_CASE("require: only of parameters, and without a choice") {
  CHECK(messages_of(with("require low < place * 1 Nm"))
            .find("4:13: a requirement of what is no parameter; compare parameters") == 0);
  CHECK(messages_of(with("require position < 1")).find("no parameter") != std::string::npos);
  CHECK(messages_of(with("require 1 < 2")).find("no parameter") != std::string::npos);
  CHECK(messages_of(with("require low < high or low > 1 Nm")) ==
        "4:20: a requirement with a choice; write a require for each, without or");
  CHECK(messages_of(with("require low < 1 rad")).find("units differ") != std::string::npos);
  CHECK(messages_of(with("require low")).find("a condition must stand") != std::string::npos);
  CHECK(messages_of("for i in 0 .. 1 { require 1 < 2 }\nout torque = 1 Nm")
            .find("a loop holds let") != std::string::npos);
}

TEST_CASE("require: the file's own values keep it, or it is refused with its place") {
  CHECK(told([] { compiled(with("require high <= low")); }) == "done");
  CHECK(told([] {
          compiled(with("require low <= high"));
        }).find("a:4:13: the law requires low <= high, which are 1 and 0.2; give") == 0);
  CHECK(told([] { compiled(with("require low < 1 Nm")); }).find("low < 1") != std::string::npos);
}

TEST_CASE("require: the host keeps it, of all that is set together") {
  const Image image =
      read_image(text(compiled(with("require high <= low and low < 2 * high + 1 Nm")).image));
  CHECK(image.requirements.size() == 2);
  LoadedParameters p(image);
  CHECK(told([&] { p.set("low", 0.1); }).find("law a requires high <= low, which are 0.199") == 0);
  CHECK(p.value("low") == Approx(1));
  CHECK(told([&] { p.check({{"high", 1500}}); }).find("high <= low") != std::string::npos);
  CHECK(told([&] {
          p.set({{"low", 3}, {"high", 500}});
        }).find("requires low < ") != std::string::npos);
  CHECK(p.value("high") == Approx(200).epsilon(1e-3));
  CHECK(told([&] { p.set({{"low", 3}, {"high", 1500}}); }) == "done");
  CHECK(p.value("high") == Approx(1500).epsilon(1e-3));
  CHECK(told([&] { p.set("low", 1.5); }) == "done");  // equal to high, in its own steps
}

TEST_CASE("require: a material whose dynamic friction is above its static one") {
  const Image image = compile_file(FELTGATE_ROOT "/rtl/laws/material.law", Target{}).image;
  LoadedParameters p(image);
  CHECK(told([&] { p.set("dynamic", 0.5); }) ==
        "law material requires dynamic <= static, which are 0.5 and 0.4; set both to values that "
        "fit");
  CHECK(told([&] { p.set({{"dynamic", 0.5}, {"static", 0.5}}); }) == "done");
  CHECK(told([&] { p.set("dampnig", 0); })
            .find("no parameter \"dampnig\"; did you mean "
                  "\"damping\"? it has ") != std::string::npos);
  CHECK(told([&] { p.set("damping", -1); }).find("damping = -1") == 0);
  CHECK(told([&] { p.set("damping", -1); }).find("is out of its range; law material takes 0 to ") !=
        std::string::npos);
}

TEST_CASE("require: ranges end where no set can be beyond") {
  const std::string both = "param a = 1 in 0 .. 4\nparam b = 2 in -1 .. 3\n";
  const auto range = [&](const std::string& requirement, std::size_t p) {
    return law_of(both + requirement + "\nout torque = (a + b) * tau_hat").parameters.at(p).range;
  };
  CHECK(range("require a <= b", 0).upper == 3);
  CHECK(range("require a <= b", 1).lower == 0);
  CHECK(range("require a < 1.5 and 0.5 <= b", 0).upper == 1.5);
  CHECK(range("require a < 1.5 and 0.5 <= b", 1).lower == 0.5);
  CHECK(range("require a <= b and b <= 2.5", 0).upper == 2.5);
  // What the file's own values break is told, with them.
  CHECK(range("require b <= a", 1).upper == 3);
  CHECK(range("require 2 <= a", 0).lower == 1);
}

TEST_CASE("require: a difference that is required not to be below 0 is none") {
  const std::string both = "param a = 1 in 0 .. 4\nparam b = 2 in 0 .. 4\nrequire a <= b\n";
  const Compiled root =
      compiled(both + "out torque = 0.1 Nm * sqrt(b - a) * clamp(position, -1, 1)");
  const Compiled share = compiled(both + "out torque = 0.1 Nm / (b - a + 0.5)");
  for (const Compiled& c : {root, share}) {
    const Measured m = measure(c, 1, 20000, false);
    CHECK(m.output[0] <= c.bound.output[0] * (1 + 1e-9) + 1e-9);
  }
  CHECK(messages_of(both + "out torque = 0.1 Nm * sqrt(a - b)")
            .find("the square root of parameters that may be below 0") != std::string::npos);
}
