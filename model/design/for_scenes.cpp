// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reduces a design to the blocks that some scenes need. Documentation: docs/designs.md
#include "design/design.hpp"

#include <algorithm>
#include <sstream>

#include "design/text_edit.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

constexpr const char* always = "free";

}  // namespace

std::string text_for_scenes(const std::string& path, const std::set<std::string>& laws,
                            const std::string& comment) {
  const toml::table root = config::parse_toml_file(path);
  config::TomlReader scenes = config::TomlReader(root, path, "the design").section("scenes");
  const std::vector<std::string> built = scenes.texts("include");
  for (const std::string& law : laws) {
    if (law != always && std::find(built.begin(), built.end(), law) == built.end()) {
      scenes.fail("include", "the design does not build \"" + law + "\"",
                  "take a design that includes it, or add it to the list");
    }
  }
  std::string list = "[\"" + std::string(always) + "\"";
  for (const std::string& law : built) {
    if (law != always && laws.count(law) != 0) list += ", \"" + law + "\"";
  }

  std::string text = text_of_file(path);
  const toml::source_region& region = root["scenes"]["include"].node()->source();
  const std::size_t begin = offset_of(text, region.begin);
  text.replace(begin, offset_of(text, region.end) - begin, list + "]");

  std::ostringstream out;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) out << "# " << line << "\n";
  out << text;
  return out.str();
}

}  // namespace feltgate::design
