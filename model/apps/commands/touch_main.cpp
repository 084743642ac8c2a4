// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate touch, a program of its own: nobody else waits for what reads meshes. Documentation:
// docs/touch.md
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "sim/axes_loop/axes_backends.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/touch/touch_run.hpp"

namespace feltgate {

namespace {

using plant::length;
using plant::Vec3;

struct TouchArguments {
  std::string glb, stroke, engine = "twin,double", json, csv;
  std::vector<std::string> materials;
  double size_m = 0.06, depth_m = 2e-3, speed_m_s = 0.1, friction = 0, press_n = 0;
  std::array<double, 3> centre_m{};
  double stiffness = 300, damping = 0, drag = 0;
  double rate_hz = 1000, latency_s = 1e-3, jitter_s = 1e-3, lost = 0;
  bool as_is = false, shading = false, mesh_only = false, quiet = false;
};

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

std::string mesh_text(const TouchArguments& a, const touch::Soup& soup, const touch::Mesh& mesh,
                      double scale) {
  constexpr std::size_t most_shown = 8;
  const touch::MeshReport& r = mesh.report;
  std::string s = fmt::format("{}: {} triangles of {} primitives, {} vertices; ", a.glb,
                              r.triangles_read, soup.primitives, r.vertices_read);
  s += a.as_is ? "as in the file\n"
               : fmt::format("scaled by {:.4g} to {:.1f} mm\n", scale, 1e3 * a.size_m);
  if (soup.not_triangles > 0)
    s += fmt::format("  left out: {} primitives of points or lines\n", soup.not_triangles);
  if (soup.skins > 0)
    s += fmt::format("  left out: {} skins; the mesh is in its rest pose\n", soup.skins);
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
  return s;
}

/// What a run was, in numbers.
struct Summary {
  double touching = 0;  ///< share of the poses
  int constraints = 0;
  double depth_m = 0, force_n = 0, median_s = 0, rare_s = 0, tilt_rad = 0, age_s = 0;
};

Summary summary_of(const touch::TouchRun& run) {
  Summary s;
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
  s.tilt_rad = run.result.figures.at("plane_tilt_rad.max");
  s.age_s = run.result.figures.at("plane_age_s.max");
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
  const Summary m = summary_of(run);
  const AxesResult& o = run.result;
  s += fmt::format(
      "\n{} planes at {:g} Hz, {:.0f} % touching, up to {} constraints; {:.0f} arrived, {:.0f} "
      "lost\n",
      u.size(), a.rate_hz, 100 * m.touching, m.constraints, o.figures.at("planes_arrived"),
      o.figures.at("planes_lost"));
  s += fmt::format("depth up to {:.3f} mm, force up to {:.3f} N\n", 1e3 * m.depth_m, m.force_n);
  s += fmt::format("a plane in force is up to {:.1f} ms old and {:.1f} degrees off the newest\n",
                   1e3 * m.age_s, m.tilt_rad * 180 / 3.14159265358979);
  s += fmt::format(
      "an update of the proxy took {:.1f} us in the median, {:.1f} us in all but one of a "
      "thousand, here\n",
      1e6 * m.median_s, 1e6 * m.rare_s);
  for (std::size_t n = 0; n < o.axes.size() && !o.reference.empty(); ++n) {
    s += fmt::format("axis {}: engine off the law in {} by up to {:.3g} uNm, proven {:.3g} uNm\n",
                     n, o.reference, 1e6 * o.axes[n].law_error_nm.max(), 1e6 * o.axes[n].bound_nm);
  }
  s += o.lock_step
           ? fmt::format("RTL and twin: {} mismatches in {} clocks\n", o.mismatches, o.clocks)
           : std::string("the twin alone; --engine all compares it with the RTL in every clock\n");
  for (const std::string& line : o.broken) s += line + "\n";
  return s;
}

nlohmann::ordered_json mesh_json(const TouchArguments& a, const touch::Mesh& mesh, double scale) {
  const touch::MeshReport& r = mesh.report;
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
                           {"turned", r.turned}};
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
  return j;
}

void add_run(nlohmann::ordered_json& j, const touch::TouchRun& run) {
  const Summary m = summary_of(run);
  const AxesResult& o = run.result;
  j["planes"] = run.updates.size();
  j["touching"] = m.touching;
  j["constraints"] = m.constraints;
  j["depth_m"] = m.depth_m;
  j["force_n"] = m.force_n;
  j["plane_age_s"] = m.age_s;
  j["plane_tilt_rad"] = m.tilt_rad;
  j["update_s"] = {{"median", m.median_s}, {"q999", m.rare_s}};
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

/// NAME=STIFFNESS,DAMPING,DRAG of a material of the mesh. Errors: std::invalid_argument.
std::pair<std::string, PlaneMaterial> material_of(const std::string& text,
                                                  const touch::Mesh& mesh) {
  const std::size_t equals = text.rfind('=');
  const std::string name = text.substr(0, equals);
  if (std::find(mesh.materials.begin(), mesh.materials.end(), name) == mesh.materials.end()) {
    throw std::invalid_argument(fmt::format("--material: the mesh has no material {}; it has {}",
                                            name, fmt::join(mesh.materials, ", ")));
  }
  const std::vector<std::string> words =
      CLI::detail::split(equals == std::string::npos ? "" : text.substr(equals + 1), ',');
  constexpr double most[] = {1000, 2, 2};
  double value[3] = {};
  for (std::size_t n = 0; n < 3; ++n) {
    if (words.size() != 3 || !CLI::detail::lexical_cast(words[n], value[n]) ||
        !(value[n] >= 0 && value[n] <= most[n])) {
      throw std::invalid_argument(
          fmt::format("--material {}: not NAME=STIFFNESS,DAMPING,DRAG up to 1000 N/m, 2 N s/m and "
                      "2; write {}=300,0,0",
                      text, name));
    }
  }
  return {name, {value[0], value[1], value[2]}};
}

touch::TouchRequest request_of(const TouchArguments& a, const touch::Mesh& mesh) {
  touch::TouchRequest r;
  r.press_n = a.press_n;
  r.proxy.friction = a.friction;
  r.proxy.shading = a.shading;
  r.host.stiffness_n_m = a.stiffness;
  r.host.damping_ns_m = a.damping;
  r.host.friction = a.drag;
  r.host.rate_hz = a.rate_hz;
  r.host.latency_s = a.latency_s;
  r.host.jitter_s = a.jitter_s;
  r.host.lost = a.lost;
  for (const std::string& text : a.materials) r.materials.insert(material_of(text, mesh));
  r.stroke = a.stroke.empty() ? touch::stroke_over(mesh, touch::TriangleTree(mesh),
                                                   a.press_n > 0 ? 0 : a.depth_m, a.speed_m_s,
                                                   a.press_n > 0 ? 0.5 : 0.9)
                              : touch::read_stroke(a.stroke);
  return r;
}

touch::TouchRun touched(const TouchArguments& a, const touch::Mesh& mesh) {
  AxesScene scene =
      read_axes_scene(find_file("stylus_cube", "vectors/scenes"),
                      [](const std::string& name) { return find_file(name, "vectors/devices"); });
  scene.scenario.name = std::filesystem::path(a.glb).stem().string();
  const DesignInfo info = find_axes_design(own_design(scene))->info();
  const auto law = make_axes_law(find_law(scene.scenario.law), info, axes_of(scene));
  AxesRunOptions options;
  options.design = own_design(scene);
  options.engine = a.engine;
  options.law = law.get();
  Progress progress(scene.scenario.name + " on " + options.design, a.quiet);
  options.progress = [&progress](double done) { progress.update(done); };
  return touch::run_touch(mesh, request_of(a, mesh), scene, options, info.tick_hz);
}

int run(const TouchArguments& a) {
  (void)choose_axes_backends(a.engine);
  files::Outputs outputs;
  outputs.reads(a.glb);
  if (!a.stroke.empty()) outputs.reads(a.stroke);
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* csv = outputs.open("--csv", a.csv);
  touch::Soup soup = touch::read_glb(a.glb);
  touch::Placing placing;
  placing.size_m = a.as_is ? 0 : a.size_m;
  placing.centre_m = {a.centre_m[0], a.centre_m[1], a.centre_m[2]};
  double scale = 1;
  touch::Mesh mesh;
  touch::TouchRun told;
  try {
    scale = touch::place(soup, placing);
    mesh = touch::clean(soup);
    if (!a.mesh_only) told = touched(a, mesh);
  } catch (const std::invalid_argument& error) {
    // Of the stroke's file it already says where.
    if (!a.stroke.empty() && std::string(error.what()).find(a.stroke) == 0) throw;
    throw std::invalid_argument(a.glb + ": " + error.what());
  }
  nlohmann::ordered_json j = mesh_json(a, mesh, scale);
  if (!a.mesh_only) add_run(j, told);
  if (json != nullptr) json->write(j.dump(2) + "\n");
  if (csv != nullptr) write_rows(csv->handle(), told);
  if (!a.quiet)
    outputs.say(mesh_text(a, soup, mesh, scale) + (a.mesh_only ? "" : run_text(a, told)));
  outputs.commit();
  return a.mesh_only || told.result.as_expected() ? exit_ok : exit_failed;
}

void add_options(CLI::App& sub, TouchArguments& a) {
  sub.add_option("glb", a.glb, "binary glTF; all that it needs is inside")
      ->required()
      ->type_name("FILE")
      ->check(checks::no_folder());
  const auto amount = [&](const std::string& name, double& value, const std::string& about,
                          const CLI::Validator& check, const char* type) {
    return sub.add_option(name, value, about)
        ->type_name(type)
        ->transform(check)
        ->capture_default_str();
  };
  CLI::Option* size = amount("--size", a.size_m, "largest side of the mesh",
                             checks::number(1e-3, 2 * touch::reach_m, "m"), "M");
  CLI::Option* centre =
      sub.add_option("--centre", a.centre_m, "its middle, m; x to the right, y away, z up")
          ->type_name("X Y Z")
          ->transform(checks::number(-touch::reach_m, touch::reach_m, "m"))
          ->capture_default_str();
  sub.add_flag("--as-is", a.as_is, "size and place as in the file, in metres")
      ->excludes(size)
      ->excludes(centre);
  sub.add_flag("--mesh-only", a.mesh_only, "what the mesh is, without a stroke");
  CLI::Option* stroke =
      sub.add_option("--stroke", a.stroke,
                     "a hand's way: CSV with time_s,x_m,y_m,z_m; default: over it, left to right")
          ->type_name("FILE")
          ->check(checks::no_folder());
  amount("--depth", a.depth_m, "of the stroke below what is seen from above",
         checks::number(0, 0.02, "m"), "M")
      ->excludes(stroke);
  amount("--speed", a.speed_m_s, "of the stroke", checks::number(0.01, 1, "m/s"), "M/S")
      ->excludes(stroke);
  amount("--press", a.press_n, "the hand presses down with it, in place of a depth",
         checks::number(0, 3.3, "N"), "N")
      ->excludes(stroke);
  amount("--stiffness", a.stiffness, "of the surface", checks::number(0, 1000, "N/m"), "N/M");
  amount("--damping", a.damping, "of the push", checks::number(0, 2, "N s/m"), "NS/M");
  amount("--drag", a.drag, "friction of the law: against the speed, at 100 kHz",
         checks::number(0, 2, ""), "MU");
  sub.add_option("--material", a.materials,
                 "stiffness, damping and drag of the parts of one material; repeat it")
      ->type_name("NAME=N/M,NS/M,MU");
  amount("--friction", a.friction, "friction of the proxy: it stays within the cone, by the host",
         checks::number(0, 2, ""), "MU");
  sub.add_flag("--shading", a.shading, "normals between the corners', so that facets feel round");
  amount("--rate", a.rate_hz, "of the planes", checks::number(10, 10e3, "Hz"), "HZ");
  amount("--latency", a.latency_s, "shortest time from a pose to its plane",
         checks::number(0, 0.1, "s"), "S");
  amount("--jitter", a.jitter_s, "most that comes to it", checks::number(0, 0.1, "s"), "S");
  amount("--lost", a.lost, "share of the planes that are lost", checks::number(0, 0.9, ""),
         "SHARE");
  sub.add_option("--engine", a.engine,
                 "twin, double, quad; all: with the RTL, which takes a minute to build")
      ->type_name("LIST")
      ->capture_default_str();
  sub.add_option("--json", a.json, "the figures as one JSON object")->type_name("FILE");
  sub.add_option("--csv", a.csv, "pen, proxy, normal and force, a row for each plane")
      ->type_name("FILE");
  sub.add_flag("--quiet", a.quiet, "print nothing");
}

}  // namespace

}  // namespace feltgate

