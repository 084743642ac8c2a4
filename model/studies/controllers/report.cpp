// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "files/json_text.hpp"
#include "studies/controllers/controllers.hpp"

namespace feltgate::controllers {

namespace {

using Json = nlohmann::ordered_json;

/// A border: none, beyond what was tried, or its value.
std::string border_text(double nm_rad) {
  if (nm_rad == 0) return "under 1";
  return nm_rad >= stiffest_nm_rad ? fmt::format("over {:g}", stiffest_nm_rad)
                                   : fmt::format("{:.1f}", nm_rad);
}

std::string number(double value) {
  const std::string text = fmt::format("{:.2f}", value);
  return text == "-0.00" ? "0.00" : text;
}

/// The figure in fixed point; behind it that in double.
template <class Text>
std::string pair_text(const Pair& p, double factor, Text text) {
  return fmt::format("{} ({})", text(factor * p.fixed), text(factor * p.real));
}

/// One line: a name and a cell for each controller.
template <class Cell>
std::string line(const Report& r, const std::string& name, Cell cell) {
  std::string s = "| " + name + " |";
  for (const Row& row : r.rows) s += " " + cell(row) + " |";
  return s + "\n";
}

std::string head(const Report& r, const std::string& first) {
  std::string rule = "|---|";
  for (std::size_t i = 0; i < r.rows.size(); ++i) rule += "---|";
  return line(r, first, [](const Row& row) { return std::string(name_of(row.kind)); }) + rule +
         "\n";
}

Json pair_json(const Pair& p) { return {{"fixed", p.fixed}, {"double", p.real}}; }

}  // namespace

std::string report_text(const Report& r) {
  std::string s = head(r, "fixed point (double)");
  const auto pairs = [&](const std::string& name, Pair Row::*figure, double factor = 1.0) {
    s += line(r, name, [&](const Row& row) { return pair_text(row.*figure, factor, number); });
  };
  pairs("settling to 2 % at stall, ms", &Row::settling_ms);
  pairs("steady error at stall, %", &Row::error_pct);
  pairs("the same, R +20 %", &Row::error_r_pct);
  pairs("the same, Kt -50 %", &Row::error_kt_pct);
  pairs("load step: inertia felt / J", &Row::felt_inertia);
  pairs("noise at rest, mNm rms", &Row::noise_nm, 1e3);
  const auto borders = [&](const std::string& name, Pair Row::*figure) {
    s += line(r, name, [&](const Row& row) { return pair_text(row.*figure, 1, border_text); });
  };
  borders("largest wall, pressed, Nm/rad", &Row::border_nm_rad);
  borders("largest wall, a hand leans on it, Nm/rad", &Row::held_border_nm_rad);
  borders("the same, a tenth of the hand's damping", &Row::light_border_nm_rad);
  s += line(r, "multiplications a tick",
            [](const Row& row) { return fmt::format("{}", size_of(row.kind).multiplications); });
  s += line(r, "bits of state",
            [](const Row& row) { return fmt::format("{}", size_of(row.kind).state_bits); });
  s += line(r, "LUT4 eq", [](const Row& row) {
    const Size size = size_of(row.kind);
    if (size.lut4 == size.measured) return fmt::format("{}", size.lut4);
    return fmt::format("{} + about {}", size.measured, size.lut4 - size.measured);
  });
  s += "\n" + head(r, "fixed point");
  const auto held = [](const Held& h) {
    return fmt::format("{:.1f} (worst {:.1f})", h.error_rms_pct, h.error_max_pct);
  };
  for (std::size_t i = 0; i < stiffness_nm_rad.size(); ++i) {
    s += line(r, fmt::format("hand of {:g} Nm/rad: error felt, % rms", stiffness_nm_rad[i]),
              [&](const Row& row) { return held(row.held[i]); });
  }
  for (std::size_t i = 0; i < inertia_ratios.size(); ++i) {
    s += line(r, fmt::format("Jn/J = {:g}, 2 Nm/rad: error felt, % rms", inertia_ratios[i]),
              [&](const Row& row) { return held(row.inertia[i]); });
  }
  for (std::size_t i = 0; i < inertia_ratios.size(); ++i) {
    s += line(r, fmt::format("Jn/J = {:g}: largest wall, pressed, Nm/rad", inertia_ratios[i]),
              [&](const Row& row) { return border_text(row.borders[i]); });
  }
  for (std::size_t i = 0; i < noise_lines.size(); ++i) {
    s += line(r, fmt::format("{} lines: noise at rest, mNm rms", noise_lines[i]),
              [&](const Row& row) { return number(1e3 * row.noise_of[i]); });
  }
  return s;
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
    const Size size = size_of(row.kind);
    Json one{{"name", name_of(row.kind)},
             {"settling_ms", pair_json(row.settling_ms)},
             {"error_pct", pair_json(row.error_pct)},
             {"error_r_pct", pair_json(row.error_r_pct)},
             {"error_kt_pct", pair_json(row.error_kt_pct)},
             {"felt_inertia", pair_json(row.felt_inertia)},
             {"noise_nm", pair_json(row.noise_nm)},
             {"border_nm_rad", pair_json(row.border_nm_rad)},
             {"held_border_nm_rad", pair_json(row.held_border_nm_rad)},
             {"light_border_nm_rad", pair_json(row.light_border_nm_rad)},
             {"multiplications", size.multiplications},
             {"state_bits", size.state_bits},
             {"lut4_equivalents", size.lut4},
             {"lut4_measured", size.measured}};
    const auto held_json = [](const char* key, double of, const Held& h) {
      return Json{
          {key, of}, {"error_rms_pct", h.error_rms_pct}, {"error_max_pct", h.error_max_pct}};
    };
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
