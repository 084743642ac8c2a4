// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include <cmath>

#include "law_tree.hpp"

namespace feltgate::judge {

namespace {

Node times(double factor, const Node& x) { return number(factor) * x; }

Law of(Law law, const Node& torque) {
  law.torques.push_back(torque);
  return law;
}

/// Sums of parameters alone, a condition in a product.
void parameters_alone(std::vector<Directed>& all) {
  {
    Law l;
    const Node p = l.param("p", 1, 0.1, 1);
    all.push_back({"a sign times its parameter, and a number", of(l, sgn(p) * p + 0.01)});
  }
  for (const bool far : {false, true}) {
    Law l;
    const Node strength = l.param("strength", 0.2, 0, 1), face = l.param("face", 0, -1, 1);
    const Node way = choose(position() < face, number("1"), number("-1"));
    const Node x = way * strength + 0.1;
    all.push_back({"a way times a strength, and a number",
                   of(l, far ? choose(velocity() > number("0"), x, number("0")) : x)});
  }
  {
    Law l;
    const Node p = l.param("p", 1, 0.1, 1);
    l.torques.push_back(limited(position(), -1, 1));
    l.events.push_back({"told", sgn(p) * p + 0.01, position() > p});
    all.push_back({"the same as an event's value", l});
  }
  {
    Law l;
    const Node which = l.param("which", 1, 0, 3, true), p = l.param("p", 1, 0.1, 1);
    l.arrays.push_back({"list", {0.1, -0.25, 0.5, 0.3}});
    const Node element = make(Kind::element, {which}, 0, "list");
    all.push_back({"an element times a parameter, and a number", of(l, element * p + 0.1)});
    all.push_back({"an element and a parameter", of(l, element + p)});
  }
}

/// Comparisons of whole states with values between whole numbers, and with whole numbers.
void whole_states(std::vector<Directed>& all) {
  const Kind kinds[] = {Kind::less, Kind::less_equal, Kind::more, Kind::more_equal};
  for (const char* threshold : {"0.5", "1.5", "2.5", "1", "0.25"}) {
    for (const Kind kind : kinds) {
      for (const bool turned : {false, true}) {
        for (const double lower : {0.0, -2.0}) {
          Law l;
          const Node stage = l.state("stage", 0, lower, 3, true), at = number(threshold);
          const Node more = choose(position() > number("0"), number("1"), number("-1"));
          l.states[0].next = make(Kind::clamp, {stage + more, number(lower, 0), number("3")});
          const Node is = turned ? make(kind, {at, stage}) : make(kind, {stage, at});
          all.push_back({std::string("a whole state beside ") + threshold,
                         of(l, choose(is, number("0.25"), number("-0.5")))});
        }
      }
    }
  }
}

/// What goes out as another one's word under another scale.
void renamed(std::vector<Directed>& all) {
  all.push_back(
      {"four times a sine", of({}, number("4") * make(Kind::sine, {number("24") * position()}))});
  const Node x =
      make(Kind::root,
           {number("0.1") + make(Kind::absolute, {limited(times(0.02, velocity()), -1, 1)})});
  all.push_back({"four times a root", of({}, number("4") * x)});
  Law l;
  const Node p = l.param("p", 1, 0.1, 3);
  const Node y = number("0.05") + make(Kind::absolute, {limited(position(), -2, 2)});
  all.push_back({"a logarithm of what runs beside one of a parameter",
                 of(l, make(Kind::logarithm, {p}) * limited(position(), -1, 1) +
                           make(Kind::logarithm, {y}))});
}

/// Whole parameters times numbers that their words cannot hold.
void whole_parameters(std::vector<Directed>& all) {
  Law l;
  const Node count = l.param("count", 1, -2, 4, true);
  const Node place = limited(position(), -1, 1), hold = l.param("hold", 0.1, 0, 0.8);
  const Node p = l.param("p", 0.556, 0.1, 2.551), q = l.param("q", 0, -1.861, 1);
  const Node wide = l.param("wide", 1, 0.01, 100), side = sgn(place - q);
  const Node least = make(Kind::minimum, {number("1") / wide, number("1.918")});
  const Node root = make(Kind::root, {number("0.829") + make(Kind::absolute, {least})});
  for (const char* number_text : {"1.938", "0.0061", "-0.3"}) {
    const Node factor = number(number_text);
    all.push_back({"a whole parameter times a number", of(l, place + factor * count)});
    all.push_back({"a whole parameter times a number beside a side",
                   of(l, limited(side * (hold * least) + factor * count, -4, 4))});
    all.push_back({"a whole parameter times a number and an input", of(l, factor * count * place)});
    all.push_back({"a whole parameter times a number or another parameter",
                   of(l, limited(choose(place >= p, p - q, factor * count), -4, 4))});
    all.push_back({"a whole parameter by a number",
                   of(l, limited(choose(place >= p, p + root, count / number("1.577")), -4, 4))});
  }
}

/// A format that holds nothing of what is compared costs an instruction less.
void coarse(std::vector<Directed>& all) {
  Law l;
  const Node p = l.param("p", 0.898, 0.1, 1.686), hold = l.param("hold", 0.1, 0, 0.8);
  const Node speed = limited(times(0.02, velocity()), -2, 2);
  const Node pull = limited(times(0.5, tau_hat()), -2, 2);
  const Node high = make(Kind::maximum, {number("0.2"), limited(position(), -2.98, 0.814)});
  const Node low = position() / number("295") - limited(position(), -0.3, 2.8);
  const Node inner =
      choose(pull * speed >= speed + speed * limited(position(), -1.282, 0.335), high, low);
  const Node face = make(Kind::minimum, {number("1.258"), limited(position(), -2, 2)});
  const auto far = [](double least, const Node& x) {
    return number(least) + make(Kind::absolute, {x});
  };
  all.push_back({"a comparison behind another one, and its format",
                 of(l, choose(speed + inner > face, hold / far(0.426, position() / number("299")),
                              speed / far(0.991, p)))});
  Law m;
  const Node tilt = m.param("tilt", 0.1745, -0.5236, 0.7854);
  const Node pressed = m.param("hold", 0.1, 0, 0.8);
  const Node way = times(0.02, limited(velocity(), -50, 50));
  const Node wave = make(Kind::sine, {13 * position() + speed});
  const Node other =
      limited(position(), -0.441, 2.405) + make(Kind::sine, {14 * position() + pressed});
  const Node moved =
      limited(position(), -1.594, 1.014) + choose(wave > other, way + tilt, way / far(0.823, pull));
  const Node turned = make(Kind::sine, {8 * position() + limited(position(), -1.716, 2.243)});
  all.push_back(
      {"a comparison behind a sine's, and its format",
       of(m, choose(moved < turned, pressed / far(0.409, limited(position(), -0.473, 0.657)),
                    number("0.623")))});
}

void nested(std::vector<Directed>& all) {
  Law l;
  const Node q = l.param("q", 0, -1, 1);
  const Node inner = choose(number("0.02") * velocity() < position() - q, number("1") + q, q - 1);
  all.push_back({"a comparison that another one decides",
                 of(l, choose(inner < number("0.3") * q, number("0.5"), number("-0.5")))});
  const Node twice = choose(inner < number("0.3") * q, number("0.2") + q, q - 0.7);
  all.push_back(
      {"two of them", of(l, choose(twice < number("0.1"), number("0.5"), number("-0.5")))});
  coarse(all);
}

/// What is rounded down to whole numbers, and noise.
void rounded_down(std::vector<Directed>& all) {
  const auto floor = [](const Node& x) { return make(Kind::floor, {x}); };
  const auto mod = [](const Node& x, const Node& m) { return make(Kind::modulo, {x, m}); };
  const Node x = limited(position(), -2, 2);
  all.push_back({"floor of a position", of({}, times(0.05, floor(times(5, x) + 0.3)))});
  all.push_back({"mod of a position", of({}, mod(x, number("0.35")))});
  {
    Law l;
    const Node p = l.param("p", 1, 0.1, 3);
    all.push_back({"floor of a product, in a condition",
                   of(l, choose(floor(p * x) < number("1"), number("0.5"), times(0.1, x)))});
  }
  {
    Law l;
    const Node n = l.state("n", 3, -9, 9, true);
    l.states[0].next =
        make(Kind::clamp, {n + choose(velocity() > number("0"), number("1"), number("-1")),
                           number(-9.0, 0), number("9")});
    all.push_back({"mod of a whole state",
                   of(l, times(0.1, mod(n, number("3"))) + times(0.01, mod(n - 4, number("7"))))});
  }
  {
    Law l;
    const double first = std::floor(8 * 0.5698402909980532 * 0x1p20) * 0x1p-20 - 4;
    l.states.push_back({"noise_7", first, 0, 1, false, true, {}, {}, {}});
    const Node noise = make(Kind::noise, {}, 0, "7");
    all.push_back({"noise beside a position",
                   of(l, noise * limited(position(), 0, 1) + times(0.1, mod(x, number("0.7"))))});
  }
}

/// Conditions that are the same, whole states that are counted to an end, and rounded values.
void the_same(std::vector<Directed>& all) {
  const Node x = limited(position(), -2, 2), far = position() > number("0.3");
  const Node slow = number("0.02") * velocity() < number("0.5") * position();
  for (const Kind kind : {Kind::equal, Kind::differs}) {
    for (const Node& other : {far, slow, make(Kind::both, {far, slow})}) {
      Law l;
      l.states.push_back({"held", 0, 0, 1, true, false, {}, {}, {}, true});
      const Node held = make(Kind::state, {}, 0, "held");
      l.states[0].next = make(kind, {held, other});
      all.push_back({"bools that are the same",
                     of(l, choose(make(kind, {slow, held}), number("0.5"), times(0.1, x)))});
    }
    for (const char* end : {"5", "3", "0"}) {
      Law l;
      const Node stage = l.state("stage", 0, 0, 5, true);
      const Node more = make(Kind::minimum, {stage + number("1"), number("5")});
      const Node is = make(kind, {stage, number(end)});
      const Node on = end[0] == '5' ? stage + number("1") : more;
      const bool same = kind == Kind::equal;
      l.states[0].next = choose(is, same ? number("0") : on, same ? on : number("0"));
      all.push_back({std::string("a whole state counted to ") + end, of(l, times(0.1, stage))});
    }
  }
  const auto round = [](const Node& of) { return make(Kind::round, {of}); };
  all.push_back({"a position rounded", of({}, times(0.05, round(times(5, x) + 0.3)))});
  all.push_back({"a rounded position, compared",
                 of({}, choose(make(Kind::equal, {round(times(3, x)), number("2")}), number("0.5"),
                               times(0.1, x)))});
}

/// What a turn drops is between two words of a table's argument, always below, and steep lines of a
/// table that is exact show it.
void dropped(std::vector<Directed>& all) {
  Law l;
  l.tables.push_back({"saw", 0, 1, {}, {0, 4, 0}, 0, true});
  for (const char* factor : {"0.02", "0.0171"}) {
    const Node x = number(factor) * velocity();
    all.push_back({"a steep table in turns", of(l, make(Kind::table, {x}, 0, "saw"))});
  }
}

/// Values that only the end of a table's last piece reaches.
void last_piece(std::vector<Directed>& all) {
  Law l;
  l.tables.push_back({"curve", 0, 2, {}, {0, 0.1, 0.1, 0.1, 4}, 0});
  const Node curve = make(Kind::table, {position()}, 0, "curve");
  all.push_back(
      {"the end of a table", of(l, choose(curve < number("3.9"), number("0.25"),
                                          times(0.1, make(Kind::sine, {times(3, position())}))))});
}

/// Factors that words fill, and by their error would leave.
void full_factors(std::vector<Directed>& all) {
  for (const char* middle :
       {"0.49998", "0.49999", "0.499992", "0.499994", "0.499996", "0.499998"}) {
    const Node peak = make(Kind::sine, {number("256") * position()});
    const Node factor = times(0.5, peak) + number(middle);
    const Node other = velocity() / number("1024") + limited(position(1), -1, 1);
    all.push_back({"a factor of all 18 bits", of({}, times(0.5, factor * other))});
  }
}

/// The angle and the direction of two axes, and a cut that has a strip.
void directions(std::vector<Directed>& all) {
  const Node x = position(), y = position(1);
  all.push_back({"the angle of two axes", of({}, times(0.3, angle(y, x, 1, 1)))});
  all.push_back(
      {"the angle of two speeds",
       of({}, times(0.3, angle(times(0.1, velocity(1)), times(0.02, velocity()) + 0.1, 0.5, 2)))});
  for (const double e : {0.05, 0.1}) {
    Law l;
    const Node p = l.param("p", 1, 0.1, 1);
    const Node near = limited(x, -1, 1), beside = limited(y, -1, 1);
    all.push_back({"a direction", of(l, direction(near, beside, e))});
    all.push_back({"a direction times a parameter", of(l, p * direction(near - p, beside, e))});
  }
}

/// A radius without limits, of whose range several users need different parts.
void wide(std::vector<Directed>& all) {
  const auto squared = [](const Node& x) { return make(Kind::power, {x}, 2); };
  const auto least = [](const Node& x, const Node& y) { return make(Kind::minimum, {x, y}); };
  const Node r = make(Kind::root, {squared(position()) + squared(times(0.02, velocity()))});
  all.push_back({"a limited radius", of({}, least(r, number("0.5")))});
  all.push_back({"a square", of({}, times(0.0001, squared(position())))});
  Law l;
  l.lets.push_back({"part", r});
  const Node part = make(Kind::let, {}, 0, "part");
  const Node ring =
      choose(part < number("0.5"), number("0.25"), limited(number("1.5") - part, 0, 0.75));
  all.push_back({"a radius beside two limits", of(l, ring)});
  const Node p = l.param("p", 0.5, 0.1, 2);
  all.push_back({"a radius up to a parameter",
                 of(l, least(part, p) - choose(number("0.25") < part, p, number("0")))});
  // Coarse where it matters: the strip of the comparison must not reach what the limits leave.
  Law coarse;
  const Node x = position(1), far = squared(number("1.611") * position());
  coarse.lets.push_back({"part", make(Kind::root, {times(0.948, far) + squared(x) + 0.148})});
  const Node beyond = number("1.994") < part;
  all.push_back({"a coarse radius beside a comparison",
                 of(coarse, choose(beyond, number("0.7"),
                                   limited(times(0.655, part) - 1.994, -0.492, 1.414)))});
}

/// Values that stay at an end, and are compared with it.
void ends(std::vector<Directed>& all) {
  const Kind kinds[] = {Kind::less,       Kind::less_equal, Kind::more,
                        Kind::more_equal, Kind::equal,      Kind::differs};
  const auto told = [](const Node& is) { return choose(is, number("0.25"), number("-0.5")); };
  for (const char* factor : {"4", "2.7"}) {
    const Node x = number(factor) * position();
    for (const Kind kind : kinds) {
      for (const char* with : {"0", "2", "7"}) {
        Law l;
        const Node stage = l.state("stage", 0, 0, 7, true);
        l.states[0].next = limited(x, 0, 7);
        all.push_back(
            {"a whole state of a real number", of(l, told(make(kind, {stage, number(with)})))});
      }
      const bool whole = kind == Kind::equal || kind == Kind::differs;
      const Node floor = make(Kind::floor, {limited(x, 0, 3)});
      all.push_back({"a floor at its upper end", of({}, told(make(kind, {floor, number("3")})))});
      if (whole) continue;
      const Node rest = make(Kind::modulo, {limited(x, 0, 20), number("3")});
      all.push_back(
          {"what an end leaves of a period", of({}, told(make(kind, {rest, number("2")})))});
      all.push_back(
          {"a limited value", of({}, told(make(kind, {limited(x, -0.7, 0.7), number("0.7")})))});
      Law l;
      const Node kept = l.state("kept", 0, 0, 3);
      l.states[0].next = limited(x, 0, 2.7);
      all.push_back({"a state at its end", of(l, told(make(kind, {kept, number("2.7")})))});
    }
  }
  Law l;
  const Node gear = l.state("gear", 0, -20, 20, true);
  l.states[0].next = limited(position() / number("0.4363") + 0.5, -20, 20);
  all.push_back({"a limited value beside a whole state, each times a number",
                 of(l, times(0.1, limited(velocity(), -1, 1)) + times(0.01, gear))});
  all.push_back({"the rest of a whole state beside it",
                 of(l, times(0.01, gear) + times(0.1, make(Kind::modulo, {gear, number("3")})) +
                           told(make(Kind::equal, {number("2") * gear, number("40")})))});
}

/// A limited value in a sum with a whole state, whose words are clipped on the way, and the
/// position beyond that limit in the torque.
void clipped_beside(std::vector<Directed>& all) {
  Law l;
  const Node stage = l.state("stage", 0, 0, 3, true);
  const Node sum = limited(position(), -2.174, 0.838) + stage;
  const Node less =
      choose(make(Kind::less_equal, {sum, number("0.538")}), number("1"), number("0"));
  l.states[0].next = make(Kind::clamp, {stage - less, number("0"), number("3")});
  const Node is = make(Kind::more_equal, {stage, number("1.5")});
  all.push_back(
      {"a limited value beside a whole state, and the position beyond its limit",
       of(l, times(3.527, choose(is, number("0.926"), limited(position(), -2.259, 2.924))))});
}

/// A comparison that was the flag once, and is needed again after another one.
void flag_once(std::vector<Directed>& all) {
  const Node held = number("0.2") < position();
  const Node again = make(Kind::either, {make(Kind::less_equal, {velocity(), number("1")}),
                                         make(Kind::both, {held, number("0.1") < tau_hat()})});
  all.push_back(
      {"a comparison of the choice before", of({}, choose(held, number("0.1"), number("0")) +
                                                       choose(again, number("0.2"), number("0")))});
}

}  // namespace

std::vector<Directed> tight_laws() {
  std::vector<Directed> all;
  dropped(all);
  last_piece(all);
  full_factors(all);
  clipped_beside(all);
  return all;
}

std::vector<Directed> directed_laws() {
  std::vector<Directed> all;
  parameters_alone(all);
  whole_states(all);
  whole_parameters(all);
  nested(all);
  renamed(all);
  rounded_down(all);
  the_same(all);
  directions(all);
  flag_once(all);
  wide(all);
  ends(all);
  return all;
}

}  // namespace feltgate::judge
