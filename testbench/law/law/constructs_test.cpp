// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Each construct of the language: what it computes. Documentation: docs/laws.md
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "law/derive.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

/// The value of a number without unit.
double value_at(const std::string& e, double x = 0) {
  return torque_of("rate = 1 kHz\nout torque = 1 Nm * (" + e + ")", x);
}

}  // namespace

TEST_CASE("operators bind as in mathematics") {
  CHECK(value_at("1 + 2 * 3") == 7);
  CHECK(value_at("(1 + 2) * 3") == 9);
  CHECK(value_at("2 - 3 - 4") == -5);
  CHECK(value_at("8 / 4 / 2") == 1);
  CHECK(value_at("-2^2") == -4);
  CHECK(value_at("(-2)^2") == 4);
  CHECK(value_at("2 * -position", 3) == -6);
  CHECK(value_at("- - position", 3) == 3);
  CHECK(value_at("+position", 3) == 3);
  CHECK(value_at("position^3", 2) == 8);
  CHECK(value_at("position^-2", 2) == 0.25);
  CHECK(value_at("position^8", -2) == 256);
  CHECK(value_at("1e-3 + .5 + 2.5E1") == Approx(25.501));
  CHECK(value_at("position - 1", 4) == 3);
  CHECK(value_at("2 / position", 4) == 0.5);
  CHECK(value_at("position / position^2", 4) == 0.25);
}

TEST_CASE("functions") {
  CHECK(value_at("min(position, 2, 3)", 5) == 2);
  CHECK(value_at("max(position, 2, 3)", 5) == 5);
  CHECK(value_at("clamp(position, -1, 1)", 5) == 1);
  CHECK(value_at("clamp(position, -1, 1)", -5) == -1);
  CHECK(value_at("clamp(position, -1, 1)", 0.5) == 0.5);
  CHECK(value_at("abs(position)", -5) == 5);
  CHECK(value_at("sgn(position)", -5) == -1);
  CHECK(value_at("sgn(position)", 0) == 1);
  CHECK(value_at("sin(position)", 1000) == Approx(std::sin(1000.0)));
  CHECK(value_at("cos(position)", 2) == Approx(std::cos(2.0)));
  CHECK(value_at("sqrt(position)", 2) == Approx(std::sqrt(2.0)));
  CHECK(value_at("log(position)", 3) == Approx(std::log(3.0)));
  CHECK(value_at("exp(position)", -2) == Approx(std::exp(-2.0)));
  CHECK(value_at("pi") == Approx(kPi));
  CHECK(value_at("sin(pi / 6) + cos(0) + sqrt(4) + exp(0) + log(exp(1))") == Approx(5.5));
}

TEST_CASE("atan2") {
  const auto angle = [](const std::string& y, double x) {
    return value_at("atan2(" + y + ", clamp(position, -1, 1))", x);
  };
  for (const double x : {-1.0, -0.5, -0.03, 0.0, 0.02, 0.25, 1.0}) {
    for (const double y : {-1.0, -0.25, 0.25, 0.6, 1.0}) {
      CHECK(angle(std::to_string(y), x) == Approx(std::atan2(y, x)));
    }
    if (x != 0) CHECK(angle("0", x) == Approx(std::atan2(0.0, x)).margin(1e-12));
  }
  // Below 1/128 of both ranges it goes to a right angle.
  CHECK(angle("0", 0) == Approx(kPi / 2));
  CHECK(angle("0", 1.0 / 256) == Approx(std::atan2(0.5, 0.5)));
  CHECK(value_at("atan2(-1, -1) + atan2(0, 0)") == Approx(-kPi / 4));
}

TEST_CASE("floor and mod") {
  for (const double x : {-4.5, -2.0, -0.25, 0.0, 0.75, 3.0, 4.99}) {
    CHECK(value_at("floor(clamp(position, -5, 5))", x) == std::floor(x));
    CHECK(value_at("floor(2 * clamp(position, -5, 5) + 0.5)", x) == std::floor(2 * x + 0.5));
    CHECK(value_at("mod(clamp(position, -5, 5), 1.5)", x) == Approx(x - 1.5 * std::floor(x / 1.5)));
    CHECK(value_at("mod(clamp(position, -5, 5), 90 deg) / 90 deg", x) ==
          Approx(2 * x / kPi - std::floor(2 * x / kPi)));
  }
  CHECK(value_at("floor(2.7) + floor(-2.7)") == -1);
  CHECK(value_at("floor(clamp(position, 0, 5))", 9) == 5);
  for (const int n : {-7, -3, -1, 0, 2, 5, 9}) {
    const std::string state =
        "state n = " + std::to_string(n) + " in -9 .. 9 whole\nnext n = n\nout torque = 1 Nm * ";
    CHECK(torque_of(state + "mod(n, 3)") == n - 3 * std::floor(n / 3.0));
    CHECK(torque_of(state + "(if mod(n, 3) == 2 then 1 else 0)") == (n + 9) % 3 / 2);
    CHECK(torque_of(state + "floor(n)") == n);
  }
  // 49 times 1/49 is less than 1.
  CHECK(torque_of("state n = 49 in 0 .. 98 whole\nnext n = n\nout torque = 1 Nm * mod(n, 49)") ==
        0);
}

