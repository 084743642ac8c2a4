// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The functions that the page in the browser calls: the loop, the hash over recorded inputs, the
// stability border by eigenvalues, and a user's own design file. Only Emscripten compiles it.
// Documentation: docs/page.md
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "apps/page/knob_loop.hpp"
#include "apps/page/live_loop.hpp"
#include "apps/page/own_design.hpp"
#include "apps/page/recorded_inputs.hpp"
#include "apps/page/said.hpp"
#include "apps/page/user_law.hpp"
#include "feltgate/reading.hpp"
#include "law/engine/machine.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/linear_loop.hpp"

namespace {

using emscripten::val;
namespace page = feltgate::page;
using page::said;

const char* registers = "/rtl/registers.toml";
constexpr int law_runs = 5000;  ///< beside the law in double
std::string plant_path(const std::string& name) { return "/plants/" + name + ".toml"; }

class Loop {
 public:
  Loop(const std::string& design, const std::string& plant)
      : loop_(design, feltgate::plant::read_plant_file(plant_path(plant))) {}

  std::string select(const std::string& scene) {
    return said([&] { loop_.select(scene); });
  }
  std::string set(const std::string& name, double value) {
    return said([&] { loop_.set(name, value); });
  }
  /// Compiles a law and loads it; empty, or the first thing that is wrong with it.
  std::string run_law(const std::string& text) {
    return said([&] {
      law_ = std::make_unique<page::UserLaw>(text, loop_.design());
      loop_.run_law(law_->scene());
    });
  }
  val law_parameters() const {
    val list = val::array();
    if (law_ == nullptr) return list;
    for (const page::LawParameter& p : law_->parameters()) {
      val one = val::object();
      one.set("name", p.name);
      one.set("unit", p.unit);
      one.set("comment", p.comment);
      one.set("value", p.value);
      one.set("low", p.low);
      one.set("high", p.high);
      one.set("step", p.step);
      list.call<void>("push", one);
    }
    return list;
  }
  std::string set_law(const std::string& name, double value) {
    return said([&] {
      law_->set(name, value);
      loop_.set(name, value);
    });
  }
  /// Torque over a turn up and back, an array of doubles.
  val law_curve(int points) const {
    val list = val::array();
    for (const double nm : law_->curve(points)) list.call<void>("push", nm);
    return list;
  }
  void arm(bool wanted) { loop_.arm(wanted); }
  void clear_faults() { loop_.clear_faults(); }
  void stop(bool pressed) { loop_.stop(pressed); }
  void host_wall(int ticks, double contact_rad, double stiffness, double damping) {
    loop_.host_wall(ticks, contact_rad, stiffness, damping);
  }
  void break_it(int what) { loop_.break_it(static_cast<page::Break>(what)); }
  void hold(int grip) { loop_.hold(static_cast<page::Grip>(grip)); }
  void lead(double theta_rad) { loop_.lead(theta_rad); }
  std::string advance(int ticks, int every) {
    return said([&] { loop_.advance(ticks, every); });
  }
  /// The samples of the last advance() as one array of doubles; valid until the next call.
  val samples() const {
    static_assert(sizeof(page::Sample) == page::sample_values * sizeof(double), "no gaps");
    const auto& list = loop_.samples();
    return val(emscripten::typed_memory_view(list.size() * page::sample_values,
                                             reinterpret_cast<const double*>(list.data())));
  }
  /// Names, units and formats of the words of a snapshot.
  val words() const {
    val list = val::array();
    for (const page::Word& word : page::snapshot_words) {
      const feltgate::Format format = word.format(loop_.design());
      val one = val::object();
      one.set("name", std::string(word.name));
      one.set("unit", std::string(word.unit));
      one.set("bits", format.width());
      one.set("fraction", format.fraction);
      list.call<void>("push", one);
    }
    return list;
  }
  /// The words of the last ticks as one array of doubles, oldest tick first; valid until the next
  /// call.
  val last_ticks() {
    words_.clear();
    for (const feltgate::Snapshot& s : loop_.last_ticks()) {
      for (const page::Word& word : page::snapshot_words) {
        words_.push_back(static_cast<double>(word.value(s)));
      }
    }
    return val(emscripten::typed_memory_view(words_.size(), words_.data()));
  }
  val status() {
    const feltgate::Snapshot& s = loop_.snapshot();
    feltgate::Reading names;
    names.limits = s.limits;
    names.faults = s.faults;
    val out = val::object();
    out.set("time_s", loop_.time_s());
    out.set("armed", s.armed);
    out.set("limits", names.limit_names());
    out.set("faults", names.fault_names());
    out.set("position", s.position);
    out.set("theta_rad", loop_.observables().theta_rad);
    out.set("hand_rad", loop_.hand_rad());
    out.set("difference_nm", loop_.take_difference());
    out.set("torque_limit_nm", loop_.torque_limit_nm());
    out.set("gentle_nm", loop_.gentle_nm());
    return out;
  }
  val parameters() const {
    val list = val::array();
    const feltgate::DesignInfo& d = loop_.design();
    for (int i = 0; i < d.parameter_count; ++i) {
      const feltgate::ParameterInfo& p = d.parameters[i];
      const feltgate::ValueRange range = feltgate::range_of(p);
      val one = val::object();
      one.set("name", std::string(p.name));
      one.set("unit", std::string(p.unit));
      one.set("value", p.si);
      one.set("low", range.low);
      one.set("high", range.high);
      one.set("step", range.step);
      list.call<void>("push", one);
    }
    return list;
  }
  val design() const {
    const feltgate::DesignInfo& d = loop_.design();
    val out = val::object();
    out.set("name", std::string(d.name));
    out.set("tick_hz", static_cast<double>(d.tick_hz));
    out.set("count_rad", d.count_rad);
    val scenes = val::array();
    for (const std::string& scene : d.scenes) scenes.call<void>("push", scene);
    out.set("scenes", scenes);
    return out;
  }

