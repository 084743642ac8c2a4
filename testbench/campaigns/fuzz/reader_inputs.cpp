// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The readers that are fuzzed. Documentation: docs/testing.md
#include "fuzz.hpp"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "design/generate.hpp"
#include "design/generate_cfg.hpp"
#include "design/host_words.hpp"
#include "files/toml/toml_reader.hpp"
#include "host/board/recording.hpp"
#include "law/derive.hpp"
#include "law/evaluate.hpp"
#include "law/load.hpp"
#include "law/read_law.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/gimbal/gimbal.hpp"
#include "sim/plant/pantograph/pantograph.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/plant/plant_table.hpp"
#include "sim/plant/profile.hpp"
#include "sim/touch/touch_run.hpp"
#include "sim/traces/open.hpp"
#include "sim/traces/place.hpp"
#include "studies/shape/outline.hpp"
#include "studies/texture/image.hpp"

namespace feltgate::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr long kMostEvents = 20'000;  ///< a stream may be long; its first part shows what matters

fs::path root_of_project;

struct Shipped {
  design::RegisterMap registers;
  design::Design design;
  plant::Parameters plant;
};

const Shipped& shipped() {
  static const Shipped s{
      design::read_registers((root_of_project / "rtl/registers.toml").string()),
      design::read_design((root_of_project / "rtl/designs/paper.toml").string()),
      plant::read_plant_file((root_of_project / "vectors/plants/p24.toml").string())};
  return s;
}

std::string as_it_is(const std::string& input) { return input; }

/// The metadata, a line "--", the first chunk, perhaps a line "--" and the second chunk: so that
/// changes reach the reader's own code behind the checksums of the zip.
std::string as_session(const std::string& input) {
  static const std::string between = "\n--\n";
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (parts.size() < 3) {
    const std::size_t end = parts.size() == 2 ? std::string::npos : input.find(between, begin);
    parts.push_back(input.substr(begin, end == std::string::npos ? end : end - begin));
    if (end == std::string::npos) break;
    begin = end + between.size();
  }
  const std::string names[] = {"metadata", parts.size() == 3 ? "logic-1-1" : "logic-1",
                               "logic-1-2"};
  std::string zip(1U << 18U, '\0');
  std::size_t used = 0;
  archive* const a = archive_write_new();
  archive_write_set_format_zip(a);
  archive_write_zip_set_compression_store(a);
  archive_write_set_bytes_per_block(a, 0);
  if (archive_write_open_memory(a, zip.data(), zip.size(), &used) != ARCHIVE_OK) {
    throw std::runtime_error("no zip");
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    archive_entry* const entry = archive_entry_new();
    archive_entry_set_pathname(entry, names[i].c_str());
    archive_entry_set_size(entry, static_cast<la_int64_t>(parts[i].size()));
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    archive_write_header(a, entry);
    archive_write_data(a, parts[i].data(), parts[i].size());
    archive_entry_free(entry);
  }
  archive_write_close(a);
  archive_write_free(a);
  zip.resize(used);
  return zip;
}

/// The JSON of a GLB file, a line "===" and its binary chunk: with the lengths of the container, so
/// that changes reach what is behind them.
std::string as_glb(const std::string& input) {
  const std::string between = "\n===\n";
  const std::size_t at = input.find(between);
  std::string json = input.substr(0, at), binary;
  if (at != std::string::npos) binary = input.substr(at + between.size());
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string file;
  const auto word = [&file](std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    file.append(reinterpret_cast<const char*>(&bits), 4);
  };
  word(0x46546c67);  // "glTF"
  word(2);
  word(28 + json.size() + binary.size());
  word(json.size());
  word(0x4e4f534a);  // "JSON"
  file += json;
  word(binary.size());
  word(0x004e4942);  // "BIN"
  return file + binary;
}

