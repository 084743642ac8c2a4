// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Greedy removal of plant effects. Documentation: docs/speed-for-accuracy.md
#include "studies/trim/trim.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "feltgate/largest.hpp"

namespace feltgate::trim {

namespace {

// Whole ticks from 50 on: there the twin needs no single clocks.
constexpr int steps_clocks[] = {250, 200, 150, 100, 50, 25, 10, 5, 2};
constexpr int averaged_step_clocks = 50;

bool equal(const Model& a, const Model& b) {
  return a.gates == b.gates && a.step_clocks == b.step_clocks &&
         std::all_of(
             std::begin(plant::effect_names), std::end(plant::effect_names),
             [&](const plant::EffectName& e) { return a.effects.*e.flag == b.effects.*e.flag; });
}

struct Job {
  const Course* course;
  Model model;
};

/// Runs models on motions, several at a time, and counts what that costs.
class Runner {
 public:
  Runner(const Options& options, const Model& full, int expected_full_runs)
      : options_(options), full_(full), expected_(expected_full_runs) {}

  std::vector<Felt> run(const std::vector<Job>& jobs) {
    std::vector<Felt> felt(jobs.size());
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    const auto work = [&] {
      for (std::size_t i = next++; i < jobs.size(); i = next++) {
        try {
          felt[i] = jobs[i].course->feel(jobs[i].model);
        } catch (...) {
          const std::lock_guard<std::mutex> lock(mutex_);
          failure = std::current_exception();
          return;
        }
        note(jobs[i], felt[i]);
      }
    };
    std::vector<std::thread> threads;
    for (int t = 1; t < options_.threads; ++t) threads.emplace_back(work);
    work();
    for (std::thread& t : threads) t.join();
    if (failure) std::rethrow_exception(failure);
    return felt;
  }
  Felt run(const Course& course, const Model& model) { return run({{&course, model}}).front(); }

  int runs = 0;
  double cpu_s = 0;

 private:
  // The full model's runs take most of the time, so they alone are the progress.
  void note(const Job& job, const Felt& felt) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++runs;
    cpu_s += felt.cpu_s;
    if (equal(job.model, full_)) ++full_runs_;
    if (!options_.progress) return;
    const double done = static_cast<double>(full_runs_) / expected_;
    options_.progress(done < 1 ? done : 0.99);
  }

  const Options& options_;
  const Model full_;
  int expected_;
  int full_runs_ = 0;
  std::mutex mutex_;
};

/// One motion, its full model's run, and how far a model is from it.
struct Reference {
  Course course;
  Felt full;
};

class Search {
 public:
  Search(const Subject& subject, const Options& options)
      : subject_(subject),
        options_(options),
        runner_(options, subject.full, options.unseen + options.timed_runs),
        own_{subject.own, {}} {
    out_.full = out_.trimmed = subject.full;
  }

  Report run() {
    own_.full = out_.full_run = runner_.run(own_.course, out_.full);
    if (out_.full.gates) drop_gates();
    drop_effects();
    coarsen();
    final_check();
    if (!out_.smaller()) return of_full();
    out_.trimmed_run = runner_.run(own_.course, out_.trimmed);
    out_.own = compare(own_.full, out_.trimmed_run);
    time_both();
    return counted();
  }

 private:
  using Clock = std::chrono::steady_clock;

  const Report& counted() {
    out_.runs = runner_.runs;
    out_.cpu_s = runner_.cpu_s;
    return out_;
  }

  // Nothing is left out: the same model needs no second run.
  const Report& of_full() {
    out_.trimmed_run = own_.full;
    out_.faster = {1.0};
    return counted();
  }

  bool out_of_time() {
    const std::chrono::duration<double> taken = Clock::now() - begin_;
    out_.out_of_time = options_.longest_s > 0 && taken.count() > options_.longest_s;
    return out_.out_of_time;
  }

