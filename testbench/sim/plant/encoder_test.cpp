// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder edges: position, time and order. docs/plant.md
#include <set>

#include "catch.hpp"
#include "plant_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

constexpr double kCountRad = 6.283185307179586476925 / 4096.0;

EncoderParameters imperfect() { return shipped("p24").encoder; }

// Counts the position like a x4 decoder and checks that only one pin changes at a time.
class Decoder {
 public:
  explicit Decoder(EncoderPins pins) : pins_(pins) {}
  void take(const EncoderEvent& event) {
    const int now = phase(event.pins);
    const int step = (now - phase(pins_) + 4) % 4;
    REQUIRE(step != 2);
    REQUIRE(event.clock > last_);
    if (step != 0) count_ += step == 1 ? 1 : -1;
    CHECK(event.pins.z == ((count_ % 4096) == 0));
    last_ = event.clock;
    pins_ = event.pins;
  }
  std::int64_t count() const { return count_; }

 private:
  // Gray order 00, 01, 11, 10 of (A, B).
  static int phase(EncoderPins p) { return p.a ? (p.b ? 2 : 3) : (p.b ? 1 : 0); }
  EncoderPins pins_;
  std::int64_t count_ = 0;
  Clock last_ = 0;
};

}  // namespace

TEST_CASE("N counts forth and back end at the start, one edge per boundary", "[encoder]") {
  for (const bool real : {false, true}) {
    Encoder encoder(imperfect(), real, 0.5 * kCountRad);
    Decoder decoder(encoder.pins());
    std::vector<EncoderEvent> events;
    Clock now = 0;
    const auto go = [&](double counts) {
      events.clear();
      encoder.advance(counts * kCountRad, now, 25, events);
      now += 25;
      for (const EncoderEvent& event : events) decoder.take(event);
      return events.size();
    };
    for (const int n : {1, 2, 3, 4, 5, 4096, 9001}) {
      std::size_t up = 0;
      std::size_t down = 0;
      for (int k = 1; k <= 4 * n; ++k) up += go(0.5 + 0.25 * k);
      CHECK(decoder.count() == n);
      CHECK(encoder.count() == n);
      for (int k = 4 * n - 1; k >= 0; --k) down += go(0.5 + 0.25 * k);
      CHECK(decoder.count() == 0);
      CHECK(up == static_cast<std::size_t>(n));
      CHECK(down == up);
      for (int k = 1; k <= 4 * n; ++k) go(0.5 - 0.25 * k);
      CHECK(decoder.count() == -n);
      for (int k = 4 * n - 1; k >= 0; --k) go(0.5 - 0.25 * k);
      CHECK(decoder.count() == 0);
    }
  }
}

TEST_CASE("ideal edges lie on p*q, and both directions share them", "[encoder]") {
  for (const bool real : {false, true}) {
    for (const std::int64_t p : {-4097, -3, 0, 1, 2, 3, 4, 4096, 12345}) {
      const Encoder probe(imperfect(), real, 0.0);
      const double edge = probe.edge_rad(p);
      if (!real) CHECK(edge == static_cast<double>(p) * kCountRad);
      CHECK(std::abs(edge / kCountRad - static_cast<double>(p)) < 0.25);
      std::vector<EncoderEvent> events;
      Encoder encoder(imperfect(), real, edge - 1e-9);
      CHECK(encoder.count() == p - 1);
      encoder.advance(edge, 0, 25, events);
      CHECK(encoder.count() == p);
      encoder.advance(edge - 1e-9, 25, 25, events);
      CHECK(encoder.count() == p - 1);
      CHECK(events.size() == 2);
    }
  }
}

