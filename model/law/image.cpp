// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/laws.md
#include "law/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "feltgate/crc32.hpp"

namespace feltgate::law {

namespace {

constexpr const char* first_line = "feltgate-law-image 1";

bool same(const ImageWord& a, const ImageWord& b) {
  return a.name == b.name && a.unit == b.unit && a.word == b.word && a.scale == b.scale &&
         a.to_si == b.to_si && a.lower == b.lower && a.upper == b.upper && a.initial == b.initial &&
         a.whole == b.whole && a.mailbox == b.mailbox && a.max_age_s == b.max_age_s &&
         a.formula == b.formula;
}

std::string blank(const std::string& s) { return s.empty() ? "-" : s; }
std::string unblank(const std::string& s) { return s == "-" ? "" : s; }

/// Reads the fields of a line; throws for a malformed one.
class Fields {
 public:
  Fields(const std::string& text, int number) : in_(text), number_(number) {}

  template <class Value>
  Value take(const char* what) {
    Value value{};
    if (!(in_ >> value)) fail(std::string(what) + " is missing or no such value");
    return value;
  }
  /// A finite number.
  double number(const char* what, bool may_be_zero = false) {
    const auto word = take<std::string>(what);
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end != 0 || !std::isfinite(value) || (value == 0 && !may_be_zero)) {
      fail(fmt::format("{} \"{}\" is no number that it can have", what, word));
    }
    return value;
  }
  std::uint64_t hex(const char* what, int bits) {
    const auto word = take<std::string>(what);
    char* end = nullptr;
    const std::uint64_t value = std::strtoull(word.c_str(), &end, 16);
    if (*end != 0 || (value >> bits) != 0) {
      fail(fmt::format("{} \"{}\" is no hexadecimal number of {} bits", what, word, bits));
    }
    return value;
  }
  std::size_t index(const char* what, int limit) {
    const int value = take<int>(what);
    if (value < 0 || value >= limit) fail(fmt::format("{} {} is not below {}", what, value, limit));
    return static_cast<std::size_t>(value);
  }
  std::string rest() {
    std::string s;
    std::getline(in_ >> std::ws, s);
    return s;
  }
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::invalid_argument(fmt::format(
        "line {}: {}; compile the law again: feltgate law NAME -o FILE", number_, reason));
  }

 private:
  std::istringstream in_;
  int number_;
};

ImageWord read_word(Fields& line) {
  ImageWord w;
  w.word = static_cast<int>(line.index("word", 32));
  w.name = line.take<std::string>("name");
  w.unit = unblank(line.take<std::string>("unit"));
  w.scale = line.number("scale");
  w.to_si = line.number("factor");
  w.lower = line.take<std::int32_t>("lower end");
  w.upper = line.take<std::int32_t>("upper end");
  w.initial = line.take<std::int32_t>("value");
  w.whole = line.take<int>("whole") != 0;
  w.mailbox = line.take<int>("mailbox") != 0;
  w.max_age_s = line.number("age", true);
  if (w.lower > w.upper) line.fail(fmt::format("{} is above {}", w.lower, w.upper));
  w.formula = unblank(line.rest());
  return w;
}

ImageRequirement read_requirement(Fields& line) {
  ImageRequirement r;
  r.smaller_name = line.take<std::string>("name");
  const auto comparison = line.take<std::string>("comparison");
  r.strict = comparison == "<";
  if (!r.strict && comparison != "<=") {
    line.fail(fmt::format("comparison \"{}\" is neither < nor <=", comparison));
  }
  r.larger_name = line.take<std::string>("name");
  const std::string both = line.rest();
  const std::size_t bar = both.find(" | ");
  if (bar == std::string::npos) line.fail("\"|\" is missing between two formulas");
  r.smaller = both.substr(0, bar);
  r.larger = both.substr(bar + 3);
  return r;
}

