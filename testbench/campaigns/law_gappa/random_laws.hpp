// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws that nobody would write, for tests of the compiler.
#pragma once

#include <fmt/format.h>

#include <string>

#include "feltgate/random.hpp"

namespace feltgate::law {

/// A law of random formulas over position, velocity, two parameters and sometimes a state.
class RandomLaw {
 public:
  explicit RandomLaw(std::uint64_t seed) : random_(seed) {}

  std::string text() {
    std::string s = fmt::format("param p = {:.3f} in 0 .. {:.3f}\n", random_.between(0.1, 0.9),
                                random_.between(1, 3));
    s += fmt::format("param q = 0 in -{:.3f} .. 1\n", random_.between(0.5, 2));
    const bool memory = random_.below(3) == 0;
    if (memory) {
      s += "state kept = 0.25 in -2 .. 2\n";
      state_ = true;
    }
    std::string first = expression(2), out = expression(3);
    if (memory) {
      s += random_.below(2) == 0
               ? fmt::format("next kept = clamp({}, -2, 2)\n", first)
               : fmt::format("next kept = kept + {:.3f} * (clamp({}, -2, 2) - kept)\n",
                             random_.between(0.01, 1), first);
    }
    s += fmt::format("out torque = 1 Nm * clamp({} + 0 * (p + q) + {}, -4, 4)\n", out,
                     memory ? "0.5 * kept" : "0");
    return s;
  }

 private:
  std::string leaf() {
    switch (random_.below(state_ ? 7 : 6)) {
      case 0:
        return fmt::format("clamp(position, -{:.3f}, {:.3f})", random_.between(0.1, 3),
                           random_.between(0.1, 3));
      case 1:
        return "clamp(0.02 s * velocity, -2, 2)";
      case 2:
        return "p";
      case 3:
        return "q";
      case 4:
        return fmt::format("{:.4f}", random_.between(0.1, 2));
      case 5:
        return fmt::format("(position / {:.2f})", random_.between(50, 300));
      default:
        return "kept";
    }
  }

  std::string expression(int depth) {
    if (depth == 0) return leaf();
    const std::string a = expression(depth - 1), b = expression(depth - 1);
    switch (random_.below(14)) {
      case 0:
      case 1:
        return fmt::format("({} + {})", a, b);
      case 2:
        return fmt::format("({} - {})", a, b);
      case 3:
      case 4:
        return fmt::format("({} * {})", a, b);
      case 5:
        return fmt::format("min({}, {})", a, b);
      case 6:
        return fmt::format("max({}, {})", a, b);
      case 7:
        return fmt::format("abs({})", a);
      case 8:
        return fmt::format("(if {} < {} then {} else {})", a, b, expression(1), expression(1));
      case 9:
        return fmt::format("sin({} * position + {})", 1 + random_.below(20), a);
      case 10:
        return fmt::format("sqrt({:.2f} + abs({}))", random_.between(0.05, 1), a);
      case 11:
        return fmt::format("({} / ({:.2f} + abs({})))", a, random_.between(0.3, 1), b);
      case 12:
        return fmt::format("(if position > q and {} > 0 then {} else {})", a, a, b);
      default:
        return fmt::format("(sgn(position - q) * {})", a);
    }
  }

  SplitMix64 random_;
  bool state_ = false;
};

}  // namespace feltgate::law