TEST_CASE("a crossing is stamped with the first clock at or after it", "[encoder]") {
  std::vector<EncoderEvent> events;
  Encoder encoder(imperfect(), false, 0.5 * kCountRad);
  encoder.advance(1.5 * kCountRad, 1000, 25, events);  // half way: clock 12.5
  REQUIRE(events.size() == 1);
  CHECK(events[0].clock == 1013);
  events.clear();
  encoder.advance(3.5 * kCountRad, 1025, 100, events);  // edges at 0.25 and 0.75
  REQUIRE(events.size() == 2);
  CHECK(events[0].clock == 1050);
  CHECK(events[1].clock == 1100);
  events.clear();
  encoder.advance(103.5 * kCountRad, 1125, 100,
                  events);  // one edge per clock: the highest rate at the pins
  CHECK(events.size() == 100);
  CHECK(events.back().clock <= 1225);
  CHECK(encoder.count() == 103);
  CHECK_THROWS_AS(encoder.advance(204.5 * kCountRad, 1225, 100, events), std::domain_error);
  CHECK_THROWS_AS(encoder.advance(std::nan(""), 1225, 100, events), std::domain_error);
  CHECK_THROWS_AS(Encoder(imperfect(), false, 1e12), std::invalid_argument);
}

TEST_CASE("imperfect edges have the stated offsets and are repeatable", "[encoder]") {
  const EncoderParameters p = imperfect();
  const Encoder one(p, true, 0.0);
  const Encoder same(p, true, 0.0);
  EncoderParameters other_seed = p;
  other_seed.seed = 2;
  const Encoder other(other_seed, true, 0.0);
  double square = 0.0;
  double sum = 0.0;
  std::set<double> distinct;
  for (std::int64_t line = 0; line < 1024; ++line) {
    const double jitter = one.edge_rad(4 * line) / kCountRad - static_cast<double>(4 * line);
    distinct.insert(jitter);
    sum += jitter;
    square += jitter * jitter;
    for (std::int64_t k = 0; k < 4; ++k) {
      const double edge = one.edge_rad(4 * line + k) / kCountRad;
      REQUIRE(edge - static_cast<double>(4 * line + k) ==
              Approx(jitter + p.edge_offset_counts[static_cast<std::size_t>(k)]).margin(1e-9));
      REQUIRE(one.edge_rad(4 * line + k) == same.edge_rad(4 * line + k));
      REQUIRE(one.edge_rad(4 * line + k) < one.edge_rad(4 * line + k + 1));
    }
  }
  CHECK(distinct.size() > 1000);
  CHECK(std::sqrt(square / 1024.0) == Approx(0.02).epsilon(0.1));
  CHECK(std::abs(sum / 1024.0) < 0.003);
  CHECK(one.edge_rad(5) != other.edge_rad(5));
  // The pattern repeats with the revolution.
  CHECK(one.edge_rad(4096 + 7) - one.edge_rad(7) == Approx(4096.0 * kCountRad).epsilon(1e-12));
}

TEST_CASE("plant delivers every edge of a prescribed motion inside its step", "[encoder]") {
  const Parameters p = shipped("p24");
  Effects effects = p.effects;
  effects.encoder_imperfect = true;
  Hand hand = moving({segment(Segment::Kind::kMinimumJerk, 0.05, 3.0),
                      segment(Segment::Kind::kMinimumJerk, 0.05, -1.0)});
  hand.start_rad = 0.5 * kCountRad;
  Plant plant(p, effects, Drive{}, hand);
  Decoder decoder(plant.encoder().pins());
  std::size_t events = 0;
  while (plant.now() < clocks_of(0.11)) {
    const Clock begin = plant.now();
    plant.advance(Bridge::off(), 25);
    for (const EncoderEvent& event : plant.events()) {
      REQUIRE(event.clock > begin);
      REQUIRE(event.clock <= plant.now());
      decoder.take(event);
      ++events;
    }
  }
  CHECK(decoder.count() == plant.encoder().count());
  CHECK(decoder.count() == static_cast<std::int64_t>(std::floor(-1.0 / kCountRad)));
  CHECK(events == static_cast<std::size_t>(std::floor(3.0 / kCountRad)) * 2 -
                      static_cast<std::size_t>(decoder.count()));
}
