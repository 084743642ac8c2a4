// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Sources made of sources. Documentation: docs/traces.md
#include "sim/traces/compose.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/traces/phase.hpp"
#include "sim/traces/place.hpp"

namespace feltgate::traces::synthetic {
namespace {

class Events final : public EncoderSource {
 public:
  Events(EncoderPins initial, std::vector<EncoderEvent> events, Clock length)
      : initial_(initial), events_(std::move(events)), length_(length) {}
  EncoderPins initial() const override { return initial_; }
  std::optional<EncoderEvent> next() override {
    if (at_ == events_.size()) return std::nullopt;
    return events_[at_++];
  }
  Clock length() const override { return length_; }

 private:
  EncoderPins initial_;
  std::vector<EncoderEvent> events_;
  Clock length_;
  std::size_t at_ = 0;
};

class Sequence final : public EncoderSource {
 public:
  explicit Sequence(std::vector<Source> parts)
      : parts_(std::move(parts)), last_(parts_.front()->initial()) {}
  EncoderPins initial() const override { return parts_.front()->initial(); }
  std::optional<EncoderEvent> next() override {
    for (;;) {
      if (const auto event = parts_[at_]->next()) {
        last_ = turned(event->pins);
        return EncoderEvent{start_ + event->clock, last_};
      }
      if (at_ + 1 == parts_.size()) return std::nullopt;
      start_ += parts_[at_]->length();
      const EncoderPins from = parts_[++at_]->initial();
      turn_ = phase_of(last_) - phase_of(from);
      if (from.z != last_.z) {
        // The new part begins with its own Z, at the clock where it starts.
        last_.z = from.z;
        return EncoderEvent{start_, last_};
      }
    }
  }
  Clock length() const override { return start_ + parts_[at_]->length(); }

 private:
  EncoderPins turned(const EncoderPins& pins) const {
    EncoderPins result = pins_at(phase_of(pins) + turn_);
    result.z = pins.z;
    return result;
  }

  std::vector<Source> parts_;
  std::size_t at_ = 0;
  Clock start_ = 0;
  unsigned turn_ = 0;
  EncoderPins last_;
};

class Cut final : public EncoderSource {
 public:
  Cut(Source source, Clock clocks) : source_(std::move(source)), clocks_(clocks) {}
  EncoderPins initial() const override { return source_->initial(); }
  std::optional<EncoderEvent> next() override {
    if (cut_) return std::nullopt;
    const auto event = source_->next();
    cut_ = event && event->clock >= clocks_;
    return cut_ ? std::nullopt : event;
  }
  Clock length() const override { return cut_ ? clocks_ : std::min(clocks_, source_->length()); }

 private:
  Source source_;
  Clock clocks_;
  bool cut_ = false;
};

class Bounce final : public EncoderSource {
 public:
  Bounce(Source source, std::uint64_t seed, int most_toggles, Clock most_spacing)
      : source_(std::move(source)),
        random_(seed),
        most_toggles_(most_toggles),
        most_spacing_(most_spacing),
        pins_(source_->initial()),
        ahead_(source_->next()) {}
  EncoderPins initial() const override { return initial_; }
  std::optional<EncoderEvent> next() override {
    if (toggles_ == 0) {
      if (!ahead_) return std::nullopt;
      before_ = std::exchange(pins_, ahead_->pins);
      clock_ = ahead_->clock;
      ahead_ = source_->next();
      const bool a = before_.a != pins_.a;
      const bool b = before_.b != pins_.b;
      if (a != b) plan((ahead_ ? ahead_->clock : source_->length()) - clock_);
      return EncoderEvent{clock_, pins_};
    }
    clock_ += spacing_;
    // The toggles come in pairs, away and back again, so that the last one ends where the edge led.
    const bool back = toggles_-- % 2 == 0;
    EncoderPins pins = pins_;
    if (back) {
      pins.a = before_.a;
      pins.b = before_.b;
    }
    return EncoderEvent{clock_, pins};
  }
  Clock length() const override { return source_->length(); }

 private:
  void plan(Clock room) {
    spacing_ = 1 + random_.below(most_spacing_);
    const Clock wanted = random_.below(most_toggles_ + 1);
    toggles_ = 2 * std::min(wanted, (room - 1) / (2 * spacing_));
  }

  Source source_;
  EncoderPins initial_ = source_->initial();
  SplitMix64 random_;
  int most_toggles_;
  Clock most_spacing_;
  EncoderPins pins_;
  std::optional<EncoderEvent> ahead_;
  EncoderPins before_;
  Clock clock_ = 0;
  Clock toggles_ = 0;
  Clock spacing_ = 1;
};

class Index final : public EncoderSource {
 public:
  Index(Source source, std::int64_t turn) : source_(std::move(source)), turn_(turn) {
    phase_ = phase_of(source_->initial());
  }
  EncoderPins initial() const override {
    EncoderPins pins = source_->initial();
    pins.z = true;
    return pins;
  }
  std::optional<EncoderEvent> next() override {
    auto event = source_->next();
    if (!event) return event;
    const unsigned phase = phase_of(event->pins);
    const unsigned moved = (phase - std::exchange(phase_, phase)) & 3U;
    if (moved == 1) ++position_;
    if (moved == 3) --position_;
    event->pins.z = position_ % turn_ == 0;
    return event;
  }
  Clock length() const override { return source_->length(); }

 private:
  Source source_;
  std::int64_t turn_;
  std::int64_t position_ = 0;
  unsigned phase_ = 0;
};

}  // namespace

Source from_events(EncoderPins initial, std::vector<EncoderEvent> events, Clock length) {
  Clock last = 0;
  for (const EncoderEvent& event : events) {
    demand(event.clock > last, "from_events: clocks do not rise");
    last = event.clock;
  }
  demand(length > last, "from_events: length");
  return std::make_unique<Events>(initial, std::move(events), length);
}

Source sequence(std::vector<Source> parts) {
  demand(!parts.empty(), "sequence: no parts");
  return std::make_unique<Sequence>(std::move(parts));
}

Source cut(Source source, Clock clocks) {
  demand(clocks >= 1, "cut: length");
  return std::make_unique<Cut>(std::move(source), clocks);
}

Source with_bounce(Source source, std::uint64_t seed, int most_toggles, Clock most_spacing) {
  demand(most_toggles >= 0 && most_spacing >= 1, "with_bounce: toggles or spacing");
  return std::make_unique<Bounce>(std::move(source), seed, most_toggles, most_spacing);
}

Source with_index(Source source, std::int64_t counts_per_turn) {
  demand(counts_per_turn >= 1, "with_index: counts per turn");
  return std::make_unique<Index>(std::move(source), counts_per_turn);
}

}  // namespace feltgate::traces::synthetic
