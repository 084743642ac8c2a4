// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/read_law.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "law/derive.hpp"
#include "law/evaluate.hpp"
#include "law/lowering.hpp"
#include "law/recovery.hpp"

namespace feltgate::law {

namespace {

/// A text of a file as printable UTF-8; '?' replaces invalid or unprintable bytes.
std::string printable(std::string_view text) {
  std::string all;
  for (std::size_t at = 0; at < text.size();) {
    std::uint32_t code = 0;
    const std::size_t length = utf8_letter(text, at, &code);
    const bool control = (code < 0x20 && code != '\t') || (code >= 0x7f && code < 0xa0);
    all += length == 0 || control ? "?" : text.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  return all;
}

/// A comment without its # and the blanks around it.
std::string bare(std::string_view comment) {
  const std::size_t begin = comment.find_first_not_of("# \t");
  if (begin == std::string_view::npos) return {};
  const std::size_t end = comment.find_last_not_of(" \t\r");
  return printable(comment.substr(begin, end - begin + 1));
}

std::string_view line_of(std::string_view text, std::size_t begin) {
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// The comment at the begin of the file, its lines joined.
std::string summary_of(std::string_view text) {
  std::string summary;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::string_view line = line_of(text, at);
    at += line.size() + 1;
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != std::string_view::npos && line[begin] != '#') break;
    const std::string words = begin == std::string_view::npos ? "" : bare(line.substr(begin));
    if (words.empty() && !summary.empty()) break;
    if (!words.empty()) summary += (summary.empty() ? "" : " ") + words;
  }
  return summary;
}

/// Stores the comment after each parameter, on the same line.
void take_comments(std::string_view text, Law& law) {
  std::size_t begin = 0;
  for (int number = 1; begin <= text.size(); ++number) {
    const std::string_view line = line_of(text, begin);
    const std::size_t hash = line.find('#');
    for (Parameter& p : law.parameters) {
      if (p.place.line == number && hash != std::string_view::npos) {
        p.comment = bare(line.substr(hash));
      }
    }
    begin += line.size() + 1;
  }
}

bool is_utf16(std::string_view text) {
  if (text.size() < 2) return false;
  const std::string_view mark = text.substr(0, 2);
  return mark == "\xff\xfe" || mark == "\xfe\xff" || text[0] == '\0' || text[1] == '\0';
}

/// Replaces line ends that are a single CR, as in old files, by LF.
std::string with_line_ends(std::string_view text) {
  std::string all(text);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] == '\r' && (i + 1 == all.size() || all[i + 1] != '\n')) all[i] = '\n';
  }
  return all;
}

}  // namespace

Law read_law_text(std::string_view given, const std::string& path, double rate_hz) {
  if (is_utf16(given)) {
    throw LawError(path, {{{}, "a file in UTF-16, not in UTF-8", "save it as UTF-8"}});
  }
  const std::string whole =
      with_line_ends(given.substr(given.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0));
  const std::string_view text = whole;
  Law law;
  law.name = std::filesystem::path(path).stem().string();
  law.summary = summary_of(text);
  law.source = whole;
  Diagnostics diagnostics;
  const std::vector<Statement> statements = parse_statements(text, diagnostics);
  if (diagnostics.empty()) {
    Lowering lowering(text, rate_hz, law, diagnostics);
    try {
      lowering.run(statements);
    } catch (const TooLong&) {
    }
    if (diagnostics.empty()) {
      take_comments(text, law);
      finish(law, lowering.graph(), diagnostics);
    }
  }
  if (!diagnostics.empty()) throw LawError(path, diagnostics.sorted());
  const Evaluation<double> first(law);
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    law.parameters[i].initial = first.parameter(i);
  }
  return law;
}

Law read_law(const std::string& path, double rate_hz) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw LawError(path, {{{0, 0}, "there is no such file", "give the path of a .law file"}});
  }
  std::ifstream in(path, std::ios::binary);
  if (std::filesystem::is_directory(status)) {
    throw LawError(path, {{{0, 0}, "is a folder", "give the path of a .law file in it"}});
  }
  if (!in.is_open()) {
    throw LawError(path, {{{0, 0}, "cannot be read", "give the path of a .law file"}});
  }
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  return read_law_text(text, path, rate_hz);
}

}  // namespace feltgate::law
