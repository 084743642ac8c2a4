// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shared by the tests of designs: shipped files, texts with one thing changed, errors.
// Documentation: docs/designs.md
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "catch.hpp"
#include "design/generate_cfg.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

inline std::string root_path(const std::string& path) {
  return std::string(FELTGATE_ROOT) + "/" + path;
}

inline std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline const RegisterMap& shipped_registers() {
  static const RegisterMap map = read_registers(root_path("rtl/registers.toml"));
  return map;
}

inline std::string design_path(const std::string& name) {
  return root_path("rtl/designs/" + name + ".toml");
}

inline Design shipped_design(const std::string& name) { return read_design(design_path(name)); }

inline Elaborated shipped(const std::string& name) {
  return elaborate(shipped_design(name), shipped_registers());
}

/// `text` with the first `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  INFO("looking for: " << from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Line of the first `what`, 1 being the first.
inline int line_of(const std::string& text, const std::string& what) {
  const auto at = text.find(what);
  INFO("looking for: " << what);
  REQUIRE(at != std::string::npos);
  int line = 1;
  for (std::size_t i = 0; i < at; ++i) line += text[i] == '\n' ? 1 : 0;
  return line;
}

/// Writes a file into the folder of this test and returns its path.
inline std::string written(const std::string& name, const std::string& text) {
  std::string path = std::string(FELTGATE_TEST_FOLDER) + "/" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// Reads and elaborates a design; the error without the folder, or "no error".
inline std::string design_error(const std::string& text) {
  const std::string path = written("changed.toml", text);
  try {
    (void)elaborate(read_design(path), shipped_registers());
  } catch (const config::ConfigError& error) {
    const std::string what = error.what();
    const std::string folder = std::string(FELTGATE_TEST_FOLDER) + "/";
    return what.rfind(folder, 0) == 0 ? what.substr(folder.size()) : what;
  }
  return "no error";
}

/// Design with one change of its text, which must be good.
inline Elaborated changed(const std::string& name, const std::string& from, const std::string& to) {
  const std::string path =
      written("changed.toml", replaced(file_text(design_path(name)), from, to));
  return elaborate(read_design(path), shipped_registers());
}

}  // namespace feltgate::design
