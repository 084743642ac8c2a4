// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random laws against the compiler: a judge without shared code checks their words.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include "catch.hpp"

#include "judge.hpp"
#include "law/diagnostics.hpp"
#include "mismatch.hpp"

namespace feltgate::judge {
namespace {

using test::share_of_week;
using test::whole_run;

int from_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr && *text != 0 ? std::atoi(text) : otherwise;
}

struct Total {
  int laws = 0, refused = 0, failed = 0;
  int left_out = 0;  ///< laws for which strips explain more than a tenth of the runs
  int left = 0;      ///< laws whose words leave them in more than 30 % of the free runs
  Verdict runs;

  void add(const std::string& name, const Law& law, std::uint64_t seed, int runs_each) {
    const Printer printer(law);
    const std::string text = printer.text();
    INFO(name << ":\n" << text);
    if (std::getenv("FELTGATE_SHOW") != nullptr) std::cout << name << ":\n" << text;
    ++laws;
    try {
      const law::Compiled c = law::compile_text(text, "random.law", law::Target{});
      CHECK(c.bound.unproven.empty());
      const Verdict v = judge(law, printer, c, seed, runs_each);
      INFO(v.failure);
      CHECK(v.failure.empty());
      failed += v.failure.empty() ? 0 : 1;
      if (v.turned * 10 > v.runs) {
        ++left_out;
        WARN(name << ": " << v.turned << " of " << v.runs
                  << " runs only explained by a comparison in its strip, the first "
                  << v.first_turned);
      }
      runs.runs += v.runs;
      runs.turned += v.turned;
      runs.aimed += v.aimed;
      runs.aimed_turned += v.aimed_turned;
      runs.unread_states += v.unread_states;
      if (v.left * 10 > v.acting * 3) {
        ++left;
        WARN(name << ": left the law in " << v.left << " of " << v.acting << " free runs");
      }
    } catch (const law::LawError& e) {
      ++refused;
      INFO(e.what());
      CHECK(std::string(e.what()).find("; ") != std::string::npos);
      if (std::getenv("FELTGATE_SHOW") != nullptr) std::cout << name << ": " << e.what() << "\n";
    }
  }

  std::string summary() const {
    return fmt::format(
        "{} laws, {} refused, {} wrong, {} left out in strips; {} runs, {} explained by a strip; "
        "{} aimed at a comparison, {} explained by its strip; {} states that no step reads; {} "
        "laws "
        "left in free runs",
        laws, refused, failed, left_out, runs.runs, runs.turned, runs.aimed, runs.aimed_turned,
        runs.unread_states, left);
  }
};

TEST_CASE("laws that were compiled wrongly once") {
  Total total;
  for (const Directed& d : directed_laws()) total.add(d.name, d.law, 7, 300);
  CHECK(total.refused == 0);
  CHECK(total.left_out == 0);
  CHECK(total.left == 0);
}

TEST_CASE("laws that come close to their bounds") {
  Total total;
  for (const Directed& d : tight_laws()) total.add(d.name, d.law, 7, 1000);
  CHECK(total.refused == 0);
  CHECK(total.left_out == 0);
}

/// A random law by its number.
void add_random(Total& total, int i, Shape shape) {
  const auto seed = static_cast<std::uint64_t>(i) + 1;
  total.add("law " + std::to_string(i), random_law(seed, shape), seed, 200);
}

Shape shape_of(int i) { return static_cast<Shape>(i % shapes); }

/// So many laws in a usual run, others each week, `all` in a whole one and ten times as many in a
/// long one. FELTGATE_JUDGE_FIRST and FELTGATE_JUDGE_LAWS select the first law and their number.
template <class ShapeOf>
Total random_laws(int usual, int week, int all, const ShapeOf& shape) {
  const int first = from_environment(
      "FELTGATE_JUDGE_FIRST", whole_run() ? 0 : usual * static_cast<int>(share_of_week(week)));
  const int count = from_environment(
      "FELTGATE_JUDGE_LAWS", whole_run() ? static_cast<int>(test::scaled_clocks(all)) : usual);
  const int most = from_environment("FELTGATE_JUDGE_MOST", 4);
  const auto began = std::chrono::steady_clock::now();
  Total total;
  // After enough failures no more laws are needed.
  for (int i = first; i < first + count && total.failed <= most; ++i) {
    add_random(total, i, shape(i));
    if (total.laws % 1000 != 0) continue;
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - began;
    std::cerr << fmt::format("law {}: {} of {} laws, {} wrong, {} refused; {:.0f} min to go\n", i,
                             total.laws, count, total.failed, total.refused,
                             gone.count() / 60 * (count - total.laws) / total.laws);
  }
  WARN(total.summary());
  // With few laws a share means little: 50 are added.
  CHECK(total.refused * 10 <= total.laws + 50);
  return total;
}

/// Functions over the whole range of an input: the compiler moves limits into their arguments.
TEST_CASE("random laws of wide functions stay within their bounds") {
  const Total total = random_laws(20, 3, 1000, [](int) { return Shape::wide; });
  CHECK(total.left_out * 20 <= total.laws + 100);
}

/// Whole states of real numbers, states, floors and rests at their ends, with every operator.
TEST_CASE("random laws that stay at ends go on as the law does") {
  const Total total = random_laws(40, 2, 2000, [](int) { return Shape::ends; });
  CHECK(total.left_out * 100 <= total.laws + 50);
  CHECK(total.left * 100 <= total.laws + 50);
}

TEST_CASE("random laws stay within their bounds") {
  const Total total = random_laws(60, 4, 10000, shape_of);
  const Verdict& r = total.runs;
  CHECK(total.left_out * 200 <= total.laws + 100);
  CHECK(r.turned * 100 <= r.runs + 1000);
  CHECK(r.unread_states * 100 <= total.laws + 100);
  CHECK(total.left * 100 <= total.laws + 100);
}

}  // namespace
}  // namespace feltgate::judge