/// A law's image with the CRC-32 that it should have, so that changes get behind it.
std::string as_law_image(const std::string& input) {
  try {
    (void)law::read_image(input);
  } catch (const std::invalid_argument& error) {
    const std::string said = error.what(), before = "the CRC-32 is ";
    const std::size_t at = said.find(before), line = input.find("\ncrc ");
    if (std::max(at, line) != std::string::npos)
      return std::string(input).replace(line + 5, 8, said, at + before.size(), 8);
  }
  return input;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// ":123: " somewhere in the message.
bool names_line(const std::string& message) {
  for (auto at = message.find(": "); at != std::string::npos; at = message.find(": ", at + 1)) {
    const auto before = message.find_last_not_of("0123456789", at - 1);
    if (before != std::string::npos && before + 1 < at && message[before] == ':') return true;
  }
  return false;
}

template <class Use>
Ending config_ending(Use use) {
  Ending ending;
  try {
    use();
    ending.read = true;
  } catch (const config::ConfigError& error) {
    ending.error = error.what();
    if (!names_line(ending.error)) ending.trouble = "the message has no line";
  }
  return ending;
}

/// Elaborates as far as it goes and makes every text that would be written.
void make_all(const design::Design& d, const design::RegisterMap& registers) {
  (void)causes_header(registers);
  (void)map_package(registers);
  (void)map_header(registers);
  const design::Elaborated e = elaborate(d, registers);
  (void)cfg_package(e);
  (void)cpp_header(e);
  (void)values_text(e);
  (void)register_page(e);
  (void)c_header(e);
  (void)c_map_header(e);
  (void)system_rdl(e);
  (void)csr_csv(e);
  (void)design_table(e);
}

Ending use_design(const fs::path& file) {
  return config_ending([&] { make_all(design::read_design(file.string()), shipped().registers); });
}

Ending use_registers(const fs::path& file) {
  return config_ending([&] { make_all(shipped().design, design::read_registers(file.string())); });
}

Ending use_plant(const fs::path& file) {
  return config_ending([&] {
    Scenario still;
    const plant::Parameters plant = plant::read_plant_file(file.string());
    still.effects = plant.effects;
    check_step(still, plant, 50e6);
  });
}

/// Plants with several axes, and the hand of a pen, told apart by a table that only one of them
/// has.
Ending use_device(const fs::path& file) {
  return config_ending([&] {
    const toml::table root = config::parse_toml_file(file.string());
    if (root.contains("hand")) {
      (void)plant::read_pen_hand(
          config::TomlReader(root, file.string(), "the file").section("hand"));
    } else if (root.contains("bodies")) {
      (void)plant::read_gimbal_file(file.string());
    } else {
      const plant::PantographParameters p = plant::read_pantograph_file(file.string());
      (void)plant::Linkage(p.linkage).pose({0.5, 2.5});
    }
  });
}

Ending use_scene(const fs::path& file) {
  return config_ending([&] {
    Scenario scenario = read_scenario(file.string());
    resolve_effects(scenario, shipped().plant.effects);
    check_step(scenario, shipped().plant, 50e6);
    (void)effects_off(scenario);
    (void)scenes_used(scenario);
  });
}

Ending use_motion(const fs::path& file) {
  Ending ending = config_ending([&] { (void)plant::read_trace_file(file.string()); });
  if (fs::file_size(file) == 0) ending.trouble.clear();  // it has no line
  return ending;
}

/// What can be read is also run, with tables as they are sampled.
Ending use_law(const fs::path& file) {
  Ending ending;
  try {
    const law::Law read = law::read_law(file.string());
    law::Evaluation<double> run(read, law::Tables::sampled);
    std::vector<double> inputs(read.inputs.size(), 0.3);
    for (int i = 0; i < 3; ++i) run.run(inputs);
    for (const law::Output& o : read.outputs) (void)law::formula(read, o.value);
    ending.read = true;
  } catch (const law::LawError& error) {
    ending.error = law::message(file.string(), error.diagnostics().front());
    if (!names_line(ending.error)) ending.trouble = "the message has no line";
  }
  return ending;
}

/// Readers that refuse with std::invalid_argument "FILE: what; mend".
template <class Use>
Ending plain_ending(Use use) {
  Ending ending;
  try {
    use();
    ending.read = true;
  } catch (const std::invalid_argument& error) {
    ending.error = error.what();
  }
  return ending;
}

/// What can be read is also cleaned; the command puts the file's name before an error of that.
Ending use_glb(const fs::path& file) {
  std::string prefix;
  Ending ending = plain_ending([&] {
    const touch::Soup soup = touch::read_glb(file.string());
    prefix = file.string() + ": ";
    (void)touch::clean(soup);
  });
  if (!ending.read) ending.error = prefix + ending.error;
  return ending;
}

/// The way of a pen, or of a mesh where the first line names a turn.
Ending use_stroke(const fs::path& file) {
  const bool turns = text_of(file).find("turn_rad") < 100;
  return plain_ending([&] { (void)touch::read_stroke(file.string(), turns); });
}

/// What can be read is made into the words of a load, with other values too, and written again; the
/// command puts the file's name before an error.
Ending use_law_image(const fs::path& file) {
  law::Image image;
  Ending ending = plain_ending([&] {
    image = law::read_image(text_of(file));
    (void)law::load(image);
    (void)law::parameter_words(image, std::vector<double>(image.words.size(), 0.3));
  });
  if (!ending.read) ending.error = file.string() + ": " + ending.error;
  if (ending.read && law::text(law::read_image(law::text(image))) != law::text(image))
    ending.trouble = "what was read is not what is written again";
  return ending;
}

template <auto Read>
Ending use_file(const fs::path& file) {
  return plain_ending([&] { (void)Read(file.string()); });
}

/// The options of a recording come from its bytes: the same input, the same options.
traces::Options options_of(const fs::path& file, traces::FileFormat format) {
  traces::Options o;
  SplitMix64 random(static_cast<std::uint64_t>(fs::file_size(file)));
  o.format = random.below(4) == 0 ? traces::FileFormat::detect : format;
  o.jitter = random.below(2) == 0;
  const std::int64_t clocks[] = {50'000'000, 1, 1'000'000'000'000, 12'345'678};
  o.clock_hz = clocks[random.below(4)];
  const std::int64_t rates[] = {0, 0, 1, 1'000'000'000'000};
  o.sample_hz = rates[random.below(4)];
  o.turn_counts = 4096;
  o.warn = [](const std::string&) {};
  const bool saleae = format == traces::FileFormat::saleae;
  if (random.below(3) == 0) {
    o.probes = saleae ? std::vector<std::string>{"Channel 0", "Channel 1"}
                      : std::vector<std::string>{"A", "B"};
  }
  if (format == traces::FileFormat::columns) {
    o.probes.clear();
    o.count_column = random.below(2) == 0 ? "count" : "";
    if (random.below(2) == 0) o.scale = 325.95;
    if (random.below(2) == 0) o.wrap = random.below(2) == 0 ? 0.0 : 360.0;
  }
  const char* const units[] = {"", "", "ms", "h"};
  o.time_unit = units[random.below(4)];
  return o;
}

Ending use_recording(const fs::path& file, traces::FileFormat format) {
  Ending ending;
  try {
    const traces::Options options = options_of(file, format);
    (void)traces::channels(file, options);
    const auto source = traces::open(file, options);
    Clock last = 0;
    long events = 0;
    while (events < kMostEvents) {
      const auto event = source->next();
      if (!event) break;
      if (event->clock <= last) ending.trouble = "an event is not later than the one before";
      last = event->clock;
      ++events;
    }
    if (events < kMostEvents && source->length() <= last) {
      ending.trouble = "the recording ends before its last event";
    }
    ending.read = true;
  } catch (const traces::TraceError& error) {
    ending.error = error.what();
  }
  return ending;
}

template <traces::FileFormat Format>
Ending use_trace(const fs::path& file) {
  return use_recording(file, Format);
}

}  // namespace

