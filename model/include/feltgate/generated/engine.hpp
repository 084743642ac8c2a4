// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/engine/engine.toml by
// `feltgate generate`: do not edit.
#pragma once

#include <cstdint>
#include <string_view>

namespace feltgate {

/// Instructions of the engine. x, y: the data words at a and b; yf: y's low 18 bits,
/// signed; acc: the result before. docs/engine-isa.md
enum class EngineOp : std::uint8_t {
  add,  ///< mode 0: sat(x + y); 1: wrap(x + y); 2: sat(acc + x); 3: wrap(acc + x)
  sub,  ///< mode 0: sat(x - y); 1, 3: wrap(x - y); 2: sat(acc - x)
  mul,  ///< sat(round(x * yf >> s))
  mac,  ///< sat(acc + round(x * yf >> s)), one saturation of the exact sum
  mlw,  ///< wrap(x * yf >> s), not rounded: turns
  min,  ///< the smaller of x, y
  max,  ///< the larger of x, y
  sel,  ///< flag ? x : y
  cmp,  ///< c = x < y; flag becomes mode 0: c; 1: flag or c; 2: flag and c; 3: not c. The result is the new flag, 0 or 1
  lrp,  ///< t = table[b + (x >> 12) mod 512]: t's value + round(t's slope * (x & 0xfff) >> 12)
  tab,  ///< table[b + (x >> 12) mod 512], its low 32 bits
  tst,  ///< table[b + (x >> 12) mod 512] becomes acc, where that is a word of a line; the result is acc
  frc,  ///< x & 0xfff
  brf,  ///< mode 0, 2: the next instruction is at b if flag; 1, 3: if not flag. The result is acc
  abs,  ///< x < 0 ? sat(-y) : y. With the same word at a and b: the amount of it
  nop,  ///< 0
};

/// Numbers, fields and addresses of the engine.
struct EngineMap {
  static constexpr int threads = 4;  ///< programs that run beside each other
  static constexpr int round_clocks = 6;  ///< clocks from one instruction of a thread to its next
  static constexpr int start_clocks = 4;  ///< clocks between two runs of a thread beside those that its inputs take (engine_period in engine_ops.hpp)
  static constexpr int thread_words = 128;  ///< a thread's program begins at this times its number
  static constexpr int program_words = 512;  ///< words of program memory
  static constexpr int program_bits = 36;  ///< bits of a program word, and of a table word
  static constexpr int data_words = 512;  ///< words of data memory
  static constexpr int data_bits = 32;  ///< bits of a data word
  static constexpr int factor_bits = 18;  ///< low bits of y that multiply, signed
  static constexpr int table_words = 512;  ///< words of table memory
  static constexpr int value_bits = 20;  ///< low bits of a table word: the value that LRP starts from, signed
  static constexpr int slope_bits = 16;  ///< bits of a table word above the value: what LRP adds over a whole segment, signed
  static constexpr int fraction_bits = 12;  ///< low bits of a table position, within a segment
  static constexpr int outputs = 3;  ///< outputs, one per axis; an engine of fewer axes drops the others
  static constexpr int private_words = 64;  ///< private words of a thread
  static constexpr int input_first = 48;  ///< first private word that the hardware writes before a run
  static constexpr int input_axis_words = 3;  ///< inputs of an axis: position, velocity, tau_hat
  static constexpr int input_tick = 57;  ///< private word of the tick's number
  static constexpr int exchange_words = 16;  ///< exchange words that a thread may write
  static constexpr int parameter_words = 32;  ///< words of a bank of parameters
  static constexpr int event_bits = 9;  ///< bits of an event's number
  static constexpr int divider_bits = 12;  ///< bits of a thread's divider, ticks per start; 0 counts as 1
  static constexpr int age_bits = 16;  ///< bits of max_age, ticks
  static constexpr int mailbox_step = 64;  ///< ticks that mailbox_age counts as one: those whose number is a multiple of it end a step
  static constexpr int host_bits = 12;  ///< bits of a host address
  static constexpr int port_first = 16384;  ///< first address of the engine at the register port of the axes
  static constexpr int shifts[] = {0, 12, 17, 27};  ///< of a product, by the field mode
  static constexpr std::string_view op_names[] = {
      "add", "sub", "mul", "mac", "mlw", "min", "max", "sel", "cmp", "lrp", "tab", "tst", "frc", "brf", "abs", "nop",};

