// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Value change dumps: timescale, scopes and variables. Documentation: docs/traces.md
#include <map>

#include "sim/traces/error.hpp"
#include "sim/traces/vcd.hpp"

namespace feltgate::traces {
namespace {

constexpr std::size_t kMostVariables = 1'000'000;
constexpr std::size_t kMostScopes = 1000;

}  // namespace

void VcdCapture::read_header() {
  std::vector<std::string> scopes;
  bool scaled = false;
  for (;;) {
    need_token("its header");
    if (token_ == "$timescale") {
      read_timescale();
      scaled = true;
    } else if (token_ == "$scope") {
      need_token("$scope");
      need_token("$scope");
      if (scopes.size() == kMostScopes) in_.fail("more than 1000 scopes", "give a VCD file");
      scopes.push_back(token_);
      skip_to_end();
    } else if (token_ == "$upscope") {
      if (!scopes.empty()) scopes.pop_back();
      skip_to_end();
    } else if (token_ == "$var") {
      read_variable(scopes);
    } else if (token_ == "$enddefinitions") {
      skip_to_end();
      break;
    } else if (token_.front() == '$') {
      skip_to_end();
    } else {
      in_.fail(shown(token_) + " stands outside every command of the header", "give a VCD file");
    }
  }
  if (!scaled) in_.fail("the header has no $timescale", "add one, such as $timescale 1 us $end");
  if (names_.empty()) in_.fail("no variable has one bit", "record A and B as single wires");
  shorten_names();
}

void VcdCapture::read_timescale() {
  std::string text;
  for (need_token("$timescale"); token_ != "$end"; need_token("$timescale")) text += token_;
  std::size_t digits = 0;
  while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9') ++digits;
  const std::string number = text.substr(0, digits);
  static const std::map<std::string, std::int64_t> kUnits = {{"s", 1},
                                                             {"ms", 1'000},
                                                             {"us", 1'000'000},
                                                             {"ns", 1'000'000'000},
                                                             {"ps", 1'000'000'000'000},
                                                             {"fs", 1'000'000'000'000'000}};
  const auto unit = kUnits.find(text.substr(digits));
  if ((number != "1" && number != "10" && number != "100") || unit == kUnits.end()) {
    in_.fail(shown(text) + " is not a timescale", "give 1, 10 or 100 of s, ms, us, ns, ps, fs");
  }
  base_ = {std::stoll(number), unit->second};
}

void VcdCapture::read_variable(const std::vector<std::string>& scopes) {
  need_token("$var");
  need_token("$var");
  const std::string size = token_;
  need_token("$var");
  const std::string id = token_;
  need_token("$var");
  const std::string name = token_;
  skip_to_end();
  if (bits_of_.size() == kMostVariables) in_.fail("more than 1000000 variables", "dump fewer");
  bits_of_.emplace(id, 0U);
  if (size != "1") return;
  std::string path;
  for (const std::string& scope : scopes) path += scope + ".";
  names_.push_back(path + name);
  ids_.push_back(id);
}

// A name that is the only one of its kind goes without its scopes.
void VcdCapture::shorten_names() {
  std::map<std::string, int> uses;
  const auto leaf = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  for (const std::string& name : names_) ++uses[leaf(name)];
  for (std::string& name : names_) {
    if (uses[leaf(name)] == 1) name = leaf(name);
  }
}

}  // namespace feltgate::traces
