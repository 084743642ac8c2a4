// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The stylus as the page in the browser calls it. Compiled by Emscripten alone.
// Documentation: docs/page.md
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <string>

#include "apps/page/said.hpp"
#include "apps/page/stylus_loop.hpp"

namespace {

using emscripten::val;
using feltgate::page::said;
using feltgate::plant::Vec3;
namespace page = feltgate::page;

val array_of(Vec3 v) {
  val list = val::array();
  for (const double part : {v.x, v.y, v.z}) list.call<void>("push", part);
  return list;
}

Vec3 vector_of(const val& list) {
  return {list[0].as<double>(), list[1].as<double>(), list[2].as<double>()};
}

double number(const val& of, const char* key) { return of[key].as<double>(); }

/// A pen on three slides in a hand, and a host with a world.
class Stylus {
 public:
  /// `slides`: mass_kg, friction_ns_m, capstan_m.
  Stylus(const std::string& image, const val& slides)
      : loop_(image, {number(slides, "mass_kg"), number(slides, "friction_ns_m"),
                      number(slides, "capstan_m")}) {}
  std::string set(const std::string& name, double value) {
    return said([&] { loop_.set(name, value); });
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
    loop_.touch(world);
  }
  void place(double x_m, double y_m, double z_m) { loop_.place({x_m, y_m, z_m}); }
  void lead(double x_m, double y_m, double z_m) { loop_.lead({x_m, y_m, z_m}); }
  std::string advance(double seconds) {
    return said([&] { loop_.advance(seconds); });
  }
  /// Places, m, speed, m/s, and force, N, as arrays; of the plane that came last its point and
  /// normal, or null; depth, m; tilt, rad; age and time, s.
  val state() const {
    val out = val::object();
    out.set("pen", array_of(loop_.pen_m()));
    out.set("speed", array_of(loop_.velocity_m_s()));
    out.set("hand", array_of(loop_.hand_m()));
    out.set("force", array_of(loop_.force_n()));
    out.set("limited", loop_.limited());
    out.set("depth", loop_.depth_m());
    const auto plane = loop_.plane();
    out.set("point", plane ? array_of(plane->point_m) : val::null());
    out.set("normal", plane ? array_of(plane->normal) : val::null());
    out.set("tilt", loop_.tilt_rad());
    out.set("age", loop_.age_s());
    out.set("time", loop_.time_s());
    out.set("rate_hz", 1 / loop_.law().period_s());
    return out;
  }

 private:
  page::StylusLoop loop_;
};

}  // namespace

EMSCRIPTEN_BINDINGS(feltgate_stylus) {
  emscripten::constant("STYLUS_MOST_N", page::StylusLoop::most_n);
  emscripten::constant("STYLUS_REACH_M", page::StylusLoop::reach_m);
  emscripten::class_<Stylus>("Stylus")
      .constructor<std::string, val>()
      .function("set", &Stylus::set)
      .function("touch", &Stylus::touch)
      .function("place", &Stylus::place)
      .function("lead", &Stylus::lead)
      .function("advance", &Stylus::advance)
      .function("state", &Stylus::state);
}
