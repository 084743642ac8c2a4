// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the package `cfg` of a design. What connects the blocks is in the table `structs`.
// Documentation: docs/designs.md
#include "design/generate_cfg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <sstream>

#include "design/generate.hpp"
#include "design/text_edit.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate::design {

namespace {

/// A member of a struct. Its type is "" for a bit, a number of bits, or a signal, whose format it
/// has; `signed` before a number gives it a sign.
struct Member {
  const char *type, *name, *doc;
};

struct Struct {
  const char *name, *doc;
  std::vector<Member> members;
};

/// What goes between the blocks. Members are packed from the top bit down.
const std::vector<Struct> structs{
    {"tick_t",
     "The tick, and the clocks in which its results are new.",
     {{"tick", "clock", "of the tick, from 0 on"},
      {"", "sample", "the position is sampled"},
      {"", "velocity", "is new, as the next four"},
      {"", "tau_hat", ""},
      {"", "scene", "its torque"},
      {"", "tau_ref", ""},
      {"", "duty", ""},
      {"", "last", "the last clock of the tick"},
      {"32", "count", "ticks since the reset"}}},
    {"encoder_t",
     "To the encoder's socket.",
     {{"", "sample", "the position is sampled"},
      {"32", "tick_count", ""},
      {"4", "filter", "samples of the glitch filter"},
      {"", "polarity", "the channels are swapped"},
      {"", "set_zero", "the position becomes 0"},
      {"", "clear", "the errors are forgotten"},
      {"", "gates_enable", ""}}},
    {"position_t",
     "From the encoder's socket.",
     {{"signed 32", "position", "counts since the zero"},
      {"signed 32", "count", "counts, which no zero changes"},
      {"signed 16", "travel", "low bits of the counts since the reset"},
      {"", "moved", "an edge came since the tick before"},
      {"", "chatters", "the torque must not grow"},
      {"", "illegal", "both channels changed in one clock"},
      {"", "error", "that was seen since the last clear"},
      {"16", "error_count", ""},
      {"16", "rejected_count", "pulses that the filter took away"},
      {"signed 32", "index_position", "counts, at the last index"},
      {"", "polarity_holds", "the channels cannot be swapped now"},
      {"", "trip_channel", "a channel is dead"},
      {"", "trip_index", "an index came at a wrong count"},
      {"", "trip_flip", "a bit has changed by itself"},
      {"6", "why", "faults.absolute"}}},
    {"drive_t",
     "To the bridge's socket.",
     {{"", "gates_enable", ""},
      {"", "gates_clear", "asynchronous: every gate off at once"},
      {"", "clear", "faults and errors are forgotten"},
      {"", "pwm_mode", "locked antiphase"},
      {"", "polarity", "the motor's leads are swapped"},
      {"", "direct", "direct voltage: no current is controlled"},
      {"", "sample", "the position is sampled"},
      {"", "valid", "the duty is new, with current and feed"},
      {"current", "current", "A, asked for"},
      {"feed", "feed", "V, of the back-EMF and the dead time"},
      {"duty", "duty", "clocks"}}},
    {"bridge_t",
     "From the bridge's socket.",
     {{"", "measured", "there is a measured current"},
      {"", "period_start", "a PWM period begins"},
      {"duty", "duty_active", "of this period"},
      {"current", "current", "A, measured"},
      {"7", "why", "faults.current, status.driver_fault, status.current_missing"}}},
    {"panel_t",
     "Of the panel: a rising arm requests to arm.",
     {{"", "arm", ""}, {"", "stop", ""}, {"", "set_zero", ""}, {"4", "scene", ""}}},
    {"law_t",
     "The program of the scene law.",
     {{"torque", "torque", "Nm"},
      {"", "late", "no fresh torque within its time"},
      {"", "restart", "with the last clock of a tick: the torque ramps"}}},
    {"peers_t",
     "The other axes.",
     {{"", "fault", "one has a fault"},
      {"", "silent", "one does not request to arm: a request waits"},
      {"", "blocked", "one is not ready: a request is refused"},
      {"", "testing", "one runs its self-test"},
      {"", "waits", "one of a lower number tests first"}}},
    {"commands_t",
     "Of host and panel.",
     {{"", "host", "1: the host has control, 0: the panel"},
      {"", "host_arm", "the host's request, a level"},
      {"", "panel_arm", "the panel's"},
      {"", "disarm", "requests do not count in this tick"},
      {"", "stop", "of the panel"},
      {"", "host_stop", ""},
      {"", "clear_faults", ""},
      {"", "kick", "of the watchdog"},
      {"2", "mode", ""}}},
    {"safety_t",
     "State of the safety.",
     {{"", "armed", ""},
      {"", "locks",
       "with the last clock of a tick: armed from the next clock on, unless a cause comes"},
      {"", "gates_enable", "falls at once at a fault"},
      {"", "gates_clear", "asynchronous: every gate off at once"},
      {"", "clear", "faults and errors are forgotten"},
      {"", "arm_request", "counts, and no sensor starts"},
      {"", "ready", "this axis can be armed"},
      {"", "unkicked", "arming waits for the watchdog's first kick"},
      {"", "derated", "hold_limit limits the torque"},
      {"", "testing", "the self-test runs"},
      {"scene_torque", "test_torque", "Nm, of the self-test"},
      {"2", "test_result", "status.self_test"},
      {"16", "faults", "by number of the cause"},
      {"5", "first_fault", "number of the cause, 0: none"},
      {"current_estimate", "current_estimate", "A"}}},
    {"snapshot_t",
     "What the host reads of a tick.",
     {{"32", "tick", ""},
      {"signed 32", "position", "counts"},
      {"32", "status", ""},
      {"32", "faults", ""},
      {"32", "encoder", "rejected and illegal counts"},
      {"signed 32", "index", "counts"},
      {"4", "scene", ""},
      {"12", "limits", ""},
      {"velocity", "velocity", "rad/s"},
      {"torque", "tau_hat", "Nm"},
      {"torque", "tau_ref", "Nm"},
      {"current", "current", "A"},
      {"voltage", "voltage", "V"},
      {"duty", "duty", "clocks"}}},
    {"word_t",
     "A word of the snapshot on its way into memory.",
     {{"", "valid", ""}, {"6", "place", "map::S_..."}, {"32", "data", ""}}},
};

/// Bits of a number from 0 to `most`.
int bits_up_to(int most) {
  int bits = 0;
  while (most >> bits != 0) ++bits;
  return bits;
}

int tick_bits(const Design& d) { return std::max(6, bits_up_to(d.clocks_per_tick() - 1)); }

/// Of the voltage that no current takes: the sum of back-EMF and dead voltage.
int feed_bits(const Elaborated& e) { return e.formats.voltage.width() + 3; }

/// "logic", "logic [7:0]", "logic signed [7:0]".
std::string logic(int bits, bool is_signed) {
  if (bits == 1 && !is_signed) return "logic";
  return fmt::format("logic {}[{}:0]", is_signed ? "signed " : "", bits - 1);
}

std::string type_of(const Elaborated& e, const std::string& type) {
  const std::string sign = "signed ";
  if (type.empty()) return logic(1, false);
  if (type == "tick") return logic(tick_bits(e.design), false);
  if (type == "feed") return logic(feed_bits(e), true);
  if (type.rfind(sign, 0) == 0) return logic(std::stoi(type.substr(sign.size())), true);
  if (type.find_first_not_of("0123456789") == std::string::npos)
    return logic(std::stoi(type), false);
  for (const auto& [name, format] : named_formats(e.formats)) {
    if (name == type) return logic(format.width(), format.sign == 1);
  }
  throw std::logic_error("no signal " + type);
}

void member_sv(std::ostream& s, const std::string& type, const std::string& name,
               const std::string& doc) {
  s << "    " << type << " " << name << ";" << (doc.empty() ? "" : "  // " + doc) << "\n";
}

void struct_sv(std::ostream& s, const Elaborated& e, const Struct& t) {
  s << "\n  // " << t.doc << "\n  typedef struct packed {\n";
  for (const Member& m : t.members) member_sv(s, type_of(e, m.type), m.name, m.doc);
  s << "  } " << t.name << ";\n";
}

const Control& control_word(const RegisterMap& map) {
  for (const Control& c : map.controls) {
    if (c.name == "control") return c;
  }
  throw config::ConfigError(fmt::format("{}:1: no control word \"control\"; list it", map.path));
}

/// Bits of the control word. Its fields must leave no gap: then the struct is the word.
int control_bits(const RegisterMap& map) {
  int next = 0;
  for (const Field& f : control_word(map).fields) {
    if (f.bit != next) {
      throw config::ConfigError(fmt::format(
          "{}:1: control.{} begins at bit {} and {} comes next; list the fields in order "
          "and without gaps",
          map.path, f.name, f.bit, next));
    }
    next += f.width;
  }
  return next;
}

/// The control word as a struct, its highest field first.
void control_sv(std::ostream& s, const RegisterMap& map) {
  std::vector<Field> fields = control_word(map).fields;
  std::reverse(fields.begin(), fields.end());
  s << "\n  // The control word.\n  typedef struct packed {\n";
  for (const Field& f : fields) member_sv(s, logic(f.width, false), f.name, f.doc);
  s << "  } control_t;\n";
}

/// An integer, or a vector of the bits that it needs.
void constant_sv(std::ostream& s, const Elaborated& e, const Constant& c) {
  const int bits = c.name == "SCENE_MASK"      ? 16
                   : c.name == "CONTROL_RESET" ? control_bits(e.registers)
                   : c.name == "DESIGN_CRC"    ? 32
                                               : 0;
  s << "  localparam "
    << (bits == 0 ? fmt::format("int {} = {};", c.name, c.value)
                  : fmt::format("{} {} = {}'h{:0{}x};", logic(bits, false), c.name, bits, c.value,
                                (bits + 3) / 4))
    << (c.doc.empty() ? "" : "  // " + c.doc) << "\n";
}

void resets_sv(std::ostream& s, const Elaborated& e) {
  s << "\n  // Parameter RAM after reset: the design's values, quantised.\n"
    << "  function automatic logic [31:0] parameter_reset(input logic [8:0] address);\n"
    << "    case (address)\n";
  for (const Word& w : e.words) {
    s << "      9'd" << w.parameter.address << ": parameter_reset = 32'd"
      << static_cast<std::uint32_t>(w.raw) << ";  // " << w.parameter.name << "\n";
  }
  s << "      default: parameter_reset = 32'd0;\n    endcase\n  endfunction\n";
}

/// Whether a word has a sign, and the bits above its format. Words of 32 bits fit as they are.
void above_sv(std::ostream& s, const Elaborated& e) {
  s << "\n  // Whether a parameter has a sign, and the bits above its format.\n"
    << "  function automatic logic [32:0] parameter_above(input logic [8:0] address);\n"
    << "    case (address)\n";
  for (const Word& w : e.words) {
    const Format f = w.field();
    const int bits = f.width() - f.sign;
    if (bits >= 32) continue;
    s << fmt::format("      9'd{}: parameter_above = {{1'd{}, 32'h{:08x}}};  // {}\n",
                     w.parameter.address, f.sign, static_cast<std::uint32_t>(-1) << bits,
                     w.parameter.name);
  }
  s << "      default: parameter_above = 33'd0;\n    endcase\n  endfunction\n";
}

/// A vector with one element of 16 bits for each register, the first at the bottom.
void vector_sv(std::ostream& s, const char* name, std::vector<int> elements) {
  std::reverse(elements.begin(), elements.end());
  s << fmt::format("  localparam logic [{}:0] {} = {{16'd{}}};\n", 16 * elements.size() - 1, name,
                   fmt::join(elements, ", 16'd"));
}

void params_sv(std::ostream& s, const Elaborated& e) {
  const std::vector<ParamsRegister> registers = params_registers(e);
  int total = 0;
  for (const ParamsRegister& r : registers) total += r.bits;
  std::vector<int> low, bits, address;
  std::vector<std::string> resets;
  int next = total;
  for (const ParamsRegister& r : registers) {
    next -= r.bits;
    low.push_back(next);
    bits.push_back(r.bits);
    address.push_back(r.address);
    resets.push_back(
        fmt::format("{}'d{}", r.bits,
                    static_cast<std::uint64_t>(r.reset) & ((std::uint64_t{1} << r.bits) - 1)));
  }
  s << "\n  // The words as the blocks take them. Of each register of params_t, from the first on: "
       "its\n"
    << "  // lowest bit, its bits, the address of its word.\n"
    << "  localparam int WORDS = " << registers.size() << ";\n";
  vector_sv(s, "WORD_LOW", low);
  vector_sv(s, "WORD_BITS", bits);
  vector_sv(s, "WORD_ADDRESS", address);
  s << "  localparam int PARAMS_W = " << total << ";\n"
    << fmt::format("  localparam logic [{}:0] PARAMS_RESET = {{{}}};\n", total - 1,
                   fmt::join(resets, ", "))
    << "  typedef struct packed {\n";
  for (const ParamsRegister& r : registers) member_sv(s, logic(r.bits, r.is_signed), r.name, "");
  s << "  } params_t;\n";
}

}  // namespace

