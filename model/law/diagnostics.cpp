// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace feltgate::law {

namespace {

constexpr std::size_t kMost = 20;  ///< further errors do not help a user who fixes the first

bool before(const Diagnostic& a, const Diagnostic& b) {
  return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
}

std::string joined(const std::string& file, const std::vector<Diagnostic>& all) {
  std::string text;
  for (const Diagnostic& one : all) text += (text.empty() ? "" : "\n") + message(file, one);
  return text;
}

}  // namespace

std::string message(const std::string& file, const Diagnostic& diagnostic) {
  const Place& p = diagnostic.place;
  const std::string where = p.line > 0 ? fmt::format(":{}:{}", p.line, p.column) : "";
  std::string text = fmt::format("{}{}: {}; {}", file, where, diagnostic.what, diagnostic.mend);
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f) c = '?';
  }
  return text;
}

LawError::LawError(const std::string& file, std::vector<Diagnostic> all)
    : std::runtime_error(joined(file, all)), diagnostics_(std::move(all)) {}

void Diagnostics::add(Place place, std::string what, std::string mend) {
  const bool known = std::any_of(all_.begin(), all_.end(), [&](const Diagnostic& d) {
    return d.place.line == place.line && d.place.column == place.column;
  });
  if (known || all_.size() >= kMost) return;
  all_.push_back({place, std::move(what), std::move(mend)});
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::vector<Diagnostic> all = all_;
  std::stable_sort(all.begin(), all.end(), before);
  return all;
}

Places::Places(std::string_view text) : line_begins_{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_begins_.push_back(i + 1);
  }
}

Place Places::of(std::size_t offset) const {
  const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
  const auto line = after - line_begins_.begin();
  return {static_cast<int>(line), static_cast<int>(offset - *(after - 1)) + 1};
}

}  // namespace feltgate::law
