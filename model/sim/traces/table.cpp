// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text tables: names, rows and times. Documentation: docs/traces.md
#include "sim/traces/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "feltgate/nearest.hpp"
#include "sim/traces/text.hpp"

namespace feltgate::traces {
namespace {

constexpr std::size_t kRowsAhead = 12;
constexpr int kUnknown = 99;
constexpr const char* kTimes[] = {"time", "t", "timestamp", "time stamp", "time_stamp", "elapsed"};

/// Power of ten of a unit of time in picoseconds; kUnknown: the word is none.
int power_of(std::string_view unit) {
  static constexpr struct {
    const char* unit;
    int power;
  } kUnits[] = {{"s", 12},           {"sec", 12},   {"secs", 12},        {"second", 12},
                {"seconds", 12},     {"ms", 9},     {"msec", 9},         {"millis", 9},
                {"milliseconds", 9}, {"us", 6},     {"usec", 6},         {"\xC2\xB5s", 6},
                {"\xCE\xBCs", 6},    {"micros", 6}, {"microseconds", 6}, {"ns", 3},
                {"nsec", 3},         {"nanos", 3},  {"nanoseconds", 3},  {"ps", 0},
                {"picoseconds", 0}};
  for (const auto& known : kUnits) {
    if (unit == known.unit) return known.power;
  }
  return kUnknown;
}

bool usual_time(const std::string& name) {
  return std::find(std::begin(kTimes), std::end(kTimes), name) != std::end(kTimes);
}

/// A column's name in small letters without its unit of time, and that unit's power of ten in
/// picoseconds, kUnknown without one. `microseconds` alone is a name and a unit.
struct Heading {
  std::string name;
  int power = kUnknown;
};

Heading heading(const std::string& column) {
  const std::string low = lower(column);
  if (low.size() > 1 && power_of(low) != kUnknown) return {"time", power_of(low)};
  for (std::size_t at = 1; at < low.size(); ++at) {
    std::string_view unit = trim(std::string_view(low).substr(at));
    const char first = unit.empty() ? ' ' : unit.front();
    if (first == '[' || first == '(') {
      const char last = first == '[' ? ']' : ')';
      if (unit.back() != last) continue;
      unit = trim(unit.substr(1, unit.size() - 2));
    } else if (first == '_' || first == '/' || first == ',') {
      unit = trim(unit.substr(1));
    } else if (low[at] != ' ' && !(usual_time(low.substr(0, at)) && unit.size() > 1)) {
      continue;  // `timeMs` has a unit; `counts` has none
    }
    const std::string name(trim(std::string_view(low).substr(0, at)));
    if (power_of(unit) != kUnknown && !name.empty()) return {name, power_of(unit)};
  }
  return {low, kUnknown};
}

bool only_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string_view without_sign(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  return text;
}

/// `0,0005` and `-1,5e-3`, as a part of Europe writes numbers.
bool has_decimal_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return false;
  std::string_view after = text.substr(comma + 1);
  const std::size_t exponent = after.find_first_of("eE");
  if (exponent != std::string_view::npos) {
    if (!only_digits(without_sign(after.substr(exponent + 1)))) return false;
    after = after.substr(0, exponent);
  }
  return only_digits(without_sign(text.substr(0, comma))) && only_digits(after);
}

/// Fields of a line, without blanks and quotes round them; a separator in quotes is none.
void split_into(std::vector<std::string_view>& fields, std::string_view line, char separator) {
  fields.clear();
  for (;;) {
    if (separator == ' ') line = trim(line);
    std::size_t from = std::min(line.find_first_not_of(' '), line.size());
    if (from < line.size() && line[from] == '"') {
      const std::size_t close = line.find('"', from + 1);
      if (close != std::string_view::npos) from = close;
    }
    const std::size_t at =
        separator == ' ' ? line.find_first_of(" \t", from) : line.find(separator, from);
    std::string_view field = trim(line.substr(0, at));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
      field = trim(field.substr(1, field.size() - 2));
    }
    fields.push_back(field);
    if (at == std::string_view::npos) return;
    line = line.substr(at + 1);
  }
}

std::size_t fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  split_into(fields, line, separator);
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields.size();
}

bool is_comment(std::string_view line) { return line.front() == '#' || line.front() == ';'; }

}  // namespace

Table::Table(const std::filesystem::path& path, const Options& options)
    : in_(path),
      time_name_(options.time_column),
      time_unit_(options.time_unit),
      warn_(options.warn) {
  std::vector<std::string> comments;
  for (;;) {
    if (!next_line()) fail("the table has no line of column names", "give a first line of names");
    if (!is_comment(line_)) break;
    comments.emplace_back(trim(std::string_view(line_).substr(1)));
    note(comments.back());
  }
  sample_hz_ = options.sample_hz > 0 ? options.sample_hz : noted_hz_;
  const Line first{line_, where_};
  read_ahead();
  line_ = first.text;
  where_ = first.where;
  choose_separator();
  split();
  const bool numbers = std::all_of(fields_.begin(), fields_.end(), [](std::string_view field) {
    return parse_real(field).has_value();
  });
  columns_.assign(fields_.begin(), fields_.end());
  if (numbers) {
    columns_ = names_before(comments);
    ahead_.push_front(first);
  }
  // libsigrok names columns by their kind, and the channels in a line before.
  const auto kinds = std::count(columns_.begin(), columns_.end(), "logic");
  if (static_cast<std::size_t>(kinds) == channels_.size()) {
    auto channel = channels_.begin();
    for (std::string& name : columns_) {
      if (name == "logic") name = *channel++;
    }
  }
  refuse_units();
}

