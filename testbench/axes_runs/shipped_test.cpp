// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The same for every shipped law. Documentation: docs/blocks/feltgate_axes.md
#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "both.hpp"
#include "law/compile.hpp"

using namespace feltgate;
using namespace feltgate::test;

TEST_CASE("axes by runs: every shipped law of one axis") {
  DesignInfo design = design_info<D>();
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(FELTGATE_ROOT "/rtl/laws")) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  int laws = 0;
  for (const auto& path : paths) {
    if (path.extension() != ".law") continue;
    const law::Compiled c = law::compile_file(path.string(), law::target_of(design));
    if (c.image.outputs.size() != 1) continue;
    ++laws;
    INFO(path.stem().string() << ", " << c.image.threads[0].length << " instructions, divider "
                              << c.divider);
    auto b = std::make_unique<Both<1>>();
    EngineMemory m;
    m.program = c.image.program;
    m.data = c.image.data;
    m.table = c.image.table;
    m.line_base = c.image.line_base;
    load<1>(*b, m, 1, static_cast<unsigned>(c.divider), 1000);
    b->arm(D::S::law);
    for (int word = 0; word < EngineMap::parameter_words; ++word) {
      const std::int32_t value = c.image.data[static_cast<std::size_t>(320 + word)];
      b->engine(EngineMap::D::parameter + word, static_cast<std::uint32_t>(value));
    }
    b->engine(H::commit, 1);
    REQUIRE(b->by_clock.out().axis[0].armed);
    Random random(7);
    b->in.reg_addr = 0;
    b->run(20 * D::clocks_per_tick);
    const std::int64_t done = b->done, whole = b->whole;
    live<1>(*b, random, 2000, false);
    // Run by run it goes from a start on: where runs are far apart that is late.
    const double share = c.divider < 50 ? 0.95 : 0.0;
    CHECK(static_cast<double>(b->whole - whole) > share * static_cast<double>(b->done - done));
    live<1>(*b, random, 300, true);
  }
  CHECK(laws >= 8);
}
