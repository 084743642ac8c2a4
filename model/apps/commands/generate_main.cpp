// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_generate ROOT [--check [DESIGN...]]: writes everything that follows from
// rtl/registers.toml and rtl/designs/*.toml; with --check it only compares and fails on a stale
// file. With --design FILE --output DIR it writes what follows from one design, anywhere.
// Documentation: docs/designs.md
#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "design/engine_map.hpp"
#include "design/generate.hpp"
#include "design/generate_cfg.hpp"
#include "design/host_words.hpp"
#include "files/toml/toml_reader.hpp"

namespace fs = std::filesystem;
using feltgate::config::ConfigError;

namespace {

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw ConfigError(
      fmt::format("{}: cannot be written ({}); give a folder in which files can be made",
                  path.string(), reason));
}

/// Writes `text` if the file differs; in check mode only reports. Returns whether it was stale.
bool update(const fs::path& path, const std::string& text, bool check_only) {
  std::ifstream in(path, std::ios::binary);
  const std::string old{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in && old == text) return false;
  if (check_only) {
    std::cerr << path.string() << ": stale; run `feltgate generate` and commit the result\n";
    return true;
  }
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) refuse(path.parent_path(), error.message());
  std::ofstream out(path, std::ios::binary);
  out << text << std::flush;
  if (!out) refuse(path, std::generic_category().message(errno));
  std::cout << "wrote " << path.string() << "\n";
  return true;
}

/// Writes the files of a design for hosts and other tools. Returns whether a file was stale.
bool update_host_files(const fs::path& folder, const feltgate::design::Elaborated& e,
                       bool check_only) {
  bool stale = update(folder / "feltgate.h", c_header(e), check_only);
  stale |= update(folder / "feltgate.rdl", system_rdl(e), check_only);
  stale |= update(folder / "csr.csv", csr_csv(e), check_only);
  return stale;
}

}  // namespace

constexpr const char* usage =
    "usage: feltgate generate [--check [DESIGN...]]\n"
    "       feltgate generate --design FILE -o DIR [--allow-coarse]\n"
    "Writes what follows from rtl/registers.toml and rtl/designs/*.toml: the map for RTL and C++,\n"
    "docs/registers.md, the packages of lever, paper and gimbal_current in rtl/generated (a build\n"
    "makes those of the others), and for lever a C++ header in model/include/feltgate/generated "
    "and\n"
    "the register map as C header, SystemRDL and CSV.\n"
    "--check only compares, all or what follows from these designs; exit code 1 when a file is "
    "stale.\n"
    "With --design one design, which may lie anywhere: DIR/cfg.sv, DIR/NAME.hpp,\n"
    "DIR/parameters.mem, the first contents of the parameter RAM for $readmemh, and "
    "DIR/values.txt,\n"
    "a line per parameter: name, address, integer, exact value; and the register map for hosts:\n"
    "DIR/feltgate.h with DIR/feltgate_map.h (C), DIR/feltgate.rdl (SystemRDL), DIR/csr.csv (as of\n"
    "LiteX). --allow-coarse lets a resolution pass that is coarser than a design for use must "
    "have;\n"
    "what cannot work is refused all the same.\n"
    "  feltgate generate                                        after a change in rtl/designs\n"
    "  feltgate generate --design my_design.toml -o out          one design anywhere\n"
    "  feltgate generate --design rtl/designs/fast.toml -o out   the C header of fast\n"
    "Exit code: 0 fine, 1 a file is stale, 2 a design or option that cannot be used.\n";

struct Options {
  fs::path root, design, output;
  std::vector<std::string> names;  ///< of designs to check
  bool check_only = false, allow_coarse = false, help = false;
};

/// Reads the arguments; false if they are invalid.
bool parse(int argc, char** argv, Options* o) {
  if (argc < 2) return false;
  o->root = argv[1];
  for (int i = 2; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--help" || option == "-h") {
      o->help = true;
    } else if (option == "--check") {
      o->check_only = true;
    } else if (option == "--allow-coarse") {
      o->allow_coarse = true;
    } else if ((option == "--design" || option == "--output" || option == "-o") && i + 1 < argc) {
      (option == "--design" ? o->design : o->output) = argv[++i];
    } else if (option.rfind('-', 0) != 0) {
      o->names.push_back(option);
    } else {
      return false;
    }
  }
  return o->help ||
         (o->design.empty() == o->output.empty() && !(o->check_only && !o->design.empty()) &&
          !(o->allow_coarse && o->design.empty()) && (o->names.empty() || o->check_only));
}

