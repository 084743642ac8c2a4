// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The functions that the page in the browser calls: the loop, the hash over recorded inputs, the
// stability border by eigenvalues. Only Emscripten compiles it. Documentation: docs/page.md
#include <emscripten/bind.h>

#include <fstream>
#include <iterator>
#include <memory>

#include "apps/page/api.hpp"
#include "apps/page/live_loop.hpp"
#include "apps/page/recorded_inputs.hpp"
#include "apps/page/user_law.hpp"
#include "design/info.hpp"
#include "feltgate/reading.hpp"
#include "law/engine/machine.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/linear_loop.hpp"

namespace {

using namespace feltgate::page;
using feltgate::design_named;
namespace design = feltgate::design;

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
      law_ = std::make_unique<UserLaw>(text, loop_.design());
      loop_.run_law(law_->scene());
    });
  }
  val law_parameters() const {
    if (law_ == nullptr) return val::array();
    return array_of(law_->parameters(), [](const LawParameter& p) {
      return object("name", p.name, "unit", p.unit, "comment", p.comment, "value", p.value, "low",
                    p.low, "high", p.high, "step", p.step);
    });
  }
  std::string set_law(const std::string& name, double value) {
    return said([&] {
      law_->set(name, value);
      loop_.set(name, value);
    });
  }
  /// Torque over a turn up and back, an array of doubles.
  val law_curve(int points) const { return array_of(law_->curve(points)); }
  void arm(bool wanted) { loop_.arm(wanted); }
  void clear_faults() { loop_.clear_faults(); }
  void stop(bool pressed) { loop_.stop(pressed); }
  void host_wall(int ticks, double contact_rad, double stiffness, double damping) {
    loop_.host_wall(ticks, contact_rad, stiffness, damping);
  }
  void break_it(int what) { loop_.break_it(static_cast<Break>(what)); }
  void hold(int grip) { loop_.hold(static_cast<Grip>(grip)); }
  void lead(double theta_rad) { loop_.lead(theta_rad); }
  std::string advance(int ticks, int every) {
    return said([&] { loop_.advance(ticks, every); });
  }
  /// The samples of the last advance() as one array of doubles; valid until the next call.
  val samples() const { return view_of<sample_values>(loop_.samples()); }
  /// The words of the snapshot of the last tick.
  val words() const {
    return array_of(snapshot_words, [&](const Word& word) {
      return object("name", std::string(word.name), "unit", std::string(word.unit), "fraction",
                    word.fraction(loop_.design()), "value",
                    static_cast<double>(word.value(loop_.snapshot())));
    });
  }
  val status() const {
    const feltgate::Snapshot& s = loop_.snapshot();
    feltgate::Reading names;
    names.limits = s.limits;
    names.faults = s.faults;
    return object("armed", s.armed, "limits", names.limit_names(), "faults", names.fault_names(),
                  "hand_rad", loop_.hand_rad(), "torque_limit_nm", loop_.torque_limit_nm(),
                  "gentle_nm", loop_.gentle_nm());
  }
  val parameters() const {
    const feltgate::DesignInfo& d = loop_.design();
    const std::vector<feltgate::ParameterInfo>& all = d.parameters;
    return array_of(all, [](const feltgate::ParameterInfo& p) {
      return object("name", std::string(p.name), "value", p.si, "high", feltgate::range_of(p).high);
    });
  }
  val design() const {
    const feltgate::DesignInfo& d = loop_.design();
    return object("name", std::string(d.name), "tick_hz", static_cast<double>(d.tick_hz),
                  "count_rad", d.count_rad);
  }

 private:
  LiveLoop loop_;
  std::unique_ptr<UserLaw> law_;
};

/// What is wrong with a law, by line; or the table of `feltgate law`.
val check_law(const std::string& design, const std::string& text) {
  try {
    const UserLaw law(text, design_named(design));
    return object("report", law.report(law_runs), "errors", val::array());
  } catch (const feltgate::law::LawError& error) {
    const auto of = [](const feltgate::law::Diagnostic& d) {
      return object("line", d.place.line, "column", d.place.column, "what", d.what, "mend", d.mend);
    };
    return object("errors", array_of(error.diagnostics(), of));
  } catch (const std::exception& error) {
    return object("failed", std::string(error.what()));
  }
}

/// Designs come from files that scripts/web_page/compile.py has put into the page.
void use_embedded_designs() {
  feltgate::set_design_source(
      {[](const std::string& name) {
         return design::info_of(design::elaborate(design::read_design("/designs/" + name + ".toml"),
                                                  design::read_registers("/rtl/registers.toml")));
       },
       [] {
         std::ifstream in("/designs/names.txt");
         return std::vector<std::string>(std::istream_iterator<std::string>(in), {});
       }});
}

/// The designs that drive a lever's motor, with brushes.
val design_names() {
  val names = val::array();
  for (const std::string& name : feltgate::design_names()) {
    if (design_named(name).phases != 3) names.call<void>("push", name);
  }
  return names;
}

/// Hash of a design's twin over inputs in the text form of recorded_inputs.hpp; "error: ..." else.
std::string hash(const std::string& design, const std::string& inputs) {
  std::string out;
  const std::string error = said([&] { out = hex(hash_of(design, inputs_from_text(inputs))); });
  return error.empty() ? out : "error: " + error;
}

/// Largest stable stiffness of the wall at this damping and rate, by eigenvalues, and the frequency
/// of the swing there.
val border(const std::string& name, const std::string& plant, double damping_nm_s_rad,
           int scene_ticks) {
  val out = val::object();
  out.set("error", said([&] {
            const auto e = design::elaborate(design::read_design("/designs/" + name + ".toml"),
                                             design::read_registers("/rtl/registers.toml"));
            const auto model = feltgate::stability::make_model(
                e, feltgate::plant::read_plant_file(plant_path(plant)));
            const auto b = feltgate::stability::border(model, damping_nm_s_rad, scene_ticks);
            add_to(out, "stiffness_nm_rad", b.stiffness_nm_rad, "rad_s", b.rad_s);
          }));
  return out;
}

}  // namespace

EMSCRIPTEN_BINDINGS(feltgate) {
  use_embedded_designs();
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
      .function("status", &Loop::status)
      .function("parameters", &Loop::parameters)
      .function("design", &Loop::design);
  emscripten::function("designNames", &design_names);
  emscripten::function("checkLaw", &check_law);
  emscripten::function("hash", &hash);
  emscripten::function("border", &border);
}
