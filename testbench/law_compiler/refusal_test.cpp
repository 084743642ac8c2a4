// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What cannot be proven, fitted or scheduled is refused with line, reason and mend.
#include <catch2/catch.hpp>

#include "law/compile.hpp"
#include "law/diagnostics.hpp"

namespace feltgate::law {
namespace {

using Catch::Matchers::Contains;

std::string refusal(const std::string& text) {
  try {
    (void)compile_text(text, "x.law", Target{});
  } catch (const LawError& e) {
    return e.what();
  }
  return "compiled";
}

TEST_CASE("a state that can leave its range is refused") {
  const std::string r = refusal(
      "state total = 0 Nm in -1 .. 1 Nm\n"
      "next total = total + 0.001 Nm\n"
      "out torque = total\n");
  CHECK_THAT(
      r, Contains("x.law:1:") && Contains("state total can leave its range") && Contains("clamp"));
}

TEST_CASE("a rate that the instructions do not fit is refused with the figures") {
  const std::string r = refusal(
      "rate = 1 MHz\n"
      "out torque = 1 Nm * sin(position) * sin(2*position) * sin(3*position)\n");
  CHECK_THAT(r, Contains("do not fit in 50:") && Contains("500000 Hz"));
}

TEST_CASE("a rate that is no part of the tick is refused") {
  CHECK_THAT(refusal("rate = 300 kHz\nout torque = 0.1 Nm * sin(position)\n"),
             Contains("is no whole part of the tick") && Contains("250000 Hz"));
}

TEST_CASE("a max_age that the engine cannot count is refused with what it can") {
  const auto aged = [](const std::string& age) {
    return refusal("mailbox push = 0 Nm in -0.1 .. 0.1 Nm max_age " + age +
                   "\nout torque = push\n");
  };
  CHECK_THAT(aged("0.1 ms"), Contains("x.law:1:") && Contains("write max_age 0.128 ms"));
  CHECK_THAT(aged("10 s"), Contains("write max_age 4194.3 ms"));
  CHECK(aged("0.128 ms") == "compiled");
  CHECK(aged("4194.3 ms") == "compiled");
}

TEST_CASE("a root of what can be negative, a division by what can be zero") {
  CHECK_THAT(refusal("out torque = 0.1 Nm * sqrt(position)\n"), Contains("x.law:1:"));
  CHECK_THAT(refusal("out torque = 0.1 Nm / position\n"), Contains("x.law:1:"));
  // The length of an arrow is never the root of less than 0.
  CHECK(refusal("let lean = clamp(position, -1, 1)\nlet twice = 2 * lean\n"
                "out torque = 0.1 Nm * clamp(sqrt(lean^2 + twice^2), 0, 1)\n") == "compiled");
}

TEST_CASE("a delay line that can leave its range, or the table memory") {
  CHECK_THAT(
      refusal("rate = 10 kHz\nline past[100] in -0.1 .. 0.1 Nm\n"
              "next past = 0.2 Nm * sin(position)\nout torque = past[100]\n"),
      Contains("x.law:2:") && Contains("line past can leave its range") && Contains("clamp"));
  CHECK_THAT(refusal("rate = 10 kHz\nline past[400] in -1 .. 1 Nm\nline more[200] in -1 .. 1 Nm\n"
                     "next past = more[3]\nnext more = 0.1 Nm * clamp(position, -1, 1)\n"
                     "out torque = past[100]\n"),
             Contains("table memory"));
}

TEST_CASE("a phase that steps by more than a turn") {
  CHECK_THAT(refusal("rate = 1 kHz\nphase a = 0 in 0 .. 1\nnext a = a + velocity * dt\n"
                     "out torque = 0.1 Nm * sin(2 * pi * a)\n"),
             Contains("x.law:2:") && Contains("more than a whole turn"));
}

}  // namespace
}  // namespace feltgate::law
