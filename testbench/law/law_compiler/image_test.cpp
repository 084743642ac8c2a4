// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Images as text, their CRC, words from parameters.
#include <catch2/catch.hpp>

#include <algorithm>

#include "law/compile.hpp"
#include "law/load.hpp"

namespace feltgate::law {
namespace {

Compiled detent() {
  return compile_file(std::string(FELTGATE_ROOT) + "/rtl/laws/detent.law", Target{});
}

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
  const std::string written = text(compile_text("param k = 1 Nm/rad in 0 .. 2 Nm/rad\n"
                                                "out torque = -k * position\n",
                                                "k.law", Target{})
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
  const Compiled c = compile_text(
      "mailbox goal = 0 rad in -1 .. 1 rad max_age 20 ms\n"
      "param stiffness = 1 Nm/rad in 0 .. 2 Nm/rad\n"
      "mailbox push = 0 Nm in -0.1 .. 0.1 Nm max_age 5 ms\n"
      "param most = 0.3 Nm in 0.1 .. 0.5 Nm\n"
      "out torque = clamp(stiffness * (goal - clamp(position, -2, 2)), -most, most) + push\n",
      "x.law", Target{});
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
}  // namespace feltgate::law
