// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT get, set. Documentation: docs/host.md
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "apps/commands/host/verbs.hpp"
#include "feltgate/nearest.hpp"
#include "files/output_file.hpp"

namespace feltgate::host {

namespace {

struct GetArguments {
  std::vector<std::string> names;
  std::string json;
  bool all = false;
};

const char* mark(const Quantity& q) {
  if (!q.writable) return "";
  if (q.while_armed == "acts") return "set, acts at once";
  return q.while_armed == "ramps" ? "set, the torque ramps" : "set while disarmed";
}

using ImageWords = std::vector<const law::ImageWord*>;

/// Whether the running law has a parameter of this name. If the board has an engine, throws for a
/// name that is unknown everywhere.
bool is_of_law(Session& session, const std::string& name) {
  const LawEngine* laws = session.laws_if_any();
  if (laws == nullptr) return false;
  if (laws->find(name) != nullptr) return true;
  const std::string wrong = session.device().quantities().missing_axis(name);
  if (!wrong.empty()) throw std::invalid_argument(wrong);
  std::vector<std::string> names;
  for (const Quantity& q : session.device().quantities().all()) names.push_back(q.name);
  for (const law::ImageWord* w : laws->parameters()) names.push_back(w->name);
  throw std::invalid_argument(fmt::format(
      "\"{}\" is no value of this board{}; {}get --all lists them", name,
      laws->image() != nullptr ? " and no parameter of the law " + laws->image()->name
                               : ", and its law is not known here: give the file with --law",
      config::did_you_mean(name, names)));
}

int get(Session& session, const GetArguments& a) {
  if (a.all != a.names.empty()) {
    throw std::invalid_argument(a.all ? "get: give names or --all, not both"
                                      : "get: give NAMES, or --all for all there is");
  }
  files::Outputs outputs;
  files::OutputFile* json = outputs.open("--json", a.json);
  Device& device = session.device();
  std::vector<const Quantity*> asked;
  std::vector<std::string> of_law;
  for (const std::string& name : a.names) {
    const Quantity* q = device.quantities().look(name);
    if (q == nullptr && is_of_law(session, name)) {
      of_law.push_back(name);
    } else {
      asked.push_back(&device.quantities().find(name));
    }
  }
  if (a.all) {
    for (const Quantity& q : device.quantities().all()) asked.push_back(&q);
    const LawEngine* laws = session.laws_if_any();
    for (const law::ImageWord* w : laws != nullptr ? laws->parameters() : ImageWords{}) {
      of_law.push_back("law." + w->name);
    }
  }
  bool of_tick = false;
  for (const Quantity* q : asked) of_tick = of_tick || q->word >= 0;
  const Tick tick = of_tick ? device.tick() : Tick{};
  nlohmann::ordered_json j;
  j["schema"] = "feltgate-host-values/1";
  j["simulated"] = device.board().simulated;
  std::string text = simulated_banner(device.board());
  for (const Quantity* q : asked) {
    const std::uint32_t word = q->word >= 0 ? tick.word(*q) : device.word(*q);
    j["values"][q->name] = {{"value", q->value_of(word)}, {"unit", q->unit}};
    text += fmt::format("{:<24} {:<26} {:<22} {}\n", q->name, q->text_of(word), mark(*q), q->doc);
  }
  for (const std::string& name : of_law) {
    const law::ImageWord& w = *session.laws().find(name);
    const double value = session.laws().get(name);
    j["values"][name] = {{"value", value}, {"unit", w.unit}};
    text += fmt::format("{:<24} {:<26} {:<22} of the law {}, {}\n", name, law_text(w, value),
                        "set, the torque ramps", session.laws().image()->name, range_text(w));
  }
  if (json != nullptr) json->write(j.dump(2) + "\n");
  outputs.say(text);
  outputs.commit();
  return exit_ok;
}

/// One word of the core.
bool set_word(Device& device, const Setting& s) {
  const Quantity& q = *s.of;
  const SetResult r = device.set(s);
  std::string what = fmt::format("{} = {}", q.name, q.text_of(s.word));
  if (std::abs(s.value() - s.asked) > 1e-9 * std::abs(s.asked)) {
    what += fmt::format(", rounded from {:.9g} to a step of [{},{},{}], {:.3g} {}", s.asked,
                        q.format.sign, q.format.integer, q.format.fraction, q.scale, q.unit);
  }
  const bool well = !r.refused && r.kept;
  if (!well) {
    const std::string now = q.text_of(device.word(q));
    what =
        r.saturated && !r.refused
            ? fmt::format("{}: saturated, is {}; the value does not fit the board's word", q.name,
                          now)
            : fmt::format("{}: refused, stays {}; {}", q.name, now,
                          r.refused ? "the motor is armed and the torque could jump: disarm first"
                                    : "the board did not keep it");
  }
  std::fputs((what + "\n").c_str(), stdout);
  return well;
}

/// Sets parameters of the law so that they take effect together.
void set_law(LawEngine& laws, const std::vector<std::pair<std::string, double>>& values) {
  const std::vector<double> rounded = laws.set(values);
  for (std::size_t n = 0; n < values.size(); ++n) {
    const law::ImageWord& w = *laws.find(values[n].first);
    std::string what = fmt::format("{} = {}", values[n].first, law_text(w, rounded[n]));
    if (std::abs(rounded[n] - values[n].second) > 1e-9 * std::abs(values[n].second)) {
      what += fmt::format(", rounded from {:.9g} to a step of {:.3g}", values[n].second,
                          std::abs(w.scale / w.to_si));
    }
    std::fputs((what + "\n").c_str(), stdout);
  }
}

int set(Session& session, const std::vector<std::string>& texts) {
  Device& device = session.device();
  // All values are checked first: an unusable one must not leave the others half set.
  std::set<std::string> given;
  const auto once = [&given](const std::string& name, const std::string& text) {
    if (given.insert(name).second) return;
    throw std::invalid_argument(text + " sets what was set before it; leave one of them out");
  };
  std::vector<Setting> settings;
  std::vector<std::pair<std::string, double>> of_law;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    if (equals != std::string::npos && equals > 0 && device.quantities().look(name) == nullptr &&
        is_of_law(session, name)) {
      LawEngine& laws = session.laws();
      once("law." + laws.find(name)->name, text);
      of_law.emplace_back(name, laws.value_in(*laws.find(name), text.substr(equals + 1)));
    } else {
      once(name, text);
      settings.push_back(device.quantities().setting(text));
    }
  }
  std::fputs(simulated_banner(device.board()).c_str(), stdout);
  bool all_well = true;
  for (const Setting& s : settings) all_well = set_word(device, s) && all_well;
  if (!of_law.empty()) set_law(session.laws(), of_law);
  return all_well ? exit_ok : exit_failed;
}

}  // namespace

