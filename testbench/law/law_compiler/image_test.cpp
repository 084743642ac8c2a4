// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Images as text, their CRC, words from parameters.
#include <algorithm>
#include <cmath>

#include "catch.hpp"

#include "compiled.hpp"
#include "law/load.hpp"
#include "machine_programs.hpp"

namespace feltgate::law {
namespace {

const Compiled& detent() { return compiled_shipped("detent"); }

TEST_CASE("an image is read as it was written") {
  const Image image = detent().image;
  const std::string written = text(image);
  CHECK(read_image(written) == image);
  CHECK(text(read_image(written)) == written);
}

TEST_CASE("a changed word is found by the CRC, a wrong line by its number") {
  const std::string written = text(detent().image);
  std::string changed = written;
  const auto word = changed.find("\np 0 ") + 5;
  changed[word] = changed[word] == '4' ? '5' : '4';
  CHECK_THROWS_WITH(read_image(changed), Catch::Matchers::Contains("CRC-32"));
  CHECK_THROWS_WITH(read_image("feltgate-law-image 1\nnonsense 3\n"),
                    Catch::Matchers::Contains("line 2"));
  CHECK_THROWS(read_image("something else\n"));
}

TEST_CASE("an image that a host could not compute with is refused, with its line") {
  const std::string written = text(compiled("param k = 1 Nm/rad in 0 .. 2 Nm/rad\n"
                                            "out torque = -k * position\n")
                                       .image);
  const auto at = written.find("\nparameter ") + 1;
  const std::string line = written.substr(at, written.find('\n', at) - at);
  CHECK_NOTHROW(read_image(written));
  const auto told = [&](const std::string& changed) {
    try {
      (void)read_image(std::string(written).replace(at, line.size(), changed));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("read");
  };
  for (const char* scale : {"0", "nan", "1e999", "0.5x"}) {
    const std::string said = told(fmt::format("parameter 0 k Nm/rad {} 1 0 9 1 0 0 0 -", scale));
    CHECK_THAT(said, Catch::Matchers::Contains("is no number that it can have; compile"));
  }
  CHECK(told("parameter 0 k Nm/rad 1 1 9 0 1 0 0 0 -").find("9 is above 0") != std::string::npos);
  CHECK(told("parameter 0 k\x01 Nm/rad 1 1 0 9 1 0 0 0 -").find("cannot be printed") !=
        std::string::npos);
  for (const char* formula : {"k k", "+", "gone"}) {
    const std::string said = told(line + "\nparameter 1 d Nm 1 1 0 9 1 0 0 0 " + formula);
    CHECK_THAT(said,
               Catch::Matchers::Contains("formula ") && Catch::Matchers::Contains("; compile"));
  }
  // Where a formula has no value the word is its least.
  Image image = detent().image;
  image.words = {{"k", "Nm", 0, 1, 1, -5, 9, 0, false, false, 0, ""},
                 {"d", "Nm", 1, 1, 1, -5, 9, 0, false, false, 0, "k k /"}};
  CHECK(parameter_words(image, {0})[1] == -5);
}

TEST_CASE("mailbox words lie at the end, and the shortest max_age counts") {
  const Compiled c = compiled(
      "mailbox goal = 0 rad in -1 .. 1 rad max_age 20 ms\n"
      "param stiffness = 1 Nm/rad in 0 .. 2 Nm/rad\n"
      "mailbox push = 0 Nm in -0.1 .. 0.1 Nm max_age 5 ms\n"
      "param most = 0.3 Nm in 0.1 .. 0.5 Nm\n"
      "out torque = clamp(stiffness * (goal - clamp(position, -2, 2)), -most, most) + push\n");
  const Image& image = c.image;
  int mailboxes = 0;
  for (const ImageWord& w : image.words) {
    CHECK((w.word >= image.mailbox_first) == w.mailbox);
    CHECK(image.data[static_cast<std::size_t>(Image::parameter_base + w.word)] == w.initial);
    CHECK(image.data[static_cast<std::size_t>(Image::upper_base + w.word)] == w.upper);
    mailboxes += w.mailbox ? 1 : 0;
  }
  CHECK(mailboxes == 2);
  CHECK(image.mailbox_first == 30);
  // The mailbox is late after the 78th step of 64 us at the latest.
  CHECK(image.mailbox_age == 77);
  CHECK(read_image(text(image)) == image);
  CHECK(read_image(text(image)).mailbox_age == 77);
  CHECK(detent().image.mailbox_first == 32);
  const auto writes = load_into_zeros(image);
  for (const HostWord& w :
       {HostWord{EngineMap::H::mailbox_first, 30}, HostWord{EngineMap::H::mailbox_age, 77}}) {
    CHECK(std::count(writes.begin(), writes.end(), w) == 1);
  }
  // The program reads the words at these addresses.
  bool goal = false;
  for (const EngineInstruction& i : c.assembled.instructions) {
    for (const int address : {i.a, i.b}) {
      if (address >= Image::parameter_base + 30 && address < Image::parameter_base + 32) {
        goal = true;
      }
      CHECK_FALSE((address >= Image::parameter_base + 4 && address < Image::parameter_base + 30));
    }
  }
  CHECK(goal);
}

TEST_CASE("the CRC is zlib's, over program, ranges, constants and tables") {
  Image image;
  const std::uint32_t empty = crc(image);
  image.data[0] = 5;    // private words are not part of the CRC
  image.data[320] = 5;  // nor are parameters, which have ranges
  CHECK(crc(image) == empty);
  image.data[448] = 1;
  CHECK(crc(image) != empty);
  image.data[448] = 0;
  image.table[511] = 1;
  CHECK(crc(image) != empty);
  image.line_base = 511;
  const std::uint32_t shorter = crc(image);
  image.table[511] = 2;
  CHECK(crc(image) == shorter);
}

TEST_CASE("a parameter's word is its value, limited to its range") {
  const Image image = detent().image;
  std::vector<double> values;
  for (const ImageWord& w : image.words) values.push_back(w.name == "clicks" ? 1000 : 0.05);
  const auto words = parameter_words(image, values);
  for (const ImageWord& w : image.words) {
    const double value = words[static_cast<std::size_t>(w.word)] * w.scale;
    if (w.name == "clicks") CHECK(value == 200);
    if (w.name == "amplitude") CHECK(std::abs(value - 0.05) <= std::abs(w.scale) / 2);
  }
}

TEST_CASE("a formula is postfix") {
  const auto value = [](const std::string& name) { return name == "a" ? 3.0 : 4.0; };
  CHECK(evaluate_formula("a b *", value) == 12);
  CHECK(evaluate_formula("1 a b + /", value) == 1.0 / 7);
  CHECK(evaluate_formula("a neg b max sqrt", value) == 2);
  CHECK(evaluate_formula("a b < 5 6 ?", value) == 5);
  CHECK(evaluate_formula("a b < not a 3 < not and 5 6 ?", value) == 6);
  CHECK(evaluate_formula("b a < a 4 < or 5 6 ?", value) == 5);
  CHECK_THROWS(evaluate_formula("a b", value));
  CHECK_THROWS(evaluate_formula("a b < 5 ?", value));
  CHECK_THROWS(evaluate_formula("a *", value));
}

}  // namespace

// Formats that the search must not choose, and the memory that tables need.

namespace {

/// That its errors, in separate runs, are within a small bound.
void check_law(const std::string& text) {
  const Compiled c = compiled(text);
  CHECK(c.bound.unproven.empty());
  CHECK(c.bound.output[0] > 0);
  CHECK(c.bound.output[0] < 1e-3);
  check_within(c, measure(c, 1, 5000));
}

TEST_CASE("a state has many steps in its range, whatever little is made of it") {
  for (const char* out : {"if big > 5 then 0.2 Nm else 0 Nm", "1e-5 Nm * floor(big)"}) {
    const Compiled c =
        compiled(std::string("state big = 0 in 0 .. 10\nnext big = clamp(4 * position, 0, 10)\n") +
                 "out torque = " + out + "\n");
    CHECK(c.program.states[0].scale <= 10 / 256.0);
  }
}

// Laws 60198 and 81752 of the judge.
TEST_CASE("a whole state that no output shows counts in ones as well") {
  const Compiled c = compiled(
      "rate = 10 kHz\nparam p = 0.616 in 0.1 .. 1.083\nparam q = 0 in -0.936 .. 1\n"
      "param count = 1 in 0 .. 4 whole\nstate stage = 0 in 0 .. 3 whole\n"
      "state side = 1 in -2 .. 2 whole\nline past[2] in -2 .. 2\n"
      "next stage = clamp(stage + (if side != count then 1 else 0) - "
      "(if clamp(position, -0.326, 2.956) < -p then 1 else 0), 0, 3)\n"
      "next side = clamp(side + (if side <= 0 then 1 else 0) - (if stage < count then 1 else 0), "
      "-2, 2)\n"
      "next past = clamp(exp(clamp(past[1] * past[1], -2, 1)), -2, 2)\n"
      "event told(p + q - (1.694 - q)) when side > 2\n"
      "out torque = 1 Nm * clamp(clamp(mod(clamp(past[1], -3, 3) + 0.142, 0.927), -1.5, 1.5)^3, "
      "-4, 4)\n");
  int whole = 0;
  for (const Step& s : c.program.steps) {
    if (s.node < 0 || !c.law.nodes[static_cast<std::size_t>(s.node)].whole) continue;
    CHECK(s.scale <= 1);
    ++whole;
  }
  CHECK(whole > 0);
}

TEST_CASE("the word of a whole parameter is a whole number of steps in one") {
  const Compiled c = compiled(
      "param q = 0 in -1.628 .. 1\nparam count = 1 in 0 .. 4 whole\n"
      "state kept = 0.25 in -2 .. 2\nnext kept = kept + 0.595 * (clamp(sin(2 * position), -2, 2) "
      "- kept)\n"
      "out torque = 1 Nm * (0.3 / (0.48 + abs(cos(7 * position + ((q - 0.917) * kept - "
      "count)))))\n");
  int whole = 0;
  for (const ImageWord& w : c.image.words) {
    if (!w.whole || !w.formula.empty()) continue;
    ++whole;
    const double steps = 1 / std::fabs(w.scale);
    CHECK(std::fabs(steps - std::nearbyint(steps)) < 1e-11 * steps);
  }
  CHECK(whole == 1);
}

TEST_CASE("what the host computes ends where its range does") {
  // Its word ended a step later, which left the state's range.
  check_law(
      "param p = 1 in 0 .. 3\nbool t = false\nnext t = p > 2\n"
      "out torque = if t then 0.1 Nm else 0\n");
  check_law(
      "param n = 1 in 0 .. 3\nline a[3] in 0 .. 9\nnext a = clamp(n * n, 0, 9)\n"
      "out torque = a[2] * 0.1 Nm\n");
  check_law(
      "param n = 1 in 0 .. 3 whole\nparam k = 1 in 0 .. 3 whole\nstate t = 0 in 0 .. 9 whole\n"
      "next t = n * k\nout torque = if t == 4 then 0.1 Nm else 0\n");
  // This filter stood still: only formats in which it does kept its range.
  const Compiled c =
      compiled("param p = 1 in 0 .. 3\nout torque = lowpass(min(p, 1) * 1 Nm, 10 Hz)\n");
  CHECK(c.bound.states_bounded);
  check_within(c, measure(c, 1, 5000, true));
}

TEST_CASE("no format is taken that holds no value of a phase") {
  check_law(
      "param a = 50 mNm in 0 .. 0.1 Nm\nparam n = 3 in 1 .. 9 whole\n"
      "mailbox goal = 30 deg in -90 .. 90 deg max_age 5 ms\nrate = 20 kHz\n"
      "let q = sin(n * position) + 0.5 * exp(-abs(goal))\n"
      "table f(x) on [0, 2] = x^2 / (1 + x) with 64 segments\n"
      "state count = 0 in 0 .. 9 whole\n"
      "next count = if count < 5 and not velocity > 1 rad/s then count + 1 else 0\n"
      "phase w = 0.25 in -0.5 .. 0.5\nnext w = w + 200 Hz * dt\n"
      "event hit(position) when 0 <= position < 1 or q > 0.5\n"
      "out torque = a * f(clamp(q, 0, 2)) + 0.01 Nm * (count + w) * sgn(q)\n");
}

TEST_CASE("a product with a value that is always 0 has a format") {
  // Its range is 0 and what intervals are rounded by: 5e-324.
  const Compiled c = compiled(
      "let near = clamp(position, -1, 1)\nlet a = if position > 0.1 then 1 + near else 0.5\n"
      "let b = if position > 0.2 then near else clamp(position, -2, 1)\n"
      "out torque = 1 Nm * clamp(0.25 + a * b * min(0.3 + abs(near), near - near), -4, 4)\n");
  CHECK(c.bound.unproven.empty());
  CHECK(c.bound.output[0] < 1e-4);
  check_within(c, measure(c, 1, 5000));
}

TEST_CASE("tables get the segments that they ask for, or are refused") {
  const auto with = [](const std::string& a, const std::string& b) {
    return "table f(x) on [0, 3] = x^2 / 9 with " + a + " segments\n" +
           "table h(x) on [0, 3] = x^3 / 27 with " + b + " segments\n" +
           "out torque = 0.1 Nm * (f(abs(position)) + h(abs(position)))\n";
  };
  CHECK_THROWS_WITH(compiled(with("300", "300")),
                    Catch::Contains("602 words of table memory, which has 512") &&
                        Catch::Contains("fewer segments"));
  check_law(with("300", "210"));
  check_law(
      "table f(x) on [0, 3] = x^2 / 9 with 511 segments\n"
      "out torque = 0.1 Nm * f(abs(position))\n");
}

TEST_CASE("noise keeps the bits that its period needs, in every format") {
  // The other states of these laws drift: the search cannot tell from the bound that noise is
  // rounded.
  for (const char* text :
       {"phase ph = 0 in 0 .. 1\nnext ph = ph + 1 Hz * dt\n"
        "out torque = 0.01 Nm * sin(2 * pi * ph) + 1 mNm * noise(1)\n",
        "rate = 1 kHz\nparam f = 10 Hz in 0.001 .. 100 Hz\n"
        "out torque = 0.1 Nm * lowpass(lowpass(clamp(position, -1, 1), f), f) + 0.01 Nm * "
        "noise(77)^3\n"}) {
    INFO(text);
    const Compiled c = compiled(text);
    for (std::size_t k = 0; k < c.law.states.size(); ++k) {
      if (c.law.states[k].name.rfind("noise", 0) == 0) CHECK(c.program.states[k].scale <= 0x1p-20);
    }
  }
}

}  // namespace

// The run rate of laws in the engine's twin, clock by clock, against the rate that the compiler
// reports.

namespace {

using test::Seen;

/// Number of runs to check: few for a slow law, because the time between its runs is long.
int runs_at(int divider) { return divider < 100 ? 240 : 12; }

template <int Axes>
Seen at_divider(const Compiled& c, int divider) {
  return test::run<Axes>(memory(c.image), divider, c.target.clocks_per_tick, 3,
                         runs_at(divider) * divider);
}
Seen at_divider(const Compiled& c, int divider) {
  return c.target.axes == 1   ? at_divider<1>(c, divider)
         : c.target.axes == 2 ? at_divider<2>(c, divider)
                              : at_divider<3>(c, divider);
}

TEST_CASE("shipped laws reach their rate in the twin, and none a higher one") {
  int slower = 0;
  for (const std::string& name : shipped_names()) {
    const Compiled& c = compiled_shipped(name);
    INFO(name << ", divider " << c.divider);
    const Seen seen = at_divider(c, c.divider);
    CHECK_FALSE(seen.overrun);
    CHECK(seen.fresh >= runs_at(c.divider) - 2);
    if (c.divider == 1 || c.law.rate_hz > 0) continue;
    CHECK(at_divider(c, c.divider - 1).overrun);
    ++slower;
  }
  CHECK(slower >= 3);
}

}  // namespace
}  // namespace feltgate::law
