// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What five papers claim, beside a closed form and a simulation of each claim; the verdict follows
// from the figures. Documentation: docs/claims.md
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "sim/loop/loop.hpp"

namespace feltgate::claims {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = 3.14159265358979323846;

/// What a statement asks of a figure. NaN is never as asked.
struct Asked {
  enum class Kind { nothing, near, at_most, at_least } kind = Kind::nothing;
  double value = none, within = 0;  ///< in the unit of the figure
  bool met(double x) const;
};
inline Asked near(double value, double within) { return {Asked::Kind::near, value, within}; }
inline Asked at_most(double value) { return {Asked::Kind::at_most, value, 0}; }
inline Asked at_least(double value) { return {Asked::Kind::at_least, value, 0}; }

struct Figure {
  std::string what, unit;
  double formula = none, simulated = none;  ///< NaN: there is none
  Asked asked;                              ///< nothing: the figure explains and judges nothing
  bool conditional = false;                 ///< under the condition that the claim's `why` says
  bool judges() const { return asked.kind != Asked::Kind::nothing; }
  /// Whether the closed form and the simulation, as far as there are, are as asked.
  bool agrees() const;
};

enum class Verdict { holds, holds_if, cannot_be_had };
const char* name_of(Verdict verdict);

struct Claim {
  std::string where;       ///< section, figure, table or equation of the paper
  std::string says;        ///< the claim
  std::string formula;     ///< the closed form
  std::string simulation;  ///< what was run, or why nothing can be
  std::string why;         ///< the condition, or what is wrong
  std::vector<Figure> figures;

  void explains(std::string what, std::string unit, double by_formula, double simulated = none);
  void asks(std::string what, std::string unit, double by_formula, double simulated, Asked asked);
  void asks_if(std::string what, std::string unit, double by_formula, double simulated,
               Asked asked);
  /// It holds if all figures without a condition agree, else "holds if" where there are some with
  /// one and all of those agree. Without a figure to judge nothing can be had.
  Verdict verdict() const;
};

/// Scenes, plants and designs of the repository, and runs of the twin with them.
class Lab {
 public:
  explicit Lab(std::string root) : root_(std::move(root)) {}
  Scenario scene(const std::string& name) const;
  plant::Parameters plant(const std::string& name) const;
  design::Elaborated design(const std::string& name) const;
  using PlantStep = std::function<void(double time_s, const plant::Observables&)>;
  RunResult run(Scenario scene, const plant::Parameters& plant, const std::string& design,
                const std::function<void(const Row&)>& row = {}, const PlantStep& step = {}) const;

 private:
  std::string root_;
};

/// A row of the table: the claim's name, its paper, and the function that works it out.
struct Source {
  const char* name;
  int paper;  ///< index in papers()
  Claim (*work_out)(const Lab&);
};
struct Paper {
  const char* title;
  const char* source;
};
const std::vector<Paper>& papers();
const std::vector<Source>& sources();
/// The rows of the Haptic Lever, and of the other four papers; sources() has both.
std::vector<Source> haptic_lever();
std::vector<Source> other_papers();

/// A row, worked out.
struct Answer {
  Source source;
  Claim claim;
};
std::string text(const Answer& answer);
/// How many there are of each verdict, in a line.
std::string summary(const std::vector<Answer>& answers);
std::string json(const std::vector<Answer>& answers);
/// The page docs/claims.md, of these answers.
std::string page(const std::vector<Answer>& answers);

/// The claims of papers with files of their own.
std::vector<Source> touch_world();
std::vector<Source> dimple();

}  // namespace feltgate::claims
