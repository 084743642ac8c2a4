// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// EngineWatch by itself: which run is behind the torque. Documentation: docs/blocks/engine.md
#include "catch.hpp"
#include "feltgate/engine_watch.hpp"

using feltgate::EngineWatch;

namespace {

struct Clock {
  bool ticks = false;
  std::uint32_t tick_count = 0;
  bool runs = false, fresh = false, takes = false, late = false, stops = false;
};
void clock(EngineWatch& w, const Clock& c) {
  w.clock(c.ticks, c.tick_count, c.runs, c.fresh, c.takes, c.late, c.stops);
}

}  // namespace

TEST_CASE("engine watch: nothing has run") {
  EngineWatch w;
  CHECK_FALSE(w.begins);
  CHECK_FALSE(w.running);
  CHECK_FALSE(w.stale);
  CHECK(w.changes == 0);
  CHECK(w.changes_at_begin == 0);
  CHECK_FALSE(w.ended.has_value());
  CHECK_FALSE(w.in_force.has_value());
  clock(w, {true, 5, false, true});
  CHECK_FALSE(w.ended.has_value());
}

TEST_CASE("engine watch: a run begins, ends, and its torque is taken a tick later") {
  EngineWatch w;
  clock(w, {false, 5, true});
  CHECK(w.begins);
  CHECK(w.running);
  REQUIRE(w.begun.size() == 1);
  clock(w, {false, 6, true});
  CHECK(w.begun.size() == 1);
  clock(w, {false, 6, false});
  CHECK_FALSE(w.running);
  CHECK(w.begins);
  clock(w, {false, 6, false, true});
  CHECK(w.ended == 5U);
  CHECK_FALSE(w.ended_before.has_value());
  CHECK(w.begun.empty());
  // In the clock behind an end the cores take what was before it.
  clock(w, {true, 6});
  CHECK_FALSE(w.in_force.has_value());
  CHECK(w.ended_before == 5U);
  CHECK_FALSE(w.begins);
  clock(w, {true, 7});
  CHECK(w.in_force == 5U);
}

TEST_CASE("engine watch: two runs that overlap end in their order") {
  EngineWatch w;
  clock(w, {false, 5, true});
  clock(w, {false, 5, false});
  clock(w, {false, 6, true});
  CHECK(w.begun.size() == 2);
  clock(w, {false, 6, true, true});
  CHECK(w.ended == 5U);
  clock(w, {false, 7, false, true});
  CHECK(w.ended == 6U);
}

TEST_CASE("engine watch: parameters that come into force, and with which a run began") {
  EngineWatch w;
  clock(w, {true, 5, false, false, true});
  CHECK(w.changes == 1);
  CHECK(w.changes_at_begin == 0);
  clock(w, {false, 5, true});
  CHECK(w.changes_at_begin == 1);
  clock(w, {true, 6, true, false, true});
  CHECK(w.changes == 2);
  CHECK(w.changes_at_begin == 1);
  // In the clock of a start the new ones are counted first.
  clock(w, {false, 6, false});
  clock(w, {false, 6, true, false, true});
  CHECK(w.changes_at_begin == 3);
}

TEST_CASE("engine watch: a mailbox that is too old leaves no torque") {
  EngineWatch w;
  clock(w, {false, 5, true});
  clock(w, {false, 5, false, true});
  CHECK(w.ended == 5U);
  clock(w, {false, 5, false, false, false, true});
  CHECK_FALSE(w.ended.has_value());
  CHECK(w.ended_before == 5U);
  CHECK_FALSE(w.stale);
  clock(w, {false, 5, false, false, false, true});
  clock(w, {true, 6, false, false, false, true});
  CHECK(w.stale);
  CHECK_FALSE(w.in_force.has_value());
  clock(w, {false, 6});
  CHECK(w.stale);
  clock(w, {true, 7});
  CHECK_FALSE(w.stale);
  // An end in such a clock gives none either.
  clock(w, {false, 7, true});
  clock(w, {false, 7, false, true, false, true});
  CHECK_FALSE(w.ended.has_value());
}

TEST_CASE("engine watch: a run that the clearing of the lines ends is behind no torque") {
  EngineWatch w;
  clock(w, {false, 5, true, true});
  CHECK(w.ended == 5U);
  clock(w, {false, 6, false});
  clock(w, {false, 7, true});
  clock(w, {true, 8, false, false, false, false, true});
  CHECK_FALSE(w.ended.has_value());
  CHECK(w.begun.empty());
  clock(w, {false, 9, true});
  clock(w, {false, 9, false, true});
  CHECK(w.ended == 9U);
}
