// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Checks a schedule. It is refused for a late result, a result that is overwritten too early, words
// that collide on a bus, words in the wrong bank, and clocks outside the tick. Documentation:
// docs/architecture.md
#include "design/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

[[noreturn]] void refuse(const std::string& place, const std::string& what,
                         const std::string& mend) {
  throw config::ConfigError(fmt::format("{}: {}; {}", place, what, mend));
}

/// A use of a result in a clock.
struct Use {
  std::string what, place;
  int clock;
};

void check_previous(const Schedule& s, const Need& need, const Use& use) {
  for (const Step& step : s.steps) {
    if (step.name != need.result && step.shows_in != need.result) continue;
    if (use.clock > step.clock) {
      refuse(use.place,
             fmt::format("{} in clock {} is to see the {} of the tick before, but the new one is "
                         "there from clock {} on (step {}, {})",
                         use.what, use.clock, need.result, step.clock + 1, step.name, step.place),
             "move it ahead, or the new one back");
    }
  }
}

void check_need(const Schedule& s, const Need& need, const Use& use) {
  const Step* step = s.step(need.result);
  if (step == nullptr) {
    refuse(use.place, fmt::format("{} needs \"{}\", which no step gives", use.what, need.result),
           "name a step");
  }
  if (need.previous) {
    check_previous(s, need, use);
    return;
  }
  const int ready = step->clock + 1;
  if (use.clock < ready) {
    refuse(use.place,
           fmt::format("{} comes late for {}: it is there from clock {} on (step {}) and needed in "
                       "clock {}",
                       need.result, use.what, ready, step->place, use.clock),
           "move the use back or the result ahead");
  }
  if (step->lasts > 0 && use.clock >= ready + step->lasts) {
    refuse(
        use.place,
        fmt::format("{} passes: it is there from clock {} to {} (step {}), and {} needs it in "
                    "clock {}",
                    need.result, ready, ready + step->lasts - 1, step->place, use.what, use.clock),
        "let both move together");
  }
  // The next value of the same register overwrites the result.
  const Step* after = step->shows_in.empty() ? nullptr : s.step(step->shows_in);
  if (after != nullptr && use.clock > after->clock) {
    refuse(use.place,
           fmt::format("{} is overwritten in clock {} by {} (step {}), and {} needs it in clock {}",
                       need.result, after->clock, after->name, after->place, use.what, use.clock),
           "move the use ahead");
  }
}

void check_uses(const RegisterMap& map, const Schedule& s) {
  for (const Product& p : s.products) {
    check_need(s, p.operand, {fmt::format("the product {}", p.name), p.place, p.slot});
  }
  for (const Step& step : s.steps) {
    if (!step.shows_in.empty() && s.step(step.shows_in) == nullptr) {
      refuse(step.place,
             fmt::format("{} shows in \"{}\", which is no step", step.name, step.shows_in),
             "name a step");
    }
    for (const Need& need : step.needs) {
      check_need(s, need, {fmt::format("the step {}", step.name), step.place, step.clock});
    }
    for (const std::string& name : step.takes) {
      const Parameter* word = map.find(name);
      if (word == nullptr) {
        refuse(step.place, fmt::format("there is no word {} to take", name), "name a parameter");
      }
      if (word->slot != step.clock) {
        refuse(
            word->place,
            fmt::format("{} is on the bus in clock {}, but the step {} ({}) takes it in clock {}",
                        name, word->slot, step.name, step.place, step.clock),
            "give it that slot");
      }
    }
  }
}

/// Checks the words of the snapshot that a step puts on the operand bus.
void check_reads(const RegisterMap& map, const Schedule& s) {
  std::vector<std::string> pinned;
  for (const Step& step : s.steps) {
    for (const std::string& name : step.reads) {
      pinned.push_back(name);
      for (const Snapshot& n : map.snapshots) {
        if (n.name != name || n.slot == step.clock) continue;
        refuse(n.place,
               fmt::format("{} of the snapshot is in slot {}, but the step {} ({}) reads it in "
                           "clock {}",
                           name, n.slot, step.name, step.place, step.clock),
               "give it that slot");
      }
    }
  }
  // A word for the operand bus is selected one clock ahead.
  for (const Snapshot& n : map.snapshots) {
    if (n.slot > 0 || std::find(pinned.begin(), pinned.end(), n.name) != pinned.end()) continue;
    refuse(n.place,
           fmt::format("{} of the snapshot in slot 0 would be selected before the wave", n.name),
           "give it a later slot");
  }
  for (const Product& p : s.products) {
    if (p.slot > 0) continue;
    refuse(p.place,
           fmt::format("the operand of {} in slot 0 would be selected before the wave", p.name),
           "give it a later slot");
  }
}

