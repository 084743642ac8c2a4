// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The functions that the tabs beside the lever's call: devices that run the words of a law without
// a core, and the knob. Only Emscripten compiles it. Documentation: docs/page.md
#include <emscripten/bind.h>

#include <cstdio>
#include <fstream>

#include "apps/page/api.hpp"
#include "apps/page/felt_mesh.hpp"
#include "apps/page/knob_loop.hpp"
#include "apps/page/law_loop.hpp"
#include "apps/page/recorded_inputs.hpp"
#include "sim/plant/plant_file.hpp"

namespace {

using namespace feltgate::page;
using feltgate::Plane;
using feltgate::PlaneHostSettings;
using feltgate::plant::Quaternion;
using feltgate::plant::Vec3;
namespace touch = feltgate::touch;

val of_vector(Vec3 v) { return array_of({v.x, v.y, v.z}); }
val of_quaternion(const Quaternion& q) { return array_of({q.w, q.x, q.y, q.z}); }
double number(const val& of, const char* key) { return of[key].as<double>(); }
Vec3 vector_of(const val& list) {
  return {list[0].as<double>(), list[1].as<double>(), list[2].as<double>()};
}
StateWord word_of(const val& of) { return {of["address"].as<int>(), number(of, "scale")}; }

/// What every device has: set(name, value) and advance(seconds), which return an error or nothing.
template <class Loop>
std::string set(Loop& loop, const std::string& name, double value) {
  return said([&] { loop.set(name, value); });
}
template <class Loop>
std::string advance(Loop& loop, double seconds) {
  return said([&] { loop.advance(seconds); });
}
template <class Loop>
emscripten::class_<Loop> device(const char* name) {
  emscripten::class_<Loop> made(name);
  made.function("set", &set<Loop>).function("advance", &advance<Loop>);
  return made;
}
/// And its state: time, s, rate of the law, and more.
template <class Loop, class... Parts>
val state(const Loop& loop, const Parts&... parts) {
  return object("time", loop.time_s(), "rate_hz", 1 / loop.law().period_s(), parts...);
}

LeverLoop* new_stick(const std::string& image) { return new LeverLoop(image, Lever::stick()); }
/// `heard`: where the image keeps what comes to the bridge.
LeverLoop* new_bow(const std::string& image, const val& heard) {
  auto bow = std::make_unique<LeverLoop>(image, Lever::bow());
  bow->watched = word_of(heard);
  return bow.release();
}
/// Angles, rad; speed, rad/s; torque of the law, Nm, now and in the mean of the last advance();
/// what the law told in that.
val lever_state(const LeverLoop& l) {
  const auto told = [](const Told& t) {
    return object("name", t.name, "value", t.value, "time", t.time_s);
  };
  return state(l, "theta", l.at(), "hand", l.hand(), "speed", l.speed(), "torque", l.force(),
               "mean_torque", l.mean_force(), "counts", l.law().counts(0), "events",
               array_of(l.told(), told));
}
/// What was watched in the last advance(), a value each run; valid until the next call.
val lever_watched(const LeverLoop& l) {
  return val(emscripten::typed_memory_view(l.seen().size(), l.seen().data()));
}

CoupledLoop* new_levers(const std::string& image, double inertia_kg_m2) {
  return new CoupledLoop(image, TwoLevers(inertia_kg_m2));
}
void meet(CoupledLoop& l, int what, double strength) {
  l.met = static_cast<Met>(what);
  l.strength = strength;
}
/// Of the lever that is held.
void lead_lever(CoupledLoop& l, double rad) {
  const feltgate::shape::Point at = l.wanted();
  l.lead(l.second_is_held ? feltgate::shape::Point{at.x, rad} : feltgate::shape::Point{rad, at.y});
}
/// Angles, rad, and torques of the law, Nm, of both; which one the hand holds, and where it is;
/// what the second one is given by what it meets, Nm.
val levers_state(const CoupledLoop& l) {
  return state(l, "theta", array_of({l.at().x, l.at().y}), "torque",
               array_of({l.force().x, l.force().y}), "held", l.second_is_held ? 1 : 0, "hand",
               l.second_is_held ? l.hand().y : l.hand().x, "met", l.met_nm);
}

/// Places of pen and hand, m; force on the pen, N; counts of the joints.
val pen_state(const PenLoop& l) {
  return state(l, "x", l.at().x, "y", l.at().y, "hand_x", l.hand().x, "hand_y", l.hand().y,
               "force_x", l.force().x, "force_y", l.force().y, "counts_1", l.law().counts(0),
               "counts_5", l.law().counts(1));
}

/// `body`: of the states w, x, y, z their {address, scale} in the image.
GimbalLoop* new_gimbal(const std::string& image, const val& body) {
  return new GimbalLoop(
      image, Handle({word_of(body[0]), word_of(body[1]), word_of(body[2]), word_of(body[3])}));
}
/// Orientations as w, x, y, z; torque on the handle, Nm; twist, rad.
val gimbal_state(const GimbalLoop& l) {
  return state(l, "hand", of_quaternion(l.hand()), "handle", of_quaternion(l.at()), "body",
               of_quaternion(body_of(l)), "torque", of_vector(l.force()), "twist", twist_rad(l));
}

/// Of the bytes of a GLB file, or without a name the knob. The importer reads files: here one in
/// the memory, under the name that it will say.
touch::Soup soup_of(const std::string& name, const std::string& bytes) {
  if (name.empty()) return knob_mesh();
  std::ofstream(name, std::ios::binary) << bytes;
  const std::unique_ptr<const char, int (*)(const char*)> removed(name.c_str(), &std::remove);
  return touch::read_glb(name);
}

/// stroke_hash() of the knob.
std::string planes_hash() { return hex(touch::stroke_hash(touch::clean(knob_mesh()))); }

/// A stylus that feels a world, or a mesh.
struct FeltLoop : StylusLoop {
  using StylusLoop::StylusLoop;
  std::string images[2];  ///< of local_space and local_edge
  bool edges = false;
  std::shared_ptr<FeltMesh> felt;
};
/// `slides`: mass_kg, friction_ns_m, capstan_m.
FeltLoop* new_stylus(const std::string& image, const std::string& of_edges, const val& slides) {
  Stylus body;
  body.own_kg = number(slides, "mass_kg");
  body.own_ns_m = number(slides, "friction_ns_m");
  body.capstan_m = number(slides, "capstan_m");
  auto loop = std::make_unique<FeltLoop>(image, body);
  loop->images[0] = image;
  loop->images[1] = of_edges;
  return loop.release();
}
/// `w`: kind, a number of PlaneHostSettings::World; centre, m; radius_m; stiffness_n_m,
/// damping_ns_m, friction; rate_hz and age_s of its planes.
void touch_world(FeltLoop& l, const val& w) {
  PlaneHostSettings world;
  world.axes = 3;
  world.world = static_cast<PlaneHostSettings::World>(w["kind"].as<int>());
  world.centre_m = vector_of(w["centre"]);
  world.radius_m = number(w, "radius_m");
  world.stiffness_n_m = number(w, "stiffness_n_m");
  world.damping_ns_m = number(w, "damping_ns_m");
  world.friction = number(w, "friction");
  world.rate_hz = number(w, "rate_hz");
  world.latency_s = number(w, "age_s");
  world.edges = l.edges;
  if (l.felt) {
    world.search = [felt = l.felt, material = feltgate::PlaneMaterial(world)](Vec3 pen_m) {
      return std::pair{felt->move(pen_m), material};
    };
  }
  l.touch(world);
}
/// From the next touch() on a mesh is felt: the bytes of a GLB file, its largest side `size_m`;
/// without a name, the knob. Returns what it is, or {error}, which changes nothing. The next call
/// is place().
val load_mesh(FeltLoop& l, const std::string& name, const std::string& bytes, double size_m) {
  val out = val::object();
  const std::string error = said([&] {
    touch::Soup soup = soup_of(name, bytes);
    out.set("scale", touch::place(soup, {size_m, {}}));
    l.felt = std::make_shared<FeltMesh>(touch::clean(soup));
    l.felt->proxy.tell_edges(l.edges);
  });
  out.set("error", error);
  if (!error.empty()) return out;
  const touch::MeshReport& r = l.felt->mesh.report;
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  const bool one = r.components.size() == 1 && r.components[0].genus();
  add_to(out, "faces", count(l.felt->mesh.triangles.size()), "read", count(r.triangles_read),
         "parts", count(r.components.size()), "borders", count(r.border_edges), "nonmanifold",
         count(r.nonmanifold_edges), "genus",
         one ? val(static_cast<double>(*r.components[0].genus())) : val::null());
  return out;
}
/// No mesh is felt from the next touch() on.
void unload_mesh(FeltLoop& l) { l.felt.reset(); }
void shade(FeltLoop& l, bool on) {
  if (l.felt) l.felt->proxy.shade(on);
}
/// Both planes of an edge of a cube or a mesh, by the other law; the next call is touch().
void tell_edges(FeltLoop& l, bool on) {
  if (on == l.edges) return;
  l.edges = on;
  l.load(l.images[on ? 1 : 0]);
  if (l.felt) l.felt->proxy.tell_edges(on);
}
/// Of each triangle its corners, m, then their normals: a Float32Array of 18 each.
val triangles(const FeltLoop& l) {
  std::vector<float> all;
  for (std::size_t n = 0; l.felt && n < l.felt->mesh.triangles.size(); ++n) {
    const auto add = [&](Vec3 v) {
      for (const double part : {v.x, v.y, v.z}) all.push_back(static_cast<float>(part));
    };
    for (const std::uint32_t corner : l.felt->mesh.triangles[n]) add(l.felt->mesh.at[corner]);
    for (const Vec3& normal : l.felt->mesh.normals[n]) add(normal);
  }
  return val::global("Float32Array").new_(emscripten::typed_memory_view(all.size(), all.data()));
}
/// Returns an error where a mesh is felt and the place is in it; the pen then stays.
std::string place_stylus(FeltLoop& l, double x_m, double y_m, double z_m) {
  return said([&] {
    if (l.felt) l.felt->begin({x_m, y_m, z_m});
    l.place({x_m, y_m, z_m});
  });
}
/// Places, m, speed, m/s, and force, N, as arrays; of the plane that came last its point and
/// normal, or null; depth, m; tilt, rad; age, s.
val stylus_state(const FeltLoop& l) {
  const auto plane = l.plane();
  const auto of_plane = [&](bool is, Vec3 Plane::*part) {
    return is ? of_vector((*plane).*part) : val::null();
  };
  const bool edge = plane && plane->edge(), on_mesh = l.felt && l.felt->touched.touching;
  return state(l, "pen", of_vector(l.at()), "speed", of_vector(l.speed()), "hand",
               of_vector(l.hand()), "force", of_vector(l.force()), "limited", l.limited, "depth",
               l.felt ? l.felt->touched.depth_m : l.depth_m(), "proxy",
               on_mesh ? of_vector(l.felt->touched.proxy_m) : val::null(), "point",
               of_plane(plane.has_value(), &Plane::point_m), "normal",
               of_plane(plane.has_value(), &Plane::normal), "tilt", l.tilt_rad(), "second_point",
               of_plane(edge, &Plane::second_point_m), "second", of_plane(edge, &Plane::second),
               "age", l.age_s());
}

/// The knob on a motor of three phases.
KnobLoop* new_knob() {
  return new KnobLoop(feltgate::plant::read_plant_file("/plants/gimbal_motor.toml"));
}
std::string detents(KnobLoop& l, double pitch_rad, double peak_nm) {
  return said([&] { l.detents(pitch_rad, peak_nm); });
}
std::string offset(KnobLoop& l, double turns) {
  return said([&] { l.offset(turns); });
}
/// The samples of the last advance() as one array of doubles; valid until the next call.
val knob_samples(const KnobLoop& l) { return view_of<knob_sample_values>(l.samples()); }
/// Angles, rad; of the core and of the rotor the electrical ones, turns; on-times of the legs as
/// shares of a period; currents of the phases, A; torques, Nm; time, s.
val knob_state(const KnobLoop& l) {
  const KnobCore& core = l.core();
  const auto& seen = l.plant().observables();
  const auto on = [&](std::int16_t clocks) {
    return clocks / static_cast<double>(core.design().pwm_period);
  };
  const double rotor_rad = l.plant().motor().electrical_rad(seen.theta_rad);
  return object("theta", seen.theta_rad, "hand", l.hand_rad(), "detent", l.detent_rad(),
                "electrical", core.electrical_turns(l.position()), "rotor",
                rotor_rad / 6.283185307179586, "offset", core.offset_turns(), "pole_pairs",
                l.pole_pairs(), "amplitude", static_cast<int>(core.raw().duty), "gates",
                core.gates(), "on", array_of(core.on_clocks(), on), "current",
                array_of(l.plant().motor().phase_a(), [](double a) { return a; }), "asked",
                core.out().tau_ref_nm, "torque", seen.motor_torque_nm, "bus", seen.bus_v, "time",
                l.time_s());
}

}  // namespace

