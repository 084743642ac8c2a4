// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Images of laws that this host has loaded, found by the words that a board shows of them.
// Documentation: docs/host.md
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "feltgate/crc32.hpp"
#include "feltgate/generated/engine.hpp"
#include "host/law_engine.hpp"

namespace feltgate::host {

namespace {

namespace fs = std::filesystem;

/// Key from ranges and constants, which two requests read.
std::uint32_t key_of(const std::vector<std::uint32_t>& words) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t w : words) {
    for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<std::uint8_t>(w >> 8 * k));
  }
  return crc32(bytes.data(), bytes.size());
}

}  // namespace

std::string laws_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return std::string(cache) + "/feltgate/laws";
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? std::string(home) + "/.cache/feltgate/laws" : "";
}

void keep_law(const std::string& folder, const law::Image& image) {
  if (folder.empty()) return;
  const std::vector<std::uint32_t> words(image.data.begin() + law::Image::lower_base,
                                         image.data.end());
  const fs::path path =
      fs::path(folder) / fmt::format("{:08x}-{:08x}.img", key_of(words), law::crc(image));
  const fs::path part = path.string() + fmt::format(".{}", getpid());
  std::error_code error;
  fs::create_directories(folder, error);
  {
    std::ofstream out(part);
    out << law::text(image);
    if (!out.flush()) {
      fs::remove(part, error);
      return;
    }
  }
  fs::rename(part, path, error);
}

bool LawEngine::recognise(const std::string& folder) {
  const int ranges = law::Image::lower_base;
  const std::string key = fmt::format(
      "{:08x}-", key_of(read(EngineMap::H::data + ranges, EngineMap::data_words - ranges)));
  std::error_code error;
  std::vector<fs::directory_entry> found;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.rfind(key, 0) == 0 && at->path().extension() == ".img") found.push_back(*at);
  }
  const auto newer = [](const fs::directory_entry& a, const fs::directory_entry& b) {
    std::error_code unread;
    return a.last_write_time(unread) > b.last_write_time(unread);
  };
  std::sort(found.begin(), found.end(), newer);
  for (const fs::directory_entry& entry : found) {
    try {
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      const law::Image image = law::read_image(text.str());
      if (image.design != device_.design().design.name || !holds(image)) continue;
      image_ = std::make_unique<law::Image>(image);
      refresh();
      return true;
    } catch (const std::invalid_argument&) {
      // The file is damaged or from another version of this program; another file may match.
    }
  }
  return false;
}

}  // namespace feltgate::host