  // The CPU time of a run varies by tens of percent on a busy machine: medians of several.
  void time_both() {
    std::vector<double> full{out_.full_run.cpu_s}, trimmed{out_.trimmed_run.cpu_s};
    for (int i = 1; i < options_.timed_runs; ++i) {
      full.push_back(runner_.run(own_.course, out_.full).cpu_s);
      trimmed.push_back(runner_.run(own_.course, out_.trimmed).cpu_s);
    }
    for (std::size_t i = 0; i < full.size(); ++i) out_.faster.push_back(full[i] / trimmed[i]);
    for (std::vector<double>* times : {&full, &trimmed, &out_.faster}) {
      std::sort(times->begin(), times->end());
    }
    out_.full_run.cpu_s = full[full.size() / 2];
    out_.trimmed_run.cpu_s = trimmed[trimmed.size() / 2];
  }

  bool fits(double loss) const { return loss <= options_.share * options_.tolerance; }

  void drop_gates() {
    Model averaged = out_.trimmed;
    set_part(averaged, gates, false);
    averaged.step_clocks = averaged_step_clocks;
    const Felt felt = runner_.run(own_.course, averaged);
    PartReport part;
    part.name = gates;
    part.alone = compare(own_.full, felt);
    part.so_far = part.alone.worst();
    part.saves = 1 - felt.cpu_s / own_.full.cpu_s;
    part.dropped = fits(part.so_far);
    if (part.dropped) {
      out_.trimmed = averaged;
      sum_ = part.so_far;
    }
    out_.parts.push_back(part);
  }

  // Each effect alone, twice, since these runs are short and their time is asked for.
  std::vector<PartReport> leave_out_each() {
    std::vector<std::string> names = subject_.parts(out_.trimmed);
    names.erase(std::remove(names.begin(), names.end(), gates), names.end());
    std::vector<Job> jobs;
    const int times = out_.trimmed.gates ? 1 : 2;
    for (int k = 0; k < times; ++k) {
      jobs.push_back({&own_.course, out_.trimmed});
      for (const std::string& name : names) {
        jobs.push_back({&own_.course, out_.trimmed});
        set_part(jobs.back().model, name, false);
      }
    }
    const std::vector<Felt> felt = runner_.run(jobs);
    const std::size_t stride = names.size() + 1;
    const auto cpu_s = [&](std::size_t i) {
      return std::min(felt[i].cpu_s, felt[i + stride * static_cast<std::size_t>(times - 1)].cpu_s);
    };
    std::vector<PartReport> parts(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      parts[i].name = names[i];
      parts[i].alone = compare(felt[0], felt[i + 1]);
      parts[i].saves = 1 - cpu_s(i + 1) / cpu_s(0);
    }
    return parts;
  }

  void drop_effects() {
    std::vector<PartReport> parts = leave_out_each();
    // The least loss first. The time that an effect saves is a few percent, less than its noise.
    std::stable_sort(parts.begin(), parts.end(), [](const PartReport& a, const PartReport& b) {
      return a.alone.worst() < b.alone.worst();
    });
    for (PartReport& part : parts) {
      // Twice the tolerance alone: no other part could be counted on to make up for it.
      if (part.alone.worst() <= 2 * options_.tolerance) {
        Model without = out_.trimmed;
        set_part(without, part.name, false);
        // Errors that cancel on this motion need not on another: the sum of all alone counts too.
        part.so_far = larger(sum_ + part.alone.worst(),
                             compare(own_.full, runner_.run(own_.course, without)).worst());
        part.dropped = fits(part.so_far);
        if (part.dropped) {
          out_.trimmed = without;
          sum_ += part.alone.worst();
        }
      }
      out_.parts.push_back(part);
    }
  }

  void coarsen() {
    for (const int step : steps_clocks) {
      if (step <= out_.trimmed.step_clocks) return;
      Model coarse = out_.trimmed;
      coarse.step_clocks = step;
      const double loss = compare(own_.full, runner_.run(own_.course, coarse)).worst();
      if (!fits(loss)) continue;
      out_.trimmed = coarse;
      out_.step_loss = loss;
      return;
    }
  }