bool Table::next_line() {
  do {
    if (ahead_.empty()) {
      if (!in_.line(line_)) return false;
      where_ = in_.where();
    } else {
      line_ = std::move(ahead_.front().text);
      where_ = std::move(ahead_.front().where);
      ahead_.pop_front();
    }
  } while (trim(line_).empty());
  return true;
}

void Table::read_ahead() {
  std::deque<Line> rows;
  while (rows.size() < kRowsAhead && next_line()) rows.push_back({line_, where_});
  ahead_ = std::move(rows);
}

/// What programs of logic analysers say before their names: the rate, and the channels.
void Table::note(std::string_view comment) {
  const std::string low = lower(comment);
  sigrok_ = sigrok_ || low.find("generated by libsigrok ") != std::string::npos;
  const std::size_t colon = comment.find_first_of(":=");
  if (colon == std::string_view::npos) return;
  std::string key = low.substr(0, colon);
  key.erase(std::remove_if(key.begin(), key.end(), [](char c) { return c == ' ' || c == '_'; }),
            key.end());
  const std::string value(trim(comment.substr(colon + 1)));
  if (key == "samplerate" || key == "samplerate[hz]" || key == "samplerate(hz)") {
    noted_hz_ = parse_rate(value).value_or(0);
  }
  if (key.compare(0, 9, "channels(") == 0) channels_ = split_names(value);
}

/// The one that gives names and first row the same number of fields, or else names at all.
void Table::choose_separator() {
  for (const bool also_row : {true, false}) {
    if (also_row && ahead_.empty()) continue;
    for (const char separator : {'\t', ';', ',', ' '}) {
      const std::size_t names = fields_of(line_, separator);
      if (names < 2 || (also_row && fields_of(ahead_.front().text, separator) != names)) continue;
      separator_ = separator;
      return;
    }
  }
}

/// The names of a table that begins with numbers: they stand in a line before it, or nowhere.
std::vector<std::string> Table::names_before(const std::vector<std::string>& comments) const {
  const std::size_t count = fields_.size();
  if (channels_.size() == count) return channels_;
  if (channels_.size() + 1 == count) {
    std::vector<std::string> names = channels_;
    names.insert(names.begin(), "Time");
    return names;
  }
  std::vector<std::string_view> names;
  if (!comments.empty()) split_into(names, comments.back(), separator_);
  if (count < 2 || names.size() != count) {
    fail("the first line holds numbers", "put the column names before them");
  }
  return {names.begin(), names.end()};
}

/// Oscilloscopes write a second line of names, with units.
void Table::refuse_units() {
  if (ahead_.empty()) return;
  const Line row = ahead_.front();
  std::vector<std::string_view> fields;
  split_into(fields, row.text, separator_);
  if (fields.size() < columns_.size()) return;  // short, as its reader will say
  bool units = false, volts = false, numbers = false;
  for (std::string_view field : fields) {
    numbers = numbers || parse_real(field).has_value();
    if (field.size() > 2 && (field.front() == '(' || field.front() == '[')) {
      field = field.substr(1, field.size() - 2);
    }
    const std::string low = lower(field);
    volts = volts || low == "v" || low == "mv" || low == "volt" || low == "volts";
    units = units || volts || power_of(low) != kUnknown;
  }
  if (!units && (numbers || row.text.find_first_of("0123456789") != std::string::npos)) return;
  traces::fail(row.where, "a row of units or names, " + shown(row.text) + ", below the names",
               volts ? "remove it, and give levels of 0 and 1 in place of volts" : "remove it");
}

void Table::split() {
  split_into(fields_, line_, separator_);
  // A separator at the end of the line starts no field.
  const bool extra = columns_.empty() ? fields_.size() > 1 : fields_.size() == columns_.size() + 1;
  if (extra && fields_.back().empty()) fields_.pop_back();
  for (const std::string_view field : fields_) {
    if (!has_decimal_comma(field)) continue;
    line_[static_cast<std::size_t>(field.data() - line_.data()) + field.find(',')] = '.';
  }
}

std::size_t Table::find(const std::string& name) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i] == name) return i;
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (lower(columns_[i]) == lower(name) || heading(columns_[i]).name == lower(name)) return i;
  }
  return columns_.size();
}

