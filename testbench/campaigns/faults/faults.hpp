// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parts of the campaign: bits of the core's state that flip, faults at pins and register port,
// device time without a fault, and each fault as a line of JSON. Documentation: docs/testing.md
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "campaigns/faults/outcome.hpp"

namespace feltgate::faults {

// Flips for one clock. The core runs in closed loop beside a sound core on the same lever.

/// One bit of state: of a flip-flop, of a parameter's word, or of the line of travels.
struct StateBit {
  enum class Kind { flop, parameter, line };
  Kind kind = Kind::flop;
  std::string name;  ///< register, or word
  int at = 0;        ///< bit number in flip_i, or address
  int bit = 0;
  std::string group;   ///< group in the report
  bool safety = true;  ///< the bit counts for the share of silent faults
};
std::vector<StateBit> state_bits();

struct StateFault {
  std::size_t act = 0;
  std::int64_t tick = 0;          ///< ticks since the beginning of the act
  int clock = 0;                  ///< clock of the tick; the bit is flipped after its edge
  std::vector<std::size_t> bits;  ///< indices into state_bits(); two for a double flip
  bool stuck = false;             ///< the first bit stays 1: a broken product, not a flip
  int reset_clocks = 0;           ///< not 0: a reset of so many clocks (brown-out), no flip
};

struct StateCampaign {
  std::string root;
  std::uint64_t seed = 1;
  int flips_per_bit = 4;
  int doubles = 0;
  int resets = 0;
  std::string only;        ///< only registers whose name contains this text; empty: all
  std::size_t acts = 100;  ///< largest number of acts
};

struct StateResult {
  StateFault fault;
  Outcome outcome;
};

std::vector<StateFault> plan(const StateCampaign& campaign);
/// Runs the faults and calls back after each one, in the order of acts and ticks. Returns the
/// number of ticks in which the sound core and the twin differed; it must be 0.
std::int64_t run(const StateCampaign& campaign, std::vector<StateFault> faults,
                 const std::function<void(const StateResult&)>& each);

// Faults at the encoder's pins, at the stop and at the register port of lever: the core's twin runs
// in closed loop beside a sound twin on the same lever. And faults at the pins that lever does not
// have: of a current loop, an absolute encoder, three phases, Hall lines.

/// The promise of docs/safety.md for a kind of fault.
enum class Promise {
  none,
  flagged,  ///< a fault in >= 99 %
  unseen,   ///< the core cannot see the fault: unsafe outcomes are reported separately
  refused,  ///< the request to arm is, for good: the gates never open
};

/// A kind of fault: the name of its row, and its share of the runs.
struct PinKind {
  const char* name;
  const char* point;  ///< "pins" or "words"
  int share;          ///< in hundredths of the number given by --pins
  Promise promise;
  int within_us = 0;  ///< the gates are off by then, where it is flagged; 0: not promised
};
/// Of a design: lever, and those whose options have pins of their own.
const std::vector<PinKind>& pin_kinds(const std::string& design = "lever");

struct PinResult {
  std::size_t kind = 0;
  std::uint64_t seed = 0;  ///< seed of this fault: kind and seed reproduce it
  std::string what;        ///< scene, speed and so on
  Outcome outcome;
  std::string design;
};

/// Runs one fault of a kind.
PinResult run_pin_fault(const std::string& root, std::size_t kind, std::uint64_t seed,
                        const std::string& design = "lever");

/// Names of the designs whose options have pins of their own.
std::vector<std::string> option_designs();
/// Those of one of these designs; none for another.
const std::vector<PinKind>& option_kinds(const std::string& design);

/// Runs one fault. The sound core has a motor and a hand of its own: what it measures is what its
/// gates make.
PinResult run_option_fault(const std::string& root, const std::string& design, std::size_t kind,
                           std::uint64_t seed);

// Device time without any fault: nothing may be flagged.

struct CleanResult {
  double scenes_s = 0, recordings_s = 0, dither_s = 0;  ///< device time of each kind
  std::int64_t alarms = 0;                              ///< faults, and motors disarmed
  std::string first;                                    ///< description of the first alarm
  double seconds() const { return scenes_s + recordings_s + dither_s; }
};

/// Runs the twin for `seconds` of device time. A twelfth is closed loop (scenes, hands and their
/// strength come from the seed); the rest is the shipped recordings in a loop, dither on one edge,
/// and a lever at rest.
CleanResult run_clean(const std::string& root, double seconds, std::uint64_t seed,
                      const std::function<void(double done)>& progress);

/// The same of a design with a current loop, an absolute encoder or three phases, in closed loop
/// alone. Errors: std::invalid_argument for another design.
CleanResult run_option_clean(const std::string& root, const std::string& design, double seconds,
                             std::uint64_t seed, const std::function<void(double done)>& progress);

// Lines of JSON.

std::string line_of(const StateResult& result, const std::vector<StateBit>& bits,
                    const std::vector<std::string>& act_names);
std::string line_of(const PinResult& result);

/// A case of a list: a pin fault or a state fault. Throws std::invalid_argument with the reason.
struct CaseLine {
  bool pins = false;
  StateFault state;
  std::size_t kind = 0;
  std::uint64_t seed = 0;
  std::string design;    ///< of a pin fault
  std::string expected;  ///< name of the expected class
};
CaseLine read_case(const std::string& line);

}  // namespace feltgate::faults
