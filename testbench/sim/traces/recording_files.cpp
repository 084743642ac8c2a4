// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Small recordings on disk for the tests of the readers. Documentation: docs/traces.md
#include "recording_files.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace feltgate::traces::test {

Folder::Folder() {
  static int number = 0;
  path_ = std::filesystem::temp_directory_path() /
          ("feltgate-traces-" + std::to_string(getpid()) + "-" + std::to_string(number++));
  std::filesystem::create_directories(path_);
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path Folder::file(const std::string& name, const std::string& bytes) const {
  std::ofstream(path_ / name, std::ios::binary) << bytes;
  return path_ / name;
}

std::filesystem::path Folder::zip(const std::string& name,
                                  const std::vector<std::pair<std::string, std::string>>& entries,
                                  bool stored) const {
  archive* const a = archive_write_new();
  archive_write_set_format_zip(a);
  if (stored) archive_write_zip_set_compression_store(a);
  if (archive_write_open_filename(a, (path_ / name).c_str()) != ARCHIVE_OK) {
    throw std::runtime_error("no zip");
  }
  for (const auto& [entry_name, data] : entries) {
    archive_entry* const entry = archive_entry_new();
    archive_entry_set_pathname(entry, entry_name.c_str());
    archive_entry_set_size(entry, static_cast<la_int64_t>(data.size()));
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    archive_write_header(a, entry);
    archive_write_data(a, data.data(), data.size());
    archive_entry_free(entry);
  }
  archive_write_free(a);
  return path_ / name;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<EncoderEvent> all_events(EncoderSource& source) {
  std::vector<EncoderEvent> events;
  while (const auto event = source.next()) events.push_back(*event);
  return events;
}

std::string told(const std::filesystem::path& path, const Options& options) {
  const auto pins = [](const EncoderPins& p) {
    return std::string(p.a ? "1" : "0") + (p.b ? "1" : "0") + (p.z ? "Z" : "");
  };
  try {
    const auto source = open(path, options);
    std::string text = "0:" + pins(source->initial());
    for (const EncoderEvent& event : all_events(*source)) {
      text += " " + std::to_string(event.clock) + ":" + pins(event.pins);
    }
    return text + " end:" + std::to_string(source->length());
  } catch (const TraceError& error) {
    return error.what();
  }
}

std::string metadata(const std::string& rate, int unit_size) {
  return "[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\ntotal probes=4\n"
         "samplerate=" +
         rate + "\nprobe1=D0\nprobe2=A\nprobe3=B\nprobe4=Z\nunitsize=" + std::to_string(unit_size) +
         "\n";
}

}  // namespace feltgate::traces::test