std::size_t Table::use_time() {
  time_column_ = columns_.size();
  if (!time_name_.empty()) {
    time_column_ = find(time_name_);
    if (time_column_ == columns_.size()) {
      fail("no column " + shown(time_name_), columns_there(time_name_));
    }
  } else {
    for (const char* usual : kTimes) {
      if (time_column_ == columns_.size()) time_column_ = find(usual);
    }
  }
  if (time_column_ == columns_.size()) {
    if (sample_hz_ > 0) return time_column_;
    fail("no column of time",
         columns_there("") +
             "; or give the rate of the samples in Hz (--sample-hz), as a line "
             "'Samplerate: ...' before the names does");
  }
  const int told = heading(columns_[time_column_]).power;
  const int asked = time_unit_.empty() ? told : power_of(time_unit_);
  if (!time_unit_.empty() && asked == kUnknown) {
    fail("the unit of time " + shown(time_unit_) + " is unknown", "give s, ms, us or ns");
  }
  time_power_ = asked == kUnknown ? 12 : asked;
  if (sigrok_ && noted_hz_ > 0 && time_unit_.empty()) {
    // libsigrok counts in units of 1000^-n s, the first that its rate does not exceed, and cuts off
    // the period of a sample to a whole number of them; a stamp tells its sample nevertheless.
    std::int64_t units = 1;
    while (units < noted_hz_) units *= 1000;
    period_ = units / noted_hz_;
  } else if (asked == kUnknown) {
    look_at_stamps();
  }
  return time_column_;
}

/// Milliseconds or microseconds without a unit are read as seconds, thousands of times too slow.
void Table::look_at_stamps() const {
  constexpr std::size_t kLeast = 4;
  if (!warn_ || ahead_.size() < kLeast) return;
  std::vector<std::string_view> fields;
  double first = 0, last = 0;
  for (const Line& row : ahead_) {
    split_into(fields, row.text, separator_);
    const auto stamp =
        time_column_ < fields.size() ? parse_real(fields[time_column_]) : std::optional<double>();
    if (!stamp) return;
    if (&row == &ahead_.front()) first = *stamp;
    last = *stamp;
  }
  const double apart = (last - first) / static_cast<double>(ahead_.size() - 1);
  if (apart < 1.0) return;
  warn_(
      fmt::format("{}: the rows are {:.4g} s apart, because the times of {} have no unit and are "
                  "taken for seconds; if they are not, give --time-unit ms or us",
                  ahead_.front().where, apart, shown(columns_[time_column_])));
}

bool Table::read() {
  if (!next_line()) return false;
  split();
  if (fields_.size() != columns_.size()) {
    const bool commas =
        separator_ == ',' && fields_.size() > columns_.size() &&
        std::all_of(fields_.begin(), fields_.end(), [](std::string_view field) {
          return only_digits(without_sign(field.substr(0, field.find_first_of("eE"))));
        });
    fail(fmt::format("the row has {} of {} fields", fields_.size(), columns_.size()),
         commas ? "its numbers seem to have a decimal comma; export them with a decimal point, or "
                  "with semicolons between the columns"
                : "the file is truncated or damaged; fetch it again");
  }
  constexpr int128_t kMost = int128_t{1} << 62U;
  const int128_t now = stamp();
  if (rows_++ == 0) origin_ = now;
  const int128_t since = now - origin_;
  const std::string shown_time = time_column_ < fields_.size() ? shown(fields_[time_column_])
                                                               : fmt::format("of row {}", rows_);
  if (since > kMost) {
    fail("time " + shown_time + " is over 53 days in", "check its unit, or cut the recording");
  }
  if (since < time_) {
    fail("time goes backwards to " + shown_time, "sort the recording or cut it");
  }
  time_ = static_cast<std::int64_t>(since);
  return true;
}

/// Picoseconds of the present row: of its time, or of its sample's number.
int128_t Table::stamp() {
  const auto of_sample = [&](int128_t sample) {
    constexpr int128_t kSecond = 1'000'000'000'000;
    return (2 * sample * kSecond + sample_hz_) / (2 * int128_t{sample_hz_});
  };
  if (time_column_ == columns_.size()) return of_sample(rows_);
  const std::string_view text = fields_[time_column_];
  if (period_ > 0) {
    const std::optional<std::int64_t> count = parse_count(text);
    if (!count || *count % period_ != 0) {
      fail("time " + shown(text) +
               fmt::format(" is no multiple of {}, the period of a sample", period_),
           "export it again, or give the unit of the time (--time-unit)");
    }
    return of_sample(*count / period_);
  }
  const std::optional<int128_t> t = parse_decimal(text, time_power_);
  if (!t) fail("time " + shown(text) + " is not a finite number", "give a number");
  return *t;
}

std::string Table::values() const {
  std::string text;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (i != time_column_) text.append(fields_[i]).append(1, separator_);
  }
  return text;
}

void Table::fail(const std::string& what, const std::string& mend) const {
  traces::fail(where_, what, mend);
}

std::string Table::columns_there(const std::string& name) const {
  return fmt::format("{}name it; there are: {}", config::did_you_mean(name, columns_),
                     list_names(columns_));
}

}  // namespace feltgate::traces
