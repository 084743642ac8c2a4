// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// For the adapters of lock_step.hpp: fields of the twin that have their port's name.
//   FELTGATE_DRIVE(rtl, in, a, b)         rtl.a_i = in.a; rtl.b_i = in.b;
//   FELTGATE_COMPARE(check, rtl, out, a, b) check("a", rtl.a_o, out.a); check("b", ...);
// A field of another name or with a sign of its own is written out.
#pragma once

#include <boost/preprocessor/cat.hpp>
#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/tuple/elem.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>

#define FELTGATE_DRIVE(rtl, in, ...) \
  BOOST_PP_SEQ_FOR_EACH(FELTGATE_DRIVE_ONE, (rtl, in), BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))
#define FELTGATE_DRIVE_ONE(_, objects, name) \
  BOOST_PP_TUPLE_ELEM(0, objects).BOOST_PP_CAT(name, _i) = BOOST_PP_TUPLE_ELEM(1, objects).name;

#define FELTGATE_COMPARE(check, rtl, out, ...)                   \
  BOOST_PP_SEQ_FOR_EACH(FELTGATE_COMPARE_ONE, (check, rtl, out), \
                        BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))
#define FELTGATE_COMPARE_ONE(_, objects, name)                                       \
  BOOST_PP_TUPLE_ELEM(0, objects)                                                    \
  (BOOST_PP_STRINGIZE(name), BOOST_PP_TUPLE_ELEM(1, objects).BOOST_PP_CAT(name, _o), \
                      BOOST_PP_TUPLE_ELEM(2, objects).name);
