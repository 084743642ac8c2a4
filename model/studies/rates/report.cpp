// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "files/json_text.hpp"
#include "studies/rates/rates.hpp"

namespace feltgate::rates {

namespace {

using Json = nlohmann::ordered_json;

constexpr double jump_share = 0.05;  ///< of the largest torque: less is not told

std::string slope_text(const Slope& s, double largest_nm) {
  std::string text;
  if (s.stiffness_nm_rad > 0) {
    text = fmt::format("at its steepest {:.4g} Nm/rad with {:.4g} Nm s/rad of damping",
                       s.stiffness_nm_rad, s.damping_nm_s_rad);
  } else if (s.damping_nm_s_rad > 0) {
    text = fmt::format("damping {:.4g} Nm s/rad", s.damping_nm_s_rad);
  } else {
    text = "nowhere stiff or damped";
  }
  if (s.jump_nm > jump_share * largest_nm) text += fmt::format(", a jump of {:.3g} Nm", s.jump_nm);
  return text;
}

/// The error (rms and largest) in mNm; "-" without ticks.
std::string error_text(const ErrorFigure& e) {
  if (e.count() == 0) return fmt::format("{:>9} {:>9}", "-", "-");
  return fmt::format("{:>9.4g} {:>9.4g}", 1e3 * e.rms(), 1e3 * e.max());
}

/// Of an error; of no tick there is none.
Json measured_json(const ErrorFigure& of, double value) {
  return of.count() == 0 ? Json(nullptr) : Json(value);
}
std::string measured_csv(const ErrorFigure& of, double value) {
  return of.count() == 0 ? "" : fmt::format("{:.6g}", value);
}

std::string kept_text(const RateRow& r) {
  if (r.expected == 0) return "-";
  return fmt::format("{} of {}", r.expected - static_cast<int>(r.broken.size()), r.expected);
}

std::string ratio_text(const Margin& m) {
  if (m.of == Margin::Of::none) return "-";
  return m.ratio >= 1e3 ? ">1000" : fmt::format("{:.3g}", m.ratio);
}

std::string margin_text(const Margin& m) {
  if (m.of == Margin::Of::none) return fmt::format("{:>9} {:>8}", "-", "-");
  return fmt::format("{:>9.4g} {:>8}", m.border, ratio_text(m));
}

std::string clocks_text(const RateRow& r) {
  if (r.clocks_available == 0) return "-";
  return fmt::format("{} of {}", r.clocks_used, r.clocks_available);
}

const char* margin_kind(const Margin& m) {
  switch (m.of) {
    case Margin::Of::stiffness:
      return "stiffness";
    case Margin::Of::damping:
      return "damping";
    case Margin::Of::torque:
      return "torque";
    case Margin::Of::none:
      break;
  }
  return "";
}

/// Against the fastest, the last.
double time_ratio(const Report& r, const RateRow& row) {
  const double of = r.rows.back().cpu_s_per_s;
  return of > 0 ? row.cpu_s_per_s / of : 0;
}

}  // namespace

std::string rate_text(double hz) {
  if (hz >= 1e6) return fmt::format("{:.3g} MHz", hz / 1e6);
  return hz >= 1e3 ? fmt::format("{:.3g} kHz", hz / 1e3) : fmt::format("{:.3g} Hz", hz);
}

namespace {

/// One lever: error, margin, clocks and time.
std::string lever_table(const Report& r) {
  const Margin::Of of = r.rows.empty() ? Margin::Of::none : r.rows.back().margin.of;
  std::string s = fmt::format(
      "\n{:<17}  {:^19}  {:^18}  {:^16}  {:>5}\n{:<17}  {:>9} {:>9}  {:>9} {:>8}  {:>16}  {:>5}\n",
      "torque renewed", "torque error, mNm",
      of == Margin::Of::damping  ? "border Nms/rad"
      : of == Margin::Of::torque ? "torque/angle Nm/rad"
                                 : "border Nm/rad",
      "engine clocks", "CPU", "at", "rms", "worst", "", "margin", "of a run", "time");
  for (const RateRow& row : r.rows) {
    s += fmt::format("{:<9} {:<7}  {}  {}  {:>16}  {:>5.2f}\n", rate_text(row.rate_hz),
                     row.block ? "block" : "engine", error_text(row.error), margin_text(row.margin),
                     clocks_text(row), time_ratio(r, row));
  }
  return s;
}

/// Several axes: what the bits show beside the margin.
std::string axes_table(const Report& r) {
  const char* line = "{:<17}  {:>9} {:>9}  {:>6}  {:>9}  {:>8}  {:>16}  {:>5}\n";
  std::string s =
      fmt::format("\n{:<17}  {:^19}  {:>6}  {:>9}  {:>8}  {:^16}  {:>5}\n", "torque renewed",
                  "torque error, mNm", "", "swing,", "expec-", "engine clocks", "CPU");
  s += fmt::format(line, "at", "rms", "worst", "margin", "mNm", "ted kept", "of a run", "time");
  for (const RateRow& row : r.rows) {
    s +=
        fmt::format("{:<9} {:<7}  {}  {:>6}  {:>9.4g}  {:>8}  {:>16}  {:>5.2f}\n",
                    rate_text(row.rate_hz), "engine", error_text(row.error), ratio_text(row.margin),
                    1e3 * row.swing_nm, kept_text(row), clocks_text(row), time_ratio(r, row));
  }
  return s;
}

}  // namespace

std::string report_text(const Report& r) {
  const bool several = r.axes > 1;
  std::string s = fmt::format("scene {}: {}\nlaw {}", r.scene, r.title, r.law);
  s += ", " + slope_text(r.slope, r.largest_nm);
  s +=
      fmt::format("; to {:.3g} Nm; {}, {:.3g} s\n", r.largest_nm,
                  several ? fmt::format("device {}, {} axes", r.plant, r.axes) : "plant " + r.plant,
                  r.simulated_s);
  s += several ? axes_table(r) : lever_table(r);
  s += fmt::format("{:<17}  {}\n", "counts alone", error_text(r.floor));
  for (const RateRow& row : r.rows) {
    const std::string rate = rate_text(row.rate_hz);
    if (!row.fault.empty()) {
      s += fmt::format("fault at {}: {}; not compared from there on\n", rate, row.fault);
    }
    for (const std::string& line : row.broken) s += fmt::format("not kept at {}: {}\n", rate, line);
  }
  for (const std::string& note : r.notes) s += "note: " + note + "\n";
  s +=
      fmt::format("gates, at every rate: {}engine 1265 LUT4 eq, 2 MULT18, 4 BRAM{}, its law none\n",
                  r.block_gates.empty() ? "" : "block " + r.block_gates + "; ",
                  several ? " with its glue to one axis" : "");
  return s;
}

std::string reports_json(const std::vector<Report>& reports) {
  Json j{{"schema", "feltgate-rates/1"}, {"version", FELTGATE_VERSION}, {"scenes", Json::array()}};
  for (const Report& r : reports) {
    Json scene{{"scene", r.scene},
               {"title", r.title},
               {"law", r.law},
               {r.axes > 1 ? "device" : "plant", r.plant},
               {"axes", r.axes},
               {"simulated_s", r.simulated_s},
               {"largest_nm", r.largest_nm}};
    scene["stiffness_nm_rad"] = r.slope.stiffness_nm_rad;
    scene["damping_nm_s_rad"] = r.slope.damping_nm_s_rad;
    scene["jump_nm"] = r.slope.jump_nm;
    scene["lever_damping_nm_s_rad"] = r.damping_nm_s_rad;
    scene["counts_alone_rms_nm"] = measured_json(r.floor, r.floor.rms());
    scene["counts_alone_max_nm"] = measured_json(r.floor, r.floor.max());
    scene["block_gates"] = r.block_gates;
    scene["notes"] = r.notes;
    scene["rates"] = Json::array();
    for (const RateRow& row : r.rows) {
      Json one{{"rate_hz", row.rate_hz},
               {"ticks", row.ticks},
               {"by", row.block ? "block" : "engine"},
               {"error_rms_nm", measured_json(row.error, row.error.rms())},
               {"error_max_nm", measured_json(row.error, row.error.max())},
               {"error_mean_nm", measured_json(row.error, row.mean_error_nm)},
               {"ticks_compared", row.error.count()},
               {"cpu_s_per_s", row.cpu_s_per_s},
               {"time_ratio", time_ratio(r, row)},
               {"fault", row.fault},
               {"mismatches", row.mismatches},
               {"clocks_compared", row.clocks_compared}};
      if (row.margin.of != Margin::Of::none) {
        one["margin"] = row.margin.ratio;
        one["border"] = row.margin.border;
        one["border_of"] = margin_kind(row.margin);
      }
      if (r.axes > 1) {
        for (const ErrorFigure& e : row.of_axes) {
          one["axes"].push_back({{"error_rms_nm", measured_json(e, e.rms())},
                                 {"error_max_nm", measured_json(e, e.max())},
                                 {"ticks_compared", e.count()}});
        }
        one["swing_nm"] = row.swing_nm;
        one["expected"] = row.expected;
        one["broken"] = row.broken;
      }
      if (!row.block) {
        one["instructions"] = row.instructions;
        one["runs"] = row.runs;
        one["clocks_used"] = row.clocks_used;
        one["clocks_available"] = row.clocks_available;
      }
      scene["rates"].push_back(one);
    }
    for (const Beside& b : r.beside) {
      Json one{{"design", b.path},
               {"counts_alone_rms_nm", measured_json(b.floor, b.floor.rms())},
               {"counts_alone_max_nm", measured_json(b.floor, b.floor.max())},
               {"margins", Json::array()}};
      for (const Margin& m : b.margins) {
        one["margins"].push_back(m.of == Margin::Of::none ? Json(nullptr) : Json(m.ratio));
      }
      scene["beside"].push_back(one);
    }
    for (const GainMargin& g : r.gains) {
      scene["gains"].push_back({{"of", g.of},
                                {"linear", g.linear},
                                {"bits", std::isnan(g.bits) ? Json(nullptr) : Json(g.bits)},
                                {"rad_s", g.rad_s},
                                {"swing_counts", g.swing_counts},
                                {"swing_nm", g.swing_nm},
                                {"large", g.large},
                                {"disagrees", g.disagrees},
                                {"why", g.why}});
    }
    j["scenes"].push_back(scene);
  }
  return files::json_text(j);
}

std::string reports_csv(const std::vector<Report>& reports) {
  std::string s =
      "scene,by,rate_hz,ticks,error_rms_nm,error_max_nm,margin,border,border_of,clocks_used,"
      "clocks_available,time_ratio,swing_nm,expected,broken\n";
  for (const Report& r : reports) {
    for (const RateRow& row : r.rows) {
      const bool known = row.margin.of != Margin::Of::none;
      s += fmt::format(
          "{},{},{:.10g},{},{},{},{},{},{},{},{},{:.3g},{}\n", r.scene,
          row.block ? "block" : "engine", row.rate_hz, row.ticks,
          measured_csv(row.error, row.error.rms()), measured_csv(row.error, row.error.max()),
          known ? fmt::format("{:.4g}", row.margin.ratio) : "",
          known ? fmt::format("{:.4g}", row.margin.border) : "", margin_kind(row.margin),
          row.clocks_used, row.clocks_available, time_ratio(r, row),
          r.axes > 1 ? fmt::format("{:.6g},{},{}", row.swing_nm, row.expected, row.broken.size())
                     : ",,");
    }
  }
  return s;
}

}  // namespace feltgate::rates
