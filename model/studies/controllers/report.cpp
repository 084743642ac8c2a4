// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include "files/table.hpp"
#include "studies/controllers/controllers.hpp"

namespace feltgate::controllers {

using files::Columns;
using files::Json;

namespace {

std::string number(double value) {
  const std::string text = fmt::format("{:.2f}", value);
  return text == "-0.00" ? "0.00" : text;
}
std::string milli(double value) { return number(1e3 * value); }

/// A border: none, beyond what was tried, or its value.
std::string border_text(double nm_rad) {
  if (nm_rad == 0) return "under 1";
  return nm_rad >= stiffest_nm_rad ? fmt::format("over {:g}", stiffest_nm_rad)
                                   : fmt::format("{:.1f}", nm_rad);
}

std::string lut4_text(const Row& row) {
  const Size size = size_of(row.kind);
  if (size.lut4 == size.measured) return fmt::format("{}", size.lut4);
  return fmt::format("{} + about {}", size.measured, size.lut4 - size.measured);
}

std::string held_text(const Held& h) {
  return fmt::format("{:.1f} (worst {:.1f})", h.error_rms_pct, h.error_max_pct);
}

/// The figures in fixed point; behind them those in double.
Columns<Row> pair_columns() {
  Columns<Row> all{{"name", [](auto& row) { return name_of(row.kind); }, "fixed point (double)"}};
  const auto add = [&](const char* key, const char* title, Pair Row::*of,
                       std::string (*text)(double) = number) {
    all.push_back({key, [of](auto& row) {
                     return Json{{"fixed", (row.*of).fixed}, {"double", (row.*of).real}};
                   }});
    all.push_back({"",
                   [of, text](auto& row) {
                     return text((row.*of).fixed) + " (" + text((row.*of).real) + ")";
                   },
                   title});
  };
  add("settling_ms", "settling to 2 % at stall, ms", &Row::settling_ms);
  add("error_pct", "steady error at stall, %", &Row::error_pct);
  add("error_r_pct", "the same, R +20 %", &Row::error_r_pct);
  add("error_kt_pct", "the same, Kt -50 %", &Row::error_kt_pct);
  add("felt_inertia", "load step: inertia felt / J", &Row::felt_inertia);
  add("noise_nm", "noise at rest, mNm rms", &Row::noise_nm, milli);
  add("border_nm_rad", "largest wall, pressed, Nm/rad", &Row::border_nm_rad, border_text);
  add("held_border_nm_rad", "largest wall, a hand leans on it, Nm/rad", &Row::held_border_nm_rad,
      border_text);
  add("light_border_nm_rad", "the same, a tenth of the hand's damping", &Row::light_border_nm_rad,
      border_text);
  all.insert(
      all.end(),
      {{"multiplications", [](auto& row) { return size_of(row.kind).multiplications; },
        "multiplications a tick"},
       {"state_bits", [](auto& row) { return size_of(row.kind).state_bits; }, "bits of state"},
       {"lut4_equivalents", [](auto& row) { return size_of(row.kind).lut4; }},
       {"lut4_measured", [](auto& row) { return size_of(row.kind).measured; }},
       {"", lut4_text, "LUT4 eq"}});
  return all;
}

/// Those that each have several of: hands, inertias, encoders. In JSON they are arrays.
Columns<Row> fixed_columns() {
  Columns<Row> all{{"", [](auto& row) { return name_of(row.kind); }, "fixed point"}};
  const auto add = [&](const std::string& title, auto value) { all.push_back({"", value, title}); };
  for (std::size_t i = 0; i < stiffness_nm_rad.size(); ++i) {
    add(fmt::format("hand of {:g} Nm/rad: error felt, % rms", stiffness_nm_rad[i]),
        [i](auto& row) { return held_text(row.held[i]); });
  }
  for (std::size_t i = 0; i < inertia_ratios.size(); ++i) {
    add(fmt::format("Jn/J = {:g}, 2 Nm/rad: error felt, % rms", inertia_ratios[i]),
        [i](auto& row) { return held_text(row.inertia[i]); });
  }
  for (std::size_t i = 0; i < inertia_ratios.size(); ++i) {
    add(fmt::format("Jn/J = {:g}: largest wall, pressed, Nm/rad", inertia_ratios[i]),
        [i](auto& row) { return border_text(row.borders[i]); });
  }
  for (std::size_t i = 0; i < noise_lines.size(); ++i) {
    add(fmt::format("{} lines: noise at rest, mNm rms", noise_lines[i]),
        [i](auto& row) { return milli(row.noise_of[i]); });
  }
  return all;
}

Json held_json(const char* key, double of, const Held& h) {
  return {{key, of}, {"error_rms_pct", h.error_rms_pct}, {"error_max_pct", h.error_max_pct}};
}

}  // namespace

std::string report_text(const Report& r) {
  return markdown(pair_columns(), r.rows) + "\n" + markdown(fixed_columns(), r.rows);
}

std::string report_json(const Report& r) {
  Json j{{"schema", "feltgate-controllers/1"},
         {"version", FELTGATE_VERSION},
         {"share", paper_share},
         {"stall_trace_s", stall_trace_s},
         {"held_trace_s", held_trace_s},
         {"stiffest_nm_rad", stiffest_nm_rad},
         {"controllers", Json::array()}};
  for (const Row& row : r.rows) {
    Json one = object_of(pair_columns(), row);
    for (std::size_t i = 0; i < stiffness_nm_rad.size(); ++i) {
      one["hands"].push_back(held_json("stiffness_nm_rad", stiffness_nm_rad[i], row.held[i]));
    }
    for (std::size_t i = 0; i < inertia_ratios.size(); ++i) {
      Json of = held_json("ratio", inertia_ratios[i], row.inertia[i]);
      of["border_nm_rad"] = row.borders[i];
      one["inertia_ratios"].push_back(of);
    }
    for (std::size_t i = 0; i < noise_lines.size(); ++i) {
      one["encoders"].push_back({{"lines", noise_lines[i]}, {"noise_nm", row.noise_of[i]}});
    }
    one["stall_nm"] = row.stall_trace_nm;
    one["held_nm"] = row.held_trace_nm;
    j["controllers"].push_back(one);
  }
  return files::json_text(j);
}

}  // namespace feltgate::controllers
