// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The functions that the tabs of three axes call: a stylus on planes and meshes, a gimbal. Only
// Emscripten compiles it. Documentation: docs/page.md
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/page/felt_mesh.hpp"
#include "apps/page/law_loops.hpp"
#include "apps/page/recorded_inputs.hpp"
#include "apps/page/said.hpp"

namespace {

using emscripten::val;
using feltgate::plant::Quaternion;
using feltgate::plant::Vec3;
namespace page = feltgate::page;
namespace touch = feltgate::touch;
using page::said;

/// Of the bytes of a GLB file, or without a name the knob. The importer reads files: here one in
/// the memory, under the name that it will say.
touch::Soup soup_of(const std::string& name, const std::string& bytes) {
  if (name.empty()) return page::knob_mesh();
  std::ofstream(name, std::ios::binary) << bytes;
  const std::unique_ptr<const char, int (*)(const char*)> removed(name.c_str(), &std::remove);
  return touch::read_glb(name);
}

/// stroke_hash() of such a mesh, its largest side `size_m`; "error: ..." where there is none.
std::string planes_hash(const std::string& name, const std::string& bytes, double size_m) {
  std::string out;
  const std::string error = said([&] {
    touch::Soup soup = soup_of(name, bytes);
    if (!name.empty()) touch::place(soup, {size_m, {}});
    out = page::hex(touch::stroke_hash(touch::clean(soup)));
  });
  return error.empty() ? out : "error: " + error;
}

val array_of(std::initializer_list<double> parts) {
  val list = val::array();
  for (const double part : parts) list.call<void>("push", part);
  return list;
}
val array_of(Vec3 v) { return array_of({v.x, v.y, v.z}); }
val array_of(const Quaternion& q) { return array_of({q.w, q.x, q.y, q.z}); }
Vec3 vector_of(const val& list) {
  return {list[0].as<double>(), list[1].as<double>(), list[2].as<double>()};
}

double number(const val& of, const char* key) { return of[key].as<double>(); }
page::StateWord word(const val& of) { return {of["address"].as<int>(), number(of, "scale")}; }

/// A pen on three slides in a hand, and a host with a world.
class Stylus {
 public:
  /// `image` of local_space, `of_edges` of local_edge; `slides`: mass_kg, friction_ns_m, capstan_m.
  Stylus(const std::string& image, const std::string& of_edges, const val& slides)
      : images_{image, of_edges},
        slides_{number(slides, "mass_kg"), number(slides, "friction_ns_m"),
                number(slides, "capstan_m")},
        loop_(std::make_unique<page::StylusLoop>(image, slides_)) {}
  std::string set(const std::string& name, double value) {
    return said([&] { loop_->set(name, value); });
  }
  /// `w`: kind, a number of PlaneHostSettings::World; centre, m; radius_m; stiffness_n_m,
  /// damping_ns_m, friction; rate_hz and age_s of its planes.
  void touch(const val& w) {
    feltgate::PlaneHostSettings world;
    world.axes = 3;
    world.world = static_cast<feltgate::PlaneHostSettings::World>(w["kind"].as<int>());
    world.centre_m = vector_of(w["centre"]);
    world.radius_m = number(w, "radius_m");
    world.stiffness_n_m = number(w, "stiffness_n_m");
    world.damping_ns_m = number(w, "damping_ns_m");
    world.friction = number(w, "friction");
    world.rate_hz = number(w, "rate_hz");
    world.latency_s = number(w, "age_s");
    world.edges = edges_;
    if (felt_) {
      world.search = [felt = felt_, material = feltgate::PlaneMaterial(world)](Vec3 pen_m) {
        return std::pair{felt->move(pen_m), material};
      };
    }
    loop_->touch(world);
  }
  /// From the next touch() on a mesh is felt: the bytes of a GLB file, its largest side `size_m`;
  /// without a name, the knob. Returns what it is, or {error}, which changes nothing. The next call
  /// is place().
  val load(const std::string& name, const std::string& bytes, double size_m) {
    val out = val::object();
    out.set("error", said([&] {
              touch::Soup soup = soup_of(name, bytes);
              out.set("scale", touch::place(soup, {size_m, {}}));
              felt_ = std::make_shared<page::FeltMesh>(touch::clean(soup));
              felt_->tell_edges(edges_);
            }));
    if (!out["error"].as<std::string>().empty()) return out;
    const touch::MeshReport& r = felt_->mesh().report;
    out.set("faces", static_cast<double>(felt_->mesh().triangles.size()));
    out.set("read", static_cast<double>(r.triangles_read));
    out.set("parts", static_cast<double>(r.components.size()));
    out.set("borders", static_cast<double>(r.border_edges));
    out.set("nonmanifold", static_cast<double>(r.nonmanifold_edges));
    const bool one = r.components.size() == 1 && r.components[0].genus();
    out.set("genus", one ? val(static_cast<double>(*r.components[0].genus())) : val::null());
    return out;
  }
  /// No mesh is felt from the next touch() on.
  void unload() { felt_.reset(); }
  void shade(bool on) {
    if (felt_) felt_->shade(on);
  }
  /// Both planes of an edge of a cube or a mesh, by the other law; the next call is touch().
  void tell_edges(bool on) {
    if (on == edges_) return;
    edges_ = on;
    const Vec3 pen_m = loop_->pen_m(), hand_m = loop_->hand_m();
    loop_ = std::make_unique<page::StylusLoop>(images_[on ? 1 : 0], slides_);
    loop_->place(pen_m);
    loop_->lead(hand_m);
    if (felt_) felt_->tell_edges(on);
  }
  /// Of each triangle its corners, m, then their normals: a Float32Array of 18 each.
  val triangles() const {
    std::vector<float> all;
    for (std::size_t n = 0; felt_ && n < felt_->mesh().triangles.size(); ++n) {
      const auto add = [&](Vec3 v) {
        for (const double part : {v.x, v.y, v.z}) all.push_back(static_cast<float>(part));
      };
      for (const std::uint32_t corner : felt_->mesh().triangles[n]) add(felt_->mesh().at[corner]);
      for (const Vec3& normal : felt_->mesh().normals[n]) add(normal);
    }
    return val::global("Float32Array").new_(emscripten::typed_memory_view(all.size(), all.data()));
  }
  /// Returns an error where a mesh is felt and the place is in it; the pen then stays.
  std::string place(double x_m, double y_m, double z_m) {
    return said([&] {
      if (felt_) felt_->begin({x_m, y_m, z_m});
      loop_->place({x_m, y_m, z_m});
    });
  }
  void lead(double x_m, double y_m, double z_m) { loop_->lead({x_m, y_m, z_m}); }
  std::string advance(double seconds) {
    return said([&] { loop_->advance(seconds); });
  }
  /// Places, m, speed, m/s, and force, N, as arrays; of the plane that came last its point and
  /// normal, or null; depth, m; tilt, rad; age and time, s.
  val state() const {
    val out = val::object();
    out.set("pen", array_of(loop_->pen_m()));
    out.set("speed", array_of(loop_->velocity_m_s()));
    out.set("hand", array_of(loop_->hand_m()));
    out.set("force", array_of(loop_->force_n()));
    out.set("limited", loop_->limited());
    out.set("depth", felt_ ? felt_->touched().depth_m : loop_->depth_m());
    out.set("proxy",
            felt_ && felt_->touched().touching ? array_of(felt_->touched().proxy_m) : val::null());
    const auto plane = loop_->plane();
    out.set("point", plane ? array_of(plane->point_m) : val::null());
    out.set("normal", plane ? array_of(plane->normal) : val::null());
    out.set("tilt", loop_->tilt_rad());
    const bool edge = plane && plane->edge();
    out.set("second_point", edge ? array_of(plane->second_point_m) : val::null());
    out.set("second", edge ? array_of(plane->second) : val::null());
    out.set("age", loop_->age_s());
    out.set("hollow", loop_->steady_hollow_m());
    out.set("time", loop_->time_s());
    out.set("rate_hz", 1 / loop_->law().period_s());
    return out;
  }