std::vector<ParamsRegister> params_registers(const Elaborated& e) {
  std::vector<ParamsRegister> registers;
  std::map<int, ParamsRegister> of_scenes;  // by slot
  for (const Word& w : e.words) {
    const Parameter& p = w.parameter;
    const Format f = w.field();
    if (p.scene.empty()) {
      registers.push_back({p.name, f.width(), f.sign == 1, p.address, w.raw});
      continue;
    }
    // As wide as the widest, and with its sign; the block takes what it needs of the bits.
    ParamsRegister& r = of_scenes[p.slot];
    if (f.width() > r.bits || (f.width() == r.bits && f.sign == 1)) {
      r = {fmt::format("scene_{}", p.slot), f.width(), f.sign == 1, 32 * bank_of_any_scene + p.slot,
           0};
    }
  }
  for (const auto& [slot, r] : of_scenes) registers.push_back(r);
  return registers;
}

std::vector<Constant> cfg_constants(const Elaborated& e) {
  std::vector<Constant> all{{"clock_hz", e.design.clock_hz, "Hz"}};
  for (const Constant& c : design_constants(e)) all.push_back(c);
  all.push_back({"design_crc", design_crc(e), "by which a host knows the design"});
  all.push_back({"tick_w", tick_bits(e.design), "bits of a clock's number in the tick"});
  all.push_back({"feed_w", feed_bits(e), "bits of the voltage that no current takes"});
  for (const auto& [name, f] : named_formats(e.formats)) {
    all.push_back(
        {name + "_w", f.width(), fmt::format("[{},{},{}]", f.sign, f.integer, f.fraction)});
    all.push_back({name + "_f", f.fraction, ""});
  }
  for (const Word& w : e.words) {
    if (w.parameter.kind == "coefficient" || w.parameter.kind == "signed") {
      all.push_back({"p_" + w.parameter.name + "_f", w.format.fraction, ""});
    }
  }
  for (Constant& c : all) c.name = upper(c.name);
  return all;
}

