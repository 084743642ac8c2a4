// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_part.sv. Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/scene_part.hpp"

namespace feltgate {

/// Combinational twin: a product with `Fraction` fraction bits as one term of a scene's torque.
template <class D, int Fraction, bool Exact = true>
class ScenePart {
 public:
  using Law = ScenePartLaw<D, Fixed>;
  using Part = typename Law::Part;

  struct In {
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t part = 0;
  };

  void reset() {}
  void clock(const In& in) { out_.part = of(in.product); }
  const Out& out() const { return out_; }

  static std::int64_t of(std::int64_t product) {
    using Product = fixed<1, D::product_bits - 1 - Fraction, Fraction>;
    const std::int64_t part = Law::part(Product::from_raw(product)).raw();
    constexpr std::int64_t below = (std::int64_t{1} << (Fraction - Part::format.fraction)) - 1;
    const bool tells = Exact && D::rounding == Round::convergent;
    return tells && (product & below) != 0 ? part | 1 : part;
  }

 private:
  Out out_;
};

}  // namespace feltgate