  /// Lowest bits of a program word's fields, and their widths.
  struct B {
    static constexpr int op = 32;  ///< instruction
    static constexpr int op_width = 4;
    static constexpr int mode = 30;  ///< variant, or shift of a product
    static constexpr int mode_width = 2;
    static constexpr int last = 29;  ///< the run ends with this instruction
    static constexpr int last_width = 1;
    static constexpr int dst = 27;  ///< where the result goes beside acc: 0 nowhere, 1 data word d, 2 output d, 3 event d
    static constexpr int dst_width = 2;
    static constexpr int d = 18;  ///< destination
    static constexpr int d_width = 9;
    static constexpr int a = 9;  ///< data word x
    static constexpr int a_width = 9;
    static constexpr int b = 0;  ///< data word y; base of a table; target of a branch
    static constexpr int b_width = 9;
  };

  /// First data words of the regions.
  struct D {
    static constexpr int own = 0;
    static constexpr int exchange = 256;
    static constexpr int parameter = 320;
    static constexpr int parameter_bank = 352;
    static constexpr int lower = 384;
    static constexpr int upper = 416;
    static constexpr int constant = 448;
  };

  /// Addresses of the host.
  struct H {
    static constexpr int data = 0x000;
    static constexpr int program = 0x200;
    static constexpr int table = 0x400;
    static constexpr int program_high = 0x600;
    static constexpr int table_high = 0x800;
    static constexpr int high = 0xa00;
    static constexpr int run = 0xa01;
    static constexpr int divider0 = 0xa02;
    static constexpr int divider1 = 0xa03;
    static constexpr int divider2 = 0xa04;
    static constexpr int divider3 = 0xa05;
    static constexpr int crc = 0xa06;
    static constexpr int line_base = 0xa07;
    static constexpr int max_age = 0xa08;
    static constexpr int commit = 0xa09;
    static constexpr int status = 0xa0a;
    static constexpr int refused_word = 0xa0b;
    static constexpr int mailbox_first = 0xa0c;
    static constexpr int mailbox_age = 0xa0d;
    static constexpr int event_count = 0xa10;
    static constexpr int event_number = 0xa11;
    static constexpr int event_value = 0xa12;
    static constexpr int event_tick = 0xa13;
    static constexpr int events_lost = 0xa14;
  };

  /// Bits of the host's words.
  struct S {
    static constexpr int status_committing = 0;  ///< a commit is under way, or a run still uses the bank before
    static constexpr int status_committing_width = 1;
    static constexpr int status_refused = 1;  ///< the last commit was refused: a word out of its range
    static constexpr int status_refused_width = 1;
    static constexpr int status_crc_busy = 2;  ///< the CRC is being computed
    static constexpr int status_crc_busy_width = 1;
    static constexpr int status_crc_good = 3;  ///< the last computed CRC was that of the word crc
    static constexpr int status_crc_good_width = 1;
    static constexpr int status_late = 4;  ///< no fresh result within max_age
    static constexpr int status_late_width = 1;
    static constexpr int status_bank = 5;  ///< bank in force
    static constexpr int status_bank_width = 1;
    static constexpr int status_overrun = 6;  ///< a start found its thread still running; cleared by a write of run
    static constexpr int status_overrun_width = 1;
    static constexpr int status_mailbox_late = 7;  ///< there is a mailbox, and no commit within mailbox_age: the torques are 0 until the next
    static constexpr int status_mailbox_late_width = 1;
    static constexpr int status_running = 8;  ///< bit per thread: it is in a run, or about to be
    static constexpr int status_running_width = 4;
    static constexpr int status_dropped = 12;  ///< a word was not taken: one of parameters or a commit while a set was being committed, or one for another memory while locked; cleared by bit 1 of commit
    static constexpr int status_dropped_width = 1;
  };
};

/// What the engine's words hold after a reset.
struct EngineReset {
  unsigned run = 0;  ///< as the host's word of this name, as of the others
  unsigned divider0 = 0;  ///< of thread 0; a reset leaves the dividers alone, configuration sets them
  unsigned divider1 = 0;  ///< of thread 1
  unsigned divider2 = 0;  ///< of thread 2
  unsigned divider3 = 0;  ///< of thread 3
  unsigned line_base = 512;  ///< first table word of delay lines
  unsigned mailbox_first = 32;  ///< first parameter word of the mailbox
  unsigned mailbox_age = 0;  ///< of the last commit
  unsigned crc = 0;  ///< the image's CRC-32
  unsigned max_age = 0;  ///< of a result; 0: that of the design

  /// Calls `visit(value, width)` for each, from the lowest bit of the RTL's parameter on.
  template <class Visit>
  void for_each(Visit&& visit) const {
    visit(run, 4);
    visit(divider0, 12);
    visit(divider1, 12);
    visit(divider2, 12);
    visit(divider3, 12);
    visit(line_base, 10);
    visit(mailbox_first, 6);
    visit(mailbox_age, 16);
    visit(crc, 32);
    visit(max_age, 16);
  }
};

}  // namespace feltgate
