// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A capture of logic levels as encoder pins: A, B and Z as they are, or STEP and DIR turned into
// quadrature. Documentation: docs/traces.md
#pragma once

#include <memory>

#include "capture.hpp"
#include "feltgate/encoder_source.hpp"
#include "options.hpp"

namespace feltgate::traces {

/// With Options::step and dir a rising STEP is one count, up where DIR is high in the same sample;
/// the pins start low. Otherwise the probes are the pins.
class LevelSource final : public EncoderSource {
 public:
  LevelSource(std::unique_ptr<Capture> capture, const Options& options);

  EncoderPins initial() const override { return initial_; }
  std::optional<EncoderEvent> next() override;
  Clock length() const override { return length_; }

 private:
  std::optional<EncoderPins> pins_of(std::uint32_t levels);
  Clock placed(std::optional<Clock> clock) const;

  std::unique_ptr<Capture> capture_;
  Placer placer_;
  bool step_dir_;
  bool step_ = false;
  unsigned phase_ = 0;
  EncoderPins initial_;
  Clock length_ = 0;
};

}  // namespace feltgate::traces
