// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The words of the bowed string under a bow that a test leads, at any rate: what the engine
// computes, bit for bit. Documentation: docs/devices/bowed_string.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "feltgate/largest.hpp"
#include "law/compile.hpp"
#include "law/engine/machine.hpp"
#include "law/host_machine.hpp"
#include "law/load.hpp"
#include "law/read_law.hpp"

namespace feltgate {

/// rtl/laws/bowed_string.law in the interpreter of the engine's words.
class BowedString {
 public:
  /// Of the law's file, no parameters.
  static constexpr double pitch_hz = 196, impedance_n_s_m = 0.35;

  /// At a rate in Hz; 0: that of the file.
  static law::Compiled compiled(double rate_hz = 0) {
    return law::compile(
        law::read_law(std::string(FELTGATE_ROOT) + "/rtl/laws/bowed_string.law", rate_hz),
        law::Target{});
  }
  /// The law must outlive this.
  explicit BowedString(const law::Compiled& law)
      : c_(law), values_(law.image), machine_(law::memory(law.image)) {
    machine_.enter();
  }
  double rate_hz() const { return c_.rate_hz; }

  /// In the file's units, which are SI, as far as the ranges go; in force with the next run.
  void set(std::map<std::string, double> values) {
    for (auto& [name, value] : values) value = values_.within(name, value);
    law::write(machine_, values_.set(values));
  }
  double value(const std::string& name) const { return values_.value(name); }

  /// A run with the bow at this speed; the torque, Nm.
  double run(double bow_m_s) {
    law::MachineInputs inputs{};
    const double lever_rad_s = bow_m_s / values_.value("reach");
    inputs[1] = static_cast<std::int32_t>(
        std::lround(std::ldexp(lever_rad_s, c_.target.velocity.fraction)));
    const law::MachineRun& r = machine_.run(c_.target.thread, inputs);
    slipped_ = !r.events.empty();
    if (slipped_) since_s_ = r.events.front().value * c_.image.events.front().scale;
    return std::ldexp(static_cast<double>(r.outputs[0]), -c_.target.torque.fraction);
  }
  /// Whether a slip began in the last run, and the time since the one before it.
  bool slipped() const { return slipped_; }
  double since_s() const { return since_s_; }
  double state(const std::string& name) const {
    for (std::size_t k = 0; k < c_.law.states.size(); ++k) {
      if (c_.law.states[k].name != name) continue;
      const int address =
          c_.target.thread * EngineMap::private_words + c_.assembled.state_address[k];
      return machine_.memory().data_at(address) * c_.program.states[k].scale;
    }
    throw std::runtime_error("no state " + name);
  }

 private:
  const law::Compiled& c_;
  law::LoadedParameters values_;
  law::Machine machine_;
  bool slipped_ = false;
  double since_s_ = 0;
};

/// How a string moves in a stretch of time.
struct Motion {
  int slips = 0;
  double shortest_s = 1, longest_s = 0;  ///< between two of them
  double sliding = 0;                    ///< share of the time
  double heard_m_s = 0;                  ///< largest at the bridge
  double mean_nm = 0, most_nm = 0;       ///< torque; the largest amount
  /// Exactly one slip in every period of the string, to 5 %: much force keeps the corner back.
  bool helmholtz() const {
    const double period_s = 1 / BowedString::pitch_hz;
    return slips > 1 && shortest_s > 0.95 * period_s && longest_s < 1.05 * period_s;
  }
};

/// A bow of even speed after 50 ms, played at `first_n` for 0.25 s, from there to `force_n` within
/// 0.4 s where they differ; the 0.25 s after another 0.25 s.
struct Bowing {
  double place = 0.1, bow_m_s = 0.2, first_n = 2, force_n = 2;
};
inline Motion play(const law::Compiled& law, const Bowing& b) {
  BowedString string(law);
  string.set({{"place", b.place}, {"force", b.first_n}});
  const bool changes = b.first_n != b.force_n;
  const double from_s = 0.25, way_s = changes ? 0.4 : 0, settle_s = 0.25, seen_s = 0.25;
  const auto runs = [&](double s) { return static_cast<int>(std::lround(s * string.rate_hz())); };
  const int each = std::max(1, runs(1e-3)), watch = runs(from_s + way_s + settle_s),
            end = watch + runs(seen_s);
  Motion m;
  for (int i = 0; i < end; ++i) {
    const double t = i / string.rate_hz(), way = (t - from_s) / 0.4;
    if (changes && i % each == 0 && way > 0 && way < 1.01) {
      string.set({{"force", b.first_n + (b.force_n - b.first_n) * std::min(way, 1.0)}});
    }
    const double torque = string.run(b.bow_m_s * std::min(1.0, t / 0.05));
    if (i < watch) continue;
    if (string.slipped()) {
      ++m.slips;
      m.shortest_s = std::min(m.shortest_s, string.since_s());
      m.longest_s = std::max(m.longest_s, string.since_s());
    }
    m.sliding += string.state("stuck") > 0.5 ? 0 : 1.0 / (end - watch);
    m.heard_m_s = larger(m.heard_m_s, std::fabs(string.state("heard")));
    m.mean_nm += torque / (end - watch);
    m.most_nm = larger(m.most_nm, std::fabs(torque));
  }
  return m;
}

/// Limits of the bow force, N: J. C. Schelleng, The bowed string and the player, Journal of the
/// Acoustical Society of America 53, 26-41, 1973. `drop` is static less dynamic friction.
struct Schelleng {
  double least_n, most_n;
};
inline Schelleng schelleng(double bow_m_s, double place, double drop, double reflected) {
  const double z = BowedString::impedance_n_s_m, bridge = z * (1 + reflected) / (1 - reflected);
  return {z * z * bow_m_s / (2 * bridge * place * place * drop), 2 * z * bow_m_s / (place * drop)};
}

}  // namespace feltgate
