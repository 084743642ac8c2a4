// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Messages about what cannot be read: where each points, what it says, how it mends. Documentation:
// docs/laws.md
#include "bad_law.hpp"

using namespace feltgate::law;

namespace {

const Bad kGrammar[] = {
    {"param a = 1 Nmm in 0 .. 2 Nm" OUT,
     "1:13: unknown unit \"Nmm\"; did you mean \"Nm\"? units are products of Nm, N, m, rad, deg, "
     "turn, s, Hz, kg, ... with prefixes; between a number and a name stands *"},
    {"param a 1 in 0 .. 2" OUT,
     "1:9: expected \"=\", found \"1\"; the form is: param NAME = VALUE UNIT in LOWER .. UPPER "
     "UNIT"},
    {"param a = 1" OUT,
     "1:12: expected \"in\" before the end of the line; the form is: param NAME = VALUE UNIT in "
     "LOWER .. UPPER UNIT"},
    {"param a = 1 in 0 - 2" OUT,
     "1:21: expected \"..\" before the end of the line; the form is: param NAME = VALUE UNIT in "
     "LOWER .. UPPER UNIT"},
    {"param if = 1 in 0 .. 2" OUT,
     "1:7: \"if\" is a word of the language and no name; choose another name"},
    {"parm a = 1 in 0 .. 2" OUT,
     "1:1: \"parm\" where a statement begins or an expression goes on; did you mean \"param\"? "
     "statements begin with param, let, state, next, out, ..."},
    {"a = 1" OUT,
     "1:1: \"a\" where a statement begins or an expression goes on; statements begin with param, "
     "let, state, next, out, ..."},
    {"let a = (1 + 2" OUT,
     "1:15: expected \")\" before the end of the line; the form is: let NAME = EXPRESSION"},
    {"out torque = 0.1 Nm * if position < 1 then 1 else 2",
     "1:23: an if inside of an expression, without parentheses; write it as a factor or a term: 2 "
     "* "
     "(if CONDITION then 1 else 0)"},
    {"let a = 1 + -if 1 < 2 then 1 else 2" OUT,
     "1:14: an if inside of an expression, without parentheses; write it as a factor or a term: 2 "
     "* "
     "(if CONDITION then 1 else 0)"},
    {"let a = 1 +" OUT,
     "1:12: expected an expression before the end of the line; the form is: let NAME = EXPRESSION"},
    {"let a = 2 x" OUT,
     "1:11: unknown unit \"x\"; units are products of Nm, N, m, rad, deg, turn, s, Hz, kg, ... "
     "with prefixes; between a number and a name stands *"},
    {"let a = if 1 < 2 then 3" OUT,
     "1:24: expected \"else\" before the end of the line; the form is: let NAME = EXPRESSION"},
    {"let a = x^y" OUT,
     "1:11: expected a whole power, found \"y\"; the form is: let NAME = EXPRESSION"},
    {"let a = x^0.5" OUT,
     "1:11: expected a whole power, found \"0\"; the form is: let NAME = EXPRESSION"},
    {"let a = 5 N/m s" OUT,
     "1:15: a unit that can be read in two ways; after \"/\" write N/(m s), or put the factor "
     "before it: N s/m"},
    {"let a = 1/32 turn" OUT,
     "1:10: a unit that would belong to the lower number alone; write 1 turn / 32, or brackets "
     "around what is below"},
    {"let a = 5 m^9" OUT,
     "1:12: a unit's power that is no whole number from 1 to 8; write for example m^2 or s^-1"},
    {"let a = 5 m^" OUT,
     "1:12: a unit's power that is no whole number from 1 to 8; write for example m^2 or s^-1"},
    {"let a = 1e400" OUT,
     "1:9: a number that is too large or too small; numbers lie between 1e-300 and 1e300"},
    {"let a = 1 $ 2" OUT,
     "1:11: \"$\" where a statement begins or an expression goes on; statements begin with param, "
     "let, state, next, out, ..."},
    {"let a = [1]" OUT,
     "1:9: expected an expression, found \"[\"; the form is: let NAME = EXPRESSION"},
    {"table f x on [0, 1] = x" OUT,
     "1:9: expected \"(\", found \"x\"; the form is: table NAME(x) on [LOWER, UPPER] = EXPRESSION "
     "with 256 segments"},
    {"table f(x) in [0, 1] = x" OUT,
     "1:12: expected \"on\", found \"in\"; the form is: table NAME(x) on [LOWER, UPPER] = "
     "EXPRESSION with 256 segments"},
    {"table f(x) on [0, 1] = x with 5" OUT,
     "1:32: expected \"segments\" before the end of the line; the form is: table NAME(x) on "
     "[LOWER, UPPER] = EXPRESSION with 256 segments"},
    {"array a = 1, 2" OUT,
     "1:11: expected \"[\", found \"1\"; the form is: array NAME = [1, 2, 3] UNIT"},
    {"line a in 0 .. 1" OUT,
     "1:8: expected \"[\", found \"in\"; the form is: line NAME[LENGTH] in LOWER .. UPPER UNIT"},
    {"mailbox a = 1 in 0 .. 2" OUT,
     "1:24: expected \"max_age\" before the end of the line; the form is: mailbox NAME = VALUE "
     "UNIT in LOWER .. UPPER UNIT max_age 5 ms"},
    {"event hit(position)" OUT,
     "1:20: expected \"when\" before the end of the line; the form is: event NAME(VALUE) when "
     "CONDITION"},
    {"for i in 0 .. 3 let a = 1" OUT,
     "1:17: expected \"{\", found \"let\"; the form is: for NAME in FIRST .. LAST { STATEMENTS }"},
    {"for i in 0 .. 3 { let a = 1 ",
     "1:28: expected \"}\" or a statement, found the end of the file; the form is: let NAME = "
     "EXPRESSION"},
    {"for i in 0 .. 3 { out = 1 }" OUT,
     "1:23: expected a name, found \"=\"; the form is: out torque = EXPRESSION"},
    {"out = 1", "1:5: expected a name, found \"=\"; the form is: out torque = EXPRESSION"},
    {"let a == 1" OUT, "1:7: expected \"=\", found \"==\"; the form is: let NAME = EXPRESSION"},
    {"let a = sum(i in 0 .. 3 i)" OUT,
     "1:25: unknown unit \"i\"; units are products of Nm, N, m, rad, deg, turn, s, Hz, kg, ... "
     "with prefixes; between a number and a name stands *"},
    {"param a = 1 in\nparam b 2\nlet c = )\nout torque = 1 Nm",
     "1:15: expected an expression before the end of the line; the form is: param NAME = VALUE "
     "UNIT in LOWER .. UPPER UNIT\n"
     "2:9: expected \"=\", found \"2\"; the form is: param NAME = VALUE UNIT in LOWER .. UPPER "
     "UNIT\n"
     "3:9: expected an expression, found \")\"; the form is: let NAME = EXPRESSION"},
    {"}" OUT,
     "1:1: \"}\" where a statement begins or an expression goes on; statements begin with param, "
     "let, state, next, out, ..."},
    {"require" OUT,
     "1:8: expected an expression before the end of the line; the form is: require SMALLER <= "
     "LARGER"},
    {"let a = 1 # (\nlet b = 2 # )\nlet c = a +* b",
     "3:12: expected an expression, found \"*\"; the form is: let NAME = EXPRESSION"},
    {"let a = \xb5\x01",
     "1:9: expected an expression, found the byte 0xb5; outside of comments a law is plain ASCII; "
     "pi is written as a word, micro as u"},
    {"array a = [1 2]" OUT,
     "1:14: expected \"]\", found \"2\"; the form is: array NAME = [1, 2, 3] UNIT"},
};

}  // namespace

TEST_CASE("what is not understood is told with its place and the form") {
  for (const Bad& bad : kGrammar) check(bad);
}
