// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/user_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "law/host_machine.hpp"
#include "law/listing.hpp"
#include "law/measure.hpp"
#include "sim/law_loop/scene_law.hpp"

namespace feltgate::page {

namespace {

law::Compiled compiled(const std::string& text, const DesignInfo& design) {
  law::Compiled c = law::compile_text(text, "law", law::target_of(design));
  for (const law::Output& o : c.law.outputs) {
    if (o.axis == 0) continue;
    throw law::LawError("law", {{o.place, fmt::format("a torque for axis {}", o.axis),
                                 "the page has one lever: write out torque = ..."}});
  }
  return c;
}

}  // namespace

UserLaw::UserLaw(const std::string& text, const DesignInfo& design)
    : design_(design),
      law_(compiled(text, design)),
      values_(law_.image),
      machine_(law::memory(law_.image)) {}

std::string UserLaw::report(int runs) const {
  law::Measured m = law::measure(law_, 1, runs);
  m.free = law::measure_free(law_, 1, runs);
  return law::report(law_, m);
}

void UserLaw::set(const std::string& name, double value) {
  law::write(machine_, values_.set(name, value));
}

std::vector<LawParameter> UserLaw::parameters() const {
  std::vector<LawParameter> all;
  for (const law::Parameter& p : law_.law.parameters) {
    const law::ImageWord* w = p.derived < 0 ? values_.find(p.name) : nullptr;
    if (w == nullptr) continue;
    const double step = w->scale / w->to_si;
    const double a = w->lower * step, b = w->upper * step;
    all.push_back({p.name, p.unit_text, p.comment, values_.value(p.name), std::min(a, b),
                   std::max(a, b), p.whole ? 1 : std::fabs(step)});
  }
  return all;
}

std::unique_ptr<SceneLaw> UserLaw::scene() const { return make_scene_law(law_, design_); }

std::vector<double> UserLaw::curve(int points) const {
  law::Machine machine = machine_;
  machine.enter();
  const int turn = static_cast<int>(std::lround(2 * law::pi / design_.count_rad));
  const std::int32_t top = (1 << (design_.torque.width() - 1)) - 1;
  std::vector<double> torques;
  const auto at = [&](int k) {
    law::MachineInputs inputs{};
    inputs[0] = turn * k / (points - 1) - turn / 2;
    std::int32_t word = machine.run(0, inputs).outputs[0];
    for (int run = 1; run < 16; ++run) {
      const std::int32_t before = std::exchange(word, machine.run(0, inputs).outputs[0]);
      if (word == before) break;
    }
    torques.push_back(std::ldexp(std::clamp(word, -top - 1, top), -design_.torque.fraction));
  };
  for (int k = 0; k < points; ++k) at(k);
  for (int k = points; k-- > 0;) at(k);
  return torques;
}

}  // namespace feltgate::page