 private:
  page::LiveLoop loop_;
  std::unique_ptr<page::UserLaw> law_;
  std::vector<double> words_;
};

/// The knob on a motor of three phases.
class Knob {
 public:
  Knob() : loop_(feltgate::plant::read_plant_file(plant_path(page::KnobCore::design_name))) {}

  std::string detents(double pitch_rad, double peak_nm) {
    return said([&] { loop_.detents(pitch_rad, peak_nm); });
  }
  std::string offset(double turns) {
    return said([&] { loop_.offset(turns); });
  }
  void arm(bool wanted) { loop_.arm(wanted); }
  void hold(bool held) { loop_.hold(held); }
  void lead(double theta_rad) { loop_.lead(theta_rad); }
  std::string advance(double seconds) {
    return said([&] { loop_.advance(seconds); });
  }
  /// The samples of the last advance() as one array of doubles; valid until the next call.
  val samples() const {
    static_assert(sizeof(page::KnobSample) == page::knob_sample_values * sizeof(double), "no gaps");
    const auto& list = loop_.samples();
    return val(emscripten::typed_memory_view(list.size() * page::knob_sample_values,
                                             reinterpret_cast<const double*>(list.data())));
  }
  /// Angles, rad; of the core and of the rotor the electrical ones, turns; on-times of the legs as
  /// shares of a period; currents of the phases, A; torques, Nm; time, s.
  val state() const {
    const page::KnobCore& core = loop_.core();
    const auto& seen = loop_.plant().observables();
    const double rotor_rad = loop_.plant().motor().electrical_rad(seen.theta_rad);
    val out = val::object(), on = val::array(), current = val::array();
    for (std::size_t leg = 0; leg < 3; ++leg) {
      on.call<void>("push", core.on_clocks()[leg] / static_cast<double>(core.design().pwm_period));
      current.call<void>("push", loop_.plant().motor().phase_a()[leg]);
    }
    out.set("theta", seen.theta_rad);
    out.set("omega", seen.omega_rad_s);
    out.set("hand", loop_.hand_rad());
    out.set("detent", loop_.detent_rad());
    out.set("position", loop_.position());
    out.set("electrical", core.electrical_turns(loop_.position()));
    out.set("rotor", rotor_rad / 6.283185307179586);
    out.set("offset", core.offset_turns());
    out.set("pole_pairs", loop_.pole_pairs());
    out.set("amplitude", static_cast<int>(core.raw().duty));
    out.set("gates", core.gates());
    out.set("on", on);
    out.set("current", current);
    out.set("asked", core.out().tau_ref_nm);
    out.set("torque", seen.motor_torque_nm);
    out.set("bus", seen.bus_v);
    out.set("time", loop_.time_s());
    return out;
  }

