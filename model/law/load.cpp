// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes the register writes that load a law. Documentation: docs/laws.md
#include "law/load.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "feltgate/generated/engine.hpp"
#include "feltgate/nearest.hpp"

namespace feltgate::law {

namespace {

using H = EngineMap::H;

/// Writes words that are longer than a register: the upper bits first, only when they change.
template <class Words>
void add_long_words(const Words& words, int base, bool zeros, std::vector<HostWord>* writes) {
  std::uint32_t high = 0;
  bool known = zeros;
  for (std::size_t n = 0; n < words.size(); ++n) {
    if (zeros && words[n] == 0) continue;
    const auto upper = static_cast<std::uint32_t>(words[n] >> 32);
    if (!known || upper != high) writes->push_back({H::high, upper});
    known = true;
    high = upper;
    writes->push_back({base + static_cast<int>(n), static_cast<std::uint32_t>(words[n])});
  }
}

std::vector<HostWord> load(const Image& image, bool zeros) {
  std::vector<HostWord> writes{{H::run, 0}};
  add_long_words(image.program, H::program, zeros, &writes);
  // The register of the upper bits still holds those of the last program word.
  writes.push_back({H::high, 0});
  add_long_words(image.table, H::table, zeros, &writes);
  const auto data = [&](int word) {
    const std::int32_t value = image.data[static_cast<std::size_t>(word)];
    if (!zeros || value != 0) {
      writes.push_back({H::data + word, static_cast<std::uint32_t>(value)});
    }
  };
  for (int word = Image::lower_base; word < EngineMap::data_words; ++word) data(word);
  unsigned run = 0;
  for (std::size_t t = 0; t < image.threads.size(); ++t) {
    const ImageThread& thread = image.threads[t];
    run |= static_cast<unsigned>(thread.used) << t;
    if (thread.used) {
      writes.push_back(
          {H::divider0 + static_cast<int>(t), static_cast<std::uint32_t>(thread.divider)});
    }
  }
  writes.push_back({H::line_base, static_cast<std::uint32_t>(image.line_base)});
  writes.push_back({H::max_age, static_cast<std::uint32_t>(image.max_age_ticks)});
  if (!zeros || image.mailbox_first != EngineMap::parameter_words) {
    writes.push_back({H::mailbox_first, static_cast<std::uint32_t>(image.mailbox_first)});
    writes.push_back({H::mailbox_age, static_cast<std::uint32_t>(image.mailbox_age)});
  }
  writes.push_back({H::crc, crc(image)});
  for (int word = 0; word < EngineMap::parameter_words; ++word) data(Image::parameter_base + word);
  writes.push_back({H::commit, 1});
  writes.push_back({H::run, run});
  return writes;
}

}  // namespace

std::vector<HostWord> load(const Image& image) { return load(image, false); }
std::vector<HostWord> load_into_zeros(const Image& image) { return load(image, true); }

EngineMemory memory(const Image& image) {
  EngineMemory m;
  m.program = image.program;
  m.data = image.data;
  m.table = image.table;
  m.line_base = image.line_base;
  return m;
}

EngineReset reset_words(const Image& image) {
  EngineReset r;
  unsigned* dividers[] = {&r.divider0, &r.divider1, &r.divider2, &r.divider3};
  for (std::size_t t = 0; t < image.threads.size(); ++t) {
    if (!image.threads[t].used) continue;
    r.run |= 1U << t;
    *dividers[t] = static_cast<unsigned>(image.threads[t].divider);
  }
  r.line_base = static_cast<unsigned>(image.line_base);
  r.max_age = static_cast<unsigned>(image.max_age_ticks);
  r.mailbox_first = static_cast<unsigned>(image.mailbox_first);
  r.mailbox_age = static_cast<unsigned>(image.mailbox_age);
  r.crc = crc(image);
  return r;
}

LoadedParameters::LoadedParameters(const Image& image) : image_(image) {
  for (const ImageWord& w : image.words) {
    if (w.formula.empty()) si_[w.name] = w.initial * w.scale;
  }
}

void LoadedParameters::take(const std::vector<std::uint32_t>& words) {
  for (const ImageWord& w : image_.words) {
    const auto word = static_cast<std::int32_t>(words.at(static_cast<std::size_t>(w.word)));
    if (w.formula.empty()) si_[w.name] = word * w.scale;
  }
}

const ImageWord* LoadedParameters::find(const std::string& name) const {
  for (const ImageWord& w : image_.words) {
    if (w.formula.empty() && w.name == name) return &w;
  }
  return nullptr;
}

double LoadedParameters::value(const std::string& name) const {
  const ImageWord* word = find(name);
  return word == nullptr ? 0 : si_.at(name) / word->to_si;
}

double LoadedParameters::rounded_si(const std::string& name, double value) const {
  const ImageWord* word = find(name);
  if (word == nullptr) {
    std::vector<std::string> names;
    for (const auto& [known, unused] : si_) names.push_back(known);
    const std::string all = fmt::format("{}", fmt::join(names, ", "));
    throw std::invalid_argument(fmt::format("law {} has no parameter \"{}\"; {}it has {}",
                                            image_.name, name, config::did_you_mean(name, names),
                                            names.empty() ? "none" : all));
  }
  const double raw = value * word->to_si / word->scale;
  if (!(std::nearbyint(raw) >= word->lower && std::nearbyint(raw) <= word->upper)) {
    const double a = word->lower * word->scale / word->to_si;
    const double b = word->upper * word->scale / word->to_si;
    throw std::invalid_argument(
        fmt::format("{} = {:g}{}{} is out of its range; law {} takes {:g} to {:g}", name, value,
                    word->unit.empty() ? "" : " ", word->unit, image_.name, std::min(a, b) + 0.0,
                    std::max(a, b) + 0.0));
  }
  return std::nearbyint(raw) * word->scale;
}

void LoadedParameters::check(const std::string& name, double value) const {
  (void)rounded_si(name, value);
}

/// All values in SI, after `values` replaced some of them.
std::map<std::string, double> LoadedParameters::with(
    const std::map<std::string, double>& values) const {
  std::map<std::string, double> all = si_;
  for (const auto& [name, value] : values) all[name] = rounded_si(name, value);
  const std::string broken =
      broken_requirement(image_, [&](const std::string& name) { return all.at(name); });
  if (broken.empty()) return all;
  throw std::invalid_argument(
      fmt::format("law {} requires {}; set both to values that fit", image_.name, broken));
}

void LoadedParameters::check(const std::map<std::string, double>& values) const {
  (void)with(values);
}

double LoadedParameters::within(const std::string& name, double value) const {
  const ImageWord* word = find(name);
  if (word == nullptr) return value;
  const double unit = word->scale / word->to_si;
  const double a = word->lower * unit, b = word->upper * unit;
  return std::clamp(value, std::min(a, b), std::max(a, b));
}

std::vector<HostWord> LoadedParameters::set(const std::string& name, double value) {
  return set(std::map<std::string, double>{{name, value}});
}

std::vector<HostWord> LoadedParameters::set(const std::map<std::string, double>& values) {
  si_ = with(values);
  std::vector<double> all;
  for (const ImageWord& w : image_.words) {
    if (w.formula.empty()) all.push_back(si_.at(w.name));
  }
  const std::vector<std::int32_t> words = parameter_words(image_, all);
  std::vector<HostWord> writes;
  for (const ImageWord& w : image_.words) {
    writes.push_back({H::data + Image::parameter_base + w.word,
                      static_cast<std::uint32_t>(words[static_cast<std::size_t>(w.word)])});
  }
  writes.push_back({H::commit, 1});
  return writes;
}

}  // namespace feltgate::law