Run add_get(CLI::App& sub) {
  auto a = std::make_shared<GetArguments>();
  sub.footer(R"(  feltgate host /dev/ttyUSB0 get angle velocity torque_limit
  feltgate host /dev/ttyUSB0 get --all                  all names, and what can be set
Parameters of a law that runs are there too, where it was loaded from here or --law gives its file.
Words of a tick are all of the same one. Other words are of the moment that each is read.
Exit code: 0 read, 2 unusable input or port, 3 the link broke down.)");
  option(sub, "names", a->names, "NAME", "parameters, words of a tick, bits such as status.armed");
  sub.add_flag("--all", a->all, "everything, with its meaning");
  option(sub, "--json", a->json, "FILE", "the same as JSON (docs/json.md)");
  return [a](Session& session) { return get(session, *a); };
}

Run add_set(CLI::App& sub) {
  auto settings = std::make_shared<std::vector<std::string>>();
  sub.footer(R"(  feltgate host /dev/ttyUSB0 set torque_limit=0.1 wall_contact=0.2rad
A bare value is in the unit that get prints. One with another unit of the kind is converted:
0.1Nm/deg, 50ms for ticks. What is set holds until the FPGA is configured anew.
Parameters of a law come into force together, with a ramp.
Exit code: 0 set, 1 refused by the board, 2 unusable input: nothing is set, 3 the link broke down.)");
  option(sub, "settings", *settings, "NAME=VALUE", "what to set")->required();
  return [settings](Session& session) { return set(session, *settings); };
}

}  // namespace feltgate::host
