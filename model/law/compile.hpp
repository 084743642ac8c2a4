// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Compiles a law to an image that an engine runs, and proves the image's error. Documentation:
// docs/laws.md
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

/// Compiles the law. Throws Refused, with line, reason and mend, when the law cannot be proven,
/// does not fit or cannot be scheduled.
Compiled compile(const Law& law, const Target& target);

/// Reads and compiles a law file. A file without a rate is read again at the rate that it reaches,
/// until the rate does not change. Throws LawError or Refused.
Compiled compile_file(const std::string& path, const Target& target);
Compiled compile_text(const std::string& text, const std::string& name, const Target& target);

/// The cost of a program and its bound, which the search minimises. One bit of error costs as much
/// as one instruction.
double cost(const Law& law, const Target& target, const Program& program, const Bound& bound,
            const std::vector<Span>& spans);

/// Whether an output's step, with these words, gives one value where the law's output has many.
bool is_dead(const Law& law, const Target& target, const Step& s, const Span& words,
             const std::vector<Span>& spans);

/// Searches the formats; returns the program with the least cost found, its primary words marked.
Program choose_formats(const Law& law, const Target& target, const std::vector<Span>& spans,
                       int* tried);

/// Marks, for every parameter, the word with the most bits as primary: it carries the value.
void mark_primary(const Law& law, Program& program);

/// Makes the image: the contents of the memories, and the names.
Image make_image(const Law& law, const Target& target, const Program& program,
                 const Assembled& assembled, int divider);

}  // namespace feltgate::law
