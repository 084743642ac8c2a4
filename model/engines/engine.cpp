// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registry of the engines that were built in. Documentation: docs/architecture.md
#include "engines/engine.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <stdexcept>

#include "engines/make_device.hpp"
#include "reference/real_chain.hpp"

namespace feltgate {

#define FELTGATE_DESIGN(name)                     \
  DesignInfo make_##name##_info();                \
  std::unique_ptr<Engine> make_##name##_twin();   \
  std::unique_ptr<Device> make_##name##_device(); \
  std::unique_ptr<RealChain> make_##name##_chain(const std::string&);
#include "designs.inc"
#undef FELTGATE_DESIGN

namespace {

std::vector<DesignMakers>& further_designs() {
  static std::vector<DesignMakers> list;
  return list;
}

const DesignMakers* further(const std::string& design) {
  for (const DesignMakers& d : further_designs()) {
    if (d.name == design) return &d;
  }
  return nullptr;
}

}  // namespace

void add_design(const DesignMakers& design) {
  if (further(design.name) == nullptr) further_designs().push_back(design);
}

std::vector<std::string> design_names() {
  return {
#define FELTGATE_DESIGN(name) #name,
#include "designs.inc"
#undef FELTGATE_DESIGN
  };
}

namespace {

RtlMaker rtl_engines = nullptr;  // set before main() where the Verilated cores are linked

[[noreturn]] void unknown_design(const std::string& design) {
  throw std::invalid_argument(
      fmt::format("design \"{0}\" is not built in; choose one of {1}, a preset (fast, balanced, "
                  "exact) by way of ./feltgate, which builds it, or add rtl/designs/{0}.toml and "
                  "run `feltgate generate`",
                  design, fmt::join(design_names(), ", ")));
}

[[noreturn]] void unknown_engine(const std::string& kind) {
  throw std::invalid_argument("engine \"" + kind + "\" is unknown; choose rtl, twin or lockstep");
}

std::unique_ptr<Engine> make_rtl(const std::string& design, const std::string& kind) {
  if (rtl_engines != nullptr) return rtl_engines(design, kind);
  throw std::invalid_argument(
      fmt::format("engine \"{}\" of design {}: the RTL is not built into this program; choose the "
                  "engine twin, or build with -DFELTGATE_RTL=ON, which needs Verilator, and link "
                  "feltgate_rtl",
                  kind, design));
}

}  // namespace

void provide_rtl_engines(RtlMaker maker) { rtl_engines = maker; }

std::unique_ptr<Engine> make_engine(const std::string& design, const std::string& kind) {
  const bool rtl = kind == "rtl" || kind == "lockstep";
  if (const DesignMakers* d = further(design)) return d->engine(kind);
#define FELTGATE_DESIGN(name)                        \
  if (design == #name) {                             \
    if (rtl) return make_rtl(design, kind);          \
    if (kind == "twin") return make_##name##_twin(); \
    unknown_engine(kind);                            \
  }
#include "designs.inc"
#undef FELTGATE_DESIGN
  unknown_design(design);
}

DesignInfo design_named(const std::string& design) {
  if (const DesignMakers* d = further(design)) return d->info();
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_info();
#include "designs.inc"
#undef FELTGATE_DESIGN
  unknown_design(design);
}

std::unique_ptr<Device> make_device(const std::string& design) {
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_device();
#include "designs.inc"
#undef FELTGATE_DESIGN
  unknown_design(design);
}

std::unique_ptr<RealChain> make_real_chain(const std::string& design, const std::string& kind) {
  if (const DesignMakers* d = further(design)) return d->chain(kind);
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_chain(kind);
#include "designs.inc"
#undef FELTGATE_DESIGN
  unknown_design(design);
}

void Engine::trace(const std::string&, Clock, Clock) {
  throw std::invalid_argument(
      fmt::format("--fst: the engine {} has no waveform; choose --engine rtl or all", name()));
}

std::int64_t quantise_parameter(const ParameterInfo& info, double value) {
  if (const auto raw = quantised(info, value)) return *raw;
  const ValueRange range = range_of(info);
  throw std::invalid_argument(
      fmt::format("{} = {} {} does not fit its register; choose a value from {} to below {}",
                  info.name, value, info.unit, range.low, range.high + range.step));
}

}  // namespace feltgate
