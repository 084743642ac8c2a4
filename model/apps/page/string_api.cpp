// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The functions that the page's tab of the bowed string calls. Only Emscripten compiles it.
// Documentation: docs/page.md
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <string>

#include "apps/page/said.hpp"
#include "apps/page/string_loop.hpp"

namespace {

using emscripten::val;
using feltgate::page::said;
namespace page = feltgate::page;

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

EMSCRIPTEN_BINDINGS(feltgate_string) {
  emscripten::class_<BowString>("BowString")
      .constructor<std::string, int, double>()
      .function("set", &BowString::set)
      .function("lead", &BowString::lead)
      .function("draw", &BowString::draw)
      .function("advance", &BowString::advance)
      .function("state", &BowString::state)
      .function("heard", &BowString::heard);
}
