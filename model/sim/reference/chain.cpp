// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "sim/reference/chain.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace feltgate {

std::int64_t quantise_parameter(const ParameterInfo& info, double value) {
  if (const auto raw = quantised(info, value)) return *raw;
  const ValueRange range = range_of(info);
  throw std::invalid_argument(
      fmt::format("{} = {} {} does not fit its register; choose a value from {} to below {}",
                  info.name, value, info.unit, range.low, range.high + range.step));
}

std::unique_ptr<RealChain> make_chain(const DesignInfo& design, const std::string& kind) {
  using axis::Fixed, axis::Real;
  if (design.data["MT_COUNTS"] != 0) {
    throw std::invalid_argument(fmt::format(
        "chain \"{}\" of design {}: M/T needs the clocks of the edges, which a chain by "
        "ticks does not have; choose the back-ends rtl,twin",
        kind, design.name));
  }
  if (kind == "fixed") return std::make_unique<Chain<Fixed>>("fixed", design);
  if (kind == "float") return std::make_unique<Chain<Real<float>>>("float", design);
  if (kind == "double") return std::make_unique<Chain<Real<double>>>("double", design);
  if (kind == "quad") return std::make_unique<Chain<Real<Quad>>>("quad", design);
  throw std::invalid_argument(
      fmt::format("chain \"{}\" is unknown; choose fixed, float, double or quad", kind));
}

}  // namespace feltgate
