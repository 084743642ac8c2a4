// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate replay and feltgate import. Documentation: docs/traces.md, docs/json.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/commands/commands.hpp"
#include "apps/commands/run_output.hpp"
#include "files/output_file.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "sim/traces/open.hpp"
#include "sim/traces/vector_file.hpp"

namespace feltgate {

namespace {

/// Options that say how to read a recording; replay and import share them.
struct TraceArguments {
  std::string path, probes, scale, wrap, format;
  traces::Options options;
  bool no_jitter = false, wraps = false;

  traces::Options read() {
    if (!probes.empty()) options.probes = traces::split_names(probes);
    if (!scale.empty()) options.scale = traces::parse_scale(scale);
    if (!format.empty()) options.format = traces::parse_format(format);
    if (wraps) options.wrap = traces::parse_wrap(wrap);
    options.jitter = !no_jitter;
    return options;
  }
  void add_to(CLI::App* sub) {
    option(*sub, "trace", path, "TRACE", "recording: .sr, VCD, CSV, or a vector of this project")
        ->required();
    option(*sub, "--probes", probes, "NAMES", "names of the signals A,B[,Z]; default: guessed");
    option(*sub, "--step", options.step, "NAME", "name of the STEP signal; with --dir");
    option(*sub, "--dir", options.dir, "NAME", "name of the DIR signal");
    option(*sub, "--time-column", options.time_column, "NAME", "column with the time");
    option(*sub, "--count-column", options.count_column, "NAME", "column with counts or an angle");
    option(*sub, "--time-unit", options.time_unit, "UNIT",
           "s, ms, us or ns of that column; default: as its name says, else s",
           CLI::IsMember({"s", "ms", "us", "ns"}));
    option(*sub, "--scale", scale, "SCALE",
           "counts per unit of that column, e.g. 2048/2pi for radians");
    sub->add_option_function<std::string>(
           "--wrap",
           [this](const std::string& text) {
             wraps = true;
             wrap = text;
           },
           "that column begins again after so many of its units, e.g. 360, 2pi or 65536; alone: a "
           "turn of an angle, or 2^16 or 2^32 counts, as its first jump tells")
        ->type_name("UNITS")
        ->expected(0, 1)
        ->check(CLI::Validator(
            [](const std::string& text) {
              try {
                (void)traces::parse_wrap(text);
                return std::string();
              } catch (const traces::TraceError&) {
                return text +
                       " is not a finite number above 0, such as 360, 2pi or 65536; where "
                       "it is to be found, put --wrap behind the file";
              }
            },
            ""));
    option(*sub, "--sample-hz", options.sample_hz, "HZ",
           "rate of the capture, where the file does not say it; rows without a time are "
           "its samples",
           checks::whole(1, 1'000'000'000'000, "Hz"));
    option(*sub, "--format", format, "FORMAT",
           "sigrok, vcd, saleae, levels, columns or vector; default: by content");
    sub->add_flag("--no-jitter", no_jitter,
                  "edges at the start of their sample instead of a seeded place inside");
    defaulted(*sub, "--seed", options.seed, "", "of that place", checks::seed());
  }
};

struct ReplayArguments {
  TraceArguments trace;
  std::string design = "lever", engine = "all", scene = "spring_tension", json, csv, fst;
  double seconds = 0;
  int every = 0;  ///< 0: sane_every()
  bool quiet = false;
};

std::string probe_text(const traces::Options& o) {
  if (!o.step.empty()) return o.step + "," + o.dir;
  std::string text;
  for (const std::string& p : o.probes) text += (text.empty() ? "" : ",") + p;
  return text;
}

/// With the clock and the encoder of a design.
traces::Options for_design(traces::Options options, const std::string& name) {
  const DesignInfo design = design_named(name);
  options.clock_hz = design.clock_hz;
  options.turn_counts = std::round(2 * 3.14159265358979323846 / design.count_rad);
  return options;
}

traces::Options with_warnings(traces::Options options) {
  options.warn = [](const std::string& what) { fmt::print(stderr, "warning: {}\n", what); };
  return options;
}

int replay(ReplayArguments& a) {
  if (a.every > 0 && a.csv.empty()) {
    throw std::invalid_argument("--every thins out the rows of --csv; add --csv FILE");
  }
  if (a.scene == "law") {
    throw std::invalid_argument(
        "--scene law: a replay loads no program; choose another scene, or use feltgate run");
  }
  traces::Options how = for_design(a.trace.read(), a.design);
  const traces::Options warning = with_warnings(how);
  // A first pass over the file finds its length.
  const bool whole = !(a.seconds > 0);
  Clock length = 0;
  if (whole) {
    const auto first_pass = traces::open(a.trace.path, warning);
    while (first_pass->next()) {
    }
    length = first_pass->length();
  }
  const auto source = traces::open(a.trace.path, whole ? how : warning);
  const std::string name = std::filesystem::path(a.trace.path).filename().string();

  ReplayOptions options;
  options.design = a.design;
  options.engine = a.engine;
  options.scene = a.scene;
  options.seed = how.seed;
  if (a.seconds > 0) {
    const double clocks = a.seconds * static_cast<double>(how.clock_hz);
    options.most_clocks = std::max<Clock>(1, std::llround(clocks));
  }
  files::Outputs outputs;
  outputs.reads(a.trace.path);
  outputs.reads(find_file(a.design, "rtl/designs"));
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* csv = outputs.open("--csv", a.csv);
  files::OutputFile* fst = outputs.open("--fst", a.fst);
  if (fst != nullptr) options.fst = fst->named();
  if (!whole) length = options.most_clocks;
  const design::Elaborated elaborated = elaborated_design(a.design);
  std::optional<CsvWriter> rows;
  if (csv != nullptr) {
    rows.emplace(csv->handle(), row_columns(false, choose_backends(a.engine).names()));
    const Clock ticks = length * elaborated.design.tick_hz / how.clock_hz;
    options.row_every = a.every > 0 ? a.every : sane_every(ticks);
    options.row = [&rows](const Row& r) { rows->add(r); };
    if (!a.quiet) fmt::print(stderr, "{}\n", rows->forecast(ticks, options.row_every));
  }
  Progress progress(name, a.quiet);
  options.progress = [&progress, length](Clock done) {
    progress.update(length > 0 ? static_cast<double>(done) / static_cast<double>(length) : 1.0);
  };
  const RunResult result = replay_within_bounds(elaborated, *source, name, options);
  const RunLabels labels{"trace", "", probe_text(how)};
  if (json != nullptr) json->write(run_json(result, labels));
  if (!a.quiet) outputs.say(run_text(result, labels));
  outputs.commit();
  show_mismatch(result, options, [&](const BackendOptions& same) {
    ReplayOptions again;
    static_cast<BackendOptions&>(again) = same;
    again.scene = options.scene;
    again.most_clocks = same.fst_to + 1;
    const auto source_again = traces::open(a.trace.path, how);
    run_replay(*source_again, name, again);
  });
  return result.as_expected() ? exit_ok : exit_failed;
}

}  // namespace

void add_replay(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<ReplayArguments>();
  CLI::App* sub =
      app.add_subcommand("replay", "open loop on an encoder recording, through every back-end");
  sub->footer(R"(  feltgate replay hand.sr --probes XA,XB
  feltgate replay axis.sr --step 5 --dir 6
  feltgate replay log.csv --time-column t --count-column theta --scale 2048/2pi
  feltgate replay hand.sr --engine twin,double,float --csv hand.csv    fixed beside float
Exit code: 0 no mismatch and no error above its bound, 1 one, 2 the recording or an option cannot be used.)");
  a->trace.add_to(sub);
  defaulted(*sub, "--design", a->design, "DESIGN", "design point in rtl/designs");
  defaulted(*sub, "--engine", a->engine, "ENGINES", backend_help);
  defaulted(*sub, "--scene", a->scene, "SCENE", "torque law that the core renders meanwhile");
  option(*sub, "--duration", a->seconds, "SECONDS", "stop after so much of it; default: its end",
         checks::seconds());
  option(*sub, "--json", a->json, "FILE", "figures as JSON (docs/json.md)");
  option(*sub, "--csv", a->csv, "FILE",
         "a row per tick, the columns of every back-end (docs/json.md)");
  option(*sub, "--every", a->every, "TICKS", every_help, checks::whole(1, 1'000'000'000));
  option(*sub, "--fst", a->fst, "FILE",
         "waveform of every clock of the RTL (large: with --duration)");
  sub->add_flag("--quiet", a->quiet, "print only what went wrong");
  sub->callback([a, exit_code] {
    a->design = built_design(a->design);
    *exit_code = replay(*a);
  });
}

void add_import(CLI::App& app, int* exit_code) {
  struct Arguments {
    TraceArguments trace;
    std::string out, place, design = "lever";
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* sub =
      app.add_subcommand("import", "convert an encoder recording to this project's vector format");
  a->trace.add_to(sub);
  sub->footer(R"(  feltgate import hand.sr hand.vec --probes XA,XB
  feltgate import log.csv --count-column theta --scale 2048/2pi -o hand.vec
Exit code: 0 written, 2 the recording or an option cannot be used.)");
  option(*sub, "out", a->place, "FILE", "vector file to write");
  option(*sub, "-o,--output", a->out, "FILE", "the same");
  defaulted(*sub, "--design", a->design, "DESIGN", "design whose clock stamps the edges");
  sub->callback([a, exit_code] {
    if (!a->out.empty() && !a->place.empty()) {
      throw std::invalid_argument("import: two files to write; leave out one of " + a->place +
                                  " and -o " + a->out);
    }
    if (a->out.empty()) a->out = a->place;
    if (a->out.empty()) {
      throw std::invalid_argument("import: the FILE to write is missing; feltgate import --help");
    }
    a->design = built_design(a->design);
    const traces::Options how = for_design(a->trace.read(), a->design);
    const auto source = traces::open(a->trace.path, with_warnings(how));
    files::Outputs outputs;
    outputs.reads(a->trace.path);
    files::OutputFile* out = outputs.open("--output", a->out);
    traces::write_vector(out->handle(), a->out, a->design, how.clock_hz, *source);
    outputs.commit();
    outputs.say(
        fmt::format("wrote {}, {:.6g} s\n", a->out,
                    static_cast<double>(source->length()) / static_cast<double>(how.clock_hz)));
    *exit_code = exit_ok;
  });
}

}  // namespace feltgate