axis::Design as_data(const Elaborated& e) {
  axis::Design d;
  for (const Constant& c : cfg_constants(e)) d.constants.emplace(c.name, c.value);
  for (const Word& w : e.words) {
    const Format f = w.field();
    d.words.push_back({w.parameter.name, w.parameter.address, f.width(), f.sign == 1, f.fraction,
                       static_cast<std::uint32_t>(w.raw)});
  }
  return d;
}

std::string cfg_package(const Elaborated& e) {
  std::ostringstream s;
  s << generated_banner("rtl/designs/" + e.design.name + ".toml and rtl/registers.toml",
                        "Formats [S,I,F], constants,")
    << "// words and structs of the design.\n\n`default_nettype none\n\n"
    << "/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it\n"
    << "package cfg;\n";
  s << "  // Of a signal: width (W) and fraction bits (F); of a coefficient (P): fraction bits.\n";
  for (const Constant& c : cfg_constants(e)) constant_sv(s, e, c);
  resets_sv(s, e);
  above_sv(s, e);
  params_sv(s, e);
  for (const Struct& t : structs) struct_sv(s, e, t);
  control_sv(s, e.registers);
  s << "endpackage\n/* verilator lint_on UNUSEDPARAM */\n\n`default_nettype wire\n";
  return s.str();
}

}  // namespace feltgate::design
