// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The functions that the tabs of pens, levers and strings call: devices that run the words of a law
// without a core. Only Emscripten compiles it. Documentation: docs/page.md
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <string>
#include <vector>

#include "apps/page/law_loops.hpp"
#include "apps/page/said.hpp"

namespace {

using emscripten::val;
namespace page = feltgate::page;
using page::said;

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

}  // namespace

EMSCRIPTEN_BINDINGS(feltgate_tabs) {
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
}
