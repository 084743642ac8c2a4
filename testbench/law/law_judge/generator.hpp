// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes a random law of a shape: expressions, conditions, and what is kept.
#pragma once

#include "feltgate/random.hpp"
#include "law_tree.hpp"

namespace feltgate::judge {

// Angles and directions in generated laws. Their random numbers are their own, so that the rest of
// a law does not depend on them.

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

class Generator {
 public:
  Generator(std::uint64_t seed, Shape shape)
      : random_(seed), roots_(seed), angles_(seed + 1000), shape_(shape) {}

  Law law() {
    angles_.allowed = shape_ != Shape::nested && shape_ != Shape::tables;
    parameters();
    memory();
    things();
    if (one_in(3)) lets();
    close_memory();
    const int axes = shape_ == Shape::axes ? 2 + below(2) : 1;
    for (int axis = 0; axis < axes; ++axis) {
      axis_ = axis;
      // The output: the torque itself, or times a number, or limited.
      const Node t = torque();
      law_.torques.push_back(one_in(3) ? t : one_in(3) ? value(0.1, 4) * t : limited(t, -4, 4));
    }
    if (shape_ == Shape::memory || one_in(5)) {
      const Node value = one_in(2) ? fixed(2) : limited(expression(1), -3, 3);
      law_.events.push_back({"told", value, condition(1)});
    }
    return law_;
  }

 protected:
  int below(int n) { return static_cast<int>(random_.below(n)); }
  bool one_in(int n) { return below(n) == 0; }
  /// Returns a number with the digits that will be printed.
  double between(double a, double b) {
    return std::strtod(fmt::format("{:.3f}", random_.between(a, b)).c_str(), nullptr);
  }
  Node some(const std::vector<Node>& of) {
    return of[static_cast<std::size_t>(below(static_cast<int>(of.size())))];
  }
  Node value(double a, double b) { return number(between(a, b), 3); }

  void parameters() {
    params_.push_back(law_.param("p", between(0.1, 0.9), 0.1, between(1, 3)));
    params_.push_back(law_.param("q", 0, -between(0.5, 2), 1));
    if (one_in(2)) {
      law_.params.push_back({"tilt", "deg", pi / 180, 10, -30, 45, false, false});
      params_.push_back(make(Kind::param, {}, 2, "tilt"));
    }
    if (one_in(3)) {
      law_.params.push_back({"hold", "mNm", 1e-3, 100, 0, 800, false, false});
      params_.push_back(make(Kind::param, {}, last(law_.params), "hold"));
    }
    // A parameter over decades, used only in functions that the host computes.
    if (one_in(4)) wide_ = law_.param("wide", 1, 0.01, 100);
    count_ = law_.param("count", 1, 0, 4, true);
    if (shape_ == Shape::memory && one_in(3)) {
      law_.params.push_back({"fed", "", 1, 0, -1, 1, false, true});
      mailbox_ = make(Kind::param, {}, last(law_.params), "fed");
    }
  }
  template <class T>
  static int last(const std::vector<T>& of) {
    return static_cast<int>(of.size()) - 1;
  }

  void memory() {
    const bool all = shape_ == Shape::memory;
    if (shape_ == Shape::whole_states || (all && one_in(2))) {
      stages_.push_back(law_.state("stage", 0, 0, 3, true));
      if (one_in(3)) stages_.push_back(law_.state("side", 1, -2, 2, true));
    }
    if ((all || shape_ == Shape::whole_states) && one_in(2)) {
      const double first = below(2);
      law_.states.push_back({"held", first, 0, 1, true, false, {}, {}, {}, true});
      held_ = make(Kind::state, {}, last(law_.states), "held");
    }
    if (all || one_in(6)) kept_.push_back(law_.state("kept", 0.25, -2, 2));
    if (all && one_in(2)) {
      law_.rate_khz = one_in(2) ? 20 : 10;
      law_.states.push_back({"wheel", 0, 0, 1, false, true, {}, {}, {}});
      kept_.push_back(make(Kind::state, {}, last(law_.states), "wheel"));
      phase_ = last(law_.states);
    }
    if (all && one_in(2)) law_.lines.push_back({"past", 2 + below(6), -2, 2, {}});
  }