 private:
  page::KnobLoop loop_;
};

/// What is wrong with a law, by line; or the table of `feltgate law`.
val check_law(const std::string& design, const std::string& text) {
  val out = val::object(), errors = val::array();
  try {
    const page::UserLaw law(text, feltgate::design_named(design));
    out.set("report", law.report(law_runs));
  } catch (const feltgate::law::LawError& error) {
    for (const feltgate::law::Diagnostic& d : error.diagnostics()) {
      val one = val::object();
      one.set("line", d.place.line);
      one.set("column", d.place.column);
      one.set("what", d.what);
      one.set("mend", d.mend);
      errors.call<void>("push", one);
    }
  } catch (const std::exception& error) {
    out.set("failed", std::string(error.what()));
  }
  out.set("errors", errors);
  return out;
}

/// The designs that drive a lever's motor, with brushes.
std::vector<std::string> lever_designs() {
  std::vector<std::string> names;
  for (const std::string& name : feltgate::design_names()) {
    if (feltgate::design_named(name).phases != 3) names.push_back(name);
  }
  return names;
}

val design_names() {
  val list = val::array();
  for (const std::string& name : lever_designs()) list.call<void>("push", name);
  return list;
}

/// Hash of a design's twin over inputs in the text form of recorded_inputs.hpp; "error: ..." else.
std::string hash(const std::string& design, const std::string& inputs) {
  std::string out;
  const std::string error =
      said([&] { out = page::hex(page::hash_of(design, page::inputs_from_text(inputs))); });
  return error.empty() ? out : "error: " + error;
}

/// The closed loop of follow_script() as it goes here.
val closed_loop(const std::string& design) {
  val rows = val::array();
  for (const page::ScriptRow& script :
       page::follow_script(design, feltgate::plant::read_plant_file(plant_path("p24")))) {
    val row = val::array();
    row.call<void>("push", script.theta_rad);
    row.call<void>("push", script.torque_nm);
    rows.call<void>("push", row);
  }
  return rows;
}

/// Largest stable stiffness of the wall at this damping and rate, by eigenvalues, and the frequency
/// of the swing there; of a design of this page or the text of a file of one.
val border(const std::string& design, const std::string& own_text, const std::string& plant,
           double damping_nm_s_rad, int scene_ticks) {
  val out = val::object();
  out.set("error", said([&] {
            const auto e = page::elaborated(own_text, "/designs/" + design + ".toml", registers);
            const auto model = feltgate::stability::make_model(
                e, feltgate::plant::read_plant_file(plant_path(plant)));
            const auto b = feltgate::stability::border(model, damping_nm_s_rad, scene_ticks);
            out.set("stiffness_nm_rad", b.stiffness_nm_rad);
            out.set("rad_s", b.rad_s);
          }));
  return out;
}

/// A user's design file: on which design of this page it runs, and the values of its parameters.
val own_design(const std::string& text) {
  val out = val::object();
  out.set("error", said([&] {
            const page::OwnDesign own =
                page::own_design(text, lever_designs(), "/designs/", registers);
            val values = val::array();
            for (const auto& [name, value] : own.values) {
              val one = val::object();
              one.set("name", name);
              one.set("value", value);
              values.call<void>("push", one);
            }
            out.set("base", own.base);
            out.set("values", values);
          }));
  return out;
}

}  // namespace

EMSCRIPTEN_BINDINGS(feltgate) {
  emscripten::class_<Loop>("Loop")
      .constructor<std::string, std::string>()
      .function("select", &Loop::select)
      .function("set", &Loop::set)
      .function("arm", &Loop::arm)
      .function("runLaw", &Loop::run_law)
      .function("lawParameters", &Loop::law_parameters)
      .function("setLaw", &Loop::set_law)
      .function("lawCurve", &Loop::law_curve)
      .function("clearFaults", &Loop::clear_faults)
      .function("stop", &Loop::stop)
      .function("hostWall", &Loop::host_wall)
      .function("breakIt", &Loop::break_it)
      .function("hold", &Loop::hold)
      .function("lead", &Loop::lead)
      .function("advance", &Loop::advance)
      .function("samples", &Loop::samples)
      .function("words", &Loop::words)
      .function("lastTicks", &Loop::last_ticks)
      .function("status", &Loop::status)
      .function("parameters", &Loop::parameters)
      .function("design", &Loop::design);
  emscripten::constant("KNOB_MOST_RAD", page::KnobLoop::most_rad);
  emscripten::class_<Knob>("Knob")
      .constructor<>()
      .function("detents", &Knob::detents)
      .function("offset", &Knob::offset)
      .function("arm", &Knob::arm)
      .function("hold", &Knob::hold)
      .function("lead", &Knob::lead)
      .function("advance", &Knob::advance)
      .function("samples", &Knob::samples)
      .function("state", &Knob::state);
  emscripten::function("designNames", &design_names);
  emscripten::function("checkLaw", &check_law);
  emscripten::function("hash", &hash);
  emscripten::function("closedLoop", &closed_loop);
  emscripten::function("border", &border);
  emscripten::function("ownDesign", &own_design);
}
