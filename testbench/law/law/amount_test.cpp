// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What users type as a number with a unit. Expected values are written out, not computed by units.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "catch2/catch.hpp"
#include "law/amount.hpp"

namespace {

using feltgate::law::amount_in;
using feltgate::law::BoardUnits;

constexpr BoardUnits kBoard{2 * 3.14159265358979323846 / 4096, 1e-6};

std::string told(const std::string& text, const std::string& unit, const BoardUnits& board = {}) {
  try {
    amount_in(text, unit, board);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "taken";
}

}  // namespace

TEST_CASE("amounts: a unit is converted, a bare number is in the unit of the parameter") {
  const struct {
    const char *text, *unit;
    double value;
  } cases[] = {
      {"4", "Nm/rad", 4},
      {" -4e-3 ", "Nm/rad", -4e-3},
      {"4Nm/deg", "Nm/rad", 229.183118052329},
      {"4 mNm/deg", "Nm/rad", 0.229183118052329},
      {"180deg", "rad", 3.14159265358979},
      {"0.5 turn/s", "rad/s", 3.14159265358979},
      {"0.1", "1", 0.1},
      {"7", "", 7},
      {"50 1/kohm", "1/ohm", 0.05},
      {"5ms", "s", 0.005},
      {"30 g", "kg", 0.03},
      {"2 g m^2", "kg m^2", 0.002},
      {"10 kHz", "Hz", 10000},
      {"3 count", "count", 3},
      {"90deg", "count", 1024},
      {"1 Nm/turn", "Nm/count", 1.0 / 4096},
      {"1 Nm/count", "Nm/rad", 651.898646904403},
      {"1 Nm rad^2", "Nm count^2", 424971.845835792},
      {"50ms", "tick", 50000},
      {"50 tick", "s", 50e-6},
      {"0.64s", "128 ticks", 5000},
      {"2 V/s", "V/tick", 2e-6},
      {"3 A^2 s", "A^2 tick", 3e6},
      {"9 128 ticks", "128 ticks", 9},
  };
  for (const auto& c : cases) {
    INFO(c.text << " in " << c.unit);
    CHECK(amount_in(c.text, c.unit, kBoard) == Approx(c.value).epsilon(1e-12));
  }
}

TEST_CASE("amounts: what cannot be taken says how to write it") {
  CHECK(told("4Nm", "Nm/rad") == "4Nm is not in Nm/rad; give it in Nm/rad");
  CHECK(told("10 Hz", "rad/s") == "10 Hz is not in rad/s; give it in rad/s");
  CHECK(told("1 Nm mrad^2", "Nm") == "1 Nm mrad^2 is not in Nm; give it in Nm");
  CHECK(told("4 N", "Nm/count", kBoard) ==
        "4 N is not in Nm/count; give it in Nm/count, or in Nm/rad");
  CHECK(told("5V", "128 ticks", kBoard) == "5V is not in 128 ticks; give it in 128 ticks, or in s");
  CHECK(told("5mNms/rad", "Nm s/rad") == "5mNms/rad is not in Nm s/rad; write 5 mNm s/rad");
  CHECK(told("80mN", "Nm") == "80mN is not in Nm; give it in Nm");
  CHECK(told("4 furlong", "rad") == "4 furlong is not in rad; give it in rad");
  CHECK(told("4 rad", "1") == "4 rad takes a number without a unit; give the number alone");
  CHECK(told("4 count", "rad") == "4 count is not in rad; give it in rad");  // no board
  CHECK(told("1/count", "rad") != "taken");
  CHECK(told("5,5", "rad").find("write its point as a point") != std::string::npos);
  CHECK(told("4 N/m s", "N/m").find("read in two ways") != std::string::npos);
  for (const char* text : {"", "x", "nan", "inf", "-inf", "1e999", "Nm", "nan Nm"}) {
    INFO(text);
    CHECK(told(text, "Nm").find("is no number; give one") != std::string::npos);
  }
}
