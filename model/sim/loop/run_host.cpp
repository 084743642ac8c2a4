// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Register writes of a run's host. Documentation: docs/architecture.md
#include "sim/loop/run_host.hpp"

#include <stdexcept>

namespace feltgate {

void RunHost::load(SceneLaw& law) {
  law_ = &law;
  law_scene_ = design().scene_number("law");
  for (const auto& [address, data] : law.load()) write({0, address, data, 0});
}

void RunHost::set_parameters(const std::map<std::string, double>& values) {
  std::map<std::string, double> of_law;
  for (const auto& [name, value] : values) {
    if (law_ != nullptr && law_->has(name)) {
      of_law[name] = value;
      continue;
    }
    const ParameterInfo* info = design().find(name);
    if (info == nullptr) throw std::invalid_argument(design().unknown(name));
    write({0, info->address, static_cast<std::uint32_t>(quantise_parameter(*info, value)), value});
  }
  if (!of_law.empty()) feed_law(of_law);
}

void RunHost::feed_law(const std::map<std::string, double>& values) {
  for (const auto& [address, data] : law_->set(values)) write({0, address, data, 0});
}

void RunHost::skip_self_test() {
  if (design().find("self_test_pulse")->raw != 0) set_parameter("self_test_pulse", 0);
}

void RunHost::set_control(int scene, int mode, bool arm) {
  write({0, design().control_address, control_word(design(), scene, mode, arm), 0});
}

void RunHost::command(std::uint32_t bits) { write({0, design().command_address, bits, 0}); }

void RunHost::write(const HostWrite& w) {
  const int copies = w.address >= axes_engine ? 1 : backend_->axes();
  for (int n = 0; n < copies; ++n) {
    pending_.emplace_back(n, w);
    backend_->write(n * axes_stride + w.address, w.data);
  }
}

}  // namespace feltgate
