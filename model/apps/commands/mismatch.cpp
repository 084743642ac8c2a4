// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The waveform around the first mismatch of a run. Documentation: docs/testing.md
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "apps/commands/commands.hpp"
#include "apps/commands/run_output.hpp"
#include "files/output_file.hpp"

namespace feltgate {

namespace {

namespace fs = std::filesystem;

/// In mismatch/ in the build folder, or in the current folder.
std::string waveform_path(const SessionResult& r) {
  const char* build = std::getenv("FELTGATE_BUILD");
  const fs::path folder = build != nullptr ? fs::path(build) / "mismatch" : fs::path("mismatch");
  fs::create_directories(folder);
  return (folder / (r.subject + "." + r.design + ".fst")).string();
}

}  // namespace

void show_mismatch(const SessionResult& r, BackendOptions options,
                   const std::function<void(const BackendOptions& again)>& run) {
  if (r.mismatches == 0) return;
  constexpr Clock before = 200, after = 20;
  files::OutputFile waveform("waveform", waveform_path(r));
  options.fst = waveform.named();
  options.fst_from = r.first_mismatch_clock - before;
  options.fst_to = r.first_mismatch_clock + after;
  run(options);
  waveform.commit();
  fmt::print(stderr,
             "first mismatch: {}\nwaveform: gtkwave {} {}/scripts/gtkwave/feltgate_core.gtkw\n",
             r.first_mismatch, waveform.path(), repository());
}

Scenario cut_after(Scenario scenario, const SessionResult& r, Clock clocks) {
  scenario.duration_s =
      std::max(1e-5, r.simulated_s * static_cast<double>(clocks) / static_cast<double>(r.clocks));
  scenario.expectations.clear();
  return scenario;
}

}  // namespace feltgate
