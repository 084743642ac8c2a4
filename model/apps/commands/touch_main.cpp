// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate touch, a program of its own: nobody else waits for what reads meshes. Documentation:
// docs/touch.md
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/commands/commands.hpp"
#include "apps/commands/host/session.hpp"
#include "apps/commands/touch/touch.hpp"
#include "sim/axes_loop/axes_run.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/touch/make_glb.hpp"

namespace feltgate {

namespace {

/// NAME=STIFFNESS,DAMPING,DRAG of a material of the mesh, with or without ,VIBRATION,FREQUENCY; or
/// NAME=PRESET. Errors: std::invalid_argument.
std::pair<std::string, PlaneMaterial> material_of(const std::string& text, const touch::Mesh& mesh,
                                                  double stiffness_n_m) {
  const std::size_t equals = text.rfind('=');
  const std::string name = text.substr(0, equals);
  if (std::find(mesh.materials.begin(), mesh.materials.end(), name) == mesh.materials.end()) {
    throw std::invalid_argument(fmt::format("--material: the mesh has no material {}; it has {}",
                                            name, fmt::join(mesh.materials, ", ")));
  }
  const std::vector<std::string> words =
      CLI::detail::split(equals == std::string::npos ? "" : text.substr(equals + 1), ',');
  for (const touch::MaterialPreset& preset : touch::material_presets) {
    if (words.size() == 1 && words[0] == preset.name)
      return {name, touch::material_of(preset, stiffness_n_m)};
  }
  constexpr double most[] = {1000, touch::most_damping_ns_m, 2, touch::most_vibration_n,
                             touch::most_frequency_hz};
  double value[5] = {};
  bool good = words.size() == 3 || words.size() == 5;
  for (std::size_t n = 0; good && n < words.size(); ++n) {
    good = CLI::detail::lexical_cast(words[n], value[n]) && value[n] >= 0 && value[n] <= most[n];
  }
  if (!good) {
    throw std::invalid_argument(fmt::format(
        "--material {}: not NAME=STIFFNESS,DAMPING,DRAG up to 1000 N/m, 2 N s/m and 2, nor with "
        ",VIBRATION,FREQUENCY up to 1 N and 250 Hz, and no preset; write {}=300,0,0 or {}=stone",
        text, name, name));
  }
  return {name, {value[0], value[1], value[2], value[3], value[4]}};
}

touch::TouchRequest request_of(const TouchArguments& a, const touch::Mesh& mesh) {
  touch::TouchRequest r = a.request;
  for (const std::string& text : a.materials)
    r.materials.insert(material_of(text, mesh, a.request.host.stiffness_n_m));
  double most_drag = a.request.host.friction;
  for (const auto& [name, material] : r.materials)
    most_drag = std::max(most_drag, material.friction);
  if (a.request.proxy.edges && most_drag > 1)
    throw std::invalid_argument("--edges takes a drag of at most 1, as the law local_edge");
  if (!a.motion.empty()) r.mesh_way = touch::read_stroke(a.motion, true);
  if (!a.board.empty()) return r;
  r.stroke = a.stroke.empty() ? touch::stroke_over(mesh, touch::TriangleTree(mesh),
                                                   a.request.press_n > 0 ? 0 : a.depth_m,
                                                   a.speed_m_s, a.request.press_n > 0 ? 0.5 : 0.9)
                              : touch::read_stroke(a.stroke);
  if (r.stroke.back().time_s < touch::shortest_s(r.host)) {
    throw std::invalid_argument(fmt::format(
        "{}the stroke ends after {:.3g} ms and a plane may take {:.3g} ms to come; make it longer, "
        "or --latency and --jitter shorter",
        a.stroke.empty() ? "" : fmt::format("{}:{}: ", a.stroke, r.stroke.size() + 1),
        1e3 * r.stroke.back().time_s, 1e3 * touch::shortest_s(r.host)));
  }
  return r;
}

touch::TouchRun touched(const TouchArguments& a, const touch::Mesh& mesh,
                        const touch::TouchRequest& request) {
  AxesScene scene = stylus_scene();
  scene.scenario.name = std::filesystem::path(a.glb).stem().string();
  scene.scenario.law = touch::law_of(request);
  const DesignInfo& info = design_named(own_design(scene));
  const auto law = make_axes_law(find_law(scene.scenario.law), info, axes_of(scene));
  AxesRunOptions options;
  options.design = own_design(scene);
  options.engine = a.engine;
  options.law = law.get();
  Progress progress(scene.scenario.name + " on " + options.design, a.quiet);
  options.progress = [&progress](double done) { progress.update(done); };
  return touch::run_touch(mesh, request, scene, options, info.tick_hz);
}

/// Refuses RTL where this program has the twin alone.
void require_engine(const std::string& engine) {
  const std::string lead = choose_axes_backends(engine).lead;
  try {
    (void)make_axes_cores("stylus_law", lead);
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument(fmt::format(
        "--engine {}: this program has the twin alone; ./feltgate touch builds the one with the "
        "RTL, or choose from twin, double and quad",
        engine));
  }
}

/// Puts a mesh with fewer faces in its place. Errors: std::invalid_argument where what is left is
/// no such body.
Decimation decimate(const TouchArguments& a, touch::Mesh& mesh) {
  touch::Mesh few = touch::clean(touch::decimate(mesh, static_cast<std::size_t>(a.faces)));
  Decimation d;
  d.faces = static_cast<std::int64_t>(few.triangles.size());
  d.faces_before = static_cast<std::int64_t>(mesh.triangles.size());
  d.hausdorff_m = touch::hausdorff_m(few, mesh);
  const auto [low, high] = touch::box_of(mesh);
  const plant::Vec3 side = high - low;
  d.share = d.hausdorff_m / std::max({side.x, side.y, side.z});
  d.opened = std::max<std::int64_t>(0, few.report.border_edges - mesh.report.border_edges);
  constexpr double most_share = 0.25;
  if (!(d.share <= most_share) || (d.opened > 0 && d.faces < 4)) {
    throw std::invalid_argument(fmt::format(
        "--faces {}: {} of {} faces would be left, {:.3g} mm away at most; take more faces",
        a.faces, d.faces, d.faces_before, 1e3 * d.hausdorff_m));
  }
  d.jumps = touch::jumps_of(few);
  d.before = touch::jumps_of(mesh);
  d.force_step_n = a.request.host.stiffness_n_m * a.depth_m * 2 * std::sin(d.jumps.most_rad / 2);
  d.file = mesh.report;
  mesh = std::move(few);
  return d;
}

int run(const TouchArguments& a) {
  require_engine(a.engine);
  files::Outputs outputs;
  outputs.reads(a.glb);
  for (const std::string& path : {a.stroke, a.motion}) {
    if (!path.empty()) outputs.reads(path);
  }
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* csv = outputs.open("--csv", a.csv);
  touch::Soup soup = touch::read_glb(a.glb);
  touch::Placing placing;
  placing.size_m = a.as_is ? 0 : a.size_m;
  placing.centre_m = {a.centre_m[0], a.centre_m[1], a.centre_m[2]};
  double scale = 1;
  touch::Mesh mesh;
  std::optional<Decimation> fewer;
  touch::TouchRun told;
  touch::TouchRequest request;
  try {
    scale = touch::place(soup, placing);
    mesh = touch::clean(soup);
    if (a.faces > 0 && static_cast<std::size_t>(a.faces) < mesh.triangles.size())
      fewer = decimate(a, mesh);
    if (!a.mesh_only) request = request_of(a, mesh);
    if (!a.mesh_only && a.board.empty()) told = touched(a, mesh, request);
  } catch (const std::invalid_argument& error) {
    // Of the files of stroke and motion it already says where.
    for (const std::string& path : {a.stroke, a.motion}) {
      if (!path.empty() && std::string(error.what()).find(path) == 0) throw;
    }
    throw std::invalid_argument(a.glb + ": " + error.what());
  }
  const BoardTouch board = a.board.empty() ? BoardTouch{} : touch_board(a, mesh, request);
  nlohmann::ordered_json j = mesh_json(a, mesh, scale, fewer);
  const bool simulated = !a.mesh_only && a.board.empty();
  if (simulated) add_run(j, told);
  if (!a.board.empty()) add_board(j, board);
  if (json != nullptr) json->write(j.dump(2) + "\n");
  if (csv != nullptr) write_rows(csv->handle(), a.board.empty() ? told : board.run);
  if (!a.quiet) {
    outputs.say(mesh_text(a, soup, mesh, scale, fewer) + (simulated ? run_text(a, told) : "") +
                (a.board.empty() ? "" : board_text(board)));
  }
  outputs.commit();
  return !simulated || told.result.as_expected() ? exit_ok : exit_failed;
}

/// With the exit codes of feltgate host for errors of a board and its line.
int guarded(const TouchArguments& a) {
  try {
    return run(a);
  } catch (const host::LinkLost& e) {
    std::fputs(fmt::format("feltgate touch: {}\n", e.what()).c_str(), stderr);
    return host::exit_link;
  } catch (const host::Refused& e) {
    std::fputs(fmt::format("feltgate touch: {}\n", e.what()).c_str(), stderr);
    return exit_failed;
  }
}

/// Writes a mesh in place of reading one.
int make(const TouchArguments& a) {
  files::Outputs outputs;
  files::OutputFile* file = outputs.open("--output", a.out);
  const touch::Soup s = touch::made_mesh(a.make, a.faces > 0 ? a.faces : 1280, a.size_m);
  file->write(touch::glb_of(s, "feltgate touch --make " + a.make));
  if (!a.quiet) {
    outputs.say(fmt::format("{}: {} faces, {} vertices, {:.1f} mm; CC0-1.0\n", a.out,
                            s.triangles.size(), s.at.size(), 1e3 * a.size_m));
  }
  outputs.commit();
  return exit_ok;
}

void add_options(CLI::App& sub, TouchArguments& a) {
  option(sub, "glb", a.glb, "FILE", "binary glTF; all that it needs is inside. Or --make one",
         checks::no_folder());
  CLI::Option* size = defaulted(sub, "--size", a.size_m, "M", "largest side of the mesh",
                                checks::number(1e-3, 2 * touch::reach_m, "m"));
  CLI::Option* centre =
      defaulted(sub, "--centre", a.centre_m, "X Y Z", "its middle, m; x to the right, y away, z up",
                checks::number(-touch::reach_m, touch::reach_m, "m"));
  sub.add_flag("--as-is", a.as_is, "size and place as in the file, in metres")
      ->excludes(size)
      ->excludes(centre);
  defaulted(sub, "--faces", a.faces, "N", "at most so many faces, the others merged; 0: all",
            checks::whole(0, 4000000));
  CLI::Option* out = option(sub, "-o,--output", a.out, "FILE", "the file of --make");
  option(sub, "--make", a.make, "SHAPE",
         "no FILE: write one to touch, ball or torus, of --faces and --size; CC0")
      ->needs(out);
  sub.add_flag("--mesh-only", a.mesh_only, "what the mesh is, without a stroke");
  CLI::Option* stroke =
      option(sub, "--stroke", a.stroke, "FILE",
             "a hand's way: CSV with time_s,x_m,y_m,z_m; default: over it, left to right",
             checks::no_folder());
  option(sub, "--motion", a.motion, "FILE",
         "the mesh moves, turns about a direction by its length, and grows: CSV with "
         "time_s,x_m,y_m,z_m,turn_x_rad,turn_y_rad,turn_z_rad,scale; default: it stands",
         checks::no_folder());
  defaulted(sub, "--depth", a.depth_m, "M", "of the stroke below what is seen from above",
            checks::number(0, 0.02, "m"))
      ->excludes(stroke);
  defaulted(sub, "--speed", a.speed_m_s, "M/S", "of the stroke", checks::number(0.01, 1, "m/s"))
      ->excludes(stroke);
  defaulted(sub, "--press", a.request.press_n, "N",
            "the hand presses down with it, in place of a depth", checks::number(0, 3.3, "N"))
      ->excludes(stroke);
  defaulted(sub, "--stiffness", a.request.host.stiffness_n_m, "N/M", "of the surface",
            checks::number(0, 1000, "N/m"));
  defaulted(sub, "--damping", a.request.host.damping_ns_m, "NS/M", "of the push",
            checks::number(0, 2, "N s/m"));
  defaulted(sub, "--drag", a.request.host.friction, "MU",
            "friction of the law: against the speed, at 100 kHz", checks::number(0, 2, ""));
  option(sub, "--material", a.materials, "NAME=N/M,NS/M,MU",
         "stiffness, damping and drag of the parts of one material, then a vibration if it has "
         "one, N and Hz; or stone, fabric, water, object; repeat it");
  CLI::Option* friction = defaulted(sub, "--friction", a.request.proxy.friction, "MU",
                                    "friction of the proxy: it stays within the cone, by the host",
                                    checks::number(0, 2, ""));
  sub.add_flag("--shading", a.request.proxy.shading,
               "normals between the corners', so that facets feel round");
  sub.add_flag("--edges", a.request.proxy.edges,
               "both planes of an edge, by the law local_edge at 50 kHz: no step at a cube's edge")
      ->excludes(friction);
  defaulted(sub, "--rate", a.request.host.rate_hz, "HZ", "of the planes",
            checks::number(10, 10e3, "Hz"));
  defaulted(sub, "--latency", a.request.host.latency_s, "S",
            "shortest time from a pose to its plane", checks::number(0, 0.1, "s"));
  defaulted(sub, "--jitter", a.request.host.jitter_s, "S", "most that comes to it",
            checks::number(0, 0.1, "s"));
  defaulted(sub, "--lost", a.request.host.lost, "SHARE", "share of the planes that are lost",
            checks::number(0, 0.9, ""));
  CLI::Option* board =
      option(sub, "--board", a.board, "PORT",
             "port of a board with the design stylus_law, or the name that feltgate board "
             "prints: its pen feels the mesh")
          ->excludes(stroke);
  defaulted(sub, "--baud", a.baud, "BAUD", "bits per second at the board, as it was built",
            checks::whole(1200, 4000000))
      ->needs(board);
  option(sub, "--for", a.seconds, "SECONDS", "end at the board after so long; default: Ctrl-C",
         checks::seconds())
      ->needs(board);
  defaulted(sub, "--engine", a.engine, "LIST",
            "twin, double, quad; all: with the RTL, which takes a minute to build");
  option(sub, "--json", a.json, "FILE", "the figures as one JSON object");
  option(sub, "--csv", a.csv, "FILE", "pen, proxy, normal and force, a row for each plane");
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
      R"(Reads the mesh, tells what it is, and leads the stylus over it. A proxy (god-object) finds
the plane under the pen 1000 times a second; it is sent to the law local_space, which the
engine renders at 100 kHz (docs/touch.md). Nothing of the mesh needs to be closed.
  feltgate touch --make ball -o ball.glb           a mesh to begin with
  feltgate touch part.glb                          over it, 2 mm deep
  feltgate touch part.glb --mesh-only              edges, components, genus
  feltgate touch part.glb --size 80mm --shading    facets feel round
  feltgate touch part.glb --faces 8000             merges faces, and says what that changes
  feltgate touch part.glb --stroke way.csv --csv felt.csv --engine all
  feltgate touch part.glb --board /dev/ttyUSB0     a pen on three slides feels it
Exit code: 0 all well, 1 a mismatch or a torque beyond its proven bound, 2 unusable input:
no GLB, cut off, empty, not finite, with files beside it, out of reach, or a stroke that
begins inside; nothing is written then. 3 the line to a board broke down.)");
  TouchArguments a;
  a.request.host.stiffness_n_m = 300;
  a.request.host.latency_s = a.request.host.jitter_s = 1e-3;
  add_options(*sub, a);
  sub->callback([&] {
    if (a.mesh_only && !a.csv.empty())
      throw std::invalid_argument("--csv is of a stroke; leave --mesh-only out");
    for (const char* name : {"--mesh-only", "--depth", "--speed", "--press", "--latency",
                             "--jitter", "--lost", "--engine"}) {
      if (!a.board.empty() && sub->count(name) > 0) {
        throw std::invalid_argument(
            fmt::format("{} is not for a pen at a board; leave it or --board out", name));
      }
    }
    if (a.make.empty() == a.glb.empty() || a.make.empty() != a.out.empty()) {
      throw std::invalid_argument(
          "touch reads a GLB file or makes one; write feltgate touch FILE, or feltgate touch "
          "--make ball -o FILE");
    }
    exit_code = a.make.empty() ? guarded(a) : make(a);
  });
  return run_command_line(app, argc, argv, exit_code);
}
