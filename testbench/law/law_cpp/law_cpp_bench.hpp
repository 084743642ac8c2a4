// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws of the build as images, and what they are given. Documentation: docs/law-compiler.md
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "feltgate/random.hpp"
#include "law/compile.hpp"
#include "law/engine/law_runner.hpp"
#include "law/load.hpp"
#include "laws/shipped.hpp"

namespace feltgate::test {

/// The shipped laws; with seeded defects of what writes the C++ only the others, which have them.
template <class Visitor>
void visit_shipped([[maybe_unused]] Visitor&& visitor) {
#ifndef LAW_CPP_DEFECTS
  laws::visit_shipped(visitor);
#endif
}

/// The law of a generated class, compiled here once more.
inline const law::Compiled& compiled_law(const std::string& name) {
  static std::map<std::string, law::Compiled> known;
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  const std::string root = FELTGATE_ROOT;
  std::string path = root + "/rtl/laws/" + name + ".law";
  if (!std::filesystem::exists(path))
    path = FELTGATE_BUILD_DIR "/testbench/law/laws/" + name + ".law";
  return known.emplace(name, law::compile_file(path, law::Target{})).first->second;
}

/// Words of inputs: of all sizes, their ends, and now and then any word of 32 bits; parameters.
class Stimulus {
 public:
  explicit Stimulus(std::uint64_t seed, bool within = false) : random_(seed), within_(within) {}

  law::MachineInputs inputs() {
    law::MachineInputs in{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      in[3 * axis] = word(1 << 17);
      in[3 * axis + 1] = word(INT32_MAX);
      in[3 * axis + 2] = word(1 << 20);
    }
    return in;
  }
  /// Values of the parameters that are no formulas, SI; as words of their ranges.
  std::vector<double> values(const law::Image& image) {
    std::vector<double> all;
    for (const law::ImageWord& w : image.words) {
      if (!w.formula.empty()) continue;
      const std::int64_t corner = random_.below(4), width = std::int64_t{w.upper} - w.lower;
      const std::int64_t word = corner == 0   ? w.lower
                                : corner == 1 ? w.upper
                                              : w.lower + random_.below(width + 1);
      const double value = static_cast<double>(word) * w.scale;
      all.push_back(w.whole ? std::floor(value) : value);
    }
    return all;
  }
  bool one_in(std::int64_t n) { return random_.below(n) == 0; }

 private:
  std::int32_t word(std::int64_t limit) {
    const std::int64_t kind = random_.below(within_ ? 15 : 16);
    if (kind == 15) {
      const std::int64_t end = random_.below(4);
      return end == 0   ? INT32_MIN
             : end == 1 ? INT32_MAX
                        : static_cast<std::int32_t>(random_.bits());
    }
    if (kind == 14) return static_cast<std::int32_t>(random_.below(2) == 0 ? -limit : limit - 1);
    const std::int64_t spread = std::max<std::int64_t>(limit >> random_.below(18), 1);
    return static_cast<std::int32_t>(random_.below(2 * spread) - spread);
  }

  SplitMix64 random_;
  bool within_;
};

}  // namespace feltgate::test