  /// Arrays, tables, filters.
  void things() {
    if (shape_ == Shape::arrays) {
      Array a{"list", {}};
      for (int i = 3 + below(5); i > 0; --i) a.values.push_back(between(-1.5, 1.5));
      law_.arrays.push_back(a);
    }
    if (shape_ == Shape::tables) tables();
    if (shape_ == Shape::axes || (shape_ == Shape::memory && one_in(2))) {
      if (law_.rate_khz == 0) law_.rate_khz = one_in(2) ? 20 : 10;
      const Node x = number("0.02") * velocity();
      State f{"smooth", 0, 0, 0, false, false, {}, limited(x, -2, 2), {}};
      f.frequency = one_in(2) ? value(20, 300) : value(10, 50) + value(20, 50) * params_[0];
      law_.states.push_back(f);
      kept_.push_back(make(Kind::state, {}, last(law_.states), "smooth"));
    }
  }

  void tables() {
    const Node x = make(Kind::counter, {}, -1, "x");
    Table t{"curve", -between(0.5, 2), between(0.5, 2), {}, {}, 8 << below(3)};
    switch (below(6)) {
      case 0:
        t.body = make(Kind::exponential, {make(Kind::negate, {make(Kind::power, {x}, 2)})});
        break;
      case 1:
        t.body = value(0.5, 1) * make(Kind::power, {x}, 3) - value(0.1, 1) * x;
        break;
      case 2:
        t.body = value(0.2, 1) * make(Kind::sine, {value(1, 5) * x}) + value(0.1, 1);
        break;
      case 3:
        t.body = make(Kind::root, {value(0.1, 1) + make(Kind::absolute, {x})});
        break;
      case 4:
        t.body = x / (value(0.3, 1) + make(Kind::absolute, {x}));
        break;
      default: {
        // The points are at whole multiples of their distance.
        const double step = 0.25 * (1 + below(2));
        const int first = -below(4), count = 4 + below(5);
        t.lower = first * step;
        t.upper = (first + count - 1) * step;
        t.segments = 0;
        for (int i = 0; i < count; ++i) t.points.push_back(between(-1.5, 1.5));
        t.periodic = one_in(2);
        if (t.periodic) t.points.back() = t.points.front();
      }
    }
    law_.tables.push_back(t);
    // All uses share one argument, because each format of an argument needs its own table.
    const Node argument = value(0.5, 2) * moving();
    curve_ = make(Kind::table, {one_in(2) ? argument + some(params_) : argument}, 0, "curve");
  }

  void lets() {
    const Node v = expression(2);
    law_.lets.push_back({"part", v});
    let_ = make(Kind::let, {}, 0, "part");
  }

  void close_memory() {
    for (const Node& s : stages_) {
      State& state = law_.states[static_cast<std::size_t>(s->index)];
      const Node up = choose(condition(1), number("1"), number("0"));
      const Node down = choose(condition(1), number("1"), number("0"));
      state.next =
          make(Kind::clamp, {s + up - down, number(state.lower, 0), number(state.upper, 0)});
    }
    for (State& s : law_.states) {
      if (s.truth) {
        const Node to = condition(1);
        s.next = one_in(2) ? to : make(Kind::either, {condition(0), make(Kind::both, {held_, to})});
      }
      if (s.name == "kept") {
        const Node self = make(Kind::state, {}, static_cast<int>(&s - law_.states.data()), "kept");
        const Node to = limited(expression(2), -2, 2);
        s.next = one_in(2) ? to : self + value(0.01, 1) * (to - self);
      }
      if (s.phase) {
        const Node self = make(Kind::state, {}, phase_, "wheel");
        s.next = self + value(0.001, 0.2) + value(0.001, 0.02) * limited(moving(), -1, 1);
      }
    }
    for (Line& l : law_.lines) l.written = limited(expression(2), -2, 2);
  }