TEST_CASE("round: halves go up, as floor(x + 0.5)") {
  for (const double x : {-2.51, -2.5, -0.5, -0.49, 0.0, 0.49, 0.5, 1.5, 2.49, 9.0}) {
    CHECK(value_at("round(clamp(position, -5, 5))", x) ==
          std::floor(std::clamp(x, -5.0, 5.0) + 0.5));
  }
  CHECK(value_at("round(2.5) + 10 * round(-2.5)") == -17);
  CHECK(torque_of("param n = 3 in 0 .. 9 whole\nout torque = 1 Nm * round(n)") == 3);
  CHECK(torque_of("let round = 2\nlet time = 3\nout torque = 1 Nm * round * time") == 6);
}

TEST_CASE("time: since the scene began, exact in every run, until its last one") {
  Running<> law(
      law_of("rate = 10 kHz\nout torque = 1 Nm * time / (1 s) + tau_hat * "
             "(if time > 0.25 ms then 1 else 0)"));
  CHECK(law.law().states.size() == 1);
  for (int n = 0; n < 5; ++n) {
    CHECK(law.torque({{"tau_hat", 1}}) == Approx(n * 1e-4 + (n > 2 ? 1 : 0)));
  }
  law.evaluation().reset();
  CHECK(law.torque({}) == 0);
  law.evaluation().set_state(0, 2e9);
  CHECK(law.torque({}) == Approx(2e5));
  CHECK(law.torque({}) == Approx(2e5));
}

TEST_CASE("names that nothing uses are noted, in the order of the file, each once") {
  const Law law = law_of(
      "param z = 1 in 0 .. 2\nlet used = 1\nfor i in 0 .. 2 { let a = i }\n"
      "table b(x) on [0, 1] = x\nout torque = used * tau_hat");
  REQUIRE(law.unused.size() == 3);
  CHECK(law.unused[0].name == "z");
  CHECK(law.unused[1].name == "a");
  CHECK(law.unused[1].place.line == 3);
  CHECK(law.unused[2].name == "b");
  CHECK(law_of("let used = 1\nout torque = used * tau_hat").unused.empty());
}

TEST_CASE("noise: even from -1 to 1, without an echo, another for each seed") {
  constexpr int runs = 1 << 16;
  const auto row = [](int seed) {
    Running<> law(law_of("out torque = 1 Nm * noise(" + std::to_string(seed) + ") + 0 * tau_hat"));
    std::vector<double> all;
    for (int i = 0; i < runs; ++i) all.push_back(law.torque({}));
    return all;
  };
  const auto together = [](const std::vector<double>& a, const std::vector<double>& b, int later) {
    double sum = 0;
    for (std::size_t i = 0; i + static_cast<std::size_t>(later) < a.size(); ++i) {
      sum += a[i] * b[i + static_cast<std::size_t>(later)];
    }
    return 3 * sum / runs;  // 1 of a row with itself
  };
  const std::vector<double> first = row(1);
  for (const int seed : {0, 1, 2, 77, 9999}) {
    const std::vector<double> one = row(seed);
    std::vector<int> counts(16);
    for (const double x : one) {
      REQUIRE(-1 <= x);
      REQUIRE(x < 1);
      ++counts[static_cast<std::size_t>((x + 1) * 8)];
    }
    for (const int c : counts) CHECK(c == Approx(runs / 16).epsilon(0.1));
    CHECK(together(one, one, 0) == Approx(1).epsilon(0.02));
    for (int later = 1; later < 300; ++later) CHECK(std::fabs(together(one, one, later)) < 0.05);
    if (seed != 1) CHECK(std::fabs(together(first, one, 0)) < 0.05);
  }
  Running<> twice(law_of("out torque = 1 Nm * (noise(3) - noise(3)) + tau_hat"));
  CHECK(twice.law().states.size() == 2);
}

