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

/// A real number that stays at its ends: kept in a whole state or in another one, rounded down, the
/// rest of a period, the index of an array. Every operator compares it with its ends and more.
class EndsGenerator : public Generator {
 public:
  explicit EndsGenerator(std::uint64_t seed) : Generator(seed, Shape::ends) {}

  Law law() {
    parameters();
    whole_ = one_in(3);
    const int count = 2 + below(8);
    lower_ = one_in(2) ? 0 : -count;
    upper_ = whole_ || one_in(2) ? count : between(0.3, count);
    const Node free = real(), x = limited(free, lower_, upper_);
    Node at;
    switch (below(6)) {
      case 0:
      case 1:
        at = law_.state("stage", 0, lower_, upper_ = std::ceil(upper_), true);
        law_.states.back().next = x;
        whole_ = true;
        break;
      case 2:
        at = law_.state("kept", 0, lower_, upper_);
        law_.states.back().next = one_in(2) ? x : choose(compared(position(), fixed(0)), x, at);
        break;
      case 3:
        at = make(Kind::floor, {x});
        whole_ = true;
        break;
      case 4:
        // Eighths: the rest at an end is exact.
        period_ = one_in(2) ? 1 + below(4) : (4 + below(28)) / 8.0;
        upper_ = std::floor(8 * upper_) / 8;
        at = make(Kind::modulo, {limited(free, lower_, upper_), number(period_)});
        whole_ = false;
        break;
      default:
        at = x;
        whole_ = false;
    }
    Node torque = choose(decided(at), value(0.1, 1), fixed(0));
    if (one_in(2)) torque = torque + choose(decided(at), value(0.1, 1), number("0"));
    if (one_in(3)) torque = torque + value(0.01, 0.1) * at;
    if (one_in(4)) {
      law_.arrays.push_back({"list", {}});
      for (int i = 0; i < 6; ++i) law_.arrays[0].values.push_back(between(-1, 1));
      torque = torque + make(Kind::element, {limited(real(), 0, 5)}, 0, "list");
    }
    law_.torques.push_back(limited(torque, -4, 4));
    if (one_in(3)) law_.events.push_back({"told", number("1"), decided(at)});
    return law_;
  }

 private:
  Node real() {
    switch (below(5)) {
      case 0:
        return value(0.5, 5) * position();
      case 1:
        return position() / value(0.2, 1) + value(0, 1);
      case 2:
        return velocity() / value(1, 20);
      case 3:
        return some(params_) * position();
      default:
        return tau_hat() / value(0.1, 1) + position();
    }
  }

  /// A comparison with an end, with what an end leaves of a period, or with a number between.
  Node decided(const Node& at) {
    const Kind kinds[] = {Kind::less,       Kind::less_equal, Kind::more,
                          Kind::more_equal, Kind::equal,      Kind::differs};
    double with = one_in(3) ? lower_ : one_in(2) ? upper_ : between(lower_, upper_);
    if (period_ > 0) with = one_in(2) ? with - period_ * std::floor(with / period_) : 0;
    if (whole_) with = std::floor(with);
    const Node other = whole_ && one_in(4) ? count_ : number(with);
    return make(kinds[below(whole_ ? 6 : 4)], {at, other});
  }

  bool whole_ = false;
  double lower_ = 0, upper_ = 1, period_ = 0;
};

}  // namespace

Law random_law(std::uint64_t seed, Shape shape) {
  return shape == Shape::wide   ? WideGenerator(seed).law()
         : shape == Shape::ends ? EndsGenerator(seed).law()
                                : Generator(seed, shape).law();
}

}  // namespace feltgate::judge
