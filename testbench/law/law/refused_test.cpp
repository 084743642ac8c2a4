// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Messages about what a law means: where each points, what it says, how it mends. Documentation:
// docs/laws.md
#include "law_case.hpp"

using namespace feltgate::law;

namespace {

const Bad kMeaning[] = {
    // units
    {"param a = 1 Nm in 0 .. 2 Nm\nout torque = a + position",
     "2:16: Nm + rad: units differ; both sides need the same unit"},
    {"param a = 1 Nm in 0 .. 2 Nm\nlet b = a - 3 N/m\nout torque = a * b",
     "2:11: Nm - N/m: units differ; both sides need the same unit"},
    {"out torque = position",
     "1:14: torque is in Nm, not in rad; check the formula's units, factor by factor"},
    {"out torque = 1 Nm/rad * velocity",
     "1:23: torque is in Nm, not in Nm/s; check the formula's units, factor by factor"},
    {"out torque = if position < 1 m then 1 Nm else 0",
     "1:26: rad < m: units differ; both sides need the same unit"},
    {"out torque = if position < 1 then 1 Nm else position",
     "1:14: Nm or rad: units differ; both sides need the same unit"},
    {"out torque = max(1 Nm, 2 N)", "1:24: Nm and N: units differ; both sides need the same unit"},
    {"out torque = clamp(tau_hat, -1, 1 Nm)", "1:29: Nm and a number: units differ; write -1 Nm"},
    {"let v = velocity\nout torque = if v > 50 then 1 Nm else 0",
     "2:19: 1/s > a number: units differ; write 50 rad/s"},
    {"out torque = if 2 < velocity then 1 Nm else 0",
     "1:19: a number < rad/s: units differ; write 2 rad/s"},
    {"out torque = 1 Nm * sin(velocity)",
     "1:25: the angle is in a number, not in rad/s; check the formula's units, factor by factor"},
    {"out torque = 1 Nm * exp(1 m)",
     "1:25: the argument is in a number, not in m; check the formula's units, factor by factor"},
    {"out torque = 1 Nm * log(1 m)",
     "1:25: the argument is in a number, not in m; check the formula's units, factor by factor"},
    {"out torque = 1 Nm * sqrt(1 m * 1 rad)",
     "1:21: the square root of m; its argument's unit must be a square: m^2, or a number"},
    {"table f(x) on [0 m, 1 m] = x\nout torque = 1 N * f(position)",
     "2:22: the argument of f is in m, not in rad; check the formula's units, factor by factor"},
    {"out torque = lowpass(tau_hat, 5 ms)\nrate = 1 kHz",
     "1:14: dt and filters need a rate; write above: rate = 40 kHz\n"
     "1:31: the frequency of lowpass is in 1/s, not in ms; check the formula's units, factor by "
     "factor"},
    // names
    {"out torque = 1 Nm * postion", "1:21: unknown name \"postion\"; did you mean \"position\"?"},
    {"out torque = 1 Nm * sinn(position)",
     "1:21: unknown function \"sinn\"; did you mean \"sin\"?"},
    {"out torque = 1 Nm * tan(position)",
     "1:21: unknown function \"tan\"; there are min, max, clamp, abs, sgn, sin, cos, sqrt, exp, "
     "lowpass, sum, floor, round, mod, noise, log, atan2, and what table defines above"},
    {"out torque = 1 Nm * atan2(position[1], position)",
     "1:21: atan2 of what has no end; limit both with clamp, the smallest range is the most exact "
     "one"},
    {"out torque = 1 Nm * atan2(clamp(position[1], 0, 1))",
     "1:21: atan2 with 1 arguments; write atan2(y, x)"},
    {"out torque = 1 Nm * atan2(clamp(position[1], 0, 1), 1 m)",
     "1:53: a number and m: units differ; both sides need the same unit"},
    {"param a = 1 in 0 .. 2\nout torque = 1 Nm * atan2(a, 1)",
     "2:21: atan2 of what only depends on parameters; make a parameter of it"},
    {"table f(x) on [0, 1] = atan2(x, 1)\nout torque = 1 Nm * f(position)",
     "1:24: atan2 in a table; take it out of the table, into its argument"},
    {"table f(x) on [0, 3] = floor(x)\nout torque = 1 Nm * f(position)",
     "1:24: floor of what has no end; limit it with clamp to 64 of them; what repeats for ever is "
     "a "
     "periodic table"},
    {"let atan2 = 1\nout torque = 1 Nm * atan2", "read"},
    {"let floor = 1\nout torque = 1 Nm * floor", "read"},
    {"let log = 1\nout torque = 1 Nm * log", "read"},
    {"let floor = 1\nout torque = 1 Nm * floor(position)",
     "2:21: \"floor\" is no function; between factors stands *"},
    {"out torque = 1 Nm * qqq",
     "1:21: unknown name \"qqq\"; define it above with param, let or state"},
    {"out torque = 1 Nm * b\nlet b = 1",
     "1:21: \"b\" is used before its definition in line 2; move the definition up"},
    {"let b = b + 1\nout torque = 1 Nm * b",
     "1:9: \"b\" is used in its own definition; a value of the run before is a state: state NAME = "
     "..., next NAME = ..."},
    {"table f(x) on [0, 1] = f(x)\nout torque = 1 Nm * f(position)",
     "1:24: \"f\" is used in its own definition; a value of the run before is a state: state NAME "
     "= ..., next NAME = ..."},
    {"param a = 1 Nm in 0 .. 2 Nm\nlet a = 2 Nm\nout torque = a",
     "2:5: \"a\" is defined twice; first in line 1; choose another name"},
    {"let sin = 1 Nm\nout torque = sin",
     "1:5: \"sin\" is a name that the language brings along; choose another name"},
    {"let position = 1 Nm\nout torque = position",
     "1:5: \"position\" is a name that the language brings along; choose another name"},
    {"let m = 1 Nm\nout torque = m", "1:5: \"m\" is a unit and no name; choose another name"},
    {"out torque = 2 * Nm",
     "1:18: the unit \"Nm\" without a number; write 1 Nm; names of units are no names of values"},
    {"out torque = 2 Nm * sin", "1:21: the function \"sin\" without its argument; write sin(...)"},
    {"let a = torque\nout torque = a",
     "1:9: \"torque\" is an output and cannot be read; give the expression a name with let"},
    {"let a = 1 Nm\nout torque = a(2)", "2:14: \"a\" is no function; between factors stands *"},
    {"let a = 1 Nm\nout torque = a[2]",
     "2:14: \"a\" has no elements; only arrays and lines have: NAME[k]"},
    {"table f(x) on [-1, 1] = sqrt(x)\nout torque = 1 Nm * f(position)",
     "1:25: in the table \"f\" this is no number at -1; let the table end where its formula does, "
     "or "
     "limit what it is of, e.g. sqrt(max(x, 0))"},
    {"table f(x) on [-1, 1] = 2 * max(0, sqrt(x))\nout torque = 1 Nm * f(position)",
     "1:36: in the table \"f\" this is no number at -1; let the table end where its formula does, "
     "or "
     "limit what it is of, e.g. sqrt(max(x, 0))"},
    {"table f(x) on [-1, 3] = if x > 2 then 1 else 1 / x\nout torque = 1 Nm * f(position)",
     "1:48: in the table \"f\" this is no number at 0; let the table end where its formula does, "
     "or "
     "limit what it is of, e.g. 1 / max(x, 0.01)"},
    {"table f(x) on [0, 1] = x\nout torque = 1 Nm * f",
     "2:21: the table \"f\" without its argument; write f(...)"},
    {"array f = [1, 2]\nout torque = 1 Nm * f",
     "2:21: \"f\" without the number of its element; write f[1]"},
    {"table f(sin) on [0, 1] = sin\nout torque = 1 Nm * f(position)",
     "1:7: the table's variable \"sin\" has a meaning already; choose another name"},
    {"table f(x) on [0, 1] = x\nparam p = 0 in 0 .. 1\nout torque = f(p) * tau_hat",
     "3:14: a table of what only depends on parameters; write its formula in its place; the host "
     "computes that"},
    {"table f(x) on [0, 1] through [0, 1]\nparam p = 0 in 0 .. 1\nout torque = f(p) * tau_hat",
     "3:14: a table of what only depends on parameters; make what it gives the parameter, or write "
     "its lines with if"},
    // names that are none
    {"let s = 1" OUT, "1:5: \"s\" is a unit and no name; choose another name"},
    {"let m = 1" OUT, "1:5: \"m\" is a unit and no name; choose another name"},
    {"let mm = 1" OUT, "1:5: \"mm\" is a unit and no name; choose another name"},
    {"let sum = 1" OUT,
     "1:5: \"sum\" is a name that the language brings along; choose another name"},
    {"let phase = 1" OUT,
     "1:5: \"phase\" is a word of the language and no name; choose another name"},
    // what is missing
    {"let a = 1 Nm", "1:1: the law has no output; write out torque = ..."},
    {"", "1:1: the law has no output; write out torque = ..."},
    {"state q = 0 Nm in -1 .. 1 Nm\nout torque = q",
     "1:7: the state \"q\" has no next; write below: next q = ..."},
    {"line l[3] in -1 .. 1 Nm\nout torque = l[1]",
     "1:6: nothing is written into the line \"l\"; write below: next l = ..."},
    {"next q = 1" OUT, "1:6: \"q\" is no state, phase, bool or line; write above: state q = ..."},
    {"state sum_of = 0 Nm in -1 .. 1 Nm\nnext sumof = sum_of\nout torque = sum_of",
     "1:7: the state \"sum_of\" has no next; write below: next sum_of = ...\n"
     "2:6: \"sumof\" is no state, phase, bool or line; did you mean \"sum_of\"? write above: state "
     "sumof "
     "= ..."},
    {"state q = 0 Nm in -1 .. 1 Nm\nnext q = q\nnext q = 0\nout torque = q",
     "3:6: a second next of \"q\"; write one: next NAME = if ..."},
    {"state q = 0 Nm in -1 .. 1 Nm\nnext q = position\nout torque = q",
     "2:10: \"q\" is in Nm, not in rad; check the formula's units, factor by factor"},
    {"out torque = 1 Nm\nout torque = 2 Nm",
     "2:5: a second torque of axis 0; add both in one expression, or write torque[1] for another "
     "axis"},
    {"out force = 1 N", "1:5: unknown output \"force\"; write out torque = ..."},
    {"out torque[3] = 1 Nm", "1:12: an axis is no whole number from 0 to 2; write one of 0 .. 2"},
    {"out torque = tau_hat[3]",
     "1:22: an axis is no whole number from 0 to 2; write one of 0 .. 2"},
    // ranges
    {"param a = 1 Nm in 2 .. 0 Nm\nout torque = a",
     "1:19: the range of \"a\" is upside down: 2 Nm .. 0 Nm; write 0 Nm .. 2 Nm"},
    {"param a = 1 Nm in 1 .. 1 Nm\nout torque = a",
     "1:19: the range of \"a\" is empty: 1 Nm .. 1 Nm; a value that never changes is a let"},
    {"param a = 3 Nm in 0 .. 2 Nm\nout torque = a",
     "1:11: 3 Nm of \"a\" lies outside of its range 0 Nm .. 2 Nm; choose a value inside, or widen "
     "the range"},
    {"param a = 300 mNm in 0 .. 200 mNm\nout torque = a",
     "1:11: 300 mNm of \"a\" lies outside of its range 0 mNm .. 200 mNm; choose a value inside, or "
     "widen the range"},
    {"param a = 30 in 0 .. 90 deg\nout torque = 1 Nm * a",
     "1:11: the value has no unit; write 30 deg"},
    {"param a = 30 deg in 0 .. 90\nout torque = 1 Nm * a",
     "1:26: the range's upper end has no unit; write 90 deg"},
    {"param a = 1 Nm in 0 .. 2 N\nout torque = a",
     "1:19: the range's lower end is in N, not in Nm; value and range need the same unit"},
    {"param a = 1.5 in 0 .. 2 whole\nout torque = 1 Nm * a",
     "1:11: the value of \"a\" is no whole number; whole stands behind whole numbers without unit"},
    {"param a = 1 Nm in 0 .. 2 Nm whole\nout torque = a",
     "1:11: the value of \"a\" is no whole number; whole stands behind whole numbers without unit"},
    {"param a = 1 in 0 .. 2\nparam b = a in 0 .. 2\nout torque = 1 Nm * a * b",
     "2:11: the value is not constant; it may hold numbers, pi, dt and lets made of them"},
    {"mailbox a = 1 in 0 .. 2 max_age 5 Nm\nout torque = 1 Nm * a",
     "1:33: max_age is no time above 0; write max_age 5 ms"},
    {"mailbox a = 1 in 0 .. 2 max_age 0 s\nout torque = 1 Nm * a",
     "1:33: max_age is no time above 0; write max_age 5 ms"},
    {"table f(x) on [1, 0] = x\nout torque = 1 Nm * f(position)",
     "1:16: the range of the table \"f\" is upside down; write on [LOWER, UPPER]"},
    {"table f(x) on [0 m, 1 s] = x\nout torque = 1 Nm * f(position)",
     "1:16: the table's ends are in m and in s; both need the same unit"},
    {"table f(x) on [0, 1] = x with 0 segments\nout torque = 1 Nm * f(position)",
     "1:31: the number of segments is no whole number from 1 to 511; write one of 1 .. 511"},
    {"param k = 1 in 0 .. 2\ntable f(x) on [0, 1] = k * x\nout torque = 1 Nm * f(position)",
     "2:7: the table \"f\" uses \"k\", which changes at run time; a table holds a function of its "
     "variable and of constants; multiply outside of it"},
    {"table f(x) on [0, 1] x\nout torque = 1 Nm * f(position)",
     "1:22: expected \"=\" or \"through\", found \"x\"; the form is: table NAME(x) on [LOWER, "
     "UPPER] "
     "= EXPRESSION with 256 segments"},
    {"table f(x) on [0, 1] through [1]\nout torque = 1 Nm * f(position)",
     "1:7: a table through one point; a line needs two, at the table's ends"},
    {"table f(x) periodic on [0, 1] through [1, 3, 2]\nout torque = 1 Nm * f(position)",
     "1:7: the periodic table \"f\" begins with 1 and ends with 2; let it end as it begins: what "
     "jumps is a comparison outside of it"},
    {"table f(x) periodic on [0, 3] = sin(x)\nout torque = 1 Nm * f(position)",
     "1:7: the periodic table \"f\" begins with 0 and ends with 0.14112; let it end as it begins: "
     "what jumps is a comparison outside of it"},
    {"table f(x) periodic on [0, 1 turn] = cos(x)\nout torque = 1 Nm * f(position)", "read"},
    {"table f(x) periodic [0, 1] = 1\nout torque = 1 Nm * f(position)",
     "1:21: expected \"on\", found \"[\"; the form is: table NAME(x) on [LOWER, UPPER] = "
     "EXPRESSION with 256 segments"},
    {"table f(x) on [0, 1] through [1 Nm, 2 N]\nout torque = f(position)",
     "1:37: elements in Nm and in N; write the unit once, behind the bracket"},
    {"param k = 1 in 0 .. 2\ntable f(x) on [0, 1] through [1, k]\nout torque = 1 Nm * f(position)",
     "2:34: a number between the brackets is not constant; it may hold numbers, pi, dt and lets "
     "made of them"},
    {"table f(x) on [0, 1] = x * velocity\nout torque = 1 Nm * f(position)",
     "1:7: the table \"f\" uses \"velocity\", which changes at run time; a table holds a function "
     "of its variable and of constants; multiply outside of it\n"
     "2:19: torque is in Nm, not in Nm/s; check the formula's units, factor by factor"},
    {"line l[0] in -1 .. 1 Nm\nnext l = 0\nout torque = l[1]",
     "1:8: the length of a line is no whole number from 1 to 512; write one of 1 .. 512"},
    {"line l[4] in 1 .. 2 Nm\nnext l = 1 Nm\nout torque = l[1]",
     "1:14: a range without 0, of a line that begins with zeros; let the range hold 0"},
    {"line l[4] in -1 .. 2 Nm\nnext l = 0\nout torque = l[5]",
     "3:16: the number of an element is no whole number from 1 to 4; write one of 1 .. 4"},
    {"array a = [1, 2] Nm\nout torque = a[2]",
     "2:16: the number of an element is no whole number from 0 to 1; write one of 0 .. 1"},
    {"array a = [1 m, 2] Nm\nout torque = a[1]",
     "1:12: a unit in front of the array's own; write the unit once, behind the bracket"},
    {"array a = [1 Nm, 2 N]\nout torque = a[1]",
     "1:18: elements in Nm and in N; write the unit once, behind the bracket"},
    {"array a = [1, position]\nout torque = 1 Nm * a[1]",
     "1:15: a number between the brackets is not constant; it may hold numbers, pi, dt and lets "
     "made of them"},
    {"rate = 5 s" OUT, "1:8: the rate is no frequency above 0; write rate = 40 kHz"},
    {"rate = 1 kHz\nrate = 2 kHz" OUT, "2:1: a second rate; write one"},
    {"out torque = 1 Nm * velocity * dt",
     "1:32: dt and filters need a rate; write above: rate = 40 kHz"},
    {"out torque = lowpass(tau_hat, 5 Hz)",
     "1:14: dt and filters need a rate; write above: rate = 40 kHz"},
    {"rate = 1 kHz\nout torque = lowpass(tau_hat, 0 Hz)",
     "2:14: a lowpass whose frequency is not above 0; write lowpass(x, 144 Hz)"},
    {"rate = 40 kHz\nout torque = lowpass(tau_hat, 10 MHz)",
     "2:14: a lowpass of 1e+07 Hz in a law that runs at 40000 Hz, which passes all; write a "
     "frequency to 20000 Hz, or no lowpass"},
    {"rate = 40 kHz\nparam f = 1 kHz in 0.1 .. 80 kHz\nout torque = lowpass(tau_hat, f)",
     "3:14: a lowpass of 80000 Hz in a law that runs at 40000 Hz, which passes all; write a "
     "frequency to 20000 Hz, or no lowpass"},
    {"rate = 1 kHz\nout torque = lowpass(tau_hat, velocity)",
     "2:14: a lowpass whose frequency changes during a run; make the frequency a constant or a "
     "param"},
    {"param a = -5 mm in -1 .. 0.1 m\nout torque = 1 N * a", "read"},
    // numbers and conditions
    {"out torque = 1 Nm / 0", "1:19: a division by 0; the divisor must not be 0"},
    {"param a = 1 in 0 .. 2\nout torque = 1 Nm / a",
     "2:19: a division by parameters that may be 0; let their ranges not hold 0"},
    {"param a = 1 in -1 .. 2\nout torque = 1 Nm * sqrt(a)",
     "2:21: the square root of parameters that may be below 0; begin their ranges at 0, or write "
     "sqrt(max(x, 0))"},
    {"param a = 1 in 0 .. 2\nout torque = 1 Nm * log(a)",
     "2:21: the logarithm of parameters that may be 0 or below; begin their ranges above 0, or "
     "write log(max(x, 0.01))"},
    {"param a = 1 in 0.1 .. 2\nout torque = 1 Nm * log(a)", "read"},
    {"table f(x) on [0, 1] = log(x)\nout torque = 1 Nm * f(position)",
     "1:24: in the table \"f\" this is no number at 0; let the table end where its formula does, "
     "or "
     "limit what it is of, e.g. log(max(x, 0.01))"},
    {"table f(x) on [0, 1024] = exp(x)\nout torque = 1 Nm * f(position)",
     "1:27: in the table \"f\" this is no number at 710; let the table end where its formula "
     "does, or limit what it is of, e.g. exp(min(x, 100))"},
    {"table f(x) on [0, 1] = (1e200 + x) * (1e200 + x)\nout torque = 1 Nm * f(position)",
     "1:36: in the table \"f\" this is no number at 0; let the table end where its formula does"},
    {"out torque = 1 Nm * log(0)",
     "1:21: the logarithm of a number that is not above 0; its argument must be above 0"},
    {"param a = 1 in 0 .. 1000\nout torque = 1 Nm * exp(a)",
     "2:21: a formula of parameters that gets too large; make the parameters' ranges smaller"},
    {"out torque = 1 Nm * sqrt(-1)",
     "1:21: the square root of a number below 0; its argument must be 0 or more"},
    {"out torque = 1 Nm * exp(1000)",
     "1:21: a value that is not finite; numbers lie between -1e300 and 1e300"},
    {"out torque = 1 Nm * floor(position)",
     "1:21: floor of what has no end; limit it with clamp to 64 of them; what repeats for ever is "
     "a periodic table"},
    {"out torque = 1 Nm * floor(clamp(position, 0, 64))",
     "1:21: floor of what takes 65 whole numbers; limit it with clamp to 64 of them; what repeats "
     "for ever is a periodic table"},
    {"out torque = 1 Nm * mod(position, 1)",
     "1:21: mod of what has no end; limit it with clamp to 64 of them; what repeats for ever is a "
     "periodic table"},
    {"out torque = 1 Nm * floor(clamp(tau_hat, 0, 1 Nm))",
     "1:27: the argument of floor is in a number, not in Nm; check the formula's units, factor by "
     "factor"},
    {"param a = 1 in 0 .. 2\nout torque = 1 Nm * floor(a)",
     "2:21: floor of what only depends on parameters; make a parameter of it, which may be whole"},
    {"param a = 1 in 1 .. 2\nout torque = 1 Nm * mod(clamp(position, 0, 1), a)",
     "2:48: the period of mod is no constant above 0; write mod(x, 15 deg)"},
    {"param a = 1 in 0 .. 2\nout torque = 1 Nm * noise(a)",
     "2:27: the seed of noise is not constant; it may hold numbers, pi, dt and lets made of them"},
    {"out torque = 1 Nm * noise(0.5)",
     "1:27: the seed of noise is no whole number from 0 to 9999; write one of 0 .. 9999"},
    {"out torque = 1 Nm * position^9",
     "1:30: a power that is no whole number from 1 to 8 or -8 to -1; write products of smaller "
     "powers"},
    {"out torque = 1 Nm * position^0",
     "1:30: a power that is no whole number from 1 to 8 or -8 to -1; write products of smaller "
     "powers"},
    {"out torque = 1 Nm * (position < 1)",
     "1:31: a condition where a number must stand; write if CONDITION then 1 else 0"},
    {"out torque = if position then 1 Nm else 0",
     "1:17: a number where a condition must stand; compare it: x > 0"},
    {"out torque = if position < 1 then 1 Nm else position < 2",
     "1:14: a condition and a number as the two values of an if; both must be numbers, or both "
     "conditions"},
    {"out torque = if position == 1 then 1 Nm else 0",
     "1:26: \"==\" between numbers that are never quite the same; compare with <, <=, > or >=, or "
     "make both whole"},
    {"bool b = true\nnext b = b\nout torque = if position > 0 == b then 1 Nm else 0",
     "3:30: a condition and a number beside \"==\"; compare the number first, in brackets: (x > 0) "
     "== held"},
    {"out torque = if (position < 1) < 2 then 1 Nm else 0",
     "1:27: a condition where a number must stand; write if CONDITION then 1 else 0"},
    {"let a = time\nlet time = a\nout torque = 1 Nm * time",
     "1:9: \"time\" is used before its definition in line 2; move the definition up"},
    {"out torque = 1 Nm * time / (1 s)",
     "1:21: dt and filters need a rate; write above: rate = 40 kHz"},
    {"out torque = 1 Nm * round(position)",
     "1:21: round of what has no end; limit it with clamp to 64 of them; what repeats for ever is "
     "a "
     "periodic table"},
    {"param p = 1 in 0 .. 2 whole\nout torque = if p / 2 != 1 then 1 Nm else 0",
     "2:23: \"!=\" between numbers that are never quite the same; compare with <, <=, > or >=, or "
     "make both whole"},
    {"out torque = if position and velocity then 1 Nm else 0",
     "1:17: a number where a condition must stand; compare it: x > 0\n"
     "1:30: a number where a condition must stand; compare it: x > 0"},
    {"out torque = clamp(tau_hat, 1 Nm)",
     "1:14: clamp with 2 arguments; write clamp(x, lower, upper)"},
    {"out torque = clamp(tau_hat, 1 Nm, -1 Nm)",
     "1:14: the ends of clamp are upside down; write clamp(x, lower, upper)"},
    {"out torque = min(tau_hat)", "1:14: min with one argument; write min(a, b)"},
    {"out torque = sum(tau_hat)",
     "1:14: a sum without a range; write sum(i in 0 .. 3: EXPRESSION)"},
    {"out torque = abs(tau_hat, 1)", "1:14: abs with 2 arguments; write abs(x)"},
    {"bool q = 1\nnext q = q\nout torque = if q then 1 Nm else 0",
     "1:10: a number where a condition must stand; compare it: x > 0"},
    {"bool q = position > 1\nnext q = q\nout torque = if q then 1 Nm else 0",
     "1:19: the first value of \"q\" is not constant; write bool q = false"},
    {"bool q = false\nnext q = 1\nout torque = if q then 1 Nm else 0",
     "2:10: a number where a condition must stand; compare it: x > 0"},
    {"bool q = false\nnext q = q\nout torque = 1 Nm * q",
     "3:21: a condition where a number must stand; write if CONDITION then 1 else 0"},
    {"bool q in 0 .. 1" OUT, "1:8: expected \"=\", found \"in\"; the form is: bool NAME = false"},
    {"bool q = false\nout torque = if q then 1 Nm else 0",
     "1:6: the state \"q\" has no next; write below: next q = ..."},
    // loops and events
    {"out torque = sum(i in 3 .. 0: tau_hat)",
     "1:23: the loop's range is upside down: 3 .. 0; write 0 .. 3"},
    {"out torque = sum(i in 0 .. 5000: tau_hat)",
     "1:23: a loop of 5001 rounds; loops are unrolled: at most 1024"},
    {"out torque = sum(i in 0 .. 0.5: tau_hat)",
     "1:28: the loop's last number is no whole number from -1000000 to 1000000; write one of "
     "-1000000 .. 1000000"},
    {"let i = 2\nout torque = i * sum(i in 0 .. 5: tau_hat)",
     "2:18: \"i\" is defined already; choose another name"},
    {"for i in 0 .. 1 { param b = 1 in 0 .. 2 }" OUT,
     "1:19: a loop holds let, var, set and for, and nothing else; write this outside of the loop"},
    {"let a = 0 Nm\nfor i in 0 .. 1 { set a = 1 Nm }\nout torque = a",
     "2:23: \"a\" is no var; write above: var a = ..."},
    {"var a = 0 Nm\nset a = 1\nout torque = a",
     "2:9: \"a\" is in Nm, not in a number; check the formula's units, factor by factor"},
    {"var a = 0 Nm\nset a = 1 < position\nout torque = a",
     "2:11: a condition and a number in one var; use two vars"},
    {"var a = 0 Nm\nfor i in 0 .. 999 { for j in 0 .. 999 { set a = a + tau_hat } }\nout torque = "
     "a",
     "2:51: a law of more than 20000 operations; make the loops shorter; the engine's program has "
     "512"},
    {"event e(1) when 1 < 2" OUT,
     "1:19: a condition that never changes; compare an input or a state"},
    {"event e(1) when position" OUT,
     "1:17: a number where a condition must stand; compare it: x > 0"},
    {"event e(1) when position < 1\nevent e(1) when position < 2" OUT,
     "2:7: the event \"e\" is defined twice; first in line 1; choose another name, or join the "
     "conditions with or"},
};

}  // namespace

TEST_CASE("what has no meaning is told with its place and a mend") {
  for (const Bad& bad : kMeaning) check(bad);
}
