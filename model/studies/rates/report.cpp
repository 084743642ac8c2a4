// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "files/table.hpp"
#include "studies/rates/rates.hpp"

namespace feltgate::rates {

namespace {

using files::cell;
using files::Columns;
using files::Json;
using files::when;

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

/// Of an error; of no tick there is none.
Json measured(const ErrorFigure& of, double value) {
  return of.count() == 0 ? Json(nullptr) : Json(value);
}

const char* margin_kind(const Margin& m) {
  constexpr const char* kinds[] = {"stiffness", "damping", "torque", ""};
  return kinds[static_cast<int>(m.of)];
}

/// Against the fastest, the last.
double time_ratio(const Report& r, const RateRow& row) {
  const double of = r.rows.back().cpu_s_per_s;
  return of > 0 ? row.cpu_s_per_s / of : 0;
}

std::string kept_text(const RateRow& r) {
  if (r.expected == 0) return "-";
  return fmt::format("{} of {}", r.expected - static_cast<int>(r.broken.size()), r.expected);
}

std::string ratio_text(const Margin& m) {
  if (m.of == Margin::Of::none) return "-";
  return m.ratio >= 1e3 ? ">1000" : fmt::format("{:.3g}", m.ratio);
}

std::string clocks_text(const RateRow& r) {
  if (r.clocks_available == 0) return "-";
  return fmt::format("{} of {}", r.clocks_used, r.clocks_available);
}

std::string notes_text(const Report& r) {
  std::string s;
  for (const std::string& note : r.notes) s += "note: " + note + "\n";
  return s;
}

std::string border_title(const Report& r) {
  if (r.rows.empty() || r.axes > 1) return "";
  const Margin::Of of = r.rows.back().margin.of;
  return of == Margin::Of::damping  ? "border\nNms/rad"
         : of == Margin::Of::torque ? "torque/angle\nNm/rad"
                                    : "border\nNm/rad";
}

const Columns<ErrorFigure> error_columns{
    {"error_rms_nm", [](auto& e) { return measured(e, e.rms()); }, "torque error\nrms, mNm",
     "{:.4g}", 1e3},
    {"error_max_nm", [](auto& e) { return measured(e, e.max()); }, "worst, mNm", "{:.4g}", 1e3},
    {"ticks_compared", &ErrorFigure::count}};

Columns<RateRow> columns_of(const Report& r) {
  const bool several = r.axes > 1;
  const auto known = [](const RateRow& row) { return row.margin.of != Margin::Of::none; };
  Columns<RateRow> all{
      {"", [](auto& row) { return rate_text(row.rate_hz); }, "<torque\nrenewed at"},
      {"by", [](auto& row) { return row.block ? "block" : "engine"; }, "<by"},
      {"rate_hz", &RateRow::rate_hz},
      {"ticks", &RateRow::ticks}};
  for (const auto& c : error_columns) {
    all.push_back(
        {c.key, [c](auto& row) { return c.value(row.error); }, c.title, c.format, c.factor});
  }
  const Columns<RateRow> more{
      {"error_mean_nm", [](auto& row) { return measured(row.error, row.mean_error_nm); }},
      {"border", [=](auto& row) { return when(known(row), row.margin.border); }, border_title(r),
       "{:.4g}"},
      {"border_of", [=](auto& row) { return when(known(row), margin_kind(row.margin)); }},
      {"margin", [=](auto& row) { return when(known(row), row.margin.ratio); }},
      {"", [](auto& row) { return ratio_text(row.margin); }, "margin"},
      {"axes", [=](auto& row) { return when(several, array_of(error_columns, row.of_axes)); }},
      {"swing_nm", [=](auto& row) { return when(several, row.swing_nm); },
       several ? "swing,\nmNm" : "", "{:.4g}", 1e3},
      {"expected", [=](auto& row) { return when(several, row.expected); }},
      {"broken", [=](auto& row) { return when(several, row.broken); }},
      {"", kept_text, several ? "expected\nkept" : ""},
      {"instructions", [](auto& row) { return when(!row.block, row.instructions); }},
      {"runs", [](auto& row) { return when(!row.block, row.runs); }},
      {"clocks_used", [](auto& row) { return when(!row.block, row.clocks_used); }},
      {"clocks_available", [](auto& row) { return when(!row.block, row.clocks_available); }},
      {"", clocks_text, "engine clocks\nof a run"},
      {"cpu_s_per_s", &RateRow::cpu_s_per_s},
      {"time_ratio", [&r](auto& row) { return time_ratio(r, row); }, "CPU\ntime", "{:.2f}"},
      {"fault", &RateRow::fault},
      {"mismatches", &RateRow::mismatches},
      {"clocks_compared", &RateRow::clocks_compared}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// What stands behind a factor that is not compared.
std::string gain_note(const GainMargin& g) {
  if (std::isnan(g.bits)) return g.why;
  return g.large ? "" : "too small a swing to compare";
}

const Columns<GainMargin> gain_columns{
    {"of", &GainMargin::of, "<factor on the torque"},
    {"linear", &GainMargin::linear, "linear", "{:.4g}"},
    {"bits", &GainMargin::bits, "bits", "{:.4g}"},
    {"", [](auto& g) { return 100 * (g.bits / g.linear - 1); }, "off", "{:+.1f} %"},
    {"rad_s", &GainMargin::rad_s, "swing", "{:.3g} Hz", 1 / 6.283185307179586},
    {"swing_counts", &GainMargin::swing_counts, "counts", "{:.3g}"},
    {"swing_nm", &GainMargin::swing_nm, "mNm", "{:.3g}", 1e3},
    {"large", &GainMargin::large},
    {"disagrees", &GainMargin::disagrees},
    {"why", &GainMargin::why},
    {"", gain_note, "< "}};

const Columns<Beside> beside_columns{
    {"design", &Beside::path},
    {"counts_alone_rms_nm", [](auto& b) { return measured(b.floor, b.floor.rms()); }},
    {"counts_alone_max_nm", [](auto& b) { return measured(b.floor, b.floor.max()); }},
    {"margins", [](auto& b) {
       Json all = Json::array();
       for (const Margin& m : b.margins)
         all.push_back(m.of == Margin::Of::none ? Json(nullptr) : Json(m.ratio));
       return all;
     }}};

const Columns<Report> scene_columns{
    {"scene", &Report::scene},
    {"title", &Report::title},
    {"law", &Report::law},
    {"plant", [](auto& r) { return when(r.axes == 1, r.plant); }},
    {"device", [](auto& r) { return when(r.axes > 1, r.plant); }},
    {"axes", &Report::axes},
    {"simulated_s", &Report::simulated_s},
    {"largest_nm", &Report::largest_nm},
    {"stiffness_nm_rad", [](auto& r) { return r.slope.stiffness_nm_rad; }},
    {"damping_nm_s_rad", [](auto& r) { return r.slope.damping_nm_s_rad; }},
    {"jump_nm", [](auto& r) { return r.slope.jump_nm; }},
    {"lever_damping_nm_s_rad", &Report::damping_nm_s_rad},
    {"counts_alone_rms_nm", [](auto& r) { return measured(r.floor, r.floor.rms()); }},
    {"counts_alone_max_nm", [](auto& r) { return measured(r.floor, r.floor.max()); }},
    {"notes", &Report::notes},
    {"rates", [](auto& r) { return array_of(columns_of(r), r.rows); }},
    {"beside", [](auto& r) { return when(!r.beside.empty(), array_of(beside_columns, r.beside)); }},
    {"gains", [](auto& r) { return when(!r.gains.empty(), array_of(gain_columns, r.gains)); }}};

}  // namespace

std::string rate_text(double hz) {
  if (hz >= 1e6) return fmt::format("{:.3g} MHz", hz / 1e6);
  return hz >= 1e3 ? fmt::format("{:.3g} kHz", hz / 1e3) : fmt::format("{:.3g} Hz", hz);
}

std::string report_text(const Report& r) {
  const bool several = r.axes > 1;
  const Json floor = object_of(error_columns, r.floor);
  std::string s =
      fmt::format("scene {}: {}\nlaw {}, {}; to {:.3g} Nm; {}, {:.3g} s\n\n", r.scene, r.title,
                  r.law, slope_text(r.slope, r.largest_nm), r.largest_nm,
                  several ? fmt::format("device {}, {} axes", r.plant, r.axes) : "plant " + r.plant,
                  r.simulated_s);
  s += table(columns_of(r), r.rows);
  s += fmt::format("counts alone: torque error {} mNm rms, {} at worst\n",
                   cell(floor["error_rms_nm"], "{:.4g}", 1e3),
                   cell(floor["error_max_nm"], "{:.4g}", 1e3));
  for (const RateRow& row : r.rows) {
    const std::string rate = rate_text(row.rate_hz);
    if (!row.fault.empty()) {
      s += fmt::format("fault at {}: {}; not compared from there on\n", rate, row.fault);
    }
    for (const std::string& line : row.broken) s += fmt::format("not kept at {}: {}\n", rate, line);
  }
  return s + notes_text(r) +
         fmt::format("gates, at every rate: engine {} LUT4 eq, 2 MULT18, 4 BRAM{}, its law none\n",
                     FELTGATE_LUT4_ENGINE, several ? " with its glue to one axis" : "");
}

std::string gains_text(const Report& r) {
  std::string s = fmt::format(
      "scene {}: {}\nlaw {} at {}, {} {} without what is not linear\nfriction of a joint {:g} Nm "
      "s/rad, also where the scene leaves it out; without noise and lost words\n\n",
      r.scene, r.title, r.law, rate_text(r.rows.back().rate_hz), r.axes > 1 ? "device" : "plant",
      r.plant, r.damping_nm_s_rad);
  const auto shown = std::count_if(r.gains.begin(), r.gains.end(),
                                   [](auto& g) { return !std::isnan(g.bits) && g.large; });
  s += table(gain_columns, r.gains);
  s += fmt::format("{} of {} compared with the bits\n", shown, r.gains.size());
  return s + notes_text(r);
}

std::string reports_json(const std::vector<Report>& reports) {
  return files::json_text({{"schema", "feltgate-rates/1"},
                           {"version", FELTGATE_VERSION},
                           {"scenes", array_of(scene_columns, reports)}});
}

}  // namespace feltgate::rates