bool share_a_scene(const Product& a, const Product& b) {
  if (a.scenes.empty() || b.scenes.empty()) return true;
  return std::any_of(a.scenes.begin(), a.scenes.end(), [&](const std::string& scene) {
    return std::find(b.scenes.begin(), b.scenes.end(), scene) != b.scenes.end();
  });
}

/// Whether the word or operand of a clock is the very result that is on the operand bus.
bool reads_result(const Schedule& s, const Step& on_bus, const Snapshot& n) {
  const Product* product = s.product(n.with);
  if (product != nullptr && product->operand.result == on_bus.name) return true;
  return std::any_of(s.steps.begin(), s.steps.end(), [&](const Step& step) {
    const auto is = [&](const Need& need) { return need.result == on_bus.name; };
    return std::find(step.reads.begin(), step.reads.end(), n.name) != step.reads.end() &&
           std::any_of(step.needs.begin(), step.needs.end(), is);
  });
}

/// Checks the results that occupy the operand bus while they last.
void check_results_on_bus(const RegisterMap& map, const Schedule& s) {
  for (const Step& step : s.steps) {
    if (!step.on_operand_bus) continue;
    const auto there = [&step](int slot) {
      return slot > step.clock && slot <= step.clock + step.lasts;
    };
    const auto meets = [&step](const std::string& place, const std::string& what, int slot) {
      refuse(place,
             fmt::format("two words meet on the operand bus in slot {}: {} and {} ({})", slot, what,
                         step.name, step.place),
             "move one of them");
    };
    for (const Product& p : s.products) {
      if (there(p.slot) && p.operand.result != step.name) {
        meets(p.place, "the operand of " + p.name, p.slot);
      }
    }
    for (const Snapshot& n : map.snapshots) {
      if (there(n.slot) && !reads_result(s, step, n)) {
        meets(n.place, n.name + " of the snapshot", n.slot);
      }
    }
  }
}

/// Checks that the operand bus is empty where a step needs a product of 0, a latency before.
void check_no_products(const RegisterMap& map, const Schedule& s) {
  for (const Step& step : s.steps) {
    if (step.no_product == 0) continue;
    const int first = step.clock - s.multiplier_latency;
    const auto empty = [&](const std::string& place, const std::string& what, int from, int to) {
      if (to < first || from >= first + step.no_product) return;
      refuse(place,
             fmt::format("{} in slot {} makes a product in clock {}, where the step {} ({}) needs "
                         "a product of 0",
                         what, from, from + s.multiplier_latency, step.name, step.place),
             "move one of them");
    };
    for (const Product& p : s.products) empty(p.place, "the operand of " + p.name, p.slot, p.slot);
    for (const Snapshot& n : map.snapshots) {
      empty(n.place, n.name + " of the snapshot", n.slot, n.slot);
    }
    for (const Step& other : s.steps) {
      if (!other.on_operand_bus) continue;
      empty(other.place, "the result of " + other.name, other.clock + 1, other.clock + other.lasts);
    }
  }
}

