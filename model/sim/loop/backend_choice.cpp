// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Selection of the back-ends of a run. Documentation: docs/speed-for-accuracy.md
#include "sim/loop/backend_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "feltgate/nearest.hpp"

namespace feltgate {

namespace {

const std::vector<std::string>& backend_names() {
  static const std::vector<std::string> names{"rtl", "twin", "float", "double", "quad"};
  return names;
}

bool has(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

std::vector<std::string> split(const std::string& engines) {
  if (engines == "all") return backend_names();
  std::vector<std::string> list;
  std::istringstream words(engines + ",");
  for (std::string word; std::getline(words, word, ',');) {
    if (!has(backend_names(), word)) {
      throw std::invalid_argument(
          fmt::format("engine \"{}\" is unknown; {}choose rtl, twin, float, double, quad, several "
                      "with commas between them, or all",
                      word, config::did_you_mean(word, backend_names())));
    }
    if (has(list, word)) {
      throw std::invalid_argument(
          fmt::format("engine \"{}\" is named twice in \"{}\"; name each once", word, engines));
    }
    list.push_back(word);
  }
  return list;
}

}  // namespace

std::vector<std::string> BackendChoice::names() const {
  std::vector<std::string> all;
  if (!rider_drives) all.push_back(lead == "lockstep" ? "twin" : lead);
  all.insert(all.end(), riders.begin(), riders.end());
  return all;
}

std::string BackendChoice::reference() const {
  if (names().size() < 2) return {};
  for (const char* exact : {"quad", "double"}) {
    if (has(riders, exact)) return exact;
  }
  return {};
}

BackendChoice choose_backends(const std::string& engines) {
  BackendChoice choice;
  bool rtl = false, twin = false;
  for (const std::string& name : split(engines)) {
    rtl = rtl || name == "rtl";
    twin = twin || name == "twin";
    if (name != "rtl" && name != "twin") choice.riders.push_back(name);
  }
  choice.lead = rtl && twin ? "lockstep" : rtl ? "rtl" : "twin";
  choice.rider_drives = !rtl && !twin;
  return choice;
}

void require_runs_of_law(const BackendChoice& choice) {
  if (choice.lead != "rtl" || choice.riders.empty()) return;
  throw std::invalid_argument(
      "--engine: the RTL alone does not tell of which run of the law a torque is; add the twin, "
      "as rtl,twin,double");
}

}  // namespace feltgate
