// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registry of the built-in back-ends. Documentation: docs/architecture.md
#include "sim/backends/backend.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "sim/backends/make_device.hpp"
#include "sim/backends/twin_backend.hpp"
#include "sim/reference/chain.hpp"

namespace feltgate {

namespace {

DesignSource& source() {
  static DesignSource designs;
  return designs;
}

struct Rtl {
  std::uint32_t design_crc;
  RtlMaker maker;
};
std::map<std::string, Rtl>& rtl() {
  static std::map<std::string, Rtl> cores;
  return cores;
}

template <class Core>
std::unique_ptr<Backend> twin(const DesignInfo& design) {
  return std::make_unique<TwinBackend<Core>>(design);
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

void set_design_source(DesignSource designs) { source() = std::move(designs); }

std::vector<std::string> design_names() { return source().names(); }

const DesignInfo& design_named(const std::string& design) {
  static std::map<std::string, DesignInfo> read;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto at = read.find(design);
  if (at != read.end()) return at->second;
  return read.emplace(design, source().named(design)).first->second;
}

bool add_rtl(const std::string& design, std::uint32_t design_crc, RtlMaker maker) {
  rtl()[design] = {design_crc, maker};
  return true;
}

void require_rtl_of(const DesignInfo& design, std::uint32_t design_crc) {
  if (design.design_crc == design_crc) return;
  throw std::invalid_argument(fmt::format(
      "design {0}: its RTL in this program is of another design of this name; run "
      "./feltgate generate, then this command by way of ./feltgate, which builds it anew",
      design.name));
}

std::unique_ptr<Backend> make_backend(const std::string& name, const std::string& kind) {
  const DesignInfo& design = design_named(name);
  if (design.axes != 1) {
    throw std::invalid_argument(
        fmt::format("design {} has {} axes; name a scene of its device", name, design.axes));
  }
  if (kind == "twin") return design.engine ? twin<LawCore>(design) : twin<FeltgateCore>(design);
  if (kind != "rtl" && kind != "lockstep") {
    throw std::invalid_argument("engine \"" + kind + "\" is unknown; choose rtl, twin or lockstep");
  }
  const auto core = rtl().find(design.name);
  if (core == rtl().end()) {
    throw std::invalid_argument(
        fmt::format("engine \"{}\" of design {}: its RTL is not in this program; choose the engine "
                    "twin, or put its file into rtl/designs and start ./feltgate, which builds it",
                    kind, name));
  }
  require_rtl_of(design, core->second.design_crc);
  return core->second.maker(design, kind == "lockstep");
}

std::unique_ptr<Device> make_device(const std::string& name) {
  const DesignInfo& design = design_named(name);
  if (design.axes == 1 && !design.engine) return std::make_unique<TwinDevice>(design);
  throw std::invalid_argument(fmt::format(
      "design {} has an engine of laws, and no device of this kind; choose another", name));
}

std::unique_ptr<RealChain> make_real_chain(const std::string& design, const std::string& kind) {
  return make_chain(design_named(design), kind);
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