TEST_CASE("conditions") {
  const auto truth = [](const std::string& c, double x) {
    return value_at("if " + c + " then 1 else 0", x);
  };
  CHECK(truth("position < 1", 1) == 0);
  CHECK(truth("position <= 1", 1) == 1);
  CHECK(truth("position > 1", 1) == 0);
  CHECK(truth("position >= 1", 1) == 1);
  CHECK(truth("0 < position < 1", 0.5) == 1);
  CHECK(truth("0 < position < 1", 1.5) == 0);
  CHECK(truth("0 < position < 1", -0.5) == 0);
  CHECK(truth("0 < position <= 1 < 3", 1) == 1);
  CHECK(truth("position < 1 or position > 2 and position < 3", 0) == 1);
  CHECK(truth("(position < 1 or position > 2) and position > 0.5", 0) == 0);
  CHECK(truth("not position < 1 and position < 2", 1.5) == 1);
  CHECK(truth("not (position < 1 and position < 2)", 1.5) == 1);
  CHECK(truth("not not position < 1", 0) == 1);
  CHECK(truth("if position < 1 then position < 0 else position > 2", -1) == 1);
  CHECK(truth("if position < 1 then position < 0 else position > 2", 1.5) == 0);
  const auto counted = [](const std::string& c, int n) {
    return torque_of("param p = 3 in -5 .. 5 whole\nstate n = " + std::to_string(n) +
                     " in -9 .. 9 whole\nnext n = n\nout torque = 1 Nm * (if " + c +
                     " then 1 else p - p)");
  };
  for (const int n : {2, 3, 4, -3}) {
    CHECK(counted("n == 3", n) == (n == 3));
    CHECK(counted("n != 3", n) == (n != 3));
    CHECK(counted("p == n", n) == (n == 3));
    CHECK(counted("not n == p", n) == (n != 3));
    CHECK(counted("abs(-n) + 1 == 2 * min(p, 2)", n) == (n * n == 9));
    CHECK(counted("0 < n == p", n) == (n == 3));
    CHECK(counted("n == p < 4", n) == (n == 3));
  }
  const auto held = [](const std::string& c, bool b, double x) {
    return torque_of("bool b = " + std::string(b ? "true" : "false") +
                         "\nnext b = b\nbool d = true\nnext d = d\nout torque = 1 Nm * (if " + c +
                         " then 1 else 0 * position)",
                     x);
  };
  for (const bool b : {false, true}) {
    for (const double x : {-1.0, 1.0}) {
      CHECK(held("b == d", b, x) == b);
      CHECK(held("b != d", b, x) == !b);
      CHECK(held("b == (position > 0)", b, x) == (b == (x > 0)));
      CHECK(held("(position > 0) != b", b, x) == (b != (x > 0)));
      CHECK(held("not b == true", b, x) == !b);
      CHECK(held("false != b", b, x) == b);
      CHECK(held("(b and position > 0) == (d or position < 0)", b, x) == (b && x > 0));
      CHECK(held("b == d == (position > 0)", b, x) == (b && x > 0));
      CHECK(held("b == b", b, x) == 1);
    }
  }
  CHECK(value_at("if position < 0 then -1 else if position < 1 then 0 else 1", 0.5) == 0);
  CHECK(value_at("2 * (if position < 0 then 3 else 4)", -1) == 6);
}

TEST_CASE("units scale, and 0 has any") {
  const auto value = [](const std::string& e, const std::string& unit) {
    return torque_of("out torque = (" + e + ") / (1 " + unit + ") * 1 Nm");
  };
  CHECK(value("250 mm", "m") == Approx(0.25));
  CHECK(value("3 um", "m") == Approx(3e-6));
  CHECK(value("2 kg m^2", "kg m^2") == 2);
  CHECK(value("5 g", "kg") == Approx(5e-3));
  CHECK(value("90 deg", "rad") == Approx(kPi / 2));
  CHECK(value("2 turns / 1 turn", "rad") == Approx(2));
  CHECK(value("1 turn / 32", "rad") == Approx(kPi / 16));
  CHECK(value("1 / (5 ms)", "Hz") == Approx(200));
  CHECK(value("40 kHz", "Hz") == Approx(40000));
  CHECK(value("60 Nm s/rad * 2 rad/s", "Nm") == Approx(120));
  CHECK(value("5 mN/mm", "N/m") == Approx(5));
  CHECK(value("1 V A", "J/s") == Approx(1));
  CHECK(value("1 N/(m s)", "kg/s^3") == Approx(1));
  CHECK(value("4 s^-1", "Hz") == Approx(4));
  CHECK(value("6 / s", "Hz") == Approx(6));
  CHECK(value("2 ohm * 3 mA", "V") == Approx(6e-3));
  CHECK(value("max(-1 m, 0)", "m") == 0);
  CHECK(value("if 0 < 1 m then 2 m else 0", "m") == 2);
  CHECK(value("sqrt(4 m^2)", "m") == 2);
}

