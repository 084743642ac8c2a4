// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Absolute encoders of several axes, and of an axis with an engine: no sensor that comes after a
// request to arm opens the gates. The twin alone. Documentation: docs/blocks/safety.md
#include <array>
#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "feltgate/axis/absolute.hpp"
#include "feltgate/design_info.hpp"
#include "feltgate/feltgate_axes.hpp"
#include "feltgate/generated/knob_law.hpp"
#include "feltgate/generated/lever_absolute.hpp"
#include "feltgate/generated/lever_current.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "twins.hpp"

using feltgate::AbsoluteSensor;
using Defect = AbsoluteSensor::Defect;

namespace {

/// N axes of design D with a sensor each, from power-up on; a panel or a host asks.
template <class D, int Axes, bool Engine>
class Device {
 public:
  static constexpr std::size_t N = Axes;
  static constexpr bool engine = Engine;

  explicit Device(bool host) : host_(host) {
    for (AbsoluteSensor& s : sensors_) s.turn(0.5, 0.5, 0, 1);
    if (host) each([this](std::size_t n) { control(n, false); });
    ticks(3);
  }
  void ticks(std::int64_t n) {
    for (std::int64_t c = n * D::clocks_per_tick - twin_.clock_of_tick(); c > 0; --c) clock();
  }
  void ms(double time) { ticks(static_cast<std::int64_t>(1e-3 * time * D::tick_hz)); }
  void set(std::size_t axis, Defect defect) { sensors_[axis].set(defect); }
  /// Of one axis; a panel asks for all at once.
  void ask(std::size_t axis, bool high) {
    if (host_) return control(axis, high);
    in_.arm = high;
    ticks(2);
  }
  void ask_all(bool high) {
    each([&](std::size_t n) { ask(n, high); });
  }
  template <class F>
  void each(F f) const {
    for (std::size_t n = 0; n < N; ++n) f(n);
  }
  bool opened() const { return opened_; }
  bool all_open() const {
    bool open = true;
    each([&](std::size_t n) { open = open && twin_.out().axis[n].gates_enable; });
    return open;
  }

 private:
  void control(std::size_t axis, bool arm) {
    using C = typename D::C;
    while (twin_.clock_of_tick() != 5) clock();
    in_.reg_addr = static_cast<std::uint16_t>(axis * feltgate::axes_stride + C::control);
    in_.reg_wdata = static_cast<std::uint32_t>(D::control_reset) | 1u << C::control_host |
                    std::uint32_t{arm} << C::control_arm;
    in_.reg_write = true;
    clock();
    in_.reg_write = false;
    ticks(2);
  }
  void clock() {
    each([this](std::size_t n) {
      in_.axis[n].encoder_data = sensors_[n].pin(now_, twin_.out().axis[n].serial);
    });
    twin_.clock(in_);
    each([this](std::size_t n) { opened_ = opened_ || twin_.out().axis[n].gates_enable; });
    ++now_;
  }

  feltgate::test::AxesOf<D, Axes, true, Engine> twin_;
  feltgate::AxesIn<Axes> in_;
  std::vector<AbsoluteSensor> sensors_{N, AbsoluteSensor{feltgate::test::absolute_parameters<D>()}};
  std::int64_t now_ = 0;
  bool host_, opened_ = false;
};

using OneWithEngine = Device<feltgate::KnobLaw, 1, true>;
using Two = Device<feltgate::LeverAbsolute, 2, false>;

}  // namespace

TEMPLATE_TEST_CASE("late sensor: none that comes after the request opens the gates", "",
                   OneWithEngine, Two) {
  for (const bool host : {false, true}) {
    for (const double later_ms : {0.5, 25.0}) {
      TestType d(host);
      d.set(TestType::N - 1, Defect::cut);
      d.ms(0.5);
      d.ask_all(true);
      d.ms(later_ms);
      d.set(TestType::N - 1, Defect::none);
      d.ms(5);
      CHECK_FALSE(d.opened());
      d.ask_all(false);
      d.ask_all(true);
      d.ms(2);  // the CRC of the programs takes up to 1 ms
      CHECK(d.all_open());
    }
  }
}

TEMPLATE_TEST_CASE("late sensor: a request at power-up waits for the first reading", "",
                   OneWithEngine, Two) {
  for (const bool host : {false, true}) {
    TestType d(host);
    d.ask_all(true);
    CHECK_FALSE(d.opened());
    d.ms(2);
    CHECK(d.all_open());
  }
}

TEST_CASE("late sensor: an axis that asked 20 ms ago arms with no other") {
  for (const double later_ms : {19.9, 20.1}) {
    Two d(true);
    d.ms(1);
    d.ask(0, true);
    d.ms(later_ms);
    d.ask(1, true);
    d.ms(1);
    CHECK(d.opened() == (later_ms < 20));
    d.ask_all(false);
    d.ask_all(true);
    d.ms(1);
    CHECK(d.all_open());
  }
}

TEST_CASE("late sensor: a simulation asks once the offset of a current is known, if it is slow") {
  feltgate::DesignInfo slow = feltgate::design_info<feltgate::LeverCurrent>();
  CHECK(slow.request_at(7) == 7);
  slow.pwm_period = 2500;
  CHECK(slow.request_at(7) == 513 * 2500);
  CHECK(slow.request_at(2'000'000) == 2'000'000);
}