void set_root(const fs::path& root) {
  root_of_project = root;
  (void)shipped();
}

const std::vector<Reader>& readers() {
  using F = traces::FileFormat;
  static const std::vector<Reader> all{
      {"design", "input.toml", as_it_is, use_design},
      {"registers", "input.toml", as_it_is, use_registers},
      {"plant", "input.toml", as_it_is, use_plant},
      {"device", "input.toml", as_it_is, use_device},
      {"scene", "input.toml", as_it_is, use_scene},
      {"motion", "input.csv", as_it_is, use_motion},
      {"sigrok", "input.sr", as_it_is, use_trace<F::sigrok>},
      {"session", "input.sr", as_session, use_trace<F::sigrok>},
      {"vcd", "input.vcd", as_it_is, use_trace<F::vcd>},
      {"saleae", "input.csv", as_it_is, use_trace<F::saleae>},
      {"levels", "input.csv", as_it_is, use_trace<F::levels>},
      {"columns", "input.csv", as_it_is, use_trace<F::columns>},
      {"law", "input.law", as_it_is, use_law},
      {"vector", "input.vec", as_it_is, use_trace<F::vector>},
      {"glb", "input.glb", as_glb, use_glb},
      {"stroke", "input.csv", as_it_is, use_stroke},
      {"law_image", "input.img", as_law_image, use_law_image},
      {"svg", "input.svg", as_it_is, use_file<shape::read_svg>},
      {"board", "input.board", as_it_is, use_file<board::read_recording>},
      {"png", "input.png", as_it_is, use_file<texture::read_png>},
  };
  return all;
}

}  // namespace feltgate::fuzz
