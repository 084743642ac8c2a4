// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A compiled law as C++: a class template over the number policy. Documentation:
// docs/law-compiler.md
#pragma once

#include <map>
#include <string>

#include "law/compile.hpp"

namespace feltgate::law {

/// The header, whose class is feltgate::SPACE::NAME<N>. `source` is named in it: the law's file.
std::string cpp_header(const Compiled& compiled, const std::string& source,
                       const std::string& space = "laws");

/// NAME: "charge_far" becomes "ChargeFar".
std::string cpp_class(const std::string& law);

/// Infix of a postfix formula (ImageWord::formula); `values` are what stands for its names.
std::string cpp_formula(const std::string& postfix,
                        const std::map<std::string, std::string>& values);
/// The statements of a run.
std::string cpp_body(const Compiled& compiled);
/// Local names of inputs and states; a state's member has a low line behind it.
std::string cpp_input(const Law& law, int input);
std::string cpp_state(const Law& law, int state);
/// A double with all its digits: "0.1", "-2.5e-05".
std::string cpp_number(double x);
/// The law's own tables and arrays as static functions of the class, and the names that they have.
std::string cpp_functions(const Compiled& compiled);
std::string cpp_table_name(const Law& law, int table);
std::string cpp_array_name(const Law& law, int array);
/// Fit for C++: keywords and the class's own names get a low line.
std::string cpp_name(const std::string& name);

}  // namespace feltgate::law
