// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/read_law.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "feltgate/nearest.hpp"
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

// Reports syntax errors and resumes parsing after them.

namespace {

constexpr int kMostDepth = 500;    ///< largest depth of an expression's tree
constexpr int kMostBrackets = 60;  ///< open at once: each costs a dozen calls of the grammar
constexpr int kMostChoices = 60;   ///< ifs in one statement, which may be nested
constexpr std::size_t kMostText = 1U << 16U;

/// Keywords that begin a statement, and the statement's form.
constexpr std::pair<const char*, const char*> kForms[] = {
    {"param", "param NAME = VALUE UNIT in LOWER .. UPPER UNIT"},
    {"mailbox", "mailbox NAME = VALUE UNIT in LOWER .. UPPER UNIT max_age 5 ms"},
    {"let", "let NAME = EXPRESSION"},
    {"var", "var NAME = EXPRESSION"},
    {"set", "set NAME = EXPRESSION"},
    {"state", "state NAME = VALUE UNIT in LOWER .. UPPER UNIT"},
    {"phase", "phase NAME = VALUE in LOWER .. UPPER"},
    {"bool", "bool NAME = false"},
    {"next", "next NAME = EXPRESSION"},
    {"table", "table NAME(x) on [LOWER, UPPER] = EXPRESSION with 256 segments"},
    {"array", "array NAME = [1, 2, 3] UNIT"},
    {"line", "line NAME[LENGTH] in LOWER .. UPPER UNIT"},
    {"for", "for NAME in FIRST .. LAST { STATEMENTS }"},
    {"out", "out torque = EXPRESSION"},
    {"event", "event NAME(VALUE) when CONDITION"},
    {"rate", "rate = 40 kHz"},
    {"require", "require SMALLER <= LARGER"},
};

constexpr const char* kOther[] = {"in", "then", "else",    "if",    "when",     "on",   "and",
                                  "or", "not",  "max_age", "whole", "segments", "with", "through"};

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
}

std::string_view word_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_name(text[end])) ++end;
  return text.substr(at, end - at);
}

const char* form_of(std::string_view word) {
  for (const auto& [name, form] : kForms) {
    if (word == name) return form;
  }
  return nullptr;
}

std::vector<std::string> statement_words() {
  std::vector<std::string> words;
  for (const auto& [name, form] : kForms) words.emplace_back(name);
  return words;
}

bool is_plain(unsigned char byte) { return byte >= 0x20 && byte < 0x7f; }

constexpr const char* kPlain =
    "outside of comments a law is plain ASCII; pi is written as a word, micro as u";

/// Describes the text at `at` for a message.
std::string found(std::string_view text, std::size_t at) {
  if (at >= text.size()) return "the end of the file";
  if (text.substr(at, 2) == "==") return "\"==\"";
  const unsigned char byte = byte_at(text, at);
  if (!is_plain(byte)) {
    std::uint32_t code = 0;
    return utf8_letter(text, at, &code) > 1 ? fmt::format("the character U+{:04X}", code)
                                            : fmt::format("the byte 0x{:02x}", byte);
  }
  const std::string_view word = word_at(text, at);
  return "\"" + std::string(word.empty() ? text.substr(at, 1) : word.substr(0, 40)) + "\"";
}

/// Skips blanks and comments.
std::size_t skip(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    if (text[at] == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (std::string_view(" \t\r\n").find(text[at]) != std::string_view::npos) {
      ++at;
    } else {
      break;
    }
  }
  return at;
}

/// Offset of the next line after `at` that begins with a statement or ends a loop.
std::size_t next_statement(std::string_view text, std::size_t at) {
  while (true) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) return text.size();
    at = end + 1;
    std::size_t begin = at;
    while (begin < text.size() && (text[begin] == ' ' || text[begin] == '\t')) ++begin;
    if (form_of(word_at(text, begin)) != nullptr) return begin;
  }
}

/// Limits the brackets and ifs that are open at once, as the grammar recurses for each.
void check_nesting(std::string_view text, const Places& places, Diagnostics& diagnostics) {
  int open = 0, choices = 0;
  for (std::size_t at = skip(text, 0); at < text.size(); at = skip(text, at)) {
    const std::string_view word = word_at(text, at);
    if (form_of(word) != nullptr && word != "for") choices = 0;
    if (word == "if") ++choices;
    const char c = text[at];
    if (c == '(' || c == '[' || c == '{') ++open;
    if ((c == ')' || c == ']' || c == '}') && open > 0) --open;
    if (open > kMostBrackets || choices > kMostChoices) {
      diagnostics.add(places.of(at), "expressions inside expressions, too many to follow",
                      "give parts of it names with let");
      return;
    }
    at += word.empty() ? 1 : word.size();
  }
}

/// The text before an error.
struct Before {
  std::string form;     ///< form of the last statement that begins before it
  std::size_t end = 0;  ///< end of the last word or sign before it
};

