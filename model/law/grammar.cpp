// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The grammar, in Boost.Spirit X3. Line ends have no meaning: each statement begins with a keyword.
#include <cerrno>
#include <cstdlib>
#include <string>

#include <boost/fusion/include/at_c.hpp>
#include <boost/range/iterator_range.hpp>
#include <boost/spirit/home/x3.hpp>

#include "law/recovery.hpp"
#include "law/syntax.hpp"

// The grammar's additions to Boost.Spirit X3. This header takes seconds to compile: only
// grammar.cpp includes it.

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

namespace feltgate::law {

namespace {

using Kind = Expression::Kind;

/// Passes the begin of the text to the actions.
struct BeginTag;

template <class Context>
std::size_t offset_of(const Context& context, Iterator at) {
  return static_cast<std::size_t>(at - x3::get<BeginTag>(context).get());
}

// -- words ---------------------------------------------------------------------------------------

const auto letter = x3::char_("a-zA-Z_");
const auto inside = x3::char_("a-zA-Z0-9_");
const auto skipper = x3::char_(" \t\r\n") | ('#' >> *(x3::char_ - '\n'));

const auto no_keyword = [](auto& context) {
  const auto& range = x3::_attr(context);
  const std::string_view word(range.begin(), static_cast<std::size_t>(range.size()));
  x3::_pass(context) = !is_keyword(word);
  x3::_val(context) = range;
};

const auto name = x3::rule<struct NameId, Text>{"a name"} =
    raw(x3::lexeme[letter >> *inside])[no_keyword];

/// A keyword or an operator, with the name that messages use for it.
template <class Id, class Subject>
auto called(const char* as, const Subject& subject) {
  return x3::rule<Id>{as} = x3::omit[subject];
}

template <class Id>
auto word(const char* text, const char* as) {
  return called<Id>(as, x3::lexeme[x3::lit(text) >> !inside]);
}

const auto in_ = word<struct InId>("in", "\"in\"");
const auto then_ = word<struct ThenId>("then", "\"then\"");
const auto else_ = word<struct ElseId>("else", "\"else\"");
const auto when_ = word<struct WhenId>("when", "\"when\"");
const auto on_ = word<struct OnId>("on", "\"on\"");
const auto max_age_ = word<struct MaxAgeId>("max_age", "\"max_age\"");
const auto segments_ = word<struct SegmentsId>("segments", "\"segments\"");
const auto plain = [](const char* text) { return x3::lexeme[x3::lit(text) >> !inside]; };
const auto is_or_through = called<struct IsOrThroughId>(
    "\"=\" or \"through\"",
    &((x3::lit('=') >> !x3::lit('=')) | x3::lexeme[x3::lit("through") >> !inside]));
const auto dots = called<struct DotsId>("\"..\"", x3::lit(".."));
const auto equals = called<struct EqualsId>("\"=\"", x3::lit('=') >> !x3::lit('='));
const auto comma = called<struct CommaId>("\",\"", x3::lit(','));
const auto colon = called<struct ColonId>("\":\"", x3::lit(':'));
const auto open = called<struct OpenId>("\"(\"", x3::lit('('));
const auto close = called<struct CloseId>("\")\"", x3::lit(')'));
const auto open_index = called<struct OpenIndexId>("\"[\"", x3::lit('['));
const auto close_index = called<struct CloseIndexId>("\"]\"", x3::lit(']'));
const auto open_body = called<struct OpenBodyId>("\"{\"", x3::lit('{'));
const auto close_body = called<struct CloseBodyId>("\"}\" or a statement", x3::lit('}'));

// -- numbers -------------------------------------------------------------------------------------

/// An optional unit on the same line; a word that is not a unit is an error.
struct UnitParser : x3::parser<UnitParser> {
  using attribute_type = Text;
  static constexpr bool has_attribute = true;

