// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Readers of encoder recordings on wrong files: one clear line for each fault, and nothing but a
// TraceError or a clean read for any damage at all. Documentation: docs/traces.md
#include "catch.hpp"
#include "recording_files.hpp"
#include "sim/traces/place.hpp"
#include "sim/traces/vector_file.hpp"

using namespace feltgate;
using namespace feltgate::traces;
using test::Folder;
using test::metadata;
using test::told;

namespace {

const std::string kVcd =
    "$timescale 1 us $end\n$scope module top $end\n$var wire 1 ! A $end\n$var wire 1 \" B $end\n"
    "$upscope $end\n$enddefinitions $end\n#0\n0!\n0\"\n#2\n1!\n#4\n1\"\n#6\n0!\n#9\n";
const std::string kCsv = "time,A,B\n0.000,0,0\n0.001,1,0\n0.002,1,0\n0.003,1,1\n0.004,0,1\n";
const std::string kSaleae =
    "Time [s],Channel 0,Channel 1\n-0.1000,1,1\n0.0000,0,1\n0.0250,0,0\n0.0375,1,0\n";
const std::string kColumns =
    "t,theta,u\n0.0e+00,1.5e-02,-1\n2.0e-03,3.0e-02,2\n4.0e-03,-1.0e-02,3\n";
const std::string kVector =
    "feltgate-vector 1 design=lever clock_hz=50000000 signals=A,B,Z\n0 0 0 1\n100 1 0 0\n"
    "205 1 1 0\n310 0 1 0\nend 400\n";

void expect(const std::string& message, const std::string& part) {
  CAPTURE(message, part);
  CHECK(message.find(part) != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
  CHECK(message.find("; ") != std::string::npos);
}

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Truncates the file at every byte and flips random bytes; both must be read or refused.
void damage(const std::string& name, const std::string& good, const Options& options) {
  const Folder folder;
  REQUIRE(told(folder.file(name, good), options).find(" end:") != std::string::npos);
  int refused = 0;
  int read = 0;
  const auto attempt = [&](const std::string& bytes) {
    const auto file = folder.file(name, bytes);
    try {
      const auto source = traces::open(file, options);
      Clock last = 0;
      for (const EncoderEvent& event : test::all_events(*source, 10'000)) {
        REQUIRE(event.clock > last);
        last = event.clock;
      }
      ++read;
    } catch (const TraceError& error) {
      expect(error.what(), name);
      ++refused;
    }
  };
  for (std::size_t size = 0; size < good.size(); ++size) attempt(good.substr(0, size));
  feltgate::SplitMix64 random(42);
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = good;
    for (std::int64_t flips = 1 + random.below(3); flips > 0; --flips) {
      const auto at =
          static_cast<std::size_t>(random.below(static_cast<std::int64_t>(good.size())));
      bytes[at] = static_cast<char>(random.below(2) == 0 ? random.below(256)
                                                         : bytes[at] ^ (1 << random.below(8)));
    }
    attempt(bytes);
  }
  for (int round = 0; round < 200; ++round) {
    std::string bytes = good.substr(0, good.size() / 4);
    for (int i = 0; i < 200; ++i) bytes += static_cast<char>(random.below(256));
    attempt(bytes);
  }
  CAPTURE(name, refused, read);
  CHECK(refused > 100);
}

}  // namespace

TEST_CASE("sigrok sessions that are wrong", "[traces]") {
  const Folder folder;
  const Options options;
  const std::string good = metadata("1 MHz");
  const auto zip = [&](const std::string& meta, const std::string& samples) {
    return told(folder.zip("a.sr", {{"metadata", meta}, {"logic-1", samples}}), options);
  };
  expect(zip(good, ""), "the recording holds no samples");
  expect(zip(edited(good, "1 MHz", "0"), "a"), "a.sr:metadata: samplerate '0' is not a rate");
  expect(zip(edited(good, "1 MHz", "nan"), "a"), "samplerate 'nan' is not a rate");
  expect(zip(edited(good, "unitsize=1", "unitsize=0"), "a"), "unitsize '0' is not a size");
  expect(zip(edited(good, "unitsize=1", "unitsize=2"), "abc"), "ends inside a sample");
  expect(zip(edited(good, "file=logic-1", "file=logic-2"), "a"), "no samples 'logic-2'");
  expect(zip("[device 1]\nsamplerate=1 MHz\n", "a"), "no probe of the recording has a name");
  expect(zip(edited(good, "probe2=A", "probe2=Q"), "a"), "there are: D0, Q, B, Z");
  Options other;
  other.probes = {"A", "Y"};
  expect(told(folder.path() / "a.sr", other), "no probe 'A'; there are: D0, Q, B, Z");
  expect(told(folder.zip("b.sr", {{"logic-1", "a"}}), options), "holds no 'metadata'");
  expect(told(folder.zip("c.sr", {{"metadata", good}, {"logic-1-1", "a"}, {"logic-1-3", "a"}}),
              options),
         "chunk logic-1-2 is missing");
  const std::string bytes = test::bytes_of(folder.path() / "a.sr");
  expect(told(folder.file("d.sr", bytes.substr(0, bytes.size() - 30)), options), "truncated");
  const auto stored = folder.zip("f.sr", {{"metadata", good}, {"logic-1", "marked samples"}}, true);
  expect(told(folder.file("f.sr", edited(test::bytes_of(stored), "marked", "Marked")), options),
         "f.sr:logic-1:sample 14: unpacking failed");
  expect(told(folder.file("e.sr", "hello"), options), "e.sr: opening the zip failed");
}

TEST_CASE("texts that are wrong", "[traces]") {
  const Folder folder;
  const Options options;
  const auto csv = [&](const std::string& text) {
    return told(folder.file("a.csv", text), options);
  };
  expect(csv(""), "a.csv: the file is empty");
  expect(csv("\n\n"), "no line of column names");
  expect(csv("time,A,B\n"), "a.csv:1: the table has no rows");
  expect(csv("0,0,1\n1,1,1\n"), "the first line holds numbers");
  expect(csv(edited(kCsv, "time", "when")), "no column of time; name it; there are: when, A, B");
  expect(csv(edited(kCsv, "0.003", "0.0015")), "a.csv:5: time goes backwards to '0.0015'");
  expect(csv(edited(kCsv, "0.003", "nan")), "a.csv:5: time 'nan' is not a finite number");
  expect(csv(edited(kCsv, "0.003,1", "0.003,2")), "level '2' of 'A' is not 0 or 1");
  expect(csv(edited(kCsv, "0.003,1,1", "0.003,1")), "a.csv:5: the row has 2 of 3 fields");
  Options near;
  near.probes = {"enc_a", "enc_q"};
  expect(told(folder.file("near.csv", "time,enc_a,enc_b\n0,0,0\n"), near),
         "no probe 'enc_q'; did you mean \"enc_a\"? there are: enc_a, enc_b");
  near.probes.clear();
  near.count_column = "coutn";
  expect(told(folder.file("near.csv", "time,count\n0,0\n"), near),
         "no column 'coutn'; did you mean \"count\"? name it; there are: time, count");
  expect(csv("t,count\n0,1\n1,inf\n"), "a.csv:3: position 'inf' is not a finite number");
  expect(csv("t,count\n0,1\n1,1e300\n"), "over 2^53 counts");
  expect(csv("t,u\n0,1\n"), "cannot tell which channels are the encoder's A and B");
  expect(csv("t,theta\n0,1\n"), "column 'theta' looks like an angle; give the scale in counts");
}

TEST_CASE("VCD and vectors that are wrong", "[traces]") {
  const Folder folder;
  const Options options;
  const auto vcd = [&](const std::string& text) {
    return told(folder.file("a.vcd", text), options);
  };
  expect(vcd(edited(kVcd, "#6", "#3")), "a.vcd:14: time goes backwards from 4 to 3");
  expect(vcd(edited(kVcd, "1 us", "3 us")), "'3us' is not a timescale");
  expect(vcd(edited(kVcd, "#6\n0!", "#6\n0?")), "a value of '?', which no $var declares");
  expect(vcd(kVcd.substr(0, 60)), "the file ends inside");
  expect(vcd(kVcd.substr(0, kVcd.find("#0"))), "the recording holds no values");
  const auto vec = [&](const std::string& text) {
    return told(folder.file("a.txt", text), options);
  };
  expect(vec(kVector.substr(0, kVector.find("end"))), "the line `end LENGTH` is missing");
  expect(vec(edited(kVector, "205", "99")), "a.txt:4: time goes backwards or stands still");
  expect(vec(edited(kVector, "205", "100")), "a.txt:4: time goes backwards or stands still");
  expect(vec(edited(kVector, "vector 1", "vector 2")), "schema '2' is not known");
  expect(vec(kVector + "500 0 0 0\n"), "text after the line");
  expect(told(folder.path() / "none.sr", options), "cannot be opened");
  expect(told(folder.path(), options), "is a folder");
  expect(told(folder.file("a.bin", std::string("\0\1\2", 3)), options), "the format is not known");
  Options clock;
  clock.clock_hz = 0;
  expect(told(folder.file("a.txt", kVector), clock), "clock_hz 0 is not a clock");
}

TEST_CASE("damaged files are read or refused, never worse", "[traces][fuzz]") {
  Options columns;
  columns.count_column = "theta";
  columns.scale = 325.949;
  damage("a.vcd", kVcd, Options());
  damage("a.csv", kCsv, Options());
  damage("saleae.csv", kSaleae, Options());
  damage("columns.csv", kColumns, columns);
  damage("a.txt", kVector, Options());
  const Folder folder;
  const auto sr = folder.zip("z.sr", {{"metadata", metadata("1 MHz")},
                                      {"logic-1-1", std::string(300, '\2') + "\6\4"},
                                      {"logic-1-2", std::string(300, '\4') + "\6\2"}});
  damage("a.sr", test::bytes_of(sr), Options());
}
