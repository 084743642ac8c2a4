// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Checks of a scene against design and plant, before a run. Documentation: docs/scenes.md
#include "sim/loop/scenario_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <stdexcept>
#include <vector>

#include "design/design.hpp"
#include "feltgate/while_armed.hpp"
#include "files/toml/toml_reader.hpp"
#include "law/units.hpp"

namespace feltgate {

namespace {

void check_scene(const Scenario& s, int line, const std::string& name, const DesignInfo& design) {
  try {
    (void)scene_number(design, name);
  } catch (const config::ConfigError& error) {
    if (line == 0) throw;
    throw config::ConfigError(fmt::format("{}:{}: {}", s.path, line, error.what()));
  }
}

void check_parameter(const std::string& place, const std::string& name, double value,
                     const DesignInfo& design, const SceneLaw* law) {
  const std::string at = place.empty() ? "" : place + ": ";
  if (law != nullptr && law->has(name)) {
    try {
      law->check(name, value);
    } catch (const std::invalid_argument& error) {
      throw config::ConfigError(at + error.what());
    }
    return;
  }
  const ParameterInfo* info = design.find(name);
  if (info == nullptr && law != nullptr) {
    try {
      law->check(name, value);  // its error names the law's parameters
    } catch (const std::invalid_argument& error) {
      throw config::ConfigError(
          fmt::format("{}{}; nor has the core: `feltgate design {}` lists its parameters", at,
                      error.what(), design.name));
    }
  }
  if (info == nullptr) throw config::ConfigError(at + design.unknown(name));
  try {
    (void)quantise_parameter(*info, value);
  } catch (const std::invalid_argument& error) {
    throw config::ConfigError(at + error.what());
  }
}

/// Checks the law's requirements on its parameters, after each set of the scene.
class Requirements {
 public:
  Requirements(const Scenario& s, const SceneLaw* law) : s_(s), law_(law) {}
  void add(const std::string& name, double value, int line) {
    if (law_ == nullptr || !law_->has(name)) return;
    all_[name] = value;
    lines_[name] = line;
  }
  void check() const {
    if (law_ == nullptr) return;
    try {
      law_->check(all_);
    } catch (const std::invalid_argument& error) {
      const std::string what = error.what();
      int last = 0;  // last line that sets a parameter it names
      for (const std::string& name : names_in(what)) {
        const auto line = lines_.find(name);
        if (line != lines_.end()) last = std::max(last, line->second);
      }
      throw config::ConfigError(last == 0 ? what : fmt::format("{}:{}: {}", s_.path, last, what));
    }
  }

 private:
  /// The names in the text of a requirement: "... requires A <= B, which are ...".
  static std::vector<std::string> names_in(const std::string& what) {
    const std::size_t from = what.find(" requires "), to = what.find(", which are");
    std::vector<std::string> names(1);
    for (std::size_t i = from; i < std::min(to, what.size()); ++i) {
      const auto c = static_cast<unsigned char>(what[i]);
      if (std::isalnum(c) != 0 || c == '_') {
        names.back() += what[i];
      } else if (!names.back().empty()) {
        names.emplace_back();
      }
    }
    return names;
  }