  // Fresh motions each time; those of earlier rounds stay.
  void final_check() {
    std::vector<Reference> motions;
    constexpr int rounds = 3;
    for (int round = 0; round < rounds && !out_.holds && !out_of_time(); ++round) {
      add_motions(motions);
      out_.holds = holds(motions);
      while (!out_.holds && !out_of_time()) {
        for (UnseenReport& u : out_.unseen) u.searched = true;
        if (!put_one_back(motions)) break;
        if (holds(motions)) break;
      }
    }
    if (out_.holds) return;
    out_.trimmed = out_.full;
    for (PartReport& p : out_.parts) p.put_back |= p.dropped;
    for (PartReport& p : out_.parts) p.dropped = false;
    // Out of time, the full model is not run against itself.
    for (UnseenReport& u : out_.unseen) u.difference = {};
    out_.holds = out_.out_of_time || holds(motions);
  }

  void add_motions(std::vector<Reference>& motions) {
    const std::size_t first = motions.size();
    for (int k = 0; k < options_.unseen; ++k) {
      UnseenReport u;
      u.seed = options_.seed + motions.size();
      Course other = subject_.other(u.seed);
      u.amplitude = other.amplitude;
      u.speed = other.speed;
      out_.unseen.push_back(u);
      motions.push_back({std::move(other), {}});
    }
    std::vector<Job> jobs;
    for (std::size_t i = first; i < motions.size(); ++i) {
      jobs.push_back({&motions[i].course, out_.full});
    }
    std::vector<Felt> felt = runner_.run(jobs);
    for (std::size_t i = first; i < motions.size(); ++i)
      motions[i].full = std::move(felt[i - first]);
  }

  std::vector<Difference> differences(const std::vector<Reference>& motions, const Model& model) {
    std::vector<Job> jobs;
    for (const Reference& r : motions) jobs.push_back({&r.course, model});
    const std::vector<Felt> felt = runner_.run(jobs);
    std::vector<Difference> all;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      all.push_back(compare(motions[i].full, felt[i]));
    }
    return all;
  }

  bool holds(const std::vector<Reference>& motions) {
    const std::vector<Difference> all = differences(motions, out_.trimmed);
    bool ok = true;
    for (std::size_t i = 0; i < all.size(); ++i) {
      out_.unseen[i].difference = all[i];
      ok &= fits(all[i].worst());
    }
    return ok;
  }

  /// A step back: a model with one more part, or with a finer step (then without a part).
  struct Return {
    Model model;
    PartReport* part;
  };

  // The cheap ones first: the step, the effects, and only then the gates.
  std::vector<Return> returns() {
    std::vector<Return> all;
    const auto finer = std::find_if(std::begin(steps_clocks), std::end(steps_clocks),
                                    [this](int step) { return step < out_.trimmed.step_clocks; });
    if (finer != std::end(steps_clocks) && *finer >= out_.full.step_clocks) {
      all.push_back({out_.trimmed, nullptr});
      all.back().model.step_clocks = *finer;
    }
    for (auto part = out_.parts.rbegin(); part != out_.parts.rend(); ++part) {
      if (!part->dropped) continue;
      all.push_back({out_.trimmed, &*part});
      set_part(all.back().model, part->name, true);
      if (part->name == gates) all.back().model.step_clocks = out_.full.step_clocks;
    }
    return all;
  }

  /// The first return with which the check holds; if none does, the one that mends most. False when
  /// everything is back.
  bool put_one_back(const std::vector<Reference>& motions) {
    std::optional<Return> best;
    double least = 1e300;
    for (const Return& r : returns()) {
      if (out_of_time()) return false;
      double worst = 0;
      for (const Difference& d : differences(motions, r.model)) worst = larger(worst, d.worst());
      // The gates cost ten times what all else does: they must mend clearly more.
      const bool gates_back = r.part != nullptr && r.part->name == gates;
      if (worst >= (gates_back && best ? 0.5 : 1.0) * least) continue;
      least = worst;
      best = r;
      if (fits(worst)) break;
    }
    if (!best) return false;
    out_.trimmed = best->model;
    if (best->part != nullptr) {
      best->part->dropped = false;
      best->part->put_back = true;
    }
    return true;
  }

  const Subject& subject_;
  const Options& options_;
  Runner runner_;
  Reference own_;
  const Clock::time_point begin_ = Clock::now();
  double sum_ = 0;  ///< sum of the single losses of the removed parts
  Report out_;
};

}  // namespace

bool Report::smaller() const { return !equal(full, trimmed); }

Report trim(const Subject& subject, const Options& options) {
  return Search(subject, options).run();
}

}  // namespace feltgate::trim
