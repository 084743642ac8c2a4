// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Readers of encoder recordings: every format and the rule of time, on files small enough to check
// by hand. Documentation: docs/traces.md
#include <cmath>

#include "catch.hpp"
#include "files/output_file.hpp"
#include "recording_files.hpp"
#include "sim/traces/capture.hpp"
#include "sim/traces/place.hpp"
#include "sim/traces/text.hpp"
#include "sim/traces/vector_file.hpp"

using namespace feltgate;
using namespace feltgate::traces;
using test::Folder;
using test::metadata;
using test::told;

namespace {

Options plain() {
  Options options;
  options.jitter = false;
  return options;
}

}  // namespace

TEST_CASE("decimal numbers are exact", "[traces]") {
  CHECK(parse_decimal("2.00000000000000004e-03", 12) == int128_t{2'000'000'000});
  CHECK(parse_decimal("-0.5", 0) == int128_t{-1});
  CHECK(parse_decimal("0.4999999999999999999999999999999999999", 0) == int128_t{0});
  CHECK(parse_decimal("1690000000.000000000001", 12) ==
        static_cast<int128_t>(1'690'000'000) * 1'000'000'000'000 + 1);
  CHECK(parse_decimal("1e-10000", 12) == int128_t{0});
  for (const char* wrong :
       {"", ".", "-", "e5", "1e", "1e+", "1e5x", "nan", "inf", "0x10", "1e99"}) {
    CAPTURE(wrong);
    CHECK_FALSE(parse_decimal(wrong, 12).has_value());
  }
}

TEST_CASE("time maps to clocks without drift", "[traces]") {
  const ClockMap map({1, 12'000'000}, 50'000'000);
  CHECK(map.at(1) == Clock{4});
  CHECK(map.at(3) == Clock{13});  // 12.5, half up
  CHECK(map.at(std::int64_t{12'000'000} * 86'400 * 365) == Clock{50'000'000} * 86'400 * 365);
  CHECK_FALSE(ClockMap({100, 1}, 1'000'000'000'000).at(std::int64_t{1} << 61U).has_value());
}

TEST_CASE("a placer keeps order and gives up when changes outrun the clock", "[traces]") {
  Placer placer(ClockMap({1, 200'000'000}, 50'000'000), true, 1);
  CHECK(placer.edge(1, 2) == Clock{1});
  CHECK(placer.edge(2, 3) == Clock{2});  // the same clock: the later one moves on
  CHECK(placer.edge(100, 101) == Clock{25});
  Clock last = 25;
  int placed = 0;
  for (std::int64_t t = 101; t < 200; ++t) {
    const auto clock = placer.edge(t, t + 1);
    if (!clock) break;
    CHECK(*clock == ++last);
    ++placed;
  }
  CHECK(placed > 15);
  CHECK(placed < 30);
}

TEST_CASE("jitter is uniform inside the sample, seeded, and keeps one clock for A and B",
          "[traces]") {
  Placer placer(ClockMap({1, 1'000'000}, 50'000'000), true, 7);
  Placer same(ClockMap({1, 1'000'000}, 50'000'000), true, 7);
  std::vector<int> hits(50);
  for (std::int64_t t = 1; t <= 50'000; ++t) {
    const auto clock = placer.edge(t, t + 1);
    REQUIRE(clock);
    REQUIRE(same.edge(t, t + 1) == clock);
    REQUIRE(*clock >= t * 50);
    REQUIRE(*clock < t * 50 + 50);
    ++hits[static_cast<std::size_t>(*clock - t * 50)];
  }
  // 1000 expected in each of 50 places, 32 the standard deviation.
  for (const int hit : hits) CHECK(std::abs(hit - 1000) < 160);
}

TEST_CASE("sigrok sessions, single and in chunks out of order", "[traces]") {
  const Folder folder;
  const std::string expected = "0:00 100:10 150:11 200:11Z 250:00 end:300";
  const auto single = folder.zip(
      "a.sr",
      {{"version", "2"}, {"metadata", metadata("1 MHz")}, {"logic-1", {0, 1, 2, 6, 15, 0}}});
  CHECK(told(single, plain()) == expected);
  const auto chunks = folder.zip("b.sr", {{"logic-1-10", {0}},
                                          {"logic-1-2", {1}},
                                          {"logic-1-1", {0}},
                                          {"logic-1-3", {2}},
                                          {"logic-1-4", {3, 3, 3}},
                                          {"logic-1-5", {6}},
                                          {"logic-1-6", {7}},
                                          {"logic-1-7", {15}},
                                          {"logic-1-8", {2}},
                                          {"logic-1-9", {2}},
                                          {"metadata", metadata("1000 kHz")}});
  CHECK(told(chunks, plain()) == "0:00 100:10 300:11 400:11Z 450:10 550:00 end:600");
  // Two bytes a sample, and a sample cut in two by the chunks.
  const auto wide = folder.zip("c.sr", {{"metadata", metadata("1000000", 2)},
                                        {"logic-1-1", {0, 1, 1, 1, 2}},
                                        {"logic-1-2", {1, 6, 1, 15, 1, 0, 1}}});
  CHECK(told(wide, plain()) == expected);
}

TEST_CASE("VCD of wires in scopes", "[traces]") {
  const Folder folder;
  const std::string header =
      "$date today $end\n$timescale 1 us $end\n$scope module top $end\n"
      "$var wire 1 ! A $end\n$var reg 1 \" B [0] $end\n$var wire 8 # bus [7:0] $end\n"
      "$upscope $end\n$enddefinitions $end\n";
  const auto vcd =
      folder.file("a.vcd", header +
                               "$comment 0! $end\n#10\n$dumpvars\nx! 0\" b0 # $end\n"
                               "#11 0!\n#11 1!\n#12 b1 \"\nb1010 #\n#14 0!\n#14 0\"\n#20\n");
  CHECK(told(vcd, plain()) == "0:00 50:10 100:11 200:00 end:550");
  const auto twice = folder.file(
      "b.vcd",
      "$timescale 100 ns $end $scope module u $end $var wire 1 a A $end $var wire 1 b B $end "
      "$upscope $end $scope module v $end $var wire 1 c A $end $var wire 1 d B $end $upscope $end "
      "$enddefinitions $end 0a 0b 0c 0d #0 #5 1c #6");
  Options options = plain();
  options.probes = {"v.A", "v.B"};
  CHECK(told(twice, options) == "0:00 25:10 end:35");
  options.probes = {"A", "B"};
  CHECK(told(twice, options).find("more than one probe 'A'; there are: u.A, u.B, v.A, v.B") !=
        std::string::npos);
}

TEST_CASE("tables of samples, of changes, and Saleae exports", "[traces]") {
  const Folder folder;
  const auto samples =
      folder.file("s.csv", "time,A,B,Z\n0,0,0,0\n1e-6,0,0,0\n2e-6,1,0,1\n3e-6,1,0,0\n4e-6,0,1,0\n");
  CHECK(told(samples, plain()) == "0:00 100:10Z 150:10 200:01 end:250");
  const auto source = traces::open(samples, Options());
  for (const EncoderEvent& event : test::all_events(*source)) {
    CHECK(event.clock % 50 != 0);  // of this seed; the samples are 50 clocks wide
  }
  const auto changes = folder.file("c.csv", "# by hand\r\ntime_us;B;A\r\n5;0;1\r\n7;1;1\r\n\r\n");
  CHECK(told(changes, Options()) == "0:10 100:11 end:101");
  const auto saleae = folder.file(
      "t.csv",
      "Time [s],Channel 0,Channel 1\n-0.000001000,1,1\n0.000000000,0,1\n0.000000020,0,0\n"
      "0.000000020,1,0\n");
  CHECK(told(saleae, Options()) == "0:11 50:01 51:00 52:10 end:53");
  Options swapped = plain();
  swapped.probes = {"channel 1", "Channel 0"};
  CHECK(told(saleae, swapped) == "0:11 50:10 51:00 52:01 end:53");
}

TEST_CASE("STEP and DIR become quadrature", "[traces]") {
  const Folder folder;
  Options options = plain();
  options.step = "S";
  options.dir = "D";
  const auto file = folder.file(
      "s.csv",
      "time_us,S,D\n0,1,1\n1,0,1\n2,1,1\n3,0,1\n4,1,1\n5,0,0\n6,1,0\n7,0,0\n8,1,0\n9,1,1\n");
  CHECK(told(file, options) == "0:00 100:01 200:11 300:01 400:00 end:450");
  options.dir.clear();
  CHECK(told(file, options).find("STEP and DIR go together, and not with probes") !=
        std::string::npos);
}

TEST_CASE("columns of counts and of angles are spread evenly", "[traces]") {
  const Folder folder;
  const auto counts = folder.file("c.csv", "t,count\n0,1\n1e-6,5\n2e-6,5\n3e-6,3.4\n");
  CHECK(told(counts, plain()) == "0:01 12:11 25:10 37:00 50:01 125:00 150:10 end:151");
  Options jittered;
  const std::vector<std::pair<Clock, Clock>> slots = {{0, 12},  {12, 25},   {25, 37},
                                                      {37, 50}, {100, 125}, {125, 150}};
  for (jittered.seed = 0; jittered.seed < 100; ++jittered.seed) {
    const auto source = traces::open(counts, jittered);
    const auto events = test::all_events(*source);
    REQUIRE(events.size() == slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) {
      CHECK(events[i].clock > slots[i].first);
      CHECK(events[i].clock <= slots[i].second);
    }
  }
  Options options = plain();
  options.count_column = "theta";
  CHECK(told(folder.file("r.csv", "t,theta\n0,0\n1e-6,0.0031\n"), options).find("--scale") ==
        std::string::npos);
  options.scale = parse_scale("2048/2pi");
  CHECK(std::fabs(*options.scale - 325.949323452) < 1e-8);
  CHECK(told(folder.file("r.csv", "t,theta\n0,0\n1e-6,0.0031\n2e-6,-0.0016\n"), options) ==
        "0:00 50:01 75:00 100:10 end:101");
  CHECK(told(folder.file("f.csv", "t,count\n0,0\n1e-6,50\n"), plain()).size() > 200);
  CHECK(told(folder.file("f.csv", "t,count\n0,0\n1e-6,51\n"), plain())
            .find("f.csv:3: 51 counts in 50 clocks: more than one state per clock; ") !=
        std::string::npos);
}

TEST_CASE("vectors are written whole or not at all, and read back exactly", "[traces]") {
  const Folder folder;
  const auto csv =
      folder.file("s.csv", "time_us,A,B,Z\n0,0,0,1\n1,0,0,1\n2,1,0,0\n3,1,0,1\n4,0,1,0\n");
  const auto path = folder.path() / "v.txt";
  const auto source = traces::open(csv, Options());
  const auto written = [&path](EncoderSource& from) {
    files::OutputFile file("-o", path.string());
    const Clock length = write_vector(file.handle(), path.string(), "lever", 50'000'000, from);
    file.commit();
    return length;
  };
  CHECK(written(*source) == 250);
  CHECK(told(path, Options()) == told(csv, Options()));
  CHECK(told(path, plain()) == told(csv, Options()));
  Options twice = plain();
  twice.clock_hz = 100'000'000;
  CHECK(told(path, twice).find(" end:500") != std::string::npos);
  CHECK(VectorCapture(path).header().design == "lever");

  const auto kept = test::bytes_of(path);
  const auto broken = folder.file("b.csv", "time_us,A,B\n0,0,0\n1,0,1\n2,0,0\n1,1,1\n");
  const auto bad = traces::open(folder.file("b.vcd",
                                            "$timescale 1 us $end $var wire 1 a A $end "
                                            "$var wire 1 b B $end $enddefinitions $end "
                                            "#0 0a 0b #5 1a #4 1b"),
                                Options());
  CHECK_THROWS_AS(written(*bad), TraceError);
  CHECK_THROWS_AS(traces::open(broken, Options()), TraceError);
  CHECK(test::bytes_of(path) == kept);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    CHECK(entry.path().extension() != ".part");
  }
  files::OutputFile file("-o", (folder.path() / "w.txt").string());
  VectorWriter writer(file.handle(), "w.txt", VectorHeader{"lever", 1, {"A", "B", "Z"}}, {});
  writer.add({5, {}});
  CHECK_THROWS_AS(writer.add({5, {}}), TraceError);
  CHECK_THROWS_AS(writer.finish(5), TraceError);
  CHECK_THROWS_AS(VectorWriter(file.handle(), "w.txt", VectorHeader{"lever", 1, {}}, {}),
                  TraceError);
}

TEST_CASE("texts of the command line", "[traces]") {
  CHECK(split_names("A, B,Z") == std::vector<std::string>{"A", "B", "Z"});
  CHECK(split_names("").empty());
  CHECK(std::fabs(parse_scale("4096/360") - 11.3777777) < 1e-6);
  for (const char* wrong : {"", "0", "nan", "1/0", "x", "1/"})
    CHECK_THROWS_AS(parse_scale(wrong), TraceError);
  CHECK(parse_format("saleae") == FileFormat::saleae);
  CHECK(std::string(name_of(FileFormat::vector)) == "vector");
  CHECK_THROWS_AS(parse_format("wav"), TraceError);
}

// Readers of encoder recordings on wrong files: one clear line for each fault.

namespace {

const std::string kVcd =
    "$timescale 1 us $end\n$scope module top $end\n$var wire 1 ! A $end\n$var wire 1 \" B $end\n"
    "$upscope $end\n$enddefinitions $end\n#0\n0!\n0\"\n#2\n1!\n#4\n1\"\n#6\n0!\n#9\n";
const std::string kCsv = "time,A,B\n0.000,0,0\n0.001,1,0\n0.002,1,0\n0.003,1,1\n0.004,0,1\n";
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
