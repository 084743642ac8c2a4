// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_generate ROOT [--check]: writes everything that follows from rtl/registers.toml and
// rtl/designs/*.toml; with --check it only compares and fails on a stale file.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "config/toml_reader.hpp"
#include "design/generate.hpp"

namespace fs = std::filesystem;
using feltgate::config::ConfigError;

namespace {

/// Writes `text` where it differs; in check mode only reports. Returns whether the file was stale.
bool update(const fs::path& path, const std::string& text, bool check_only) {
  std::ifstream in(path, std::ios::binary);
  const std::string old{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in && old == text) return false;
  if (check_only) {
    std::cerr << path.string() << ": stale; run `feltgate generate` and commit the result\n";
    return true;
  }
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  std::cout << "wrote " << path.string() << "\n";
  return true;
}

}  // namespace

constexpr const char* usage =
    "usage: feltgate generate [--check]\n"
    "Writes what follows from rtl/registers.toml and rtl/designs/*.toml: the SystemVerilog "
    "packages in\n"
    "rtl/generated, the C++ headers in model/include/feltgate/generated, and docs/registers.md.\n"
    "--check only compares; exit code 1 when a file is stale.\n";

int main(int argc, char** argv) {
  const std::string option = argc == 3 ? argv[2] : "";
  const bool check_only = option == "--check";
  if (option == "--help" || option == "-h") {
    std::cout << usage;
    return 0;
  }
  if (argc < 2 || argc > 3 || (argc == 3 && !check_only)) {
    std::cerr << usage;
    return 2;
  }
  try {
    const fs::path root = argv[1];
    const auto registers = feltgate::design::read_registers((root / "rtl/registers.toml").string());
    bool stale = false;
    for (const auto& entry : fs::directory_iterator(root / "rtl/designs")) {
      if (entry.path().extension() != ".toml") continue;
      const auto e = elaborate(feltgate::design::read_design(entry.path().string()), registers);
      const std::string& name = e.design.name;
      stale |= update(root / "rtl/generated" / name / "feltgate_pkg.sv", systemverilog_package(e),
                      check_only);
      stale |= update(root / "model/include/feltgate/generated" / (name + ".hpp"), cpp_header(e),
                      check_only);
      if (name == "lever")
        stale |= update(root / "docs/registers.md", register_page(e), check_only);
    }
    return check_only && stale ? 1 : 0;
  } catch (const ConfigError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
