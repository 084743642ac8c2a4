// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT calibrate cogging. Documentation: docs/calibration.md
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/commands/commands.hpp"
#include "apps/commands/host/bench_design.hpp"
#include "apps/commands/host/verbs.hpp"
#include "design/law_target.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "host/identify/report.hpp"
#include "law/compile.hpp"

namespace feltgate::host {

namespace {

/// Written once it is one that the engine of the design takes. Errors: LawError, law::Refused.
void write_law(files::OutputFile* to, const std::string& path, const std::string& text,
               const design::Elaborated& e) {
  (void)law::compile_text(text, path, design::law_target(e));
  to->write(text);
}

}  // namespace

int calibrate_cogging(Session& session, const CoggingArguments& a) {
  if (a.from.empty() == a.slow_turn.empty() || (a.from.empty() && !a.write.empty())) {
    throw std::invalid_argument(
        "calibrate cogging needs --slow-turn FILE, a law to write that turns the lever, or --from "
        "FILE, what was recorded of it: time_s, position, tau_hat and tau_ref");
  }
  if (!a.into.empty() && a.write.empty()) {
    throw std::invalid_argument("--into LAW says what --write FILE writes; give both");
  }
  const BenchDesign known(session, "");
  const design::Elaborated& e = known.design();
  const SmallTorque small = small_torque_of(e);
  if (!e.design.engine && !(a.write.empty() && a.slow_turn.empty())) {
    throw std::invalid_argument(fmt::format(
        "design {} has no engine for a law; give one that has with --design", e.design.name));
  }
  files::Outputs outputs;
  std::string into, into_path;
  if (!a.into.empty()) {
    into_path = find_law(a.into);
    outputs.reads(into_path);
    std::ifstream in(into_path);
    into.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) throw std::invalid_argument(into_path + ": cannot be read; check the path");
  }
  if (!a.from.empty() && a.from != "-") outputs.reads(a.from);
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* write = outputs.open("--write", a.write);
  files::OutputFile* slow = outputs.open("--slow-turn", a.slow_turn);
  if (slow != nullptr) {
    write_law(slow, a.slow_turn, slow_turn_law(small), e);
    outputs.say(
        fmt::format("{}: turns the lever by 1.2 turns up and down in 31 s; record "
                    "position, tau_hat and tau_ref\n",
                    a.slow_turn));
    outputs.commit();
    return exit_ok;
  }
  const Cogging cogging = identify_cogging(ColumnTable::of_file(a.from), e, a.confidence);
  std::string text = report_text(cogging, a.confidence);
  if (write != nullptr) {
    if (cogging.terms.empty()) {
      throw std::invalid_argument(
          fmt::format("--write {}: there is nothing to take away\n{}", a.write, text));
    }
    write_law(write, a.write,
              compensating_law(cogging, small, fmt::format("{}, design {}", a.from, e.design.name),
                               into, into_path),
              e);
    text += fmt::format("{}: a law that takes it away{}\n", a.write,
                        a.into.empty() ? "" : ", with " + a.into);
  }
  outputs.say(text);
  if (json != nullptr) json->write(files::json_text(report_json(cogging, a.confidence)));
  outputs.commit();
  return exit_ok;
}

}  // namespace feltgate::host