/// Checks that users of the one operand bus and the one multiplier do not collide.
void check_buses(const RegisterMap& map, const Schedule& s) {
  for (const Product& p : s.products) {
    for (const Product& q : s.products) {
      if (&p < &q && p.slot == q.slot && share_a_scene(p, q)) {
        refuse(q.place,
               fmt::format("two products are wanted of slot {} of the multiplier: {} ({}) and {}",
                           q.slot, p.name, p.place, q.name),
               "give one another slot");
      }
    }
  }
  for (const Snapshot& n : map.snapshots) {
    for (const Snapshot& other : map.snapshots) {
      if (&n < &other && n.slot == other.slot) {
        refuse(other.place,
               fmt::format("two words of the snapshot meet in slot {}: {} ({}) and {}", n.slot,
                           n.name, n.place, other.name),
               "give one another slot");
      }
    }
    for (const Product& p : s.products) {
      if (p.slot == n.slot && p.name != n.with) {
        refuse(n.place,
               fmt::format("two words meet on the operand bus in slot {}: {} of the snapshot and "
                           "the operand of {} ({})",
                           n.slot, n.name, p.name, p.place),
               "give one another slot");
      }
    }
    if (!n.with.empty() && s.product(n.with) == nullptr) {
      refuse(n.place, fmt::format("{} passes by with {}, which is no product", n.name, n.with),
             "name a product");
    }
  }
}

/// Checks that each slot is read from only one bank: the scene's or the common one.
void check_banks(const RegisterMap& map, const Schedule& s) {
  for (const Parameter& p : map.parameters) {
    const bool of_scene = !p.scene.empty();
    if (p.slot >= s.wave_length) continue;
    for (const Parameter& other : map.parameters) {
      if (of_scene && other.scene.empty() && other.slot == p.slot) {
        refuse(p.place,
               fmt::format("two words meet on the parameter bus in slot {}: {} lies in the bank of "
                           "a scene, {} ({}) in the common one",
                           p.slot, p.name, other.name, other.place),
               "give one another slot");
      }
    }
    // The last clock before wave clock 0 still fetches from the common bank.
    if (of_scene && p.slot == 0) {
      refuse(p.place, fmt::format("slot 0 cannot be a scene's, and {} is one's", p.name),
             "give it a later one");
    }
  }
}

/// Checks that a word that a step fetches is alone on the parameter bus in its clock.
void check_fetches(const RegisterMap& map, const Schedule& s) {
  for (const Step& step : s.steps) {
    if (step.fetches.empty()) continue;
    if (map.find(step.fetches) == nullptr) {
      refuse(step.place, fmt::format("there is no word {} to fetch", step.fetches),
             "name a parameter");
    }
    for (const Parameter& p : map.parameters) {
      if (p.slot != step.clock) continue;
      refuse(p.place,
             fmt::format("two words meet on the parameter bus in slot {}: {} and {}, which the "
                         "step {} ({}) fetches",
                         p.slot, p.name, step.fetches, step.name, step.place),
             "give one another slot");
    }
  }
}

/// Checks that the wave ends before the next one; its last two clocks already fetch words of the
/// next wave.
void check_ends(const RegisterMap& map, const Schedule& s) {
  const int last = s.wave_length - s.first_wave_clock - 1;
  const auto inside = [&](const std::string& place, const std::string& what, int clock) {
    if (clock < 0 || clock > last) {
      refuse(place,
             fmt::format("{} lies in clock {}, outside the clocks 0 to {} of a tick of {} clocks",
                         what, clock, last, s.wave_length),
             "move it, or make the wave longer");
    }
  };
  for (const Step& step : s.steps) inside(step.place, "the step " + step.name, step.clock);
  for (const Product& p : s.products) {
    inside(p.place, "the product " + p.name, p.slot + s.multiplier_latency);
  }
  for (const Snapshot& n : map.snapshots) {
    inside(n.place, fmt::format("storing {} of the snapshot", n.name), n.slot + 1);
  }
}

}  // namespace

void check_tick(const Design& d, const Schedule& s) {
  if (d.clocks_per_tick() >= s.wave_length) return;
  d.fail("clock.tick_hz",
         fmt::format("the chain takes {} clocks and a tick has {}", s.wave_length,
                     d.clocks_per_tick()),
         "lower tick_hz or raise clock_hz");
}

void check_schedule(const RegisterMap& map, const Schedule& s) {
  check_ends(map, s);
  check_banks(map, s);
  check_fetches(map, s);
  check_buses(map, s);
  check_results_on_bus(map, s);
  check_reads(map, s);
  check_uses(map, s);
  check_no_products(map, s);
}

}  // namespace feltgate::design
