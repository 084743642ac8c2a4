// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "generator.hpp"

namespace feltgate::judge {

namespace {

class WideGenerator : public Generator {
 public:
  explicit WideGenerator(std::uint64_t seed) : Generator(seed, Shape::wide) {}

  /// A radius, root, quotient, logarithm or exponential of inputs without limits, used several
  /// times behind limits and comparisons, also of what is kept.
  Law law() {
    parameters();
    const Node x = one_in(2) ? value(0.3, 3) * position() : number("0.02") * velocity();
    const Node y = one_in(2) ? position(1) : value(0.005, 0.05) * velocity();
    const auto squared = [](const Node& of) { return make(Kind::power, {of}, 2); };
    const Node amount = make(Kind::absolute, {x});
    Node function;
    switch (below(6)) {
      case 0:
        function = make(Kind::root, {squared(x) + squared(y)});
        break;
      case 1:
        function = make(Kind::root, {value(0.1, 2) * squared(x) + squared(y) + value(0, 0.2)});
        break;
      case 2:
        function = make(Kind::root, {amount});
        break;
      case 3:
        function = make(Kind::logarithm, {value(0.05, 1) + amount});
        break;
      case 4:
        function = number("1") / (value(0.05, 1) + amount);
        break;
      default:
        function = make(Kind::exponential, {make(Kind::negate, {value(0.1, 3) * amount})});
    }
    law_.lets.push_back({"part", function});
    let_ = make(Kind::let, {}, 0, "part");
    Node torque = one_in(3) ? limited(let_, -1, 4) : use_of(let_);
    for (int more = below(3); more > 0; --more) {
      const Node other = use_of(let_);
      torque = one_in(3) ? torque * other : one_in(2) ? torque - other : torque + other;
    }
    if (one_in(4)) {
      const double lower = one_in(2) ? 0.1 : 0.3;
      torque = torque + value(0.1, 1) * direction(limited(position(), -1, 1),
                                                  limited(position(1), -1, 1), lower);
    }
    if (one_in(4)) {
      const bool truth = one_in(2);
      law_.states.push_back({"held", 0, 0, 1, truth, false, {}, {}, {}, truth});
      law_.states[0].next = truth ? compared(let_, value(0.1, 2)) : limited(use_of(let_), 0, 1);
      held_ = make(Kind::state, {}, 0, "held");
      torque = torque + (truth ? choose(held_, value(0.1, 1), number("0")) : held_);
    } else if (one_in(4)) {
      law_.lines.push_back({"past", 2 + below(6), -2, 2, {}});
      const Node decided = choose(compared(let_, value(0.1, 2)), value(0.1, 1), fixed(1));
      law_.lines[0].written = limited(one_in(2) ? decided : use_of(let_), -2, 2);
      torque = torque + make(Kind::line, {}, 1 + below(law_.lines[0].length), "past");
    }
    law_.torques.push_back(limited(torque, -4, 4));
    if (one_in(4)) law_.events.push_back({"told", use_of(let_), compared(let_, value(0.1, 2))});
    return law_;
  }

 private:
  /// An expression in which only a part of the range of `r` matters.
  Node use_of(const Node& r) {
    const Node end = one_in(3) ? some(params_) : value(0.1, 2);
    const double low = -between(0, 1), high = between(0.1, 2);
    switch (below(9)) {
      case 0:
        return make(Kind::minimum, {r, end});
      case 1:
        return make(Kind::minimum, {make(Kind::maximum, {r, end}), value(2, 3)});
      case 2:
        return limited(end - r, low, high);
      case 3:
        return limited(r - end, low, high);
      case 4:
        return choose(compared(r, end), fixed(1), limited(value(0.5, 2) * r - end, low, high));
      case 5:
        return make(Kind::absolute, {limited(r - end, low, high)});
      case 6:
        return fixed(1) * make(Kind::negate, {make(Kind::minimum, {r, value(0.1, 2)})});
      case 7:
        return limited(r + limited(position(), -1, 1), low, high);
      default:
        return limited(make(Kind::absolute, {r - end}) - value(0, 1), low, high);
    }
  }
};

}  // namespace

Law random_law(std::uint64_t seed, Shape shape) {
  return shape == Shape::wide ? WideGenerator(seed).law() : Generator(seed, shape).law();
}

}  // namespace feltgate::judge