  template <class Context, class RuleContext, class Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context&, RuleContext&,
             Attribute& attribute) const {
    Iterator begin = first;
    while (begin != last && (*begin == ' ' || *begin == '\t')) ++begin;
    const std::string_view rest(begin, static_cast<std::size_t>(last - begin));
    UnitValue ignored;
    std::size_t length = 0;
    try {
      length = scan_unit(rest, ignored);
    } catch (const UnitError& error) {
      throw SyntaxError{begin + error.offset, error.what, error.mend};
    }
    if (length == 0) refuse_word(rest);
    attribute = Text(length == 0 ? first : begin, length == 0 ? first : begin + length);
    if (length > 0) first = begin + length;
    return true;
  }
};
const UnitParser unit{};

Expression new_expression(Kind kind, std::size_t offset) {
  Expression e;
  e.kind = kind;
  e.offset = offset;
  return e;
}

void adopt(Expression& e, const ExpressionPtr& argument) {
  e.depth = std::max(e.depth, argument->depth + 1);
  e.arguments.push_back(argument);
}

std::string_view view(const Text& text) {
  return {text.begin(), static_cast<std::size_t>(text.size())};
}

void take_unit(const Text& text, UnitValue& value, std::string& as_written) {
  as_written = std::string(view(text));
  if (!as_written.empty()) scan_unit(as_written, value);
}

const auto decimal = raw(
    x3::lexeme[((+x3::char_("0-9") >> -('.' >> +x3::char_("0-9"))) | ('.' >> +x3::char_("0-9"))) >>
               -(x3::char_("eE") >> -x3::char_("+-") >> +x3::char_("0-9")) >>
               !(x3::char_("0-9") | (x3::lit('.') >> x3::char_("0-9")))]);

double number_in(std::string_view text) {
  // from_chars cannot be used: the library of the page's compiler has it for integers only.
  errno = 0;
  const double value = std::strtod(std::string(text).c_str(), nullptr);
  if (errno == ERANGE) {
    throw SyntaxError{text.data(), "a number that is too large or too small",
                      "numbers lie between 1e-300 and 1e300"};
  }
  return value;
}

const auto make_number = [](auto& context) {
  const Text text = boost::fusion::at_c<0>(x3::_attr(context));
  Expression e = new_expression(Kind::number, offset_of(context, text.begin()));
  e.value = number_in(view(text));
  take_unit(boost::fusion::at_c<1>(x3::_attr(context)), e.unit, e.unit_text);
  x3::_val(context) = std::make_shared<const Expression>(std::move(e));
};

// -- expressions ---------------------------------------------------------------------------------

const auto pass_on = [](auto& context) { x3::_val(context) = x3::_attr(context); };

const auto make_binary = [](auto& context) {
  const Text sign = boost::fusion::at_c<0>(x3::_attr(context));
  Expression e = new_expression(Kind::binary, offset_of(context, sign.begin()));
  e.name = std::string(view(sign));
  adopt(e, x3::_val(context));
  adopt(e, boost::fusion::at_c<1>(x3::_attr(context)));
  check_depth(e.depth, sign.begin());
  check_fraction(e, sign.begin(), sign.begin() - e.offset);
  x3::_val(context) = std::make_shared<const Expression>(std::move(e));
};

/// Signs or `not`s, then their operand.
const auto make_unary = [](auto& context) {
  ExpressionPtr value = boost::fusion::at_c<1>(x3::_attr(context));
  const auto& signs = boost::fusion::at_c<0>(x3::_attr(context));
  for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign) {
    if (view(*sign) == "+") continue;
    Expression e = new_expression(Kind::unary, offset_of(context, sign->begin()));
    e.name = std::string(view(*sign));
    adopt(e, value);
    check_depth(e.depth, sign->begin());
    value = std::make_shared<const Expression>(std::move(e));
  }
  x3::_val(context) = value;
};

const auto make_power = [](auto& context) {
  const Text exponent = x3::_attr(context);
  Expression e = new_expression(Kind::power, offset_of(context, exponent.begin()));
  e.value = number_in(view(exponent));
  adopt(e, x3::_val(context));
  x3::_val(context) = std::make_shared<const Expression>(std::move(e));
};

const auto make_name = [](auto& context) {
  const Text text = x3::_attr(context);
  Expression e = new_expression(Kind::name, offset_of(context, text.begin()));
  e.name = std::string(view(text));
  x3::_val(context) = std::make_shared<const Expression>(std::move(e));
};

/// The part in brackets after a name.
template <Kind kind>
struct MakeBracket {
  template <class Context>
  void operator()(Context& context) const {
    Expression e = *x3::_val(context);
    e.kind = kind;
    add(e, x3::_attr(context));
    x3::_val(context) = std::make_shared<const Expression>(std::move(e));
  }
  static void add(Expression& e, const ExpressionPtr& one) { adopt(e, one); }
  static void add(Expression& e, const std::vector<ExpressionPtr>& all) {
    for (const ExpressionPtr& one : all) adopt(e, one);
  }
};