  const Scenario& s_;
  const SceneLaw* law_;
  std::map<std::string, double> all_;
  std::map<std::string, int> lines_;
};

/// The host can feed only a parameter that the scene's law keeps as a mailbox.
void check_mailbox(const Scenario& s, const SceneLaw* law) {
  const auto refuse = [&](int line, const std::string& what) {
    throw config::ConfigError(fmt::format("{}:{}: {}", s.path, line, what));
  };
  if (s.feed_hz > 0 && (law == nullptr || !law->has_mailbox())) {
    refuse(s.feed_line,
           "[feed] needs a law with a mailbox; name one under [core], or leave it out");
  }
  if (!s.tracker) return;
  const TrackerSettings& t = *s.tracker;
  if (law == nullptr) {
    refuse(t.line, "[tracker] needs a law with a mailbox; name one: law = \"wall_tracked\"");
  }
  for (const std::string& name :
       {t.mailbox, t.encoder_mailbox.empty() ? t.mailbox : t.encoder_mailbox}) {
    if (law->is_mailbox(name)) continue;
    refuse(t.line, fmt::format("law {} has no mailbox \"{}\"; name one that it has, or write "
                               "`mailbox {} = 0 rad in -10 .. 10 rad max_age 20 ms` into it",
                               law->name(), name, name));
  }
}

/// Only an absolute encoder can be broken.
void check_encoder(const Scenario& s, const DesignInfo& design) {
  for (const Event& e : s.events) {
    if (e.encoder.empty() || design.absolute) continue;
    throw config::ConfigError(fmt::format(
        "{}:{}: design {} has no absolute encoder that \"{}\" could break; choose one that has, "
        "lever_absolute say",
        s.path, e.line, design.name, e.encoder));
  }
}

/// Finds writes that an armed core would drop silently because the torque could jump.
void check_held(const Scenario& s, const DesignInfo& design) {
  bool armed = false, asked = false;
  int mode = s.mode;
  for (const Event& e : s.events) {
    if (!asked && e.at_s >= s.arm_s) armed = asked = true;
    const bool disarms = e.arm && !*e.arm;
    std::string what;
    for (const auto& [name, value] : e.set) {
      const ParameterInfo* info = design.find(name);  // nullptr: a parameter of the law
      if (info != nullptr && while_armed(info->address, 0) == WhileArmed::refused) what = name;
    }
    if (e.mode && *e.mode != mode && !disarms) what = "mode";
    if (armed && !what.empty()) {
      throw config::ConfigError(fmt::format(
          "{}{} cannot change while the motor is armed; write arm = false into an event "
          "before this one and arm = true into one after it, or set it from the start",
          e.line == 0 ? "" : fmt::format("{}:{}: ", s.path, e.line), what));
    }
    if (e.arm) armed = *e.arm;
    mode = e.mode.value_or(mode);
  }
}

/// A value of one board in the counts of another.
double in_counts(double value, const std::string& unit, const law::BoardUnits& from,
                 const law::BoardUnits& to) {
  const std::size_t at = unit.find("count");
  if (at == std::string::npos) return value;
  const auto text = [](double x, const std::string& of) { return fmt::format("{} {}", x, of); };
  const std::string si = std::string(unit).replace(at, std::strlen("count"), "rad");
  return law::amount_in(text(law::amount_in(text(value, unit), si, from), si), unit, to);
}

/// Whether a figure grows with the scene's torques: in Nm, Nm s/rad or J.
bool is_torque(const std::string& figure) {
  const std::string name = figure.substr(0, figure.find('.'));
  const auto ends = [&](const std::string& with) {
    return name.size() > with.size() &&
           name.compare(name.size() - with.size(), with.size(), with) == 0;
  };
  return ends("_nm") || ends("_nm_s_rad") || ends("_j");
}

}  // namespace

int scene_number(const DesignInfo& design, const std::string& name) {
  const int number = design.scene_number(name);
  if (number >= 0) return number;
  throw config::ConfigError(design.unknown_scene(name));
}

std::optional<double> parameter_in(const std::string& name, const std::string& text,
                                   const DesignInfo& design, const SceneLaw* law) {
  const bool of_law = law != nullptr && law->has(name);
  const ParameterInfo* of_core = design.find(name);
  if (!of_law && of_core == nullptr) return {};
  return law::amount_in(text, of_law ? law->unit(name) : of_core->unit,
                        {design.count_rad, 1 / static_cast<double>(design.tick_hz)});
}

void scale_torques(Scenario& s, double scale, const design::Elaborated& made_for,
                   const DesignInfo& design) {
  if (!s.law.empty()) {
    throw std::invalid_argument(s.path + ": the torque is a law's; scale it in the law");
  }
  const law::BoardUnits from{made_for.design.count_rad(), made_for.design.tick_s()};
  const law::BoardUnits to{design.count_rad, 1 / static_cast<double>(design.tick_hz)};
  const auto factor = [scale](const std::string& unit) {
    return unit.rfind("Nm", 0) == 0 ? scale : 1.0;
  };
  const auto set = [&](std::map<std::string, double>& values, const std::string& name,
                       double value) {
    const ParameterInfo* info = design.find(name);
    if (info == nullptr) return;  // check_asked() names it
    values[name] = factor(info->unit) * in_counts(value, info->unit, from, to);
  };
  const auto set_all = [&](std::map<std::string, double>& values,
                           std::map<std::string, std::string>& amounts) {
    for (const auto& [name, value] : std::map(values)) set(values, name, value);
    for (const auto& [name, text] : amounts) {
      const ParameterInfo* info = design.find(name);
      if (info != nullptr) values[name] = factor(info->unit) * law::amount_in(text, info->unit, to);
    }
    amounts.clear();
  };
  const auto used = scenes_used(s);
  std::map<std::string, double> left;  // to the design
  for (const design::Word& w : made_for.words) {
    const std::string& name = w.parameter.name;
    if (used.count(w.parameter.scene) == 0 || s.parameters.count(name) != 0) continue;
    if (s.amounts.count(name) == 0) left[name] = w.si;
  }
  set_all(s.parameters, s.amounts);
  for (const auto& [name, value] : left) set(s.parameters, name, value);
  for (Event& e : s.events) {
    set_all(e.set, e.amounts);
    if (e.step_nm) *e.step_nm *= scale;
  }
  for (Expectation& x : s.expectations) {
    if (x.design == made_for.design.name) x.design.reset();
    if (!is_torque(x.figure)) continue;
    x.low *= scale;
    x.high *= scale;
  }
}

void resolve_amounts(Scenario& s, const DesignInfo& design, const SceneLaw* law) {
  const auto resolve = [&](std::map<std::string, std::string>& amounts,
                           std::map<std::string, double>& values, const auto& line_of) {
    for (const auto& [name, text] : amounts) {
      try {
        // check_asked() reports an unknown name, with the choices.
        values[name] = parameter_in(name, text, design, law).value_or(0);
      } catch (const std::invalid_argument& error) {
        throw config::ConfigError(
            fmt::format("{}:{}: {}: {}", s.path, line_of(name), name, error.what()));
      }
    }
    amounts.clear();
  };
  resolve(s.amounts, s.parameters,
          [&](const std::string& name) { return s.parameter_lines.at(name); });
  for (Event& e : s.events) {
    resolve(e.amounts, e.set, [&](const std::string&) { return e.line; });
  }
}

bool has_amounts(const Scenario& s) {
  return !s.amounts.empty() || std::any_of(s.events.begin(), s.events.end(),
                                           [](const Event& e) { return !e.amounts.empty(); });
}

void check_asked(const Scenario& s, const DesignInfo& design, const SceneLaw* law) {
  if (has_amounts(s)) {
    throw config::ConfigError(s.path + ": values with units are not taken here; write numbers");
  }
  check_scene(s, s.scene_line, s.scene, design);
  Requirements requirements(s, law);
  for (const auto& [name, value] : s.parameters) {
    const auto line = s.parameter_lines.find(name);
    const bool of_file = line != s.parameter_lines.end();
    check_parameter(of_file ? fmt::format("{}:{}", s.path, line->second) : "", name, value, design,
                    law);
    requirements.add(name, value, of_file ? line->second : 0);
  }
  requirements.check();
  for (const Event& e : s.events) {
    if (e.scene) check_scene(s, e.line, *e.scene, design);
    for (const auto& [name, value] : e.set) {
      check_parameter(e.line == 0 ? "" : fmt::format("{}:{}", s.path, e.line), name, value, design,
                      law);
      requirements.add(name, value, e.line);
    }
    requirements.check();
  }
  check_mailbox(s, law);
  check_encoder(s, design);
  check_held(s, design);
}

void check_phases(const Scenario& s, const plant::Parameters& plant, const DesignInfo& design) {
  const bool three = plant.phases.has_value();
  for (const Event& e : s.events) {
    if (!e.open_phase || three) continue;
    throw config::ConfigError(fmt::format(
        "{}:{}: the motor of plant {} has no phase that could be open; choose a plant that has, "
        "gimbal_motor say",
        s.path, e.line, plant.name));
  }
  if (design.hall && three && !plant.phases->hall) {
    throw config::ConfigError(fmt::format(
        "design {} begins with the motor's Hall lines, and plant {} has none; give it hall_rad and "
        "hall_error_rad in [motor], or choose another, hall_motor say",
        design.name, plant.name));
  }
  if (three == (design.phases == 3)) return;
  throw config::ConfigError(fmt::format(
      "plant {} has a motor {}, and design {} drives one {}; choose another plant or design",
      plant.name, three ? "with three phases" : "with brushes", design.name,
      three ? "with brushes" : "with three phases"));
}

void check_scenario(const Scenario& s, const plant::Parameters& plant, const DesignInfo& design,
                    const SceneLaw* law) {
  check_asked(s, design, law);
  check_phases(s, plant, design);
  check_step(s, plant, static_cast<double>(design.clock_hz));
}

}  // namespace feltgate