void read_line(Image& image, std::uint32_t& stored, Fields& line) {
  const auto key = line.take<std::string>("key");
  if (key == "name") {
    image.name = line.take<std::string>("name");
  } else if (key == "design") {
    image.design = line.take<std::string>("design");
  } else if (key == "thread") {
    ImageThread& t = image.threads[line.index("thread", 4)];
    t.used = true;
    t.divider = line.take<int>("divider");
    t.length = line.take<int>("length");
  } else if (key == "line_base") {
    image.line_base = line.take<int>("line_base");
  } else if (key == "max_age") {
    image.max_age_ticks = line.take<int>("max_age");
  } else if (key == "mailbox") {
    image.mailbox_first = static_cast<int>(line.index("mailbox", 33));
    image.mailbox_age = static_cast<int>(line.index("age", 0x10000));
  } else if (key == "crc") {
    stored = static_cast<std::uint32_t>(line.hex("crc", 32));
  } else if (key == "parameter") {
    image.words.push_back(read_word(line));
  } else if (key == "output") {
    ImageOutput o;
    o.axis = line.take<int>("axis");
    o.name = line.take<std::string>("name");
    image.outputs.push_back(o);
  } else if (key == "event") {
    ImageEvent e;
    e.number = line.take<int>("number");
    e.name = line.take<std::string>("name");
    e.scale = line.number("scale");
    image.events.push_back(e);
  } else if (key == "require") {
    image.requirements.push_back(read_requirement(line));
  } else if (key == "p") {
    const auto n = line.index("address", 512);
    image.program[n] = line.hex("program word", 36);
  } else if (key == "d") {
    const auto n = line.index("address", 512);
    image.data[n] = static_cast<std::int32_t>(line.hex("data word", 32));
  } else if (key == "t") {
    const auto n = line.index("address", 512);
    image.table[n] = line.hex("table word", 36);
  } else {
    line.fail("\"" + key + "\" is unknown");
  }
}

/// Throws std::invalid_argument where a formula cannot be computed from the parameters.
void check_formulas(const Image& image) {
  const auto value_of = [&image](const std::string& name) {
    for (const ImageWord& p : image.words) {
      if (p.formula.empty() && p.name == name) return p.initial * p.scale;
    }
    throw std::invalid_argument("formula names \"" + name + "\", which is no parameter");
  };
  for (const ImageWord& w : image.words) {
    if (!w.formula.empty()) (void)evaluate_formula(w.formula, value_of);
  }
  for (const ImageRequirement& r : image.requirements) {
    for (const std::string& formula : {r.smaller, r.larger})
      (void)evaluate_formula(formula, value_of);
  }
}

}  // namespace

bool Image::operator==(const Image& o) const {
  return text(*this) == text(o) &&
         std::equal(words.begin(), words.end(), o.words.begin(), o.words.end(), same);
}

std::uint32_t crc(const Image& image) {
  std::uint32_t state = crc32_start;
  const auto add = [&state](std::uint64_t word, int bytes) {
    for (int i = 0; i < bytes; ++i) {
      state = crc32_step(state, static_cast<std::uint8_t>(word >> (8 * i)));
    }
  };
  for (const std::uint64_t word : image.program) add(word, 5);
  for (std::size_t i = Image::lower_base; i < image.data.size(); ++i) {
    add(static_cast<std::uint32_t>(image.data[i]), 4);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(image.line_base); ++i) {
    add(image.table[i], 5);
  }
  return ~state;
}

