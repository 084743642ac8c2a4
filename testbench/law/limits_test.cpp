// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Errors as a whole: all of them, in order, and soon. Documentation: docs/laws.md
#include <fstream>

#include "catch.hpp"
#include "law_case.hpp"

using namespace feltgate::law;

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
  CHECK_THROWS_WITH(read_law(folder),
                    folder + ":1:1: cannot be read; give the path of a .law file");
  CHECK_THROWS_AS(read_law(folder + "/nothing.law"), LawError);
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
  std::ifstream page(FELTGATE_ROOT "/docs/laws.md");
  std::string line, text;
  bool inside = false;
  int laws = 0;
  while (std::getline(page, line)) {
    if (line == "```law") {
      inside = true;
      text.clear();
    } else if (inside && line == "```") {
      inside = false;
      ++laws;
      INFO(text);
      CHECK(messages_of(text) == "read");
    } else if (inside) {
      text += line + "\n";
    }
  }
  CHECK(laws == 8);
}