EMSCRIPTEN_BINDINGS(feltgate_tabs) {
  using emscripten::allow_raw_pointers;
  device<LeverLoop>("Lever")
      .class_function("stick", &new_stick, allow_raw_pointers())
      .class_function("bow", &new_bow, allow_raw_pointers())
      .function(
          "lead", +[](LeverLoop& l, double rad) { l.lead(rad); })
      .function("draw", &draw)
      .function("state", &lever_state)
      .function("watched", &lever_watched);
  emscripten::constant("COUPLED_WALL_RAD", TwoLevers::wall_rad);
  emscripten::constant("COUPLED_MOST_RAD", TwoLevers::most_rad);
  device<CoupledLoop>("Coupled")
      .constructor(&new_levers, allow_raw_pointers())
      .function("hold", &hold)
      .function("meet", &meet)
      .function("lead", &lead_lever)
      .function("state", &levers_state);
  device<PenLoop>("Pen")
      .constructor<std::string>()
      .function(
          "load",
          +[](PenLoop& l, const std::string& image) { return said([&] { l.load(image); }); })
      .function(
          "place",
          +[](PenLoop& l, double x_m, double y_m) {
            l.place({x_m, y_m});
          })
      .function(
          "lead",
          +[](PenLoop& l, double x_m, double y_m) {
            l.lead({x_m, y_m});
          })
      .function("state", &pen_state);
  device<GimbalLoop>("Gimbal")
      .constructor(&new_gimbal, allow_raw_pointers())
      .function(
          "turn",
          +[](GimbalLoop& l, double x, double y, double z) {
            turn(l, {x, y, z});
          })
      .function("state", &gimbal_state);
  emscripten::function("planesHash", &planes_hash);
  emscripten::constant("STYLUS_MOST_N", Stylus::most_n);
  device<FeltLoop>("Stylus")
      .constructor(&new_stylus, allow_raw_pointers())
      .function("touch", &touch_world)
      .function("load", &load_mesh)
      .function("unload", &unload_mesh)
      .function("shade", &shade)
      .function("tellEdges", &tell_edges)
      .function("triangles", &triangles)
      .function("place", &place_stylus)
      .function(
          "lead",
          +[](FeltLoop& l, double x, double y, double z) {
            l.lead({x, y, z});
          })
      .function("state", &stylus_state);
  emscripten::constant("KNOB_MOST_RAD", KnobLoop::most_rad);
  emscripten::class_<KnobLoop>("Knob")
      .constructor(&new_knob, allow_raw_pointers())
      .function("advance", &advance<KnobLoop>)
      .function("detents", &detents)
      .function("offset", &offset)
      .function("arm", &KnobLoop::arm)
      .function("hold", &KnobLoop::hold)
      .function("lead", &KnobLoop::lead)
      .function("samples", &knob_samples)
      .function("state", &knob_state);
}