TEST_CASE("parameters: units, ranges, comments, integers") {
  const Law law = law_of(
      "param a = 50 mNm in 0 .. 0.5 Nm   # how much\n"
      "param b = 30 deg in -pi .. pi\n"
      "param c = 3 in 1 .. 9 whole\n"
      "param d = 5 deg in -90 .. 90 deg\n"
      "param e = 0 in -1 .. 2 kg m^2/s^2\n"
      "let f = a * position\nlet q = b + position\nlet h = c + position\nlet i = d + position\n"
      "out torque = f * q * h * i + max(e, tau_hat)");
  REQUIRE(law.parameters.size() == 5);
  const Parameter &a = law.parameters[0], &b = law.parameters[1], &c = law.parameters[2];
  const Parameter &d = law.parameters[3], &e = law.parameters[4];
  CHECK(a.unit_text == "mNm");
  CHECK(a.to_si == Approx(1e-3));
  CHECK(a.initial == Approx(0.05));
  CHECK(a.range.upper == 0.5);
  CHECK(a.comment == "how much");
  CHECK(a.place.line == 1);
  CHECK(a.place.column == 7);
  CHECK(b.unit_text == "deg");
  CHECK(b.initial == Approx(kPi / 6));
  CHECK(b.range.lower == Approx(-kPi));
  CHECK(c.whole);
  CHECK(c.unit_text.empty());
  CHECK(d.range.lower == Approx(-kPi / 2));
  CHECK(e.unit == a.unit);
  CHECK(e.unit_text == "kg m^2/s^2");
}

TEST_CASE("inputs of every axis") {
  Running<> law(
      law_of("out torque = tau_hat + 1 Nm * position[1]\n"
             "out torque[2] = 1 Nm s * velocity[2] + 1 Nm * position[0]"));
  const double first =
      law.torque({{"position", 1}, {"position[1]", 2}, {"velocity[2]", 3}, {"tau_hat", 4}});
  CHECK(first == 6);
  CHECK(law.output(2) == 4);
  CHECK(law.law().inputs.size() == 4);
}

TEST_CASE("a state is what its next was a run before") {
  Running<> law(
      law_of("state count = 2 in 0 .. 100\nnext count = if count < 5 then count + 1 else 0\n"
             "out torque = 1 Nm * count"));
  std::string seen;
  for (int i = 0; i < 7; ++i) seen += std::to_string(static_cast<int>(law.torque({}))) + " ";
  CHECK(seen == "2 3 4 5 0 1 2 ");
  law.evaluation().reset();
  CHECK(law.torque({}) == 2);
}

TEST_CASE("a phase wraps, a whole state is rounded down") {
  Running<> phase(
      law_of("rate = 1 kHz\nphase p = 0.25 in -0.5 .. 0.5\n"
             "next p = p + 200 Hz * dt\nout torque = 1 Nm * p"));
  for (const double p : {0.25, 0.45, -0.35, -0.15, 0.05, 0.25}) {
    CHECK(phase.torque({}) == Approx(p));
  }
  Running<> whole(law_of("state n = 0 in 0 .. 9 whole\nnext n = 2.7\nout torque = 1 Nm * n"));
  CHECK(whole.torque({}) == 0);
  CHECK(whole.torque({}) == 2);
}

TEST_CASE("a bool is a condition that is kept") {
  Running<> law(
      law_of("bool held = true\nbool was = false\nnext was = held\n"
             "next held = position > 1 or held and position > 0\nvar any = false\n"
             "set any = held or was\n"
             "out torque = 1 Nm * ((if held then 1 else 0) + (if any then 10 else 0))"));
  const auto of = [&](double x) { return law.torque({{"position", x}}); };
  CHECK(of(-1) == 11);
  CHECK(of(0.5) == 10);
  CHECK(of(0.5) == 0);
  CHECK(of(2) == 0);
  CHECK(of(0.5) == 11);
  CHECK(of(-1) == 11);
  CHECK(of(-1) == 10);
  CHECK(of(-1) == 0);
  law.evaluation().reset();
  CHECK(of(-1) == 11);
}