Before before(std::string_view text, std::size_t begin, std::size_t end) {
  Before found{"", begin};
  for (std::size_t at = skip(text, begin); at < end; at = skip(text, at)) {
    const std::string_view word = word_at(text, at);
    if (form_of(word) != nullptr) found.form = form_of(word);
    at += word.empty() ? 1 : word.size();
    found.end = at;
  }
  return found;
}

Diagnostic explained(std::string_view text, std::size_t begin, const SyntaxError& error,
                     const Places& places) {
  const std::size_t at = skip(text, static_cast<std::size_t>(error.at - text.data()));
  if (!error.mend.empty()) return {places.of(at), error.what, error.mend};
  if (error.what == "expected a name" && is_keyword(word_at(text, at))) {
    return {places.of(at), found(text, at) + " is a word of the language and no name",
            "choose another name"};
  }
  if (error.what == "expected an expression") {
    std::size_t first = at;
    while (first < text.size() && (text[first] == '+' || text[first] == '-')) {
      first = skip(text, first + 1);
    }
    if (word_at(text, first) == "if") {
      return {places.of(first), "an if inside of an expression, without parentheses",
              "write it as a factor or a term: 2 * (if CONDITION then 1 else 0)"};
    }
  }
  const Before last = before(text, begin, at);
  const bool plain = at >= text.size() || is_plain(byte_at(text, at));
  const std::string mend = plain ? "the form is: " + last.form : kPlain;
  if (places.of(at).line != places.of(last.end).line) {
    return {places.of(last.end), error.what + " before the end of the line", mend};
  }
  return {places.of(at < text.size() ? at : last.end), error.what + ", found " + found(text, at),
          mend};
}

Diagnostic no_statement(std::string_view text, std::size_t at, const Places& places) {
  const std::string_view word = word_at(text, at);
  const std::string guess = config::did_you_mean(word, statement_words());
  if (text[at] == '=' && text.substr(at, 2) != "==") {
    return {places.of(at), "\"=\" where an expression has ended",
            "a definition begins with its word: let NAME = EXPRESSION"};
  }
  const std::string what = found(text, at) + " where a statement begins or an expression goes on";
  if (!is_plain(byte_at(text, at))) return {places.of(at), what, kPlain};
  return {places.of(at), what, guess + "statements begin with param, let, state, next, out, ..."};
}

}  // namespace

bool is_keyword(std::string_view word) {
  return form_of(word) != nullptr ||
         std::any_of(std::begin(kOther), std::end(kOther), [&](auto k) { return word == k; });
}

void refuse_word(std::string_view rest) {
  const std::string_view word = word_at(rest, 0);
  // A number after a number is not meant as a unit: the grammar reports what it expected.
  if (word.empty() || is_keyword(word) || (word[0] >= '0' && word[0] <= '9')) return;
  const std::string guess = config::did_you_mean(word, unit_symbols());
  throw SyntaxError{rest.data(), "unknown unit \"" + std::string(word.substr(0, 40)) + "\"",
                    guess +
                        "units are products of Nm, N, m, rad, deg, turn, s, Hz, kg, ... with "
                        "prefixes; between a number and a name stands *"};
}

void check_depth(int depth, const char* at) {
  if (depth <= kMostDepth) return;
  throw SyntaxError{at, "an expression of more than 500 operations",
                    "give parts of it names with let"};
}

void check_fraction(const Expression& e, const char* at, const char* begin) {
  const Expression &a = *e.arguments[0], &b = *e.arguments[1];
  const auto is_number = [](const Expression& x) { return x.kind == Expression::Kind::number; };
  if (e.name != "/" || !is_number(a) || !is_number(b)) return;
  if (!a.unit_text.empty() || b.unit_text.empty()) return;
  if (std::find(at, begin + b.offset, '(') != begin + b.offset) return;
  throw SyntaxError{at, "a unit that would belong to the lower number alone",
                    fmt::format("write {} {} / {}, or brackets around what is below", a.value,
                                b.unit_text, b.value)};
}

std::vector<Statement> parse_statements(std::string_view text, Diagnostics& diagnostics) {
  const Places places(text);
  std::vector<Statement> statements;
  if (text.size() > kMostText) {
    diagnostics.add({}, "a file of more than 64 KiB", "a law is a page of text");
    return statements;
  }
  check_nesting(text, places, diagnostics);
  if (!diagnostics.empty()) return statements;
  std::size_t at = skip(text, 0);
  while (at < text.size()) {
    Statement statement;
    try {
      const char* const end = parse_statement(text, text.data() + at, statement);
      if (end != nullptr) {
        statements.push_back(std::move(statement));
        at = static_cast<std::size_t>(end - text.data());
        continue;
      }
      // After an error, the end of a loop may remain unmatched.
      if (text[at] != '}' || diagnostics.empty()) {
        const Diagnostic d = no_statement(text, at, places);
        diagnostics.add(d.place, d.what, d.mend);
      }
      at = next_statement(text, at);
    } catch (const SyntaxError& error) {
      const Diagnostic d = explained(text, at, error, places);
      diagnostics.add(d.place, d.what, d.mend);
      at = next_statement(text, std::max(at, static_cast<std::size_t>(error.at - text.data())));
    }
  }
  return statements;
}

}  // namespace feltgate::law
