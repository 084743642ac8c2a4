// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate claims. Documentation: docs/claims.md
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "apps/commands/commands.hpp"
#include "feltgate/nearest.hpp"
#include "files/output_file.hpp"
#include "studies/claims/claims.hpp"

namespace feltgate {

namespace {

struct ClaimsArguments {
  std::vector<std::string> names;
  std::string json;
  bool markdown = false;
};

std::vector<claims::Source> chosen(const std::vector<std::string>& names) {
  std::set<std::string> known;
  std::vector<claims::Source> out;
  for (const claims::Source& s : claims::sources()) {
    known.insert(s.name);
    const bool named = std::find(names.begin(), names.end(), s.name) != names.end();
    if (named || names.empty()) out.push_back(s);
  }
  for (const std::string& name : names) {
    if (known.count(name) > 0) continue;
    throw std::invalid_argument(fmt::format("claim \"{}\" is unknown; {}choose among {}", name,
                                            config::did_you_mean(name, known),
                                            fmt::join(known, ", ")));
  }
  return out;
}

int run_claims(const ClaimsArguments& a) {
  const auto sources = chosen(a.names);
  const claims::Lab lab(repository());
  files::Outputs outputs;
  files::OutputFile* json = outputs.open("--json", a.json);
  std::vector<claims::Answer> answers;
  {
    Progress progress("claims", a.markdown);
    for (const claims::Source& s : sources) {
      answers.push_back({s, s.work_out(lab)});
      progress.update(static_cast<double>(answers.size()) / static_cast<double>(sources.size()));
    }
  }
  if (a.markdown) {
    outputs.say(claims::page(answers));
  } else {
    for (const claims::Answer& answer : answers) outputs.say(claims::text(answer));
    outputs.say(claims::summary(answers));
  }
  if (json != nullptr) json->write(claims::json(answers));
  outputs.commit();
  return exit_ok;
}

}  // namespace

void add_claims(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<ClaimsArguments>();
  CLI::App* sub = app.add_subcommand(
      "claims", "what five papers claim, beside a closed form and a simulation, with a verdict");
  sub->footer(
      "Each claim comes with its place in the paper, the closed form with the paper's own "
      "numbers,\n"
      "a simulation where one can judge it, and a verdict: holds, holds if, cannot be had.\n"
      "  feltgate claims                          every claim, in a few seconds\n"
      "  feltgate claims window half_nm_of_7_a    only these\n"
      "  feltgate claims --markdown > claims.md\n"
      "Exit code: 0 whatever the verdicts, 2 unusable input.");
  CLI::Option* names =
      sub->add_option("claim", a->names, "claims; all when none is named")->type_name("CLAIM");
  sub->add_option("--json", a->json, "the table as JSON (docs/json.md)")->type_name("FILE");
  sub->add_flag("--markdown", a->markdown, "print a page of all claims instead")
      ->excludes(names);
  sub->callback([a, exit_code] { *exit_code = run_claims(*a); });
}

}  // namespace feltgate
