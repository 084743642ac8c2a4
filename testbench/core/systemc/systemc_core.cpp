// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// systemc_core CLOCKS [--broken] [--by-twin] [--options] [--vcd FILE]: the Verilated core and its
// twin as sc_modules on the same pins, every output compared on every clock; motor and encoder
// close the loop through the gates of one of them. --broken: a twin whose observer is one bit off.
// The same loop without SystemC must end at the same count. --options: twins with two modulators
// and with Hall lines, on random pins beside the same cores without SystemC.
#include <Vcore_sc.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>
#include <systemc>

#include "feltgate/generated/gimbal_current.hpp"
#include "feltgate/generated/hall_motor.hpp"
#include "feltgate/generated/lever.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/hand.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/systemc/motor_module.hpp"
#include "sim/systemc/twin_module.hpp"

using namespace feltgate;

namespace {

constexpr int kResetClocks = 4;
constexpr int kStepClocks = 25;
constexpr int kArm = 20 * Lever::clocks_per_tick;  // clock of the request

/// lever with the lowest bit of one parameter changed.
struct Broken : Lever {
  static constexpr auto parameters = [] {
    std::array<ParameterInfo, std::size(Lever::parameters)> all{};
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] = Lever::parameters[i];
      if (all[i].address == A::observer_a1) ++all[i].raw;
    }
    return all;
  }();
};

plant::Hand hand() { return plant::pushing_hand(0.2, 0.002); }

plant::Parameters motor() {
  return plant::read_plant_file(FELTGATE_SOURCE_DIR "/vectors/plants/p24.toml");
}

/// Drives the panel and compares; everything between two rising edges.
class Watch : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk_i{"clk_i"};
  SC_HAS_PROCESS(Watch);
  Watch(const sc_core::sc_module_name& name, systemc::CoreInputs& in,
        const systemc::CoreOutputs<Lever>& rtl, const systemc::CoreOutputs<Lever>& twin)
      : sc_module(name), in_(in), rtl_(rtl), twin_(twin) {
    SC_METHOD(between);
    sensitive << clk_i.neg();
    dont_initialize();
  }
  std::int64_t clocks = 0, mismatches = 0, armed = 0;

 private:
  void between() {
    if (++edges_ <= kResetClocks) {
      in_.rst_ni.write(edges_ == kResetClocks);
      return;
    }
    const std::int64_t next = ++clocks;
    in_.arm_i.write(next >= kArm);
    in_.scene_i.write(Lever::S::spring_tension);
    // A write of the register port in the middle, and a read that follows it.
    in_.reg_write_i.write(next == 2 * kArm + 7);
    in_.reg_addr_i.write(Lever::A::torque_limit);
    in_.reg_wdata_i.write(30000);
    armed += rtl_.armed_o.read() ? 1 : 0;
    const char* differs = rtl_.difference(twin_);
    if (differs == nullptr) return;
    if (mismatches++ == 0) {
      std::printf("mismatch at clock %lld in %s\n", static_cast<long long>(clocks - 1), differs);
    }
  }

  systemc::CoreInputs& in_;
  const systemc::CoreOutputs<Lever>& rtl_;
  const systemc::CoreOutputs<Lever>& twin_;
  std::int64_t edges_ = 0;
};

/// The count at the end of the same loop without SystemC.
std::int32_t direct_count(std::int64_t clocks) {
  const plant::Parameters p = motor();
  plant::Plant plant(p, p.effects, plant::drive_of(design_info<Lever>()), hand());
  FeltgateCore core{design_of<Lever>()};
  CoreIn in;
  in.encoder = plant.encoder().pins();
  double on[4] = {};
  std::size_t next = 0;
  for (std::int64_t clock = 0; clock < clocks; ++clock) {
    if (clock % kStepClocks == 0) {
      plant.advance(plant::Bridge::gates(on[0], on[1], on[2], on[3]), kStepClocks);
      for (double& share : on) share = 0;
      next = 0;
    }
    const auto& events = plant.events();
    for (; next < events.size() && events[next].clock <= clock; ++next) {
      in.encoder = events[next].pins;
    }
    in.arm = clock >= kArm;
    in.scene = clock > 0 ? Lever::S::spring_tension : 0;
    in.reg_write = clock == 2 * kArm + 7;
    in.reg_addr = clock > 0 ? Lever::A::torque_limit : 0;
    in.reg_wdata = clock > 0 ? 30000 : 0;
    core.clock(in);
    for (int gate = 0; gate < 4; ++gate) {
      if (((core.out().gates >> gate) & 1u) != 0) on[gate] += 1.0 / kStepClocks;
    }
    // An event at the end of a step acts in the first clock of the next.
    if ((clock + 1) % kStepClocks == 0 && next < events.size()) in.encoder = events.back().pins;
  }
  return core.out().position;
}

