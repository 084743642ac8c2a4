// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Opens an encoder recording: which format it has, and which reader that takes.
// Documentation: docs/traces.md
#include "sim/traces/open.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/traces/sigrok.hpp"
#include "sim/traces/sources.hpp"
#include "sim/traces/vcd.hpp"
#include "sim/traces/vector_file.hpp"

namespace feltgate::traces {
namespace {

constexpr std::int64_t kMostHz = 1'000'000'000'000;
constexpr std::size_t kHead = 256;

void check(const std::string& file, const Options& options) {
  if (options.clock_hz < 1 || options.clock_hz > kMostHz) {
    fail(file, fmt::format("clock_hz {} is not a clock", options.clock_hz), "give 1 to 1e12 Hz");
  }
  if (options.sample_hz < 0 || options.sample_hz > kMostHz) {
    fail(file, fmt::format("sample_hz {} is not a rate", options.sample_hz), "give 0 to 1e12 Hz");
  }
  if (options.wrap && !(*options.wrap >= 0 && *options.wrap < 1e18)) {
    fail(file, "the wrap is not a number above 0", "give the units of a turn, such as 360");
  }
  if (options.scale && (!std::isfinite(*options.scale) || *options.scale == 0.0)) {
    fail(file, "the scale is not a finite number other than 0", "give counts per unit");
  }
}

/// Whether the first rows have only 0 and 1 beside their time.
bool holds_levels(Table& table) {
  const std::size_t time = table.use_time();
  for (int rows = 0; rows < 64 && table.read(); ++rows) {
    for (std::size_t i = 0; i < table.columns().size(); ++i) {
      const std::optional<double> value = parse_real(table.field(i));
      if (i != time && value && *value != 0.0 && *value != 1.0) return false;
    }
  }
  return true;
}

FileFormat table_format(const std::filesystem::path& path, const Options& options) {
  if (!options.count_column.empty()) return FileFormat::columns;
  if (!options.probes.empty() || !options.step.empty() || !options.dir.empty()) {
    return FileFormat::levels;
  }
  Options silent = options;
  silent.warn = nullptr;
  Table table(path, silent);
  bool time = false;
  bool channel = false;
  for (const std::string& name : table.columns()) {
    time = time || lower(name).compare(0, 5, "time ") == 0 || lower(name) == "time[s]";
    channel = channel || lower(name).compare(0, 8, "channel ") == 0;
  }
  if (time && channel) return FileFormat::saleae;
  if (!quadrature_pairs(table.columns()).empty()) return FileFormat::levels;
  return has_count_column(table) || !holds_levels(table) ? FileFormat::columns : FileFormat::levels;
}

std::unique_ptr<Capture> capture(const std::filesystem::path& path, FileFormat format,
                                 const Options& options) {
  switch (format) {
    case FileFormat::sigrok:
#ifdef FELTGATE_SIGROK
      return std::make_unique<SigrokCapture>(path, options.sample_hz);
#else
      fail(path.string(), "sigrok recordings are not built into this program",
           "convert it to a VCD, or build with libarchive and -DFELTGATE_SIGROK=ON");
#endif
    case FileFormat::vcd:
      return std::make_unique<VcdCapture>(path, options.sample_hz);
    case FileFormat::vector:
      return std::make_unique<VectorCapture>(path);
    default:
      return std::make_unique<LevelTable>(path, options);
  }
}

}  // namespace

FileFormat detect(const std::filesystem::path& path, const Options& options) {
  std::string head;
  {
    ByteReader reader(path);
    for (int c = reader.get(); c >= 0 && head.size() < kHead; c = reader.get()) {
      head += static_cast<char>(c);
    }
  }
  const std::string suffix = lower(path.extension().string());
  const auto starts = [](std::string_view text, std::string_view with) {
    return text.substr(0, with.size()) == with;
  };
  if (starts(head, "PK") || suffix == ".sr") return FileFormat::sigrok;
  if (starts(head, "feltgate-vector")) return FileFormat::vector;
  if (starts(trim(head), "$") || suffix == ".vcd") return FileFormat::vcd;
  const bool text = head.find('\0') == std::string::npos;
  if (text && (suffix == ".csv" || suffix == ".tsv" || suffix == ".txt" ||
               head.find_first_of(",;\t") != std::string::npos)) {
    return table_format(path, options);
  }
  fail(path.string(), "the format is not known",
       "give a sigrok .sr, a VCD, a CSV or a feltgate vector");
}

std::unique_ptr<EncoderSource> open(const std::filesystem::path& path, const Options& options) {
  check(path.string(), options);
  const FileFormat format =
      options.format == FileFormat::detect ? detect(path, options) : options.format;
  if (format == FileFormat::columns) return std::make_unique<ColumnSource>(path, options);
  return std::make_unique<LevelSource>(capture(path, format, options), options);
}

std::vector<std::string> channels(const std::filesystem::path& path, const Options& options) {
  check(path.string(), options);
  const FileFormat format =
      options.format == FileFormat::detect ? detect(path, options) : options.format;
  if (format == FileFormat::columns) return Table(path, options).columns();
  return capture(path, format, options)->channels();
}

}  // namespace feltgate::traces