int main(int argc, char** argv) {
  using namespace feltgate;
  CLI::App app{"feltgate touch: a mesh under the pen of the stylus"};
  app.name("feltgate");
  app.require_subcommand(1);
  int exit_code = exit_ok;
  CLI::App* sub = app.add_subcommand("touch", "a mesh under the pen of the stylus, in closed loop");
  sub->footer(
      "Reads the mesh, tells what it is, and leads the stylus over it. A proxy (god-object) finds\n"
      "the plane under the pen 1000 times a second; it is sent to the law local_space, which the\n"
      "engine renders at 100 kHz (docs/touch.md). Nothing of the mesh needs to be closed.\n"
      "  feltgate touch part.glb                          over it, 2 mm deep\n"
      "  feltgate touch part.glb --mesh-only              edges, components, genus\n"
      "  feltgate touch part.glb --size 80mm --shading    facets feel round\n"
      "  feltgate touch part.glb --stroke way.csv --csv felt.csv --engine all\n"
      "Exit code: 0 all well, 1 a mismatch or a torque beyond its proven bound, 2 unusable input:\n"
      "no GLB, cut off, empty, not finite, with files beside it, out of reach, or a stroke that\n"
      "begins inside; nothing is written then.");
  TouchArguments a;
  add_options(*sub, a);
  sub->callback([&] {
    if (a.mesh_only && !a.csv.empty())
      throw std::invalid_argument("--csv is of a stroke; leave --mesh-only out");
    exit_code = run(a);
  });
  return run_command_line(app, argc, argv, exit_code);
}
