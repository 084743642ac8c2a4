// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A trimmed scene as a scene file. Documentation: docs/speed-for-accuracy.md
#include "studies/trim/trim.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <vector>

#include "files/toml/toml_reader.hpp"

namespace fs = std::filesystem;

namespace feltgate::trim {

namespace {

/// The lines of a scene file, counted from 1 as the parser counts them.
class Lines {
 public:
  explicit Lines(const std::string& path) : root_(config::parse_toml_file(path)) {
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) lines_.push_back(line);
    gone_.resize(lines_.size(), false);
  }

  const toml::table& root() const { return root_; }
  /// Takes out a top-level key, or a whole table with its header.
  void remove(const std::string& key) {
    const toml::node* node = root_.get(key);
    if (node == nullptr) return;
    std::size_t last = node->source().end.line;
    if (const toml::table* table = node->as_table()) {
      for (const auto& [name, value] : *table) {
        (void)name;
        last = std::max<std::size_t>(last, value.source().end.line);
      }
    }
    for (std::size_t n = node->source().begin.line; n <= last; ++n) gone_[n - 1] = true;
  }
  void replace(const toml::node& node, const std::string& with) {
    const auto& at = node.source();
    lines_[at.begin.line - 1].replace(at.begin.column - 1, at.end.column - at.begin.column, with);
  }
  /// Everything, `keys` before the first table.
  std::string text(const std::string& keys) const {
    std::size_t first = lines_.size() + 1;
    for (const auto& [name, node] : root_) {
      (void)name;
      const bool inline_table = node.is_table() && node.as_table()->is_inline();
      if ((node.is_table() && !inline_table) || node.is_array_of_tables()) {
        first = std::min<std::size_t>(first, node.source().begin.line);
      }
    }
    std::string out;
    for (std::size_t n = 1; n <= lines_.size(); ++n) {
      if (n == first) out += keys + "\n";
      if (!gone_[n - 1]) out += lines_[n - 1] + "\n";
    }
    return first > lines_.size() ? out + keys : out;  // without tables, or with inline ones alone
  }

 private:
  toml::table root_;
  std::vector<std::string> lines_;
  std::vector<bool> gone_;
};

/// A TOML string.
std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << std::quoted(text);
  return out.str();
}

}  // namespace

std::string scene_text(const Scenario& scene, const Model& model, const std::string& comment) {
  Lines lines(scene.path);
  for (const char* key : {"step_clocks", "bridge", "plant", "effects"}) lines.remove(key);
  const fs::path folder = fs::absolute(scene.path).parent_path();
  for (const char* table : {"hand", "met"}) {
    const toml::array* phases = lines.root()[table]["phase"].as_array();
    if (phases == nullptr) continue;
    for (const toml::node& phase : *phases) {
      const toml::node* file = phase.is_table() ? phase.as_table()->get("file") : nullptr;
      if (file == nullptr || !file->is_string()) continue;
      lines.replace(*file, quoted((folder / file->value_or(std::string())).string()));
    }
  }
  const toml::node* device = lines.root().get("device");
  const std::string name = device == nullptr ? "" : device->value_or(std::string());
  if (name.find('/') != std::string::npos) {
    lines.replace(*device, quoted(fs::absolute(name).string()));
  }
  const toml::node* law = lines.root().at_path("core.law").node();
  if (law != nullptr &&
      (scene.law.find('/') != std::string::npos || fs::path(scene.law).extension() == ".law")) {
    lines.replace(*law, quoted((folder / scene.law).string()));
  }

  std::ostringstream text;
  std::istringstream words(comment);
  for (std::string line; std::getline(words, line);) {
    text << (line.empty() ? "#" : "# ") << line << "\n";
  }
  std::ostringstream keys;
  if (!scene.plant.empty()) {  // of one lever
    const bool path = scene.plant.find('/') != std::string::npos;
    keys << "plant = " << quoted(path ? fs::absolute(scene.plant).string() : scene.plant) << "\n"
         << "bridge = \"" << (model.gates ? "switched" : "averaged") << "\"\n"
         << "step_clocks = " << model.step_clocks << "\n";
  }
  text << lines.text(keys.str()) << "\n[effects]\n";
  for (const plant::EffectName& e : plant::effect_names) {
    text << e.name << " = " << (model.effects.*e.flag ? "true" : "false") << "\n";
  }
  return text.str();
}

}  // namespace feltgate::trim