  /// Returns an expression that is neither a parameter nor a constant.
  Node moving() {
    switch (below(kept_.empty() ? 5 : 7)) {
      case 0:
      case 1:
        return limited(position(axis()), -between(0.1, 3), between(0.1, 3));
      case 2:
        return limited(number("0.02") * velocity(axis()), -2, 2);
      case 3:
        return position(axis()) / value(50, 300);
      case 4:
        return one_in(2) ? limited(number("0.5") * tau_hat(), -2, 2)
                         : number("0.02") * limited(velocity(axis()), -50, 50);
      default:
        return some(kept_);
    }
  }
  int axis() { return shape_ == Shape::axes && one_in(3) ? below(3) : axis_; }

  Node leaf() {
    const int n = below(12);
    if (n < 2) return some(params_);
    if (n == 2) return value(0.1, 2);
    if (n == 3 && !law_.lines.empty())
      return make(Kind::line, {}, 1 + below(law_.lines[0].length), "past");
    if (n == 4 && mailbox_) return mailbox_;
    if (n == 5 && let_) return let_;
    if (n < 8 && !stages_.empty()) return some(stages_);
    if (n < 10 && !law_.arrays.empty()) return element();
    if (n < 10 && !law_.tables.empty()) return curve_;
    return moving();
  }

  Node element() {
    const int length = static_cast<int>(law_.arrays[0].values.size());
    const auto list = [](const Node& i) { return make(Kind::element, {i}, 0, "list"); };
    switch (below(8)) {
      case 0:
      case 1:
        return list(number(std::to_string(below(length))));
      case 2:
        return list(count_);
      case 3:
      case 4:
      case 5:
        return list(value(1, 4) * limited(moving(), 0, 1));
      default: {
        const Node i = make(Kind::counter, {}, -1, "i");
        return make(Kind::sum, {list(i) * some(params_)}, std::min(2, length - 1), "i");
      }
    }
  }

  /// Returns an expression of parameters and numbers only, which the host computes.
  Node fixed(int depth) {
    if (wide_ && one_in(4)) {
      const Node limit = value(0.5, 3);
      switch (below(3)) {
        case 0:
          return make(Kind::minimum, {make(Kind::root, {wide_}), limit});
        case 1:
          return make(Kind::minimum, {number("1") / wide_, limit});
        default:
          return make(Kind::exponential, {make(Kind::negate, {wide_})});
      }
    }
    if (depth == 0) return one_in(3) ? value(0.1, 2) : one_in(4) ? count_ : some(params_);
    const Node a = fixed(depth - 1), b = fixed(depth - 1);
    switch (below(9)) {
      case 0:
      case 1:
        return a + b;
      case 2:
        return a - b;
      case 3:
      case 4:
        return a * b;
      case 5:
        return make(one_in(2) ? Kind::minimum : Kind::maximum, {a, b});
      case 6:
        return a / (value(0.3, 1) + make(Kind::absolute, {b}));
      case 7:
        return make(root_kind(), {value(0.1, 1) + make(Kind::absolute, {a})});
      default:
        return make(Kind::negate, {a});
    }
  }

  Node condition(int depth) {
    const Angles::Without none(angles_);
    if (!stages_.empty() && one_in(2)) {
      const Node with = one_in(4)   ? count_
                        : one_in(2) ? number(fmt::format("{}.5", below(3)))
                                    : number(fmt::format("{}", below(4)));
      if (one_in(3) && with->text.find('.') == std::string::npos) {
        const Node other = one_in(3) ? with + some(stages_) : with;
        return make(one_in(2) ? Kind::equal : Kind::differs, {some(stages_), other});
      }
      return compared(some(stages_), with);
    }
    if (held_ && one_in(4)) return held_;
    if (depth > 0 && one_in(4)) {
      const Node a = condition(depth - 1), b = condition(depth - 1);
      return one_in(3) ? make(Kind::opposite, {a})
                       : make(one_in(2) ? Kind::both : Kind::either, {a, b});
    }
    if (one_in(3)) return compared(moving(), one_in(2) ? fixed(1) : value(-1, 1));
    return compared(moving() + expression(depth), one_in(2) ? value(-1, 1) : expression(depth));
  }
  Node compared(const Node& a, const Node& b) {
    const Kind kinds[] = {Kind::less, Kind::less_equal, Kind::more, Kind::more_equal};
    return one_in(4) ? make(kinds[below(4)], {b, a}) : make(kinds[below(4)], {a, b});
  }

