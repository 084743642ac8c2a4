// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Messages about what cannot be read: where each points, what it says, how it mends. Documentation:
// docs/laws.md
#include <cmath>
#include <fstream>
#include <string>

#include "catch.hpp"
#include "compiled.hpp"
#include "law/load.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

TEST_CASE("what has no meaning is told with its place and a mend") {
  std::ifstream file(FELTGATE_ROOT "/testbench/law/refused.txt");
  std::string law, messages, line;
  int laws = 0;
  const auto check = [&] {
    if (messages.empty()) return;
    INFO(law);
    CHECK(messages_of(law.substr(0, law.size() - 1)) == messages.substr(0, messages.size() - 1));
    ++laws;
  };
  std::getline(file, line);
  while (std::getline(file, line)) {
    if (line == "==") {
      check();
      law = messages = "";
    } else if (line.rfind("=> ", 0) == 0) {
      messages += line.substr(3) + "\n";
    } else {
      law += line + "\n";
    }
  }
  check();
  CHECK(laws == 203);
  CHECK(messages_of("for i in 0 .. 3 { let a = 1 ") ==
        "1:28: expected \"}\" or a statement, found the end of the file; the form is: let NAME = "
        "EXPRESSION");
}

// What a law requires of its parameters: read, compiled, kept by the host.

namespace {

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
        }).find("x.law:4:13: the law requires low <= high, which are 1 and 0.2; give") == 0);
  CHECK(told([] { compiled(with("require low < 1 Nm")); }).find("low < 1") != std::string::npos);
}

TEST_CASE("require: the host keeps it, of all that is set together") {
  const Image image =
      read_image(text(compiled(with("require high <= low and low < 2 * high + 1 Nm")).image));
  CHECK(image.requirements.size() == 2);
  LoadedParameters p(image);
  CHECK(told([&] { p.set("low", 0.1); }).find("law x requires high <= low, which are 0.199") == 0);
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
    check_within(c, measure(c, 1, runs_of(5000)));
  }
  CHECK(messages_of(both + "out torque = 0.1 Nm * sqrt(a - b)")
            .find("the square root of parameters that may be below 0") != std::string::npos);
}

// Errors as a whole: all of them, in order, and soon.

TEST_CASE("every message names the file, and what() holds all of them") {
  try {
    (void)read_law_text("let a = b\nlet c = d", "folder/bad.law");
    FAIL();
  } catch (const LawError& error) {
    CHECK(error.diagnostics().size() == 3);
    CHECK(std::string(error.what()).rfind("folder/bad.law:1:9: unknown name \"b\"", 0) == 0);
    CHECK(std::string(error.what()).find("\nfolder/bad.law:2:9: unknown") != std::string::npos);
  }
  const std::string folder = FELTGATE_ROOT "/rtl/laws";
  CHECK_THROWS_WITH(read_law(folder), folder + ": is a folder; give the path of a .law file in it");
  CHECK_THROWS_WITH(read_law(folder + "/nothing.law"),
                    folder + "/nothing.law: there is no such file; give the path of a .law file");
}

TEST_CASE("what would take too long or too deep is refused at once") {
  const auto repeated = [](const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
  };
  const auto out = [](const std::string& e) {
    return messages_of("out torque = 1 Nm * (" + e + ")");
  };
  const std::string deep = "expressions inside expressions, too many to follow";
  CHECK(out(repeated("(", 5000) + "1" + repeated(")", 5000)).find(deep) != std::string::npos);
  CHECK(out(repeated("sin(", 100) + "1" + repeated(")", 100)).find(deep) != std::string::npos);
  CHECK(out(repeated("if 1 < 2 then 1 else ", 1000) + "1").find(deep) != std::string::npos);
  CHECK(messages_of(repeated("for i in 0 .. 1 {", 3000)).find(deep) != std::string::npos);
  CHECK(out(repeated("position + ", 600) + "1").find("more than 500") != std::string::npos);
  CHECK(out(repeated("- ", 600) + "1").find("more than 500") != std::string::npos);
  CHECK(out(repeated("(", 50) + "1" + repeated(")", 50)) == "read");
  CHECK(out(repeated("position + ", 400) + "1") == "read");
  CHECK(messages_of(repeated("# long\n", 10000)).find("64 KiB") != std::string::npos);
  const std::string loops = "var q = 0\nfor i in 0 .. 999 { for j in 0 .. 999 { set q = 1 } }\n";
  CHECK(messages_of(loops + "out torque = 1 Nm * q").find("300000 steps") != std::string::npos);
}