std::string text(const Image& image) {
  std::string s = fmt::format("{}\nname {}\ndesign {}\n", first_line, image.name, image.design);
  for (std::size_t t = 0; t < 4; ++t) {
    const ImageThread& thread = image.threads[t];
    if (thread.used) s += fmt::format("thread {} {} {}\n", t, thread.divider, thread.length);
  }
  s += fmt::format("line_base {}\nmax_age {}\ncrc {:08x}\n", image.line_base, image.max_age_ticks,
                   crc(image));
  if (image.mailbox_first != 32) {
    s += fmt::format("mailbox {} {}\n", image.mailbox_first, image.mailbox_age);
  }
  for (const ImageWord& w : image.words) {
    s += fmt::format("parameter {} {} {} {:.17g} {:.17g} {} {} {} {} {} {:.17g} {}\n", w.word,
                     w.name, blank(w.unit), w.scale, w.to_si, w.lower, w.upper, w.initial,
                     w.whole ? 1 : 0, w.mailbox ? 1 : 0, w.max_age_s, blank(w.formula));
  }
  for (const ImageOutput& o : image.outputs) s += fmt::format("output {} {}\n", o.axis, o.name);
  for (const ImageEvent& e : image.events) {
    s += fmt::format("event {} {} {:.17g}\n", e.number, e.name, e.scale);
  }
  for (const ImageRequirement& r : image.requirements) {
    s += fmt::format("require {} {} {} {} | {}\n", r.smaller_name,
                     r.strict ? "<" : "<=", r.larger_name, r.smaller, r.larger);
  }
  for (std::size_t i = 0; i < 512; ++i) {
    if (image.program[i] != 0) s += fmt::format("p {} {:09x}\n", i, image.program[i]);
  }
  for (std::size_t i = 0; i < 512; ++i) {
    const auto word = static_cast<std::uint32_t>(image.data[i]);
    if (word != 0) s += fmt::format("d {} {:08x}\n", i, word);
  }
  for (std::size_t i = 0; i < 512; ++i) {
    if (image.table[i] != 0) s += fmt::format("t {} {:09x}\n", i, image.table[i]);
  }
  return s;
}

Image read_image(const std::string& text) {
  Image image;
  std::istringstream in(text);
  std::string line;
  std::uint32_t stored = 0;
  for (int number = 1; std::getline(in, line); ++number) {
    Fields fields(line, number);
    const auto control = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; };
    if (std::any_of(line.begin(), line.end(), control))
      fields.fail("a character that cannot be printed");
    if (number == 1) {
      if (line != first_line)
        fields.fail(fmt::format("this is no law's image (\"{}\")", first_line));
      continue;
    }
    if (!line.empty()) read_line(image, stored, fields);
  }
  if (image.name.empty() || image.design.empty()) Fields("", 1).fail("no name or no design");
  if (image.line_base < 0 || image.line_base > 512)
    Fields("", 1).fail("line_base is not in 0 .. 512");
  if (stored != crc(image)) {
    Fields("", 1).fail(
        fmt::format("the CRC-32 is {:08x} where {:08x} is written", crc(image), stored));
  }
  try {
    check_formulas(image);
  } catch (const std::invalid_argument& error) {
    Fields("", 1).fail(error.what());
  }
  return image;
}

std::vector<std::int32_t> parameter_words(const Image& image, const std::vector<double>& values) {
  std::vector<std::int32_t> words(32, 0);
  const auto rounded = [](const ImageWord& w, double value) {
    const double word = std::nearbyint(value / w.scale);
    if (!(word > w.lower)) return w.lower;  // NaN too
    return static_cast<std::int32_t>(std::min(word, static_cast<double>(w.upper)));
  };
  std::size_t next = 0;
  for (const ImageWord& w : image.words) {
    if (!w.formula.empty()) continue;
    const double value = next < values.size() ? values[next] : w.initial * w.scale;
    ++next;
    words[static_cast<std::size_t>(w.word)] = rounded(w, value);
  }
  for (const ImageWord& w : image.words) {
    if (w.formula.empty()) continue;
    const double value = evaluate_formula(w.formula, [&](const std::string& name) {
      for (const ImageWord& p : image.words) {
        if (p.formula.empty() && p.name == name) {
          return words[static_cast<std::size_t>(p.word)] * p.scale;
        }
      }
      throw std::invalid_argument("formula names \"" + name + "\", which is no parameter");
    });
    words[static_cast<std::size_t>(w.word)] = rounded(w, value);
  }
  return words;
}

}  // namespace feltgate::law