  Node expression(int depth) {
    if (depth == 0) return leaf();
    const Node a = expression(depth - 1), b = expression(depth - 1);
    switch (below(16)) {
      case 0:
      case 1:
        return a + b;
      case 2:
        return a - b;
      case 3:
      case 4:
        return a * b;
      case 5:
        return make(Kind::minimum, {a, b});
      case 6:
        return make(Kind::maximum, {a, b});
      case 7:
        return one_in(3) ? make(Kind::power, {limited(a, -1.5, 1.5)}, 2 + below(2))
                         : make(Kind::absolute, {a});
      case 8:
        return choose(condition(depth - 1), a, b);
      case 9:
        return or_angle(unless_tables(one_in(2) ? Kind::sine : Kind::cosine,
                                      number(1.0 + below(20), 0) * position(axis()) + a),
                        a, b);
      case 10:
        return or_angle(unless_tables(root_kind(), value(0.05, 1) + make(Kind::absolute, {a})), a,
                        b);
      case 11:
        if (!law_.tables.empty()) return a - b;
        return a / (value(0.3, 1) + make(Kind::absolute, {b}));
      case 12:
        return one_in(3) ? unless_tables(Kind::exponential, limited(a, -2, 1))
                         : fixed(1) * a + fixed(1);
      case 13:
        return choose(make(Kind::both, {compared(position(axis()), some(params_)), condition(0)}),
                      a, b);
      case 14:
        return sgn(moving() - some(params_)) * a;
      default: {
        // Not at 0, where inputs often are.
        const Node x = limited(a, -3, 3) + value(0.05, 0.25);
        const Node whole = one_in(2) ? value(0.1, 0.5) * make(Kind::floor, {value(0.5, 4) * x})
                                     : make(Kind::modulo, {x, value(0.3, 2)});
        // The language refuses a floor of parameters alone: it wants a parameter there.
        return of_parameters(x) ? x : whole;
      }
    }
  }

  Node or_angle(const Node& other, const Node& a, const Node& b) {
    const int beside = shape_ == Shape::axes ? 1 - axis_ % 2 : 0;
    return angles_.or_angle(other, position(axis_) + a, position(beside) - b);
  }
  /// Returns a root or, sometimes, a logarithm.
  Kind root_kind() { return roots_.below(3) == 0 ? Kind::logarithm : Kind::root; }
  /// The table memory is small: a law with tables gets no function here.
  Node unless_tables(Kind function, const Node& x) const {
    return law_.tables.empty() ? make(function, {x}) : limited(x, -2, 2);
  }

  Node torque() {
    switch (shape_) {
      case Shape::parameters_alone: {
        // A direction from a condition, a strength from parameters, and an added term.
        const Node way = one_in(3)   ? sgn(some(params_))
                         : one_in(2) ? sgn(moving() - some(params_))
                                     : choose(condition(1), fixed(1), fixed(1));
        const Node sum = way * fixed(1) + fixed(1);
        return one_in(2)   ? sum
               : one_in(2) ? choose(condition(0), sum, fixed(1))
                           : expression(1) + sum;
      }
      case Shape::whole_states: {
        const Node between = compared(stages_[0], number(fmt::format("{}.5", below(3))));
        if (one_in(2)) return choose(between, value(0.1, 2), leaf());
        return choose(between, choose(condition(0), fixed(1), expression(1)), leaf());
      }
      case Shape::nested: {
        const Node inner = choose(condition(1), expression(1), expression(1));
        return choose(compared(moving() + inner, expression(1)), expression(1), expression(1));
      }
      default:
        return expression(shape_ == Shape::axes || one_in(2) ? 2 : 3);
    }
  }

  static constexpr Real pi = 3.14159265358979323846264338327950288L;
  SplitMix64 random_, roots_;
  Angles angles_;
  Shape shape_;
  Law law_;
  std::vector<Node> params_, kept_, stages_;
  Node count_, wide_, held_, mailbox_, let_, curve_;
  int phase_ = -1, axis_ = 0;
};

}  // namespace feltgate::judge
