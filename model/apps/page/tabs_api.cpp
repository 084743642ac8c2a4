// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The functions that the page's other tabs call: devices that run the words of a law without a
// core. Only Emscripten compiles it. Documentation: docs/page.md
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/page/coupled_loop.hpp"
#include "apps/page/felt_mesh.hpp"
#include "apps/page/gimbal_loop.hpp"
#include "apps/page/pen_loop.hpp"
#include "apps/page/said.hpp"
#include "apps/page/stick_loop.hpp"
#include "apps/page/string_loop.hpp"
#include "apps/page/stylus_loop.hpp"

namespace {

using emscripten::val;
using feltgate::plant::Quaternion;
using feltgate::plant::Vec3;
namespace page = feltgate::page;
namespace touch = feltgate::touch;
using page::said;

/// Of the bytes of a GLB file, or without a name the knob.
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

/// The pen of the pantograph in a hand, and a law's image that pushes it.
class Pen {
 public:
  explicit Pen(const std::string& image) : loop_(image) {}
  std::string load(const std::string& image) {
    return said([&] { loop_.load(image); });
  }
  std::string set(const std::string& name, double value) {
    return said([&] { loop_.set(name, value); });
  }
  void place(double x_m, double y_m) { loop_.place({x_m, y_m}); }
  void lead(double x_m, double y_m) { loop_.lead({x_m, y_m}); }
  std::string advance(double seconds) {
    return said([&] { loop_.advance(seconds); });
  }
  /// Places of pen and hand, m; force on the pen, N; counts of the joints; time, s.
  val state() const {
    val out = val::object();
    out.set("x", loop_.pen_m().x);
    out.set("y", loop_.pen_m().y);
    out.set("hand_x", loop_.hand_m().x);
    out.set("hand_y", loop_.hand_m().y);
    out.set("force_x", loop_.force_n().x);
    out.set("force_y", loop_.force_n().y);
    out.set("counts_1", loop_.law().counts(0));
    out.set("counts_5", loop_.law().counts(1));
    out.set("time", loop_.time_s());
    out.set("rate_hz", 1 / loop_.law().period_s());
    return out;
  }

 private:
  page::PenLoop loop_;
};

/// A stick over drums.
class Stick {
 public:
  explicit Stick(const std::string& image) : loop_(image) {}
  std::string set(const std::string& name, double value) {
    return said([&] { loop_.set(name, value); });
  }
  void lead(double theta_rad) { loop_.lead(theta_rad); }
  std::string advance(double seconds) {
    return said([&] { loop_.advance(seconds); });
  }
  /// Angles, rad; torque of the law, Nm; what it told in the last advance().
  val state() const {
    val out = val::object(), events = val::array();
    out.set("theta", loop_.theta_rad());
    out.set("hand", loop_.hand_rad());
    out.set("torque", loop_.torque_nm());
    out.set("counts", loop_.law().counts(0));
    out.set("time", loop_.time_s());
    out.set("rate_hz", 1 / loop_.law().period_s());
    for (const page::StickEvent& e : loop_.events()) {
      val one = val::object();
      one.set("name", e.name);
      one.set("value", e.value);
      one.set("time", e.time_s);
      events.call<void>("push", one);
    }
    out.set("events", events);
    return out;
  }

 private:
  page::StickLoop loop_;
};

/// Two levers that a law couples.
class Coupled {
 public:
  Coupled(const std::string& image, double inertia_kg_m2) : loop_(image, inertia_kg_m2) {}
  std::string set(const std::string& name, double value) {
    return said([&] { loop_.set(name, value); });
  }
  std::string hold(int lever) {
    return said([&] { loop_.hold(lever); });
  }
  std::string meet(int what, double strength) {
    return said([&] { loop_.meet(static_cast<page::Met>(what), strength); });
  }
  void lead(double theta_rad) { loop_.lead(theta_rad); }
  std::string advance(double seconds) {
    return said([&] { loop_.advance(seconds); });
  }
  /// Angles, rad, and torques of the law, Nm, of both; which one the hand holds, and where it is;
  /// what the second one is given by what it meets, Nm.
  val state() const {
    val out = val::object(), theta = val::array(), torque = val::array();
    for (int n = 0; n < 2; ++n) {
      theta.call<void>("push", loop_.theta_rad(n));
      torque.call<void>("push", loop_.torque_nm(n));
    }
    out.set("theta", theta);
    out.set("torque", torque);
    out.set("held", loop_.held());
    out.set("hand", loop_.hand_rad());
    out.set("met", loop_.met_nm());
    out.set("time", loop_.time_s());
    out.set("rate_hz", 1 / loop_.law().period_s());
    return out;
  }

