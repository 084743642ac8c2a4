// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registry of the boards' cores that a program has, by design and kind. Documentation:
// docs/host.md
#include "host/board/core.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace feltgate::board {

namespace {

struct Maker {
  std::string design, kind;
  CoreMaker make;
};

std::vector<Maker>& makers() {
  static std::vector<Maker> all;
  return all;
}

}  // namespace

bool add_core(const std::string& design, const std::string& kind, CoreMaker make) {
  makers().push_back({design, kind, make});
  return true;
}

std::unique_ptr<Core> make_core(const std::string& design, const std::string& kind,
                                const BoardOptions& options) {
  for (const Maker& m : makers()) {
    if (m.design == design && m.kind == kind) return m.make(options);
  }
  throw std::invalid_argument(fmt::format(
      "design {}: its board as {} is not in this program; ./feltgate board --design {}{} builds it",
      design, kind, design, kind == "rtl" ? " --rtl" : ""));
}

}  // namespace feltgate::board