TEST_CASE("lowpass: its step response is exact at every rate") {
  for (const double rate : {1e3, 1e5}) {
    Running<> law(
        law_of("param f = 10 Hz in 1 .. 100 Hz\n"
               "out torque = lowpass(tau_hat, f) + lowpass(tau_hat, f)",
               rate));
    CHECK(law.law().states.size() == 1);
    CHECK(law.law().states[0].follows >= 0);
    const int runs = static_cast<int>(rate / 100);
    double last = 0;
    for (int i = 0; i < runs; ++i) last = law.torque({{"tau_hat", 1}});
    CHECK(last == Approx(2 * (1 - std::exp(-2 * kPi * 10 * 0.01))));
  }
}

TEST_CASE("arrays: constants in loops, elements by number at run time") {
  Running<> law(
      law_of("array a = [1, 2, 4] mNm\nout torque = a[position] + sum(i in 0 .. 2: a[i])"));
  const auto of = [&](double x) { return law.torque({{"position", x}}) * 1000; };
  CHECK(of(0) == Approx(8));
  CHECK(of(1.9) == Approx(9));
  CHECK(of(2) == Approx(11));
  CHECK(of(-5) == Approx(8));
  CHECK(of(5) == Approx(11));
  CHECK(Running<>(law_of("array b = [1 m, -2 m]\nout torque = 1 N * b[1]")).torque({}) == -2);
}

TEST_CASE("a line gives back what was written") {
  Running<> law(
      law_of("line l[3] in -9 .. 9 Nm\nnext l = tau_hat\n"
             "out torque = l[1] + 10 * l[3] + 100 * l[position + 1]"));
  std::vector<double> seen;
  for (int i = 1; i <= 5; ++i) seen.push_back(law.torque({{"tau_hat", i}, {"position", 1}}));
  CHECK(seen == std::vector<double>{0, 1, 102, 213, 324});
}

TEST_CASE("loops are unrolled") {
  // The nearest of three points, and which it is.
  Running<> law(
      law_of("array points = [1, 3, 7]\nvar best = 100\nvar which = 0\n"
             "for i in 0 .. 2 {\n  let d = abs(position - points[i])\n"
             "  let nearer = d < best\n  set which = if nearer then i else which\n"
             "  set best = min(d, best)\n}\nout torque = 1 Nm * (best + 100 * which)"));
  for (const auto& [x, expected] :
       {std::make_pair(0.5, 0.5), std::make_pair(2.5, 100.5), std::make_pair(9.0, 202.0)}) {
    CHECK(law.torque({{"position", x}}) == Approx(expected));
  }
  CHECK(law.law().arrays.size() == 1);
  CHECK(value_at("sum(i in 1 .. 4: i * position)", 2) == 20);
  CHECK(value_at("min(i in -1 .. 1: (position - i)^2)", 0.9) == Approx(0.01));
  CHECK(value_at("max(i in -1 .. 1: i * position)", -3) == 3);
  CHECK(value_at("sum(i in 0 .. 2: sum(j in 0 .. i: 1))") == 6);
}

TEST_CASE("events happen when their condition becomes true") {
  Running<> law(law_of(
      "event inside(1 Nm s * velocity) when position > 1\nevent out_again when position < 1\n"
      "out torque = tau_hat"));
  std::string seen;
  for (const double x : {0.0, 2.0, 3.0, 0.0, 0.0, 2.0}) {
    law.torque({{"position", x}, {"velocity", 10 + x}});
    seen += law.evaluation().happened(0) ? "i" : law.evaluation().happened(1) ? "o" : ".";
  }
  CHECK(seen == "oi.o.i");
  CHECK(law.evaluation().event_value(0) == 12);
  CHECK(law.law().events[1].number == 2);
}

TEST_CASE("a mailbox is a parameter with an age") {
  const Law law = law_of(
      "mailbox goal = 1 rad in -2 .. 2 rad max_age 5 ms # where to\n"
      "param k = 2 Nm/rad in 0 .. 3 Nm/rad\nout torque = 2 * k * goal");
  CHECK(law.parameters[0].mailbox);
  CHECK(law.parameters[0].max_age_s == Approx(5e-3));
  CHECK(law.parameters[0].comment == "where to");
  REQUIRE(law.parameters.size() == 3);  // 2*k is derived, goal is not in it
  CHECK(law.parameters[2].name == "2*k");
}

TEST_CASE("line ends and comments mean nothing") {
  const Law law = law_of(
      "\n\n# first\n# second\n\n# third\nlet a = # why\n  1 Nm +\r\n  2 Nm out torque\n=\na");
  CHECK(law.summary == "first second");
  CHECK(Running<>(law).torque({}) == 3);
}