const auto make_choice = [](auto& context) {
  using boost::fusion::at_c;
  const auto& parts = x3::_attr(context);
  Expression e = new_expression(Kind::choice, offset_of(context, at_c<0>(parts).begin()));
  adopt(e, at_c<1>(parts));
  adopt(e, at_c<2>(parts));
  adopt(e, at_c<3>(parts));
  x3::_val(context) = std::make_shared<const Expression>(std::move(e));
};

const auto make_reduce = [](auto& context) {
  using boost::fusion::at_c;
  const auto& parts = x3::_attr(context);
  Expression e = new_expression(Kind::reduce, offset_of(context, at_c<0>(parts).begin()));
  e.name = std::string(view(at_c<0>(parts)));
  e.variable = std::string(view(at_c<1>(parts)));
  adopt(e, at_c<2>(parts));
  adopt(e, at_c<3>(parts));
  adopt(e, at_c<4>(parts));
  x3::_val(context) = std::make_shared<const Expression>(std::move(e));
};

/// An expression in brackets: `(a < b) == c` is no chain of comparisons.
const auto put_brackets = [](auto& context) {
  Expression e = *x3::_attr(context);
  e.brackets = true;
  x3::_val(context) = std::make_shared<const Expression>(std::move(e));
};

template <class Id>
using Rule = x3::rule<Id, ExpressionPtr>;
const Rule<struct ExpressionId> expression{"an expression"};
const Rule<struct EitherId> either{"an expression"};
const Rule<struct BothId> both{"an expression"};
const Rule<struct OppositeId> opposite{"an expression"};
const Rule<struct CompareId> compare{"an expression"};
const Rule<struct SumId> sum{"an expression"};
const Rule<struct ProductId> product{"an expression"};
const Rule<struct UnaryId> unary{"an expression"};
const Rule<struct PowerId> power{"an expression"};
const Rule<struct NumberId> number{"a number"};
const Rule<struct NamedId> named{"a name"};
const Rule<struct ReduceId> reduce{"a sum"};
const Rule<struct ChoiceId> choice{"an if"};
const Rule<struct PrimaryId> primary{"an expression"};

const auto number_def = (decimal >> unit)[make_number];
const auto named_def = name[make_name] >>
                       -(('(' > (expression % ',') > close)[MakeBracket<Kind::call>()] |
                         ('[' > expression > close_index)[MakeBracket<Kind::index>()]);
const auto reduce_def = (raw(plain("sum") | plain("min") | plain("max")) >> '(' >> name >> in_ >
                         expression > dots > expression > colon > expression > close)[make_reduce];
const auto choice_def =
    (raw(plain("if")) > expression > then_ > expression > else_ > expression)[make_choice];
const auto primary_def =
    number[pass_on] | ('(' > expression > close)[put_brackets] | reduce[pass_on] | named[pass_on];
const auto exponent = x3::rule<struct ExponentId, Text>{"a whole power"} =
    raw(x3::lexeme[-x3::char_('-') >> +x3::char_("0-9") >> !(inside | '.')]);
const auto power_def = primary[pass_on] >> -('^' > exponent[make_power]);
const auto unary_def = (*raw(x3::char_("+-")) >> power)[make_unary];
const auto product_def = unary[pass_on] >> *(raw(x3::char_("*/")) > unary)[make_binary];
const auto sum_def = product[pass_on] >> *(raw(x3::char_("+-")) > product)[make_binary];
const auto comparison = raw(x3::lit("<=") | ">=" | "==" | "!=" | "<" | ">");
const auto compare_def = sum[pass_on] >> *(comparison > sum)[make_binary];
const auto opposite_def = (*raw(plain("not")) >> compare)[make_unary];
const auto both_def = opposite[pass_on] >> *(raw(plain("and")) > opposite)[make_binary];
const auto either_def = both[pass_on] >> *(raw(plain("or")) > both)[make_binary];
const auto expression_def = choice[pass_on] | either[pass_on];

BOOST_SPIRIT_DEFINE(number, named, reduce, choice, primary, power, unary, product, sum, compare,
                    opposite, both, either, expression)

// -- statements ----------------------------------------------------------------------------------

/// Begins a statement: its keyword.
template <Statement::Kind kind>
struct Begin {
  template <class Context>
  void operator()(Context& context) const {
    x3::_val(context) = Statement{};
    x3::_val(context).kind = kind;
    x3::_val(context).offset = offset_of(context, x3::_attr(context).begin());
  }
};

