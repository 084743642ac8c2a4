// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text, JSON and CSV of `feltgate touch`, and its session at a board. Documentation: docs/touch.md
#include "apps/commands/touch/touch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "apps/commands/commands.hpp"
#include "apps/commands/host/streaming.hpp"

namespace feltgate {

using plant::length;
using plant::Vec3;

namespace {

double degrees(double rad) { return rad * 180 / 3.14159265358979323846; }

std::string genus_text(const touch::Component& c) {
  if (!c.manifold) return "edges of more than two faces: no genus";
  if (!c.orientable) return "one side only: no genus";
  const std::string genus = fmt::format("genus {}", *c.genus());
  if (c.border_loops > 0) {
    return fmt::format("open, {} border{}, {}", c.border_loops, c.border_loops == 1 ? "" : "s",
                       genus);
  }
  return fmt::format("closed, {}, {:.4g} cm3, looks {}", genus, 1e6 * std::abs(c.volume_m3),
                     c.volume_m3 < 0 ? "inwards" : "outwards");
}

/// Of the planes in a simulated run.
struct PlaneSummary {
  double tilt_rad = 0, age_s = 0;
  double step_n = 0;  ///< of the spring's force, at a new plane
};

PlaneSummary planes_of(const touch::TouchRun& run) {
  const auto& figures = run.result.figures;
  return {figures.at("plane_tilt_rad.max"), figures.at("plane_age_s.max"),
          figures.at("plane_step_n.max")};
}

}  // namespace

TouchSummary summary_of(const touch::TouchRun& run) {
  TouchSummary s;
  std::vector<double> took;
  for (const touch::TouchUpdate& u : run.updates) {
    s.touching += u.touched.touching ? 1 : 0;
    s.constraints = std::max(s.constraints, u.touched.constraints);
    s.depth_m = std::max(s.depth_m, u.touched.depth_m);
    took.push_back(u.took_s);
  }
  s.touching /= static_cast<double>(std::max<std::size_t>(1, run.updates.size()));
  for (const touch::TouchRow& row : run.rows) s.force_n = std::max(s.force_n, length(row.force_n));
  std::sort(took.begin(), took.end());
  s.median_s = touch::quantile(took, 0.5);
  s.rare_s = touch::quantile(took, 0.999);
  return s;
}

std::vector<std::string> Decimation::warnings() const {
  constexpr double far_share = 0.05;
  std::vector<std::string> all;
  if (share > far_share)
    all.push_back(fmt::format("{:.0f} % of its size away: another shape is felt; take more faces",
                              100 * share));
  if (opened > 0)
    all.push_back(fmt::format("{} edges more at a border: slivers were dropped", opened));
  return all;
}

std::string mesh_text(const TouchArguments& a, const touch::Soup& soup, const touch::Mesh& mesh,
                      double scale, const std::optional<Decimation>& fewer) {
  constexpr std::size_t most_shown = 8;
  const touch::MeshReport& r = fewer ? fewer->file : mesh.report;
  std::string s = fmt::format("{}: {} triangles of {} primitives, {} vertices; ", a.glb,
                              r.triangles_read, soup.primitives, r.vertices_read);
  s += a.as_is ? "as in the file\n"
               : fmt::format("scaled by {:.4g} to {:.1f} mm\n", scale, 1e3 * a.size_m);
  if (soup.not_triangles > 0)
    s += fmt::format("  left out: {} primitives of points or lines\n", soup.not_triangles);
  if (soup.skins > 0)
    s += fmt::format("  left out: {} skins; the mesh is in its rest pose\n", soup.skins);
  if (soup.animations > 0)
    s += fmt::format("  left out: {} animations; the mesh is in its rest pose\n", soup.animations);
  for (const std::string& name : soup.extensions)
    s += fmt::format("  left out: the extension {}, which may change the mesh\n", name);
  s += fmt::format(
      "  welded {} vertices, dropped {} triangles without an area and {} that were there twice\n",
      r.welded, r.degenerate, r.duplicates);
  s += fmt::format(
      "  edges: {} at a border, {} of more than two faces, {} between inverted faces ({} turned)\n",
      r.border_edges, r.nonmanifold_edges, r.inverted_edges, r.turned);
  if (mesh.materials.size() > 1)
    s += fmt::format("  materials: {}\n", fmt::join(mesh.materials, ", "));
  for (std::size_t n = 0; n < r.components.size() && n < most_shown; ++n) {
    const touch::Component& c = r.components[n];
    s += fmt::format("  component {}: V - E + F = {} - {} + {} = {}, {}\n", n, c.vertices, c.edges,
                     c.faces, c.euler(), genus_text(c));
  }
  if (r.components.size() > most_shown)
    s += fmt::format("  and {} smaller ones\n", r.components.size() - most_shown);
  if (fewer) {
    s += fmt::format("  {} of {} faces: {:.3g} mm away at most\n", fewer->faces,
                     fewer->faces_before, 1e3 * fewer->hausdorff_m);
    s += fmt::format(
        "  faces turn by up to {:.1f} degrees on 95 % of their edges, {:.1f} at most; before "
        "{:.1f} "
        "and {:.1f}\n  so the force steps by up to {:.3g} N on 95 % of the edges, {:g} mm deep at "
        "{:g} N/m\n",
        degrees(fewer->jumps.most_rad), degrees(fewer->jumps.largest_rad),
        degrees(fewer->before.most_rad), degrees(fewer->before.largest_rad), fewer->force_step_n,
        1e3 * a.depth_m, a.request.host.stiffness_n_m);
    for (const std::string& w : fewer->warnings()) s += "  warning: " + w + "\n";
  }
  return s;
}

std::string run_text(const TouchArguments& a, const touch::TouchRun& run) {
  constexpr std::size_t lines = 12;
  const auto& u = run.updates;
  const auto& r = run.rows;
  std::string s = fmt::format("\n{:>8} {:>24} {:>24} {:>9} {:>24}\n", "time ms", "pen mm", "normal",
                              "depth mm", "force N");
  const std::size_t all = std::min(u.size(), r.size());
  const auto three = [](Vec3 v, double by, int digits) {
    return fmt::format("{:>7.{}f} {:>7.{}f} {:>7.{}f} ", by * v.x, digits, by * v.y, digits,
                       by * v.z, digits);
  };
  for (std::size_t k = 1; k <= lines && all > 0; ++k) {
    const std::size_t n = std::min(all - 1, k * all / lines);
    s += fmt::format("{:>8.1f} {:>24} {:>24} {:>9.3f} {:>24}\n", 1e3 * r[n].time_s,
                     three(r[n].pen_m, 1e3, 2), three(r[n].normal, 1, 3),
                     1e3 * u[n].touched.depth_m, three(r[n].force_n, 1, 3));
  }
  const TouchSummary m = summary_of(run);
  const PlaneSummary p = planes_of(run);
  const AxesResult& o = run.result;
  s += fmt::format(
      "\n{} planes at {:g} Hz, {:.0f} % touching, up to {} constraints; {:.0f} arrived, {:.0f} "
      "lost\n",
      u.size(), a.request.host.rate_hz, 100 * m.touching, m.constraints,
      o.figures.at("planes_arrived"), o.figures.at("planes_lost"));
  s += fmt::format("depth up to {:.3f} mm, force up to {:.3f} N\n", 1e3 * m.depth_m, m.force_n);
  s += fmt::format(
      "a plane in force is up to {:.1f} ms old and {:.1f} degrees off the newest; at a new one the "
      "force steps by up to {:.3f} N\n",
      1e3 * p.age_s, degrees(p.tilt_rad), p.step_n);
  s += fmt::format(
      "an update of the proxy took {:.1f} us in the median, {:.1f} us in all but one of a "
      "thousand, here\n",
      1e6 * m.median_s, 1e6 * m.rare_s);
  for (std::size_t n = 0; n < o.axes.size() && !o.reference.empty(); ++n) {
    const double bound_nm = o.axes[n].bound_nm;
    s += fmt::format("axis {}: engine off the law in {} by up to {:.3g} uNm, {}\n", n, o.reference,
                     1e6 * o.axes[n].law_error_nm.max(),
                     std::isfinite(bound_nm) ? fmt::format("proven {:.3g} uNm", 1e6 * bound_nm)
                                             : "no bound proven: the law has a state");
  }
  s += o.lock_step
           ? fmt::format("RTL and twin: {} mismatches in {} clocks\n", o.mismatches, o.clocks)
           : std::string("the twin alone; --engine all compares it with the RTL in every clock\n");
  for (const std::string& line : o.broken) s += line + "\n";
  return s;
}

nlohmann::ordered_json mesh_json(const TouchArguments& a, const touch::Mesh& mesh, double scale,
                                 const std::optional<Decimation>& fewer) {
  const touch::MeshReport& r = fewer ? fewer->file : mesh.report;
  nlohmann::ordered_json j{{"schema", "feltgate-touch/1"},
                           {"version", FELTGATE_VERSION},
                           {"mesh", std::filesystem::path(a.glb).filename().string()},
                           {"scale", scale},
                           {"triangles_read", r.triangles_read},
                           {"vertices_read", r.vertices_read},
                           {"welded", r.welded},
                           {"degenerate", r.degenerate},
                           {"duplicates", r.duplicates},
                           {"border_edges", r.border_edges},
                           {"nonmanifold_edges", r.nonmanifold_edges},
                           {"inverted_edges", r.inverted_edges},
                           {"turned", r.turned},
                           {"stroke_hash", fmt::format("{:016x}", touch::stroke_hash(mesh))}};
  for (const touch::Component& c : r.components) {
    nlohmann::ordered_json part{{"vertices", c.vertices},
                                {"edges", c.edges},
                                {"faces", c.faces},
                                {"euler", c.euler()},
                                {"border_loops", c.border_loops}};
    if (const auto genus = c.genus()) part["genus"] = *genus;
    if (c.border_loops == 0) part["volume_m3"] = c.volume_m3;
    j["components"].push_back(part);
  }
  if (fewer) {
    const auto turn = [](const touch::Jumps& jumps) {
      return nlohmann::ordered_json{{"most", jumps.most_rad}, {"largest", jumps.largest_rad}};
    };
    nlohmann::ordered_json& d = j["decimated"];
    d["faces"] = fewer->faces;
    d["faces_before"] = fewer->faces_before;
    d["hausdorff_m"] = fewer->hausdorff_m;
    d["turn_rad"] = turn(fewer->jumps);
    d["turn_before_rad"] = turn(fewer->before);
    d["force_step_n"] = fewer->force_step_n;
    d["warnings"] = fewer->warnings();
  }
  return j;
}

/// What a run and a session at a board say alike.
void add_summary(nlohmann::ordered_json& j, const TouchSummary& m) {
  j["touching"] = m.touching;
  j["constraints"] = m.constraints;
  j["depth_m"] = m.depth_m;
  j["force_n"] = m.force_n;
  j["update_s"] = {{"median", m.median_s}, {"q999", m.rare_s}};
}

void add_run(nlohmann::ordered_json& j, const touch::TouchRun& run) {
  const PlaneSummary p = planes_of(run);
  const AxesResult& o = run.result;
  j["planes"] = run.updates.size();
  add_summary(j, summary_of(run));
  j["plane_age_s"] = p.age_s;
  j["plane_tilt_rad"] = p.tilt_rad;
  j["plane_step_n"] = p.step_n;
  for (const AxisFigures& axis : o.axes) {
    if (!o.reference.empty())
      j["law_error_nm"].push_back({{"max", axis.law_error_nm.max()}, {"bound", axis.bound_nm}});
  }
  if (o.lock_step) j["mismatches"] = o.mismatches;
  j["clocks"] = o.clocks;
  j["broken"] = o.broken;
}

void write_rows(std::FILE* to, const touch::TouchRun& run) {
  fmt::print(to,
             "time_s,pen_x_m,pen_y_m,pen_z_m,proxy_x_m,proxy_y_m,proxy_z_m,depth_m,constraints,"
             "normal_x,normal_y,normal_z,force_x_n,force_y_n,force_z_n\n");
  for (std::size_t n = 0; n < std::min(run.updates.size(), run.rows.size()); ++n) {
    const touch::Touched& t = run.updates[n].touched;
    const touch::TouchRow& r = run.rows[n];
    fmt::print(to,
               "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{:.9g},{:.9g},{:.9g},{:."
               "9g},{:.9g},{:.9g}\n",
               r.time_s, r.pen_m.x, r.pen_m.y, r.pen_m.z, t.proxy_m.x, t.proxy_m.y, t.proxy_m.z,
               t.depth_m, t.constraints, r.normal.x, r.normal.y, r.normal.z, r.force_n.x,
               r.force_n.y, r.force_n.z);
  }
}

// The planes of a mesh for a board.

using plant::Vec3;

namespace {

/// Of an update on the line: SLIP, CRC, address and word of each write.
constexpr double bits_per_write = 15 * 10, most_of_line = 0.8;
/// Without --csv, figures are of the last so many poses at most: a session may last for days.
constexpr std::size_t most_kept = 200'000;

/// Gives the board this law, if it does not have it, without a plane: another session may have left
/// one, and its velocity, in the mailbox.
void bring_law(host::Session& session, host::LawEngine& laws, const char* name, bool quiet) {
  const law::Image image = session.image_of(name);
  if (laws.holds(image)) {
    laws.attach(image);
  } else {
    Progress progress("loading the law " + image.name, quiet);
    laws.load(image, [&](double share) { progress.update(share); });
    host::keep_law(host::laws_folder(), image);
  }
  laws.set({{"stiffness", 0}, {"speed_x", 0}, {"speed_y", 0}, {"speed_z", 0}});
}

/// Within the ranges of the law's words.
void keep_within(std::map<std::string, double>& words, const host::LawEngine& laws) {
  for (auto& [name, value] : words) {
    const law::ImageWord& w = *laws.find(name);
    const double ends[] = {w.lower * w.scale, w.upper * w.scale};
    value = std::clamp(value, std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  }
}

/// Leaves the oldest poses out.
void forget(touch::TouchRun& run, std::size_t count) {
  const auto rows = static_cast<std::ptrdiff_t>(count);
  run.rows.erase(run.rows.begin(), run.rows.begin() + rows);
  run.updates.erase(run.updates.begin(), run.updates.begin() + rows);
}

/// Whether the pen is outside of the mesh, so that a proxy can begin; says what to do if not.
bool began(touch::Seeker& seeker, Vec3 pen_m, bool quiet) {
  try {
    seeker.begin(pen_m);
    return true;
  } catch (const std::invalid_argument&) {
    if (!quiet) std::fputs("the pen is in the mesh: lead it out, then it feels the mesh\n", stderr);
    return false;
  }
}

}  // namespace

AxesScene stylus_scene() {
  return read_axes_scene(find_file("stylus_cube", "vectors/scenes"), [](const std::string& name) {
    return find_file(name, "vectors/devices");
  });
}

BoardTouch touch_board(const TouchArguments& a, const touch::Mesh& mesh,
                       const touch::TouchRequest& request) {
  constexpr double shown_every_s = 0.25;
  host::Session session;
  session.options.port = a.board;
  session.options.baud = a.baud;
  session.options.patience_s = 3;
  const std::string design = session.design().name();
  if (session.device().axes() != 3 || design.find("stylus") == std::string::npos) {
    throw std::invalid_argument(
        fmt::format("--board {}: its design {} is no stylus; a pen on three slides is needed",
                    a.board, design));
  }
  host::Device& device = session.device();
  host::LawEngine laws(device);
  bring_law(session, laws, touch::law_of(request), a.quiet);
  const double capstan_m =
      std::get<StylusSetup>(stylus_scene().device).parameters.lever.lever.radius_m;
  touch::Seeker seeker(mesh, request);
  host::MailboxBurst burst(device, laws);

  BoardTouch b;
  host::StreamArguments stream;
  for (const char* word : {"angle", "tau_ref"}) {
    for (const char* axis : {"", ".1", ".2"}) stream.names.push_back(std::string(word) + axis);
  }
  stream.arm = "law";
  stream.seconds = a.seconds;
  const auto writes = static_cast<double>(plane_words(seeker.host(), {}, {}, {}).size() + 1);
  const double fits_hz = most_of_line * a.baud / (bits_per_write * writes);
  const double tick_hz = session.board().tick_hz();
  const auto period = std::max(
      device.shortest_period(host::stream_mask(device, stream), a.baud),
      static_cast<std::uint32_t>(std::ceil(tick_hz / std::min(a.request.host.rate_hz, fits_hz))));
  b.rate_hz = tick_hz / period;
  const auto columns = host::stream_columns(device, stream);
  double shown_s = -shown_every_s;
  bool told = a.quiet;  // that the pen is in the mesh
  if (!a.quiet) {
    std::fputs(fmt::format("{}planes at {:.0f} Hz to {}, {} baud; Ctrl-C ends it\n",
                           simulated_banner(session.board()), b.rate_hz, a.board, a.baud)
                   .c_str(),
               stderr);
  }
  host::follow_stream(device, stream, period, [&](const host::Tick& oldest) {
    host::Tick tick = oldest;
    for (; const auto newer = device.streamed(host::HostClock::now()); ++b.skipped) tick = *newer;
    const auto vector_of = [&](std::size_t first, double by) {
      return Vec3{by * tick.value(*columns[first]), by * tick.value(*columns[first + 1]),
                  by * tick.value(*columns[first + 2])};
    };
    const Vec3 pen_m = vector_of(0, capstan_m);
    if (b.run.updates.empty() && !began(seeker, pen_m, std::exchange(told, true))) return;
    const auto [plane, material] = seeker.find(pen_m, tick.time_s, b.run.updates);
    std::map<std::string, double> words = plane_words(seeker.host(), material, plane, pen_m);
    keep_within(words, laws);
    burst.send(words);
    const Vec3 force_n = vector_of(3, 1 / capstan_m);
    b.run.rows.push_back({tick.time_s, pen_m, plane.normal, force_n});
    if (a.csv.empty() && b.run.rows.size() >= most_kept) forget(b.run, most_kept / 2);
    if (a.quiet || tick.time_s - shown_s < shown_every_s) return;
    shown_s = tick.time_s;
    const touch::Touched& t = b.run.updates.back().touched;
    std::fputs(
        fmt::format("{:7.2f} s  pen {:6.2f} {:6.2f} {:6.2f} mm  {}  force {:6.3f} {:6.3f} "
                    "{:6.3f} N\n",
                    tick.time_s, 1e3 * pen_m.x, 1e3 * pen_m.y, 1e3 * pen_m.z,
                    t.touching ? fmt::format("{:5.2f} mm deep", 1e3 * t.depth_m) : "free         ",
                    force_n.x, force_n.y, force_n.z)
            .c_str(),
        stderr);
  });
  b.counts = burst.check();
  return b;
}

std::string board_text(const BoardTouch& b) {
  const TouchSummary m = summary_of(b.run);
  return fmt::format(
      "\n{} planes at {:.0f} Hz, {:.0f} % touching; {} poses overtaken, {} frames lost on the "
      "line, {} checks found a busy engine\n"
      "depth up to {:.3f} mm, force up to {:.3f} N; an update of the proxy took {:.1f} us in the "
      "median\n",
      b.counts.sent, b.rate_hz, 100 * m.touching, b.skipped, b.counts.lost_frames, b.counts.dropped,
      1e3 * m.depth_m, m.force_n, 1e6 * m.median_s);
}

void add_board(nlohmann::ordered_json& j, const BoardTouch& b) {
  j["planes"] = b.counts.sent;
  j["rate_hz"] = b.rate_hz;
  add_summary(j, summary_of(b.run));
  j["overtaken"] = b.skipped;
  j["lost_frames"] = b.counts.lost_frames;
  j["dropped"] = b.counts.dropped;
}

}  // namespace feltgate
