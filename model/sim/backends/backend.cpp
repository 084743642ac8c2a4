// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registry of the built-in back-ends. Documentation: docs/architecture.md
#include "sim/backends/backend.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "sim/backends/make_device.hpp"
#include "sim/reference/real_chain.hpp"

namespace feltgate {

namespace {

std::vector<DesignMakers>& designs() {
  static std::vector<DesignMakers> list;
  return list;
}

RtlMaker rtl_backends = nullptr;  // set before main() if the Verilated cores are linked

const DesignMakers* find(const std::string& design) {
  for (const DesignMakers& d : designs()) {
    if (d.name == design) return &d;
  }
  return nullptr;
}

std::function<void(const DesignInfo&)> check_of_designs;

const DesignMakers& makers_of(const std::string& design) {
  if (const DesignMakers* d = find(design)) {
    check_design(d->info());
    return *d;
  }
  throw std::invalid_argument(
      fmt::format("design \"{0}\" is not built in; choose one of {1}, a preset (fast, balanced, "
                  "exact) by way of ./feltgate, which builds it, or add rtl/designs/{0}.toml and "
                  "run `feltgate generate`",
                  design, fmt::join(design_names(), ", ")));
}

}  // namespace

void AnyBackend::break_encoder(const std::string& defect) {
  throw std::invalid_argument(
      fmt::format("design {} has no absolute encoder with a defect \"{}\"", design().name, defect));
}

int Backend::on_time(std::size_t) const {
  throw std::invalid_argument(fmt::format(
      "back-end {} does not show on-times; switch the bridge, or take twin or lockstep", name()));
}

void check_designs(std::function<void(const DesignInfo&)> check) {
  check_of_designs = std::move(check);
}

void check_design(const DesignInfo& design) {
  static std::set<std::string> good;
  if (check_of_designs == nullptr || good.count(design.name) > 0) return;
  check_of_designs(design);
  good.insert(design.name);
}

void add_design(const DesignMakers& design) {
  for (DesignMakers& d : designs()) {
    if (d.name != design.name) continue;
    d = design;
    return;
  }
  designs().push_back(design);
}

std::vector<std::string> design_names() {
  std::vector<std::string> names;
  for (const DesignMakers& d : designs()) {
    if (!d.preset) names.push_back(d.name);
  }
  return names;
}

void provide_rtl_backends(RtlMaker maker) { rtl_backends = maker; }

std::unique_ptr<Backend> make_rtl_backend(const std::string& design, const std::string& kind) {
  if (kind != "rtl" && kind != "lockstep") {
    throw std::invalid_argument("engine \"" + kind + "\" is unknown; choose rtl, twin or lockstep");
  }
  if (rtl_backends != nullptr) return rtl_backends(design, kind);
  throw std::invalid_argument(
      fmt::format("engine \"{}\" of design {}: the RTL is not built into this program; choose the "
                  "engine twin, or build with -DFELTGATE_RTL=ON, which needs Verilator, and link "
                  "feltgate_rtl",
                  kind, design));
}

std::unique_ptr<Backend> make_backend(const std::string& design, const std::string& kind) {
  return makers_of(design).engine(kind);
}

DesignInfo design_named(const std::string& design) { return makers_of(design).info(); }

std::unique_ptr<Device> make_device(const std::string& design) {
  const DesignMakers& d = makers_of(design);
  if (d.device != nullptr) return d.device();
  throw std::invalid_argument(
      fmt::format("design {} has no device here; choose one of {}, or use "
                  "TwinDevice of its generated header",
                  design, fmt::join(design_names(), ", ")));
}

std::unique_ptr<RealChain> make_real_chain(const std::string& design, const std::string& kind) {
  return makers_of(design).chain(kind);
}

void AnyBackend::trace(const std::string&, Clock, Clock) {
  throw std::invalid_argument(
      fmt::format("--fst: the back-end {} has no waveform; choose --engine rtl or all", name()));
}

std::uint32_t control_word(const DesignInfo& design, int scene, int mode, bool arm) {
  const ControlBits& bits = design.control;
  return design.control_reset | 1u << bits.host | (arm ? 1u : 0u) << bits.arm |
         static_cast<std::uint32_t>(scene) << bits.scene |
         static_cast<std::uint32_t>(mode) << bits.mode;
}

}  // namespace feltgate