feltgate::design::EngineDescription read_engine(const Options& o) {
  return feltgate::design::read_engine((o.root / "rtl/engine/engine.toml").string());
}

/// What the link's users must know of the engine.
void add_engine(const Options& o, feltgate::design::RegisterMap* registers) {
  for (const feltgate::design::Cause& c : read_engine(o).constants) {
    if (c.name == "port_first") {
      registers->link_constants.push_back(
          {"engine", c.number,
           "first address of the engine's words, where features.engine is set"});
    }
  }
}

void generate_one(const Options& o, const feltgate::design::RegisterMap& registers) {
  auto design = feltgate::design::read_design(o.design.string());
  design.allow_coarse = o.allow_coarse;
  const auto e = elaborate(design, registers);
  update(o.output / "cfg.sv", cfg_package(e), false);
  update(o.output / (e.design.name + ".hpp"), cpp_header(e), false);
  update(o.output / "parameters.mem", memory_text(e), false);
  update(o.output / "values.txt", values_text(e), false);
  update(o.output / "feltgate_map.h", c_map_header(e), false);
  update_host_files(o.output, e, false);
}

/// The files of a design in rtl/designs. Whether one was stale.
bool update_design(const Options& o, const feltgate::design::Elaborated& e) {
  const std::string& name = e.design.name;
  const fs::path folder = o.root / "rtl/generated" / name;
  bool stale = false;
  if (name == "lever" || name == "paper" || name == "gimbal_current") {  // others': at build time
    stale |= update(folder / "cfg.sv", cfg_package(e), o.check_only);
    stale |= update(folder / "parameters.mem", memory_text(e), o.check_only);
  }
  if (name == "lever") {  // the others' files for hosts are written on request
    stale |=
        update(o.root / "model/include/feltgate/generated/lever.hpp", cpp_header(e), o.check_only);
    stale |= update_host_files(folder, e, o.check_only);
    stale |= update(o.root / "docs/registers.md", register_page(e), o.check_only);
    stale |= update(o.root / "rtl/generated/feltgate_map.h", c_map_header(e), o.check_only);
  }
  return stale;
}

/// Whether the files of a named design were stale.
bool check_named(const Options& o, const feltgate::design::RegisterMap& registers) {
  bool stale = false;
  for (const std::string& name : o.names) {
    const fs::path file = o.root / "rtl/designs" / (name + ".toml");
    const auto e = elaborate(feltgate::design::read_design(file.string()), registers);
    if (!update_design(o, e)) continue;
    stale = true;
    std::cerr << file.string()
              << ": the file has changed since feltgate generate, so what it says is not used; "
                 "run ./feltgate generate\n";
  }
  return stale;
}

/// Whether a file was stale.
bool generate_all(const Options& o, const feltgate::design::RegisterMap& registers) {
  const fs::path headers = o.root / "model/include/feltgate/generated";
  bool stale = update(o.root / "rtl/generated/map.sv", map_package(registers), o.check_only);
  stale |= update(headers / "map.hpp", map_header(registers), o.check_only);
  stale |=
      update(o.root / "rtl/generated/feltgate_link_pkg.sv", link_package(registers), o.check_only);
  stale |= update(headers / "link.hpp", link_header(registers), o.check_only);
  const auto engine = read_engine(o);
  stale |=
      update(o.root / "rtl/generated/feltgate_engine_pkg.sv", engine_package(engine), o.check_only);
  stale |= update(headers / "engine.hpp", engine_header(engine), o.check_only);
  stale |= update(o.root / "docs/engine-isa.md", engine_page(engine), o.check_only);
  stale |= update(headers / "causes.hpp", causes_header(registers), o.check_only);
  for (const auto& entry : fs::directory_iterator(o.root / "rtl/designs")) {
    if (entry.path().extension() != ".toml") continue;
    const auto e = elaborate(feltgate::design::read_design(entry.path().string()), registers);
    stale |= update_design(o, e);
  }
  return stale;
}

int main(int argc, char** argv) {
  Options o;
  if (!parse(argc, argv, &o)) {
    std::cerr << usage;
    return 2;
  }
  if (o.help) {
    std::cout << usage;
    return 0;
  }
  try {
    auto registers = feltgate::design::read_registers((o.root / "rtl/registers.toml").string());
    add_engine(o, &registers);
    if (!o.design.empty()) {
      generate_one(o, registers);
      return 0;
    }
    if (!o.names.empty()) return check_named(o, registers) ? 1 : 0;
    return generate_all(o, registers) && o.check_only ? 1 : 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
