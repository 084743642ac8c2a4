// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The same for every shipped law of one axis, and how much time whole runs save.
// Documentation: docs/architecture.md, docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "both.hpp"
#include "law/compile.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// Calls `each` with every shipped law of one axis; returns their number.
template <class Each>
int for_shipped_laws(Each&& each) {
  const DesignInfo design = design_info<D>();
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
    each(path.stem().string(), c);
  }
  return laws;
}

/// Both twins, armed in the law.
std::unique_ptr<Both<1>> armed_in(const law::Compiled& c) {
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
  b->in.reg_addr = 0;
  b->run(20 * D::clocks_per_tick);
  return b;
}

template <class Work>
double cpu_s(Work&& work) {
  const std::clock_t began = std::clock();
  work();
  return static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE("axes by runs: every shipped law of one axis") {
  const int laws = for_shipped_laws([](const std::string&, const law::Compiled& c) {
    const auto b = armed_in(c);
    Random random(7);
    const std::int64_t done = b->done, whole = b->whole;
    live<1>(*b, random, 2000, false);
    // Run by run it goes from a start on: where runs are far apart that is late.
    const double share = c.divider < 50 ? 0.95 : 0.0;
    CHECK(static_cast<double>(b->whole - whole) > share * static_cast<double>(b->done - done));
    live<1>(*b, random, 300, true);
  });
  CHECK(laws >= 8);
}

/// Prints the table of docs/speed-for-accuracy.md: a lever that moves a count every 37 ticks, for
/// 0.02 s.
TEST_CASE("axes by runs: CPU time of every shipped law", "[.][times]") {
  constexpr int moves = 540, ticks = 37;
  struct Unwatched {
    void event(std::int64_t, int) {}
    void words() {}
  } unwatched;
  std::cout << "| law | by clocks, s | by runs, s | ratio |\n|---|---|---|---|\n";
  const int laws = for_shipped_laws([&](const std::string& name, const law::Compiled& c) {
    const auto b = armed_in(c);
    double by_clock_s = 0, by_run_s = 0;
    for (int k = 0; k < moves; ++k) {
      constexpr std::int64_t clocks = ticks * D::clocks_per_tick;
      b->step(0, k % 90 < 45);
      by_clock_s += cpu_s([&] {
        for (std::int64_t n = 0; n < clocks; ++n) b->by_clock.clock(b->in);
      });
      by_run_s += cpu_s([&] {
        b->by_event.run(
            b->in, clocks, [] {}, unwatched);
      });
    }
    b->memories();
    std::cout << fmt::format("| {} | {:.3f} | {:.3f} | {:.1f} |\n", name, by_clock_s, by_run_s,
                             by_clock_s / by_run_s);
  });
  CHECK(laws >= 8);
}
