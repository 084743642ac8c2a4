// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bounds of laws proven a second time, by Gappa.
#include "law/gappa.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <set>
#include <string>
#include "catch.hpp"

#include "compiled.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/random.hpp"
#include "files/program.hpp"
#include "law_tree.hpp"
#include "mismatch.hpp"

namespace feltgate::law {

namespace {

bool long_run() {
  const char* more = std::getenv("FELTGATE_LONG");
  return more != nullptr && *more != 0;
}

/// Gappa on a text.
class Prover {
 public:
  Prover()
      : folder_(std::filesystem::temp_directory_path() /
                fmt::format("feltgate_gappa.{}", getpid())),
        nowhere_(open("/dev/null", O_WRONLY | O_CLOEXEC)) {
    std::filesystem::create_directory(folder_);
  }
  ~Prover() {
    close(nowhere_);
    std::filesystem::remove_all(folder_);
  }
  Prover(const Prover&) = delete;
  Prover& operator=(const Prover&) = delete;

  bool proves(const std::string& text) const {
    const std::string path = (folder_ / "problem.g").string();
    std::ofstream(path) << text;
    return files::run_program({FELTGATE_GAPPA, path}, nowhere_, nowhere_) == 0;
  }
  GappaCount count(const Compiled& c, int cells) const {
    return prove_again(c, cells, [&](const GappaLemma& l) { return proves(l.text); });
  }

 private:
  std::filesystem::path folder_;
  int nowhere_;
};

void require_all(const Prover& gappa, const Compiled& c, int cells) {
  const GappaCount count = gappa.count(c, cells);
  INFO(c.law.name << ": " << count.steps - static_cast<int>(count.uncovered.size()) << " of "
                  << count.steps << " instructions covered by " << count.lemmas << " lemmas");
  for (const std::string& name : count.open) UNSCOPED_INFO("not proven: " << name);
  CHECK(count.open.empty());
  for (const int i : count.uncovered) UNSCOPED_INFO("not covered: " << i);
  CHECK(count.uncovered.empty());
  CHECK(count.lemmas > 0);
}

TEST_CASE("Gappa proves every instruction of the shipped laws") {
  const Prover gappa;
  // A usual run proves every sixth law.
  const int every = test::whole_run() ? 1 : 6;
  int i = 0;
  for (const std::string& name : shipped_names()) {
    if (i++ % every == 0) require_all(gappa, compiled_shipped(name), long_run() ? 0 : 1);
  }
}

TEST_CASE("Gappa's rounding is the engine's", "[defects]") {
  const Prover gappa;
  SplitMix64 random(3);
  std::string goals, wrong;
  for (int i = 0; i < 60; ++i) {
    const EngineOp op = i % 2 == 0 ? EngineOp::mul : EngineOp::mlw;
    const int mode = 1 + i / 2 % 3, shift = engine_shift(mode);
    const auto y = static_cast<std::int32_t>(random.below(262144) - 131072);
    // Ties, and others.
    const std::int32_t tie = shift < 20 ? 1 << (shift - 1) : 1 << 20;
    const auto x = static_cast<std::int32_t>(i % 4 < 2 ? random.below(4000000) - 2000000
                                                       : tie * (random.below(9) - 4));
    const std::int32_t result = engine_step(op, mode, {}, x, y, 0).acc;
    goals += fmt::format("{}{}(({}) * ({}) * 1b-{}) in [{},{}]", i > 0 ? " /\\ " : "",
                         i % 2 == 0 ? "near" : "down", x, y, shift, result, result);
  }
  const std::string head = "@near = fixed<0,nu>;\n@down = fixed<0,dn>;\n{ 0 in [0,0] -> ";
  CHECK(gappa.proves(head + goals + " }\n"));
  CHECK_FALSE(gappa.proves(head + "near(5 * 1b-1) in [2,2] }\n"));
}

TEST_CASE("what the tables say is looked up word by word") {
  const Compiled c = compiled_shipped("charge");
  for (std::size_t i = 0; i < c.program.steps.size(); ++i) {
    if (c.program.steps[i].op != EngineOp::lrp) continue;
    const TableUse& t = c.program.tables[static_cast<std::size_t>(c.program.steps[i].table)];
    const TableProof proof = table_proof(c, static_cast<int>(i));
    REQUIRE(proof.error.size() == t.words.size());
    double largest = 0;
    for (std::size_t k = 0; k < t.words.size(); ++k) {
      INFO("segment " << k);
      CHECK(proof.error[k] <= t.errors[k]);
      largest = larger(largest, proof.error[k]);
    }
    CHECK(largest > t.error / 2);
  }
}

// What a defect of the compiler's proof shows itself in: branches, tables, low-passes, factors.
TEST_CASE("a bound that is too small is not proven", "[defects]") {
  const Prover gappa;
  // A sum of two values that were rounded; a long law would take Gappa a minute to come to one.
  require_all(gappa,
              compiled("param k = 0.3 in -1 .. 1\n"
                       "let x = clamp(position, -1, 1)\n"
                       "out torque = 1 Nm * (abs(k * x) + abs(x * x))\n"),
              2);
  for (const char* name : {"wall", "charge_far", "quaternion"}) {
    require_all(gappa, compiled_shipped(name), 2);
  }
  require_all(gappa,
              compiled("rate = 40 kHz\n"
                       "param k = 0.3 Nm in -1 .. 1 Nm\n"
                       "state held = 0 in -1 .. 1\n"
                       "let x = clamp(position, -1, 1)\n"
                       "next held = lowpass(abs(x) * x, 100 Hz)\n"
                       "let y = sin(3 * position) * sqrt(abs(x) + 0.01)\n"
                       "let side = if position < 0.5 then 0.5 - position else 0\n"
                       "out torque = k * min(held, 0.7 * x) + 0.1 Nm * y + 1 mNm * side\n"),
              6);
}

TEST_CASE("Gappa proves what the language brings along") {
  const Prover gappa;
  const std::set<std::string> names{"cogging", "counts", "equal", "latch", "rough", "since"};
  std::size_t proven = 0;
  for (const Construct& c : constructs()) {
    if (names.count(c.name) == 0) continue;
    require_all(gappa, compiled(c.text), 2);
    ++proven;
  }
  CHECK(proven == names.size());
}

TEST_CASE("Gappa proves random laws") {
  const Prover gappa;
  int proven = 0;
  for (int i = 0; i < (long_run() ? 200 : 6); ++i) {
    const auto seed = static_cast<std::uint64_t>(i) + 5001;
    const judge::Law random = judge::random_law(seed, judge::Shape::formula);
    const std::string text = judge::Printer(random).text();
    INFO("law " << i << ":\n" << text);
    try {
      require_all(gappa, compiled(text), 2);
      ++proven;
    } catch (const LawError&) {
    }
  }
  CHECK(proven > 2);
}

}  // namespace
}  // namespace feltgate::law