template <class TwinDesign>
int simulate(std::int64_t clocks, bool by_twin, const char* vcd) {
  sc_core::sc_clock clk("clk", 20, sc_core::SC_NS);
  systemc::CoreInputs in("in");
  systemc::CoreOutputs<Lever> of_rtl("of_rtl"), of_twin("of_twin");

  Vcore_sc rtl("rtl");
  systemc::TwinModule<TwinDesign> twin("twin");
  systemc::MotorModule lever("lever", motor(), design_info<Lever>(), hand(), kStepClocks);
  Watch watch("watch", in, of_rtl, of_twin);
  in.rst_ni.write(false);
  systemc::bind(rtl, clk, in, of_rtl);
  systemc::bind(twin, clk, in, of_twin);
  systemc::CoreOutputs<Lever>& driver = by_twin ? of_twin : of_rtl;
  systemc::bind(lever, clk, in, driver);
  watch.clk_i(clk);

  sc_core::sc_trace_file* file = nullptr;
  if (vcd != nullptr) {
    file = sc_core::sc_create_vcd_trace_file(vcd);
    file->set_time_unit(1, sc_core::SC_NS);
    sc_core::sc_trace(file, clk, "clk");
    sc_core::sc_trace(file, lever.angle_rad, "angle_rad");
    of_rtl.trace(file, "rtl");
    of_twin.trace(file, "twin");
  }
  sc_core::sc_start(20 * static_cast<double>(kResetClocks + clocks), sc_core::SC_NS);
  if (file != nullptr) sc_core::sc_close_vcd_trace_file(file);

  const auto count = static_cast<std::int32_t>(driver.position_o.read());
  const std::int32_t direct = direct_count(clocks);
  std::printf("%lld clocks, %lld mismatches, armed for %lld clocks, %d counts (direct: %d)\n",
              static_cast<long long>(watch.clocks), static_cast<long long>(watch.mismatches),
              static_cast<long long>(watch.armed), count, direct);
  const bool lived = watch.armed > clocks / 2 && count > 10;
  if (!lived) std::printf("the lever did not move as it should\n");
  if (count != direct) std::printf("without SystemC the loop ends elsewhere\n");
  return watch.mismatches == 0 && lived && count == direct ? 0 : 1;
}

/// Random pins of the options for a twin, in SystemC and by itself.
template <class D>
class Beside : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Beside);
  explicit Beside(const sc_core::sc_module_name& name) : sc_module(name) {
    board.connect(twin);
    core_.clock({});  // the first edge is at 0 s
    SC_METHOD(between);
    sensitive << board.clk.negedge_event();
    dont_initialize();
  }
  std::int64_t clocks = 0, mismatches = 0, currents = 0, faults = 0;

 private:
  void between() {
    const CoreOut& o = core_.out();
    constexpr auto mask = static_cast<std::uint32_t>((1u << D::f.current.width()) - 1);
    const auto& shown = board.out;
    const unsigned gates =
        (shown.gate_a_hi_o.read() ? 1u : 0u) | (shown.gate_c_lo_o.read() ? 32u : 0u);
    if ((shown.current_o.read() != (static_cast<std::uint32_t>(o.current) & mask) ||
         gates != (o.gates & 33u) || shown.faults_o.read() != o.faults ||
         shown.word_data_o.read() != o.word_data)) {
      ++mismatches;
    }
    currents += o.current != 0 ? 1 : 0;
    const bool told = o.word_valid && o.word_slot == Map::R::faults;
    faults += told && o.word_data >> D::C::faults_absolute != 0 ? 1 : 0;
    ++clocks;
    bits_ = bits_ * 6364136223846793005u + 1442695040888963407u;
    const auto random = static_cast<std::uint32_t>(bits_ >> 40);
    CoreIn in;
    in.current_data =
        static_cast<std::uint8_t>(random & (D::current_loop != 0 && D::phases == 3 ? 3u : 0u));
    in.hall = static_cast<std::uint8_t>(clocks >> 9 & 7);
    in.arm = clocks > 530'000;  // once the offset of the current is known, after 512 periods
    if constexpr (D::absolute_encoder != 0) {
      sensor_.turn(0.9, 0.9, clocks, 1);
      in.encoder_data = sensor_.pin(clocks, o.serial);
    }
    board.in.current_data_i.write(in.current_data);
    board.in.hall_i.write(in.hall);
    board.in.encoder_data_i.write(in.encoder_data);
    board.in.arm_i.write(in.arm);
    core_.clock(in);
  }

 public:
  systemc::Board<D> board{"board"};
  systemc::TwinModule<D> twin{"twin"};

 private:
  FeltgateCore core_{design_of<D>()};
  AbsoluteSensor sensor_{axis::Absolute::parameters(design_of<GimbalCurrent>())};
  std::uint64_t bits_ = 1;
};

int options(std::int64_t clocks) {
  Beside<GimbalCurrent> shunts("shunts");
  Beside<HallMotor> hall("hall");
  sc_core::sc_start(20 * static_cast<double>(clocks), sc_core::SC_NS);
  std::printf(
      "two shunts: %lld clocks, %lld mismatches, %lld currents; Hall: %lld mismatches, %lld "
      "faults\n",
      static_cast<long long>(shunts.clocks), static_cast<long long>(shunts.mismatches),
      static_cast<long long>(shunts.currents), static_cast<long long>(hall.mismatches),
      static_cast<long long>(hall.faults));
  const bool lived = shunts.currents > 1000 && hall.faults > clocks / 1000;
  return shunts.mismatches + hall.mismatches == 0 && lived ? 0 : 1;
}

}  // namespace

int sc_main(int argc, char** argv) {
  const std::int64_t clocks = argc > 1 ? std::atoll(argv[1]) : 0;
  bool broken = false, by_twin = false, pins = false;
  const char* vcd = nullptr;
  for (int i = 2; i < argc; ++i) {
    if (std::strcmp(argv[i], "--broken") == 0) broken = true;
    if (std::strcmp(argv[i], "--by-twin") == 0) by_twin = true;
    if (std::strcmp(argv[i], "--options") == 0) pins = true;
    if (std::strcmp(argv[i], "--vcd") == 0 && i + 1 < argc) vcd = argv[++i];
  }
  if (clocks < 1) {
    std::fprintf(stderr,
                 "usage: systemc_core CLOCKS [--broken] [--by-twin] [--options] [--vcd FILE]\n");
    return 2;
  }
  if (pins) return options(clocks);
  return broken ? simulate<Broken>(clocks, by_twin, vcd) : simulate<Lever>(clocks, by_twin, vcd);
}