const auto put_name = [](auto& context) {
  const Text text = x3::_attr(context);
  x3::_val(context).name = std::string(view(text));
  x3::_val(context).name_offset = offset_of(context, text.begin());
};

const auto put_variable = [](auto& context) {
  x3::_val(context).variable = std::string(view(x3::_attr(context)));
};

template <ExpressionPtr Statement::*member>
struct Put {
  template <class Context>
  void operator()(Context& context) const {
    x3::_val(context).*member = x3::_attr(context);
  }
};
const Put<&Statement::value> put_value{};

const auto put_whole = [](auto& context) { x3::_val(context).whole = true; };
const auto put_periodic = [](auto& context) { x3::_val(context).periodic = true; };
const auto put_element = [](auto& context) {
  x3::_val(context).elements.push_back(x3::_attr(context));
};
const auto put_unit = [](auto& context) {
  take_unit(x3::_attr(context), x3::_val(context).unit, x3::_val(context).unit_text);
};
const auto put_body = [](auto& context) {
  x3::_val(context).body.push_back(std::move(x3::_attr(context)));
};

template <Statement::Kind kind>
auto begin(const char* text) {
  return raw(plain(text))[Begin<kind>()];
}

using S = Statement::Kind;
using StatementRule = x3::rule<struct StatementId, Statement>;
const StatementRule statement{"a statement"};

const auto whole = -x3::omit[plain("whole")][put_whole];
const auto defined = equals > expression[put_value];
const auto range =
    expression[Put<&Statement::lower>()] > dots > expression[Put<&Statement::upper>()];
const auto ranged = in_ > range;
const auto param = begin<S::param>("param") > name[put_name] > defined > ranged > whole;
const auto mailbox = begin<S::mailbox>("mailbox") > name[put_name] > defined > ranged > whole >
                     max_age_ > expression[Put<&Statement::age>()];
const auto state = begin<S::state>("state") > name[put_name] > defined > ranged > whole;
const auto phase = begin<S::phase>("phase") > name[put_name] > defined > ranged;
const auto boolean = begin<S::boolean>("bool") > name[put_name] > defined;
const auto let = begin<S::let>("let") > name[put_name] > defined;
const auto var = begin<S::var>("var") > name[put_name] > defined;
const auto set = begin<S::set>("set") > name[put_name] > defined;
const auto next = begin<S::next>("next") > name[put_name] > defined;
const auto numbers = open_index > (expression[put_element] % ',') > close_index > unit[put_unit];
const auto table = begin<S::table>("table") > name[put_name] > open > name[put_variable] > close >
                   -x3::omit[plain("periodic")][put_periodic] > on_ > open_index >
                   expression[Put<&Statement::lower>()] > comma >
                   expression[Put<&Statement::upper>()] > close_index > is_or_through >
                   ((plain("through") > numbers) |
                    (defined >
                     -(plain("with") > expression[Put<&Statement::segments>()] > segments_)));
const auto array = begin<S::array>("array") > name[put_name] > equals > numbers;
const auto line = begin<S::line>("line") > name[put_name] > open_index >
                  expression[Put<&Statement::index>()] > close_index > ranged;
const auto loop = begin<S::loop>("for") > name[put_variable] > in_ > range > open_body >
                  *statement[put_body] > close_body;
const auto out = begin<S::out>("out") > name[put_name] >
                 -('[' > expression[Put<&Statement::index>()] > close_index) > defined;
const auto event = begin<S::event>("event") > name[put_name] >
                   -('(' > expression[put_value] > close) > when_
                   > expression[Put<&Statement::condition>()];
const auto rate = begin<S::rate>("rate") > defined;
const auto require = begin<S::require>("require") > expression[Put<&Statement::condition>()];

const auto statement_def = param | mailbox | state | phase | boolean | let | var | set | next |
                           table | array | line | loop | out | event | rate | require;
BOOST_SPIRIT_DEFINE(statement)

}  // namespace

Iterator parse_statement(std::string_view text, Iterator at, Statement& result) {
  const Iterator last = text.data() + text.size();
  const Iterator begin = text.data();
  const auto parser = x3::with<BeginTag>(std::cref(begin))[statement];
  try {
    const bool good = x3::phrase_parse(at, last, parser, skipper, result, x3::skip_flag::post_skip);
    return good ? at : nullptr;
  } catch (const x3::expectation_failure<Iterator>& failure) {
    throw SyntaxError{failure.where(), "expected " + failure.which(), ""};
  }
}

}  // namespace feltgate::law
