// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes a compiled law as C++: a class template over the number policy. Documentation:
// docs/law-compiler.md
#pragma once

#include <map>
#include <string>

#include "law/compile.hpp"

namespace feltgate::law {

/// Text of the header, whose class is feltgate::SPACE::NAME<N>. The header names `source`, the
/// law's file.
std::string cpp_header(const Compiled& compiled, const std::string& source,
                       const std::string& space = "laws");

/// The class name NAME: "charge_far" becomes "ChargeFar".
std::string cpp_class(const std::string& law);

/// The infix form of a postfix formula (ImageWord::formula); `values` replaces its names.
std::string cpp_formula(const std::string& postfix,
                        const std::map<std::string, std::string>& values);
/// The C++ statements of one run.
std::string cpp_body(const Compiled& compiled);
/// Local names of inputs and states; a state's member has an underscore appended.
std::string cpp_input(const Law& law, int input);
std::string cpp_state(const Law& law, int state);
/// A double with all its digits: "0.1", "-2.5e-05".
std::string cpp_number(double x);
/// The law's own tables and arrays as static functions of the class, and their names.
std::string cpp_functions(const Compiled& compiled);
std::string cpp_table_name(const Law& law, int table);
std::string cpp_array_name(const Law& law, int array);
/// A valid C++ name: keywords and the class's own names get an underscore appended.
std::string cpp_name(const std::string& name);

}  // namespace feltgate::law
