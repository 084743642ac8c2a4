// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law becomes an image that an engine runs, with the proof of its error. Documentation:
// docs/law-compiler.md
#pragma once

#include <string>
#include <vector>

#include "law/allocate.hpp"
#include "law/back_end.hpp"
#include "law/bound.hpp"
#include "law/image.hpp"

namespace feltgate::law {

struct Compiled {
  Law law;  ///< its states' ranges complete
  Target target;
  Program program;
  Assembled assembled;
  Bound bound;
  Image image;
  double rate_hz = 0;
  int divider = 1;
  int tried = 0;  ///< choices of formats that were looked at
};

/// Throws Refused, with line, reason and mend, for what cannot be proven, fitted or scheduled.
Compiled compile(const Law& law, const Target& target);

/// Reads and compiles; a file without a rate is read again at the rate that it reaches, until that
/// does not change. Throws LawError or Refused.
Compiled compile_file(const std::string& path, const Target& target);
Compiled compile_text(const std::string& text, const std::string& name, const Target& target);

/// What lower() and bound() cost: the search makes it small. A bit of error is worth an
/// instruction.
double cost(const Law& law, const Target& target, const Program& program, const Bound& bound,
            const std::vector<Span>& spans);

/// Chooses formats: the program with the least cost that was found, its words' primaries marked.
Program choose_formats(const Law& law, const Target& target, const std::vector<Span>& spans,
                       int* tried);

/// Of every parameter, the word with the most bits is the one that says its value.
void mark_primary(const Law& law, Program& program);

/// The memories and names.
Image make_image(const Law& law, const Target& target, const Program& program,
                 const Assembled& assembled, int divider);

}  // namespace feltgate::law