 private:
  page::CoupledLoop loop_;
};

/// A lever that bows a string.
class BowString {
 public:
  /// An image, and where it keeps what comes to the bridge.
  BowString(const std::string& image, int heard_address, double heard_scale)
      : loop_(image, {heard_address, heard_scale}) {}
  std::string set(const std::string& name, double value) {
    return said([&] { loop_.set(name, value); });
  }
  void lead(double theta_rad) { loop_.lead(theta_rad); }
  void draw(double bow_m_s) { loop_.draw(bow_m_s); }
  std::string advance(double seconds) {
    return said([&] { loop_.advance(seconds); });
  }
  /// Angles, rad; speed, rad/s; torque of the law, Nm, now and in the
  /// mean of the last advance(); slips of the last advance(), s.
  val state() const {
    val out = val::object(), slips = val::array();
    out.set("theta", loop_.theta_rad());
    out.set("hand", loop_.hand_rad());
    out.set("speed", loop_.speed_rad_s());
    out.set("torque", loop_.torque_nm());
    out.set("mean_torque", loop_.mean_nm());
    out.set("time", loop_.time_s());
    out.set("rate_hz", 1 / loop_.law().period_s());
    for (const page::StringSlip& s : loop_.slips()) {
      val one = val::object();
      one.set("time", s.time_s);
      one.set("since", s.since_s);
      slips.call<void>("push", one);
    }
    out.set("slips", slips);
    return out;
  }
  /// What came to the bridge in the last advance(), m/s, a value each run: a Float32Array that is
  /// valid until the next call.
  val heard() const {
    return val(emscripten::typed_memory_view(loop_.heard_m_s().size(), loop_.heard_m_s().data()));
  }

 private:
  page::StringLoop loop_;
};

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
    if (felt_) {
      world.search = [felt = felt_, material = feltgate::PlaneMaterial(world)](Vec3 pen_m) {
        return std::pair{felt->move(pen_m), material};
      };
    }
    loop_.touch(world);
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
      loop_.place({x_m, y_m, z_m});
    });
  }
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
    out.set("depth", felt_ ? felt_->touched().depth_m : loop_.depth_m());
    out.set("proxy",
            felt_ && felt_->touched().touching ? array_of(felt_->touched().proxy_m) : val::null());
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
  /// The importer reads files, here one in the memory, under the name that it will say.
  page::StylusLoop loop_;
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

EMSCRIPTEN_BINDINGS(feltgate_tabs) {
  emscripten::function("planesHash", &planes_hash);
  emscripten::class_<Pen>("Pen")
      .constructor<std::string>()
      .function("load", &Pen::load)
      .function("set", &Pen::set)
      .function("place", &Pen::place)
      .function("lead", &Pen::lead)
      .function("advance", &Pen::advance)
      .function("state", &Pen::state);
  emscripten::class_<Stick>("Stick")
      .constructor<std::string>()
      .function("set", &Stick::set)
      .function("lead", &Stick::lead)
      .function("advance", &Stick::advance)
      .function("state", &Stick::state);
  emscripten::constant("COUPLED_WALL_RAD", page::CoupledLoop::wall_rad);
  emscripten::constant("COUPLED_MOST_RAD", page::CoupledLoop::most_rad);
  emscripten::class_<Coupled>("Coupled")
      .constructor<std::string, double>()
      .function("set", &Coupled::set)
      .function("hold", &Coupled::hold)
      .function("meet", &Coupled::meet)
      .function("lead", &Coupled::lead)
      .function("advance", &Coupled::advance)
      .function("state", &Coupled::state);
  emscripten::class_<BowString>("BowString")
      .constructor<std::string, int, double>()
      .function("set", &BowString::set)
      .function("lead", &BowString::lead)
      .function("draw", &BowString::draw)
      .function("advance", &BowString::advance)
      .function("state", &BowString::state)
      .function("heard", &BowString::heard);
  emscripten::class_<Gimbal>("Gimbal")
      .constructor<std::string, val>()
      .function("set", &Gimbal::set)
      .function("turn", &Gimbal::turn)
      .function("advance", &Gimbal::advance)
      .function("state", &Gimbal::state);
  emscripten::constant("STYLUS_MOST_N", page::StylusLoop::most_n);
  emscripten::constant("STYLUS_REACH_M", page::StylusLoop::reach_m);
  emscripten::class_<Stylus>("Stylus")
      .constructor<std::string, val>()
      .function("set", &Stylus::set)
      .function("touch", &Stylus::touch)
      .function("load", &Stylus::load)
      .function("unload", &Stylus::unload)
      .function("shade", &Stylus::shade)
      .function("triangles", &Stylus::triangles)
      .function("place", &Stylus::place)
      .function("lead", &Stylus::lead)
      .function("advance", &Stylus::advance)
      .function("state", &Stylus::state);
}
