// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A fault as one line of JSON. Documentation: docs/testing.md
#include "campaigns/faults/faults.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "campaigns/faults/world.hpp"
#include "feltgate/generated/causes.hpp"
#include "feltgate/generated/lever.hpp"

namespace feltgate::faults {

namespace {

using Json = nlohmann::ordered_json;

double rounded(double v, double to) { return std::round(v / to) * to; }

void add(const Outcome& o, Json* j) {
  (*j)["class"] = name_of(o.is);
  if (!o.why.empty()) (*j)["why"] = o.why;
  Json flags = Json::array();
  for (unsigned n = 0; n < fault_names.size(); ++n) {
    if ((o.flagged >> n) & 1u) flags.push_back(fault_names[n]);
  }
  if (!flags.empty()) (*j)["flagged"] = flags;
  if (o.off_after >= 0) (*j)["off_after_us"] = o.off_after;
  (*j)["peak_nm"] = rounded(o.peak_nm, 1e-6);
  (*j)["integral_nm_s"] = rounded(o.integral_nm_s, 1e-9);
  (*j)["motor_peak_nm"] = rounded(o.motor_peak_nm, 1e-4);
}

}  // namespace

std::string line_of(const StateResult& r, const std::vector<StateBit>& bits,
                    const std::vector<std::string>& act_names) {
  Json j;
  if (r.fault.bits.empty()) {
    j["point"] = "pins";
    j["group"] = "brown-out";
    j["act"] = act_names[r.fault.act];
    j["tick"] = r.fault.tick;
    j["clock"] = r.fault.clock;
    j["reset_clocks"] = r.fault.reset_clocks;
    add(r.outcome, &j);
    return j.dump();
  }
  const StateBit& b = bits[r.fault.bits[0]];
  j["point"] = r.fault.bits.size() > 1 ? "two bits" : "state";
  j["register"] = b.name;
  j["bit"] = b.bit;
  if (b.kind == StateBit::Kind::line) j["address"] = b.at;
  if (r.fault.bits.size() > 1) {
    const StateBit& c = bits[r.fault.bits[1]];
    j["register_2"] = c.name;
    j["bit_2"] = c.bit;
    if (c.kind == StateBit::Kind::line) j["address_2"] = c.at;
  }
  j["group"] = b.group;
  j["safety"] = b.safety;
  j["act"] = act_names[r.fault.act];
  j["tick"] = r.fault.tick;
  j["clock"] = r.fault.clock;
  add(r.outcome, &j);
  return j.dump();
}

std::string line_of(const PinResult& r) {
  Json j;
  const PinKind& kind = pin_kinds(r.design)[r.kind];
  if (r.design != Lever::name) j["design"] = r.design;
  j["point"] = kind.point;
  j["group"] = kind.name;
  j["seed"] = r.seed;
  j["what"] = r.what;
  j["must_flag"] = kind.promise == Promise::flagged;
  if (kind.promise == Promise::unseen) j["unseen"] = true;
  if (kind.promise == Promise::refused) j["must_refuse"] = true;
  add(r.outcome, &j);
  j["count_changed"] = r.outcome.count_changed;
  j["travel_rad"] = rounded(r.outcome.travel_rad, 1e-5);
  return j.dump();
}

CaseLine read_case(const std::string& line) {
  const Json j = Json::parse(line);
  CaseLine c;
  c.expected = j.at("class");
  if (j.contains("seed")) {
    c.pins = true;
    c.seed = j.at("seed");
    c.design = j.value("design", Lever::name);
    const auto& kinds = pin_kinds(c.design);
    for (; c.kind < kinds.size() && j.at("group") != kinds[c.kind].name; ++c.kind) {
    }
    if (c.kind == kinds.size())
      throw std::invalid_argument("no kind of fault is called " + j.at("group").dump());
    return c;
  }
  const auto all = acts();
  for (; c.state.act < all.size() && j.at("act") != all[c.state.act].name; ++c.state.act) {
  }
  if (c.state.act == all.size())
    throw std::invalid_argument("no act is called " + j.at("act").dump());
  c.state.tick = j.at("tick");
  c.state.clock = j.at("clock");
  if (j.contains("reset_clocks")) {
    c.state.reset_clocks = j.at("reset_clocks");
    return c;
  }
  static const auto bits = state_bits();
  const auto find = [&](const std::string& more) {
    const std::string name = j.at("register" + more);
    const int bit = j.at("bit" + more);
    for (std::size_t n = 0; n < bits.size(); ++n) {
      if (bits[n].name != name || bits[n].bit != bit) continue;
      if (bits[n].kind == StateBit::Kind::line && bits[n].at != j.at("address" + more)) continue;
      c.state.bits.push_back(n);
      return;
    }
    throw std::invalid_argument(fmt::format("no bit {} of a register {}", bit, name));
  };
  find("");
  if (j.contains("register_2")) find("_2");
  return c;
}

}  // namespace feltgate::faults
