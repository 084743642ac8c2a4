// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The compiler refuses laws that it cannot prove, fit or schedule. The message has the line, the
// reason and a correction.
#include <catch2/catch.hpp>

#include "law/compile.hpp"
#include "law/diagnostics.hpp"
#include "law/listing.hpp"

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

TEST_CASE("more constants and parameter words than fit are refused at the first beyond") {
  // Each term has a frequency and a phase of its own; the first `params` phases are parameters.
  const auto law = [](int terms, int params) {
    std::string text, sum;
    for (int i = 0; i < params; ++i) {
      text += "param p" + std::to_string(i) + " = 0." + std::to_string(i + 101) + " in 0 .. 1\n";
    }
    for (int i = 0; i < terms; ++i) {
      sum += (i == 0 ? "" : "\n+ ") + std::string("sin(") + std::to_string(i + 1) +
             " * position + " +
             (i < params ? "p" + std::to_string(i) : "0." + std::to_string(i + 101)) + ")";
    }
    return text + "out torque = 1 mNm * (" + sum + ")\n";
  };
  const std::string r = refusal(law(35, 0));
  CHECK_THAT(r, Contains("constants, 64 fit, and here is the first that does not; write ") &&
                    Contains(" of its numbers as a param each") &&
                    Contains("32 of 32 words are free"));
  CHECK_THAT(r, !Contains("x.law:1:"));
  CHECK(refusal(law(35, 8)) == "compiled");
  CHECK_THAT(refusal(law(35, 33)), Contains("x.law:") && !Contains("x.law:1:") &&
                                       Contains("parameter words, 32 fit; write some"));
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

TEST_CASE("a rate of the file stands: no second one, and none below its use") {
  const std::string torque = "out torque = -0.1 Nm * clamp(position, -1, 1)\n";
  CHECK(refusal("rate = 1 kHz\nrate = 2 kHz\n" + torque) == "x.law:2:1: a second rate; write one");
  CHECK(refusal("rate = 1 kHz\nrate = 1 kHz\n" + torque) == "x.law:2:1: a second rate; write one");
  const std::string above = "dt and filters need a rate; write above: rate = 40 kHz";
  CHECK(refusal("out torque = -0.1 Nm * lowpass(clamp(position, -1, 1), 10 Hz)\nrate = 1 kHz\n") ==
        "x.law:1:24: " + above);
  CHECK(refusal("out torque = 1 Nm * velocity * dt\nrate = 2 kHz\n") == "x.law:1:32: " + above);
  CHECK(compile_text("rate = 2 kHz\n" + torque, "x.law", Target{}).rate_hz == 2000);
}

TEST_CASE("without a rate, dt and filters take the fastest, and the answer says so") {
  const auto answer = [](const std::string& text) {
    const Compiled c = compile_text(text, "x.law", Target{});
    return report(c, measure(c, 1, 10));
  };
  const std::string torque = "out torque = 0.1 Nm * lowpass(clamp(position, -1, 1), 10 Hz)\n";
  const std::string says = "the file says no rate: this is the fastest";
  CHECK_THAT(answer(torque), Contains(" 500000 Hz\n" + says));
  CHECK_THAT(answer("rate = 2 kHz\n" + torque), !Contains(says));
  CHECK_THAT(answer("out torque = tau_hat\n"), !Contains(says));
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

TEST_CASE("a root of what can be negative, a division by what can be zero, a log of either") {
  CHECK_THAT(refusal("out torque = 0.1 Nm * log(abs(position))\n"),
             Contains("x.law:1:") && Contains("log of what can be 0; limit it, e.g. log(max("));
  CHECK_THAT(refusal("out torque = 0.1 Nm * log(clamp(position, -1, 1))\n"),
             Contains("log of what can be -1;"));
  CHECK_THAT(refusal("out torque = 0.1 Nm * sqrt(position)\n"), Contains("x.law:1:"));
  CHECK_THAT(refusal("out torque = 0.1 Nm / position\n"), Contains("x.law:1:"));
  // The length of a vector is never the root of a negative number.
  CHECK(refusal("let lean = clamp(position, -1, 1)\nlet twice = 2 * lean\n"
                "out torque = 0.1 Nm * clamp(sqrt(lean^2 + twice^2), 0, 1)\n") == "compiled");
}

TEST_CASE("a root of what ends at 0 exactly: products, squares and quotients keep their sign") {
  const auto root_of = [](const std::string& x) {
    return refusal(
        "param c = 0.5 in 0 .. 1\nlet a = min(abs(position), 1)\nlet b = clamp(velocity / "
        "(1 rad/s), 0, 1)\nout torque = 0.1 Nm * sqrt(" +
        x + ") + 0 * c * a * b * 1 Nm\n");
  };
  CHECK(refusal("out torque = sqrt(0.01 Nm^2 * min(abs(position), 1))\n") == "compiled");
  CHECK(refusal("let a = min(abs(position), 1)\nlet b = max(-1, -abs(position))\n"
                "out torque = 0.1 Nm * sqrt(-a * b)\n") == "compiled");
  CHECK(root_of("a * b") == "compiled");
  CHECK(root_of("c * a") == "compiled");
  CHECK(root_of("a^3 + b^2") == "compiled");
  CHECK(root_of("c * a * b + 2 * a") == "compiled");
  CHECK_THAT(root_of("a * b - 0.001"), Contains("sqrt of what can be -0.001"));
  CHECK_THAT(root_of("a * (b - 1e-9)"), Contains("sqrt of what can be -1e-09"));
}

TEST_CASE("what does not fit is told with its line, its range and the mend") {
  const std::string ends = "a word with the step 1.53e-05 holds -32768 .. 32768 Nm; ";
  const std::string limit = "limit it with clamp, or narrow the ranges of parameters and states";
  CHECK_THAT(refusal("let x = position\nout torque = 100 Nm * x^8\n"),
             Contains("x.law:2:21: this value goes over 0 .. ") &&
                 Contains(" Nm and does not fit: " + ends + limit));
  CHECK_THAT(refusal("out torque = 1 Nm * exp(position)\n"),
             Contains("x.law:1:19: 1*exp(position) goes over ") && Contains(ends + limit));
  CHECK(refusal("out torque = 40000 Nm\n") ==
        "x.law:1:14: 40000 Nm does not fit: " + ends + "write a smaller number");
  CHECK(refusal("param a = 3 Nm in 0 .. 1e6 Nm\nout torque = a\n") ==
        "x.law:1:7: a goes over 0 .. 1e+06 Nm and does not fit: " + ends + limit);
  CHECK_THAT(
      refusal("rate = 10 kHz\nline past[10] in -1 .. 1\nnext past = position\n"
              "out torque = 1 Nm * past[3]\n"),
      Contains("x.law:2:6: line past can leave its range -1 .. 1: its next value can be -2") &&
          Contains("write clamp(..., -1, 1), or give it a larger range"));
}

TEST_CASE("a larger range is a mend only where one holds, and then it is told") {
  const auto leaves = [](const std::string& next) {
    return refusal("rate = 10 kHz\nstate x = 0 in 0 .. 10\nnext x = " + next +
                   "\nout torque = 0.01 Nm * x\n");
  };
  const auto mend_of = [](const std::string& said) {
    const std::string before = "give it a larger range: ";
    const std::size_t at = said.find(before);
    return at == std::string::npos ? "" : said.substr(at + before.size());
  };
  for (const char* next : {"abs(position)", "0.999 * x + 0.1"}) {
    INFO(next);
    const std::string said = leaves(next), range = mend_of(said);
    CHECK_THAT(said, Contains("end with clamp(..., 0, 10), or "));
    REQUIRE(!range.empty());
    CHECK(refusal("rate = 10 kHz\nstate x = 0 in " + range + "\nnext x = " + next +
                  "\nout torque = 0.01 Nm * x\n") == "compiled");
  }
  for (const char* next : {"x + abs(position)", "2 * x", "x + 1"}) {
    INFO(next);
    CHECK_THAT(leaves(next), Contains(", and in a larger range still more; end with clamp(..., 0, "
                                      "10)") &&
                                 !Contains("or give"));
  }
}

TEST_CASE("a state that leaves its range by little: with the digits that show it") {
  const std::string r = refusal(
      "state q = 0 in 0 .. 1\nnext q = min(q + 0.000001, 1.000001)\nout torque = 1 Nm * q\n");
  CHECK_THAT(r, Contains("state q can leave its range 0 .. 1: its next value can be 1.0000"));
}

TEST_CASE("a value that its word does not hold is told") {
  const Compiled c =
      compile_text("param a = 1 in 0 .. 1e12\nout torque = 1 Nm * clamp(a * position, -1, 1)\n",
                   "a.law", Target{});
  CHECK_THAT(report(c, measure(c, 1, 10)),
             Contains("warning: a: 1 of the file becomes 0; its step is 8.54e+07: narrow its "
                      "range, or give it a value of 4.27e+08 or more\n"));
}

TEST_CASE("a filter whose frequency may be 0 is told how to begin above it") {
  const std::string law = "rate = 10 kHz\nparam f = 100 Hz in 0 .. 3000 Hz\nout torque = 0.1 Nm * ";
  CHECK_THAT(refusal(law + "lowpass(clamp(position, -1, 1), f)\n"),
             Contains("keep the filter's frequency above 0, e.g. max(..., 10 Hz)"));
  CHECK(refusal(law + "lowpass(clamp(position, -1, 1), max(f, 10 Hz))\n") == "compiled");
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
