// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Names, units and words of a board's quantities. Documentation: docs/host.md
#include "host/host_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "feltgate/axes_ports.hpp"
#include "feltgate/nearest.hpp"
#include "law/units.hpp"

namespace feltgate::host {

namespace {

/// A word of the snapshot as a signal: unit, format, and the step if it has no format.
struct Signal {
  const char* name;
  const char* unit;
  Format format;
};

int mode_word(const std::vector<design::Snapshot>& in_order, const std::string& name) {
  for (std::size_t k = 0; k < in_order.size(); ++k) {
    if (in_order[k].name == name) return static_cast<int>(k);
  }
  return -1;
}

std::vector<design::Snapshot> by_slot(std::vector<design::Snapshot> words) {
  std::sort(words.begin(), words.end(),
            [](const auto& a, const auto& b) { return a.slot < b.slot; });
  return words;
}

}  // namespace

std::int64_t Quantity::raw_of(std::uint32_t word_there) const {
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  const std::uint64_t bits = (word_there >> bit) & mask;
  const bool negative = is_signed && ((bits >> (width - 1)) & 1u) != 0;
  return static_cast<std::int64_t>(bits) - (negative ? std::int64_t{1} << width : 0);
}

double Quantity::value_of(std::uint32_t word_there) const {
  return static_cast<double>(raw_of(word_there)) * scale;
}

double Quantity::low() const { return is_signed ? -std::ldexp(scale, width - 1) : 0.0; }

double Quantity::high() const {
  return (std::ldexp(1.0, is_signed ? width - 1 : width) - 1) * scale;
}

std::string Quantity::text_of(std::uint32_t word_there) const {
  if (unit.empty() && width > 16) return fmt::format("0x{:08x}", word_there);
  return fmt::format("{:.9g}{}{}", value_of(word_there), unit.empty() || unit == "1" ? "" : " ",
                     unit == "1" ? "" : unit);
}

Quantities::Quantities(const design::Elaborated& design, int axes)
    : axes_(axes),
      count_rad_(design.design.count_rad()),
      tick_hz_(static_cast<double>(design.design.tick_hz)) {
  add_parameters(design);
  add_snapshot(design);
  add_fields(design);
  add_axes();
  add_link(design);
}

void Quantities::add_parameters(const design::Elaborated& design) {
  for (const design::Word& w : design.words) {
    Quantity q;
    q.kind = Quantity::Kind::parameter;
    q.name = w.parameter.name;
    q.unit = w.parameter.unit;
    q.doc = w.parameter.doc;
    q.address = w.parameter.address;
    q.width = std::min(w.format.width(), 32);
    q.is_signed = w.format.sign == 1;
    q.scale = std::ldexp(1.0, -w.format.fraction);
    q.writable = true;
    q.format = w.format;
    q.while_armed = w.parameter.while_armed;
    all_.push_back(q);
  }
}

void Quantities::add_snapshot(const design::Elaborated& design) {
  const Formats& f = design.formats;
  const Signal signals[] = {{"velocity", "rad/s", f.velocity}, {"tau_hat", "Nm", f.torque},
                            {"tau_ref", "Nm", f.torque},       {"current_ref", "A", f.current},
                            {"voltage", "V", f.voltage},       {"position", "count", {1, 31, 0}},
                            {"index", "count", {1, 31, 0}},    {"tick", "tick", {0, 32, 0}}};
  const std::vector<design::Snapshot> words = by_slot(design.registers.snapshots);
  words_ = static_cast<int>(words.size());
  for (const design::Snapshot& s : words) {
    Quantity q;
    q.kind = Quantity::Kind::snapshot;
    q.name = s.name;
    q.doc = s.doc;
    q.address = design::snapshot_base + s.slot;
    q.word = mode_word(words, s.name);
    for (const Signal& signal : signals) {
      if (s.name != signal.name) continue;
      q.unit = signal.unit;
      q.is_signed = signal.format.sign == 1;
      q.scale = std::ldexp(1.0, -signal.format.fraction);
    }
    if (s.name == "duty") {
      q.unit = "1";
      q.doc = "the voltage as a share of the supply, -1 to 1";
      q.is_signed = true;
      q.scale = 1.0 / design.design.pwm_period_clocks();
    }
    all_.push_back(q);
    // The same words again, in units for people.
    if (s.name == "position") {
      q.name = "angle";
      q.unit = "rad";
      q.doc = "the position as an angle";
      q.scale = count_rad_;
      all_.push_back(q);
    } else if (s.name == "tick") {
      q.name = "time";
      q.unit = "s";
      q.doc = "the tick counter as a time, since the reset";
      q.scale = 1.0 / tick_hz_;
      all_.push_back(q);
    }
  }
}

void Quantities::add_fields(const design::Elaborated& design) {
  const auto add = [&](const std::string& of, int address, int word, const design::Field& f) {
    Quantity q;
    q.kind = Quantity::Kind::field;
    q.name = of + "." + f.name;
    q.unit = "1";
    q.doc = f.doc;
    q.address = address;
    q.bit = f.bit;
    q.width = f.width;
    q.word = word;
    all_.push_back(q);
  };
  for (const design::Control& c : design.registers.controls) {
    if (c.name == "command") continue;  // it always reads 0
    for (const design::Field& f : c.fields) add(c.name, c.address, -1, f);
  }
  const std::vector<design::Snapshot> words = by_slot(design.registers.snapshots);
  for (const design::Snapshot& s : words) {
    for (const design::Field& f : s.fields) {
      add(s.name, design::snapshot_base + s.slot, mode_word(words, s.name), f);
    }
  }
}

std::string Quantities::suffix(int axis) { return axis == 0 ? "" : fmt::format(".{}", axis); }

void Quantities::add_axes() {
  const std::vector<Quantity> one = all_;
  for (int axis = 1; axis < axes_; ++axis) {
    for (Quantity q : one) {
      q.name += suffix(axis);
      q.address += axis * axes_stride;
      if (q.word >= 0) q.word += axis * words_;
      all_.push_back(q);
    }
  }
}

std::string Quantities::missing_axis(const std::string& name) const {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot + 1 == name.size()) return "";
  const std::string axis = name.substr(dot + 1);
  if (axis.find_first_not_of("0123456789") != std::string::npos) return "";
  if (look(name.substr(0, dot)) == nullptr) return "";
  return fmt::format("\"{}\": there is no axis {}; this board has {}", name, axis,
                     axes_ == 1 ? "axis 0 alone" : fmt::format("the axes 0 to {}", axes_ - 1));
}

