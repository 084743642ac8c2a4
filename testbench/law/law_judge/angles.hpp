// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Angles and directions in generated laws. Their random numbers are their own, so that the rest of
// a law does not depend on them.
#pragma once

#include "feltgate/random.hpp"
#include "law_tree.hpp"

namespace feltgate::judge {

class Angles {
 public:
  explicit Angles(std::uint64_t seed) : random_(seed) {}

  /// Without an angle until the object is destroyed: strips count the largest error of all values.
  class Without {
   public:
    explicit Without(Angles& of) : of_(of), before_(of.allowed) { of.allowed = false; }
    ~Without() { of_.allowed = before_; }
    Without(const Without&) = delete;
    Without& operator=(const Without&) = delete;

   private:
    Angles& of_;
    bool before_;
  };

  /// Returns `other` or, sometimes and once in a law, the angle or a direction of x and y.
  Node or_angle(const Node& other, const Node& x, const Node& y) {
    if (!allowed || used_ || random_.below(2) != 0) return other;
    used_ = true;
    const double a = end(), b = end();
    if (random_.below(2) == 0) return angle(y, x, a, b);
    const double e = 0.05 * static_cast<double>(1 + random_.below(4));
    return direction(limited(x, -a, b), limited(y, -2, 2), e);
  }

  bool allowed = true;

 private:
  double end() { return 0.25 * static_cast<double>(1 + random_.below(8)); }

  SplitMix64 random_;
  bool used_ = false;
};

}  // namespace feltgate::judge