 private:
  const std::string images_[2];
  const page::StylusSlides slides_;
  std::unique_ptr<page::StylusLoop> loop_;
  bool edges_ = false;
  std::shared_ptr<page::FeltMesh> felt_;
};

/// A handle that turns about three axes, and a body behind it.
class Gimbal {
 public:
  /// `body`: of the states w, x, y, z their {address, scale} in the image.
  Gimbal(const std::string& image, const val& body)
      : loop_(image, {word(body[0]), word(body[1]), word(body[2]), word(body[3])}) {}
  std::string set(const std::string& name, double value) {
    return said([&] { loop_.set(name, value); });
  }
  void turn(double x_rad, double y_rad, double z_rad) { loop_.turn({x_rad, y_rad, z_rad}); }
  std::string advance(double seconds) {
    return said([&] { loop_.advance(seconds); });
  }
  /// Orientations as w, x, y, z; torque on the handle, Nm; twist, rad; time, s.
  val state() const {
    val out = val::object();
    out.set("hand", array_of(loop_.hand()));
    out.set("handle", array_of(loop_.handle()));
    out.set("body", array_of(loop_.body()));
    out.set("torque", array_of(loop_.torque_nm()));
    out.set("twist", loop_.twist_rad());
    out.set("time", loop_.time_s());
    out.set("rate_hz", 1 / loop_.law().period_s());
    return out;
  }

 private:
  page::GimbalLoop loop_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(feltgate_space) {
  emscripten::function("planesHash", &planes_hash);
  emscripten::class_<Gimbal>("Gimbal")
      .constructor<std::string, val>()
      .function("set", &Gimbal::set)
      .function("turn", &Gimbal::turn)
      .function("advance", &Gimbal::advance)
      .function("state", &Gimbal::state);
  emscripten::constant("STYLUS_MOST_N", page::StylusLoop::most_n);
  emscripten::constant("STYLUS_REACH_M", page::StylusLoop::reach_m);
  emscripten::class_<Stylus>("Stylus")
      .constructor<std::string, std::string, val>()
      .function("set", &Stylus::set)
      .function("touch", &Stylus::touch)
      .function("load", &Stylus::load)
      .function("unload", &Stylus::unload)
      .function("shade", &Stylus::shade)
      .function("tellEdges", &Stylus::tell_edges)
      .function("triangles", &Stylus::triangles)
      .function("place", &Stylus::place)
      .function("lead", &Stylus::lead)
      .function("advance", &Stylus::advance)
      .function("state", &Stylus::state);
}