void Quantities::add_link(const design::Elaborated& design) {
  for (const design::LinkWord& w : design.registers.link_words) {
    Quantity q;
    q.name = w.name;
    q.unit = w.name == "identity" || w.name == "design_crc" ? "" : "1";
    q.doc = w.doc;
    q.address = w.address;
    all_.push_back(q);
  }
}

const Quantity* Quantities::look(const std::string& asked) const {
  const bool first = asked.size() > 2 && asked.compare(asked.size() - 2, 2, ".0") == 0;
  const std::string name = first ? asked.substr(0, asked.size() - 2) : asked;
  for (const Quantity& q : all_) {
    if (q.name == name) return &q;
  }
  return nullptr;
}

const Quantity& Quantities::find(const std::string& name) const {
  if (const Quantity* q = look(name)) return *q;
  if (const std::string wrong = missing_axis(name); !wrong.empty()) {
    throw std::invalid_argument(wrong);
  }
  std::vector<std::string> names;
  for (const Quantity& q : all_) names.push_back(q.name);
  throw std::invalid_argument(
      fmt::format("\"{}\" is no value of this board; {}get --all lists them", name,
                  config::did_you_mean(name, names)));
}

const Quantity& Quantities::streamed(const std::string& name) const {
  const Quantity* q = look(name);
  if (q != nullptr && q->word >= 0) return *q;
  if (const std::string wrong = missing_axis(name); q == nullptr && !wrong.empty()) {
    throw std::invalid_argument(wrong);
  }
  std::vector<std::string> names;
  std::string list;
  for (const Quantity& each : all_) {
    if (each.word < 0) continue;
    names.push_back(each.name);
    if (each.kind == Quantity::Kind::snapshot) list += (list.empty() ? "" : ", ") + each.name;
  }
  throw std::invalid_argument(fmt::format("\"{}\" is no word of a tick; {}choose from {}", name,
                                          config::did_you_mean(name, names), list));
}

double Quantities::value_in(const Quantity& of, const std::string& text) const {
  try {
    return law::amount_in(text, of.unit, {count_rad_, 1 / tick_hz_});
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", of.name, error.what()));
  }
}

Setting Quantities::setting(const Quantity& of, double value) const {
  if (!of.writable) {
    throw std::invalid_argument(
        fmt::format("{} can only be read; get --all marks what can be set", of.name));
  }
  const double steps = std::round(value / of.scale);
  if (!(value >= of.low() && steps <= of.high() / of.scale)) {
    throw std::invalid_argument(fmt::format(
        "{} = {:g} {} does not fit its word [{},{},{}]; choose a value from {:g} to {:g} "
        "{} in steps of {:g}",
        of.name, value, of.unit, of.format.sign, of.format.integer, of.format.fraction, of.low(),
        of.high(), of.unit, of.scale));
  }
  Setting s;
  s.of = &of;
  s.asked = value;
  s.word = static_cast<std::uint32_t>(static_cast<std::int64_t>(steps) & 0xffffffff);
  return s;
}

Setting Quantities::setting(const std::string& text) const {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw std::invalid_argument(
        fmt::format("\"{}\" sets nothing; write NAME=VALUE, such as torque_limit=0.2", text));
  }
  const Quantity& of = find(text.substr(0, equals));
  if (!of.writable) return setting(of, 0);  // its error gives the reason
  return setting(of, value_in(of, text.substr(equals + 1)));
}

}  // namespace feltgate::host