TEST_CASE("what is missing is called by a name for people, wherever a statement ends") {
  const std::string form = "; the form is: let NAME = EXPRESSION";
  CHECK(messages_of("let a = sin()") == "1:13: expected an expression, found \")\"" + form);
  CHECK(messages_of("let a = clamp(,1,2)") == "1:15: expected an expression, found \",\"" + form);
  CHECK(messages_of("let a = sin(\nlet b = 2") ==
        "1:13: expected an expression before the end of the line" + form);
  CHECK(messages_of("array a = [] Nm") ==
        "1:12: expected an expression, found \"]\"; the form is: array NAME = [1, 2, 3] UNIT");
  const std::string all[] = {
      "param a = 1 Nm in 0 .. (2 Nm) whole",
      "mailbox a = 1 in 0 .. 2 max_age 5 ms",
      "let a = if not 1 < 2 and 2 < 3 or 3 < 4 then max(1, 2) else -sum(i in 0 .. 1: a[i]) ^ 2",
      "phase a = 0 in 0 .. 1",
      "next a = sin(1, 2)",
      "set a = 1 * 2 / 3 + 4 - 5",
      "table f(x) on [0, 1] = x with 5 segments",
      "table f(x) on [0, 1] through [0, 1] Nm",
      "array a = [1, 2] Nm",
      "line a[3] in -1 .. 1 Nm",
      "for i in 0 .. 3 { var a = 1 }",
      "out torque[1] = 1 Nm",
      "event hit(position) when position > 1",
      "rate = 40 kHz",
      "require a <= 2"};
  for (const std::string& text : all) {
    for (std::size_t end = 0; end <= text.size(); ++end) {
      for (const char* then : {"", ")", "]", ",", "}", "\nlet b = 1"}) {
        const std::string m = messages_of(text.substr(0, end) + then);
        INFO(text.substr(0, end) << then);
        CHECK(m.find("boost") == std::string::npos);
      }
    }
  }
}

TEST_CASE("files of other editors: a mark at the begin, other line ends, UTF-16, no UTF-8") {
  const std::string out = "out torque = tau_hat";
  CHECK(messages_of("\xef\xbb\xbf" + out) == "read");
  CHECK(
      messages_of("\xef\xbb\xbflet a = ") ==
      "1:8: expected an expression, found the end of the file; the form is: let NAME = EXPRESSION");
  const std::string utf16 = "1:1: a file in UTF-16, not in UTF-8; save it as UTF-8";
  CHECK(messages_of(std::string("\xff\xfeo\0u\0", 6)) == utf16);
  CHECK(messages_of(std::string("\xfe\xff\0o", 4)) == utf16);
  CHECK(messages_of(std::string("o\0u\0", 4)) == utf16);
  // A CR alone ends a line, and so the comment.
  const Law old = law_of("# a knob\rparam a = 1 Nm in 0 .. 2 Nm # how much\rout torque = a\r");
  CHECK(old.summary == "a knob");
  CHECK(old.parameters.at(0).comment == "how much");
  CHECK(messages_of("# x\r" + out + "\rlet b = c\r") == messages_of("# x\n" + out + "\nlet b = c"));
  CHECK(messages_of("# x\r\n" + out + "\r\n") == "read");
  // What a terminal would not take is a question mark.
  CHECK(law_of("# fr\xfch \x1b[1m gr\xc3\xbc\xc3\x9f\x65 \xed\xa0\x80\n" + out).summary ==
        "fr?h ?[1m gr\xc3\xbc\xc3\x9f\x65 ???");
}

TEST_CASE("what is no ASCII is told by its number") {
  const std::string mend =
      "; outside of comments a law is plain ASCII; pi is written as a word, micro as u";
  CHECK(messages_of("let a = 2 * \xcf\x80") ==
        "1:13: expected an expression, found the character U+03C0" + mend);
  CHECK(messages_of("let gr\xc3\xb6\xc3\x9f\x65 = 2") ==
        "1:7: expected \"=\", found the character U+00F6" + mend);
  CHECK(messages_of("let a = \xb5\x01") ==
        "1:9: expected an expression, found the byte 0xb5" + mend);
  CHECK(messages_of("\xdf = 1") ==
        "1:1: the byte 0xdf where a statement begins or an expression goes on" + mend);
}

TEST_CASE("at most twenty messages, in the order of the file") {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "let a" + std::to_string(i) + " = nothing\n";
  try {
    (void)read_law_text(text, "x.law");
    FAIL();
  } catch (const LawError& error) {
    REQUIRE(error.diagnostics().size() == 20);
    for (int i = 0; i < 20; ++i) {
      CHECK(error.diagnostics()[static_cast<std::size_t>(i)].place.line == i + 1);
    }
  }
}

TEST_CASE("every law on the page can be read") {
  const std::vector<std::string> laws = laws_of_page();
  CHECK(laws.size() == 11);
  for (const std::string& text : laws) {
    INFO(text);
    CHECK(messages_of(text) == "read");
    if (text.find("let angle =") == std::string::npos) continue;
    Running<> law(law_of(text));
    for (double a = -3.1; a < 3.14; a += 0.0625) {
      const double is =
          law.torque({{"position", 0.03 * std::cos(a)}, {"position[1]", 0.03 * std::sin(a)}});
      CHECK(std::fabs(is - 0.05 * std::sin(3 * a)) < 0.05 * 3 * 3e-5);
    }
  }
}
