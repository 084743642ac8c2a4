// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The grammar's additions to Boost.Spirit X3. This header takes seconds to compile: only
// grammar.cpp includes it.
#pragma once

#include <boost/range/iterator_range.hpp>
#include <boost/spirit/home/x3.hpp>
#include <string>

// An error names the expected input by the name of its first rule.
namespace boost::spirit::x3 {

template <class Subject, class Action>
struct get_info<action<Subject, Action>> {
  using result_type = std::string;
  std::string operator()(const action<Subject, Action>& p) const { return what(p.subject); }
};

template <class Subject>
struct get_info<expect_directive<Subject>> {
  using result_type = std::string;
  std::string operator()(const expect_directive<Subject>& p) const { return what(p.subject); }
};

template <class Left, class Right>
struct get_info<sequence<Left, Right>> {
  using result_type = std::string;
  std::string operator()(const sequence<Left, Right>& p) const { return what(p.left); }
};

template <class Left, class Right>
struct get_info<list<Left, Right>> {
  using result_type = std::string;
  std::string operator()(const list<Left, Right>& p) const { return what(p.left); }
};

}  // namespace boost::spirit::x3

namespace feltgate::law {

namespace x3 = boost::spirit::x3;

using Iterator = const char*;
using Text = boost::iterator_range<Iterator>;

/// The text that `Subject` matched, also when it is one part of a sequence.
template <class Subject>
struct Raw : x3::unary_parser<Subject, Raw<Subject>> {
  using attribute_type = Text;
  static constexpr bool has_attribute = true;
  static constexpr bool handles_container = false;
  explicit Raw(const Subject& subject) : x3::unary_parser<Subject, Raw<Subject>>(subject) {}

  template <class Context, class RuleContext, class Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context& context, RuleContext& rule,
             Attribute& attribute) const {
    x3::skip_over(first, last, context);
    Iterator end = first;
    if (!this->subject.parse(end, last, context, rule, x3::unused)) return false;
    attribute = Text(first, end);
    first = end;
    return true;
  }
};

template <class Subject>
auto raw(const Subject& subject) {
  return Raw(x3::as_parser(subject));
}

}  // namespace feltgate::law
