// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine's instructions as pure, exact functions; twin, interpreter, compiler and proofs share
// them. Program words: docs/engine-isa.md (generated)
#pragma once

#include <cstdint>

#include "feltgate/generated/engine.hpp"

namespace feltgate {

/// The fields of a program word, as raw bits.
struct EngineInstruction {
  EngineOp op = EngineOp::nop;
  int mode = 0;       ///< 0 to 3
  bool last = false;  ///< this instruction ends the run
  int dst = 0;        ///< number of an EngineTarget
  int d = 0;          ///< 0 to 511, like a and b
  int a = 0;
  int b = 0;
};

/// Where a result goes in addition to acc: EngineInstruction::dst.
enum class EngineTarget : int { none, data, output, event };

/// Decodes a program word (36 bits). Bits above the word are ignored.
constexpr EngineInstruction engine_decode(std::uint64_t word) {
  using B = EngineMap::B;
  const auto field = [word](int bit, int width) {
    return static_cast<int>((word >> bit) & ((std::uint64_t{1} << width) - 1));
  };
  return {static_cast<EngineOp>(field(B::op, B::op_width)),
          field(B::mode, B::mode_width),
          field(B::last, 1) != 0,
          field(B::dst, B::dst_width),
          field(B::d, B::d_width),
          field(B::a, B::a_width),
          field(B::b, B::b_width)};
}

/// Encodes a program word; each field must fit its width.
constexpr std::uint64_t engine_encode(const EngineInstruction& i) {
  using B = EngineMap::B;
  const auto at = [](int value, int bit) { return static_cast<std::uint64_t>(value) << bit; };
  return at(static_cast<int>(i.op), B::op) | at(i.mode, B::mode) | at(i.last ? 1 : 0, B::last) |
         at(i.dst, B::dst) | at(i.d, B::d) | at(i.a, B::a) | at(i.b, B::b);
}

/// The state that an instruction reads and writes, of one thread.
struct EngineState {
  std::int32_t acc = 0;
  bool flag = false;
};

/// v saturated to 32 bits.
constexpr std::int32_t engine_sat(std::int64_t v) {
  if (v > INT32_MAX) return INT32_MAX;
  if (v < INT32_MIN) return INT32_MIN;
  return static_cast<std::int32_t>(v);
}

/// The low 32 bits of v as a signed number.
constexpr std::int32_t engine_wrap(std::int64_t v) {
  const auto low = static_cast<std::int64_t>(static_cast<std::uint64_t>(v) & 0xffffffffU);
  return static_cast<std::int32_t>(low >= (std::int64_t{1} << 31) ? low - (std::int64_t{1} << 32)
                                                                  : low);
}

/// floor(v / 2^s), also for negative v.
constexpr std::int64_t engine_floor_shift(std::int64_t v, int s) {
  return v >= 0 ? v >> s : -((-v - 1) >> s) - 1;
}

/// v / 2^s rounded to nearest, ties up; |v| must be below 2^62.
constexpr std::int64_t engine_round_shift(std::int64_t v, int s) {
  return s == 0 ? v : engine_floor_shift(v + (std::int64_t{1} << (s - 1)), s);
}

/// The low factor_bits bits of a data word, as a signed number: the part that multiplies.
constexpr std::int32_t engine_factor(std::int32_t y) {
  constexpr std::int32_t half = 1 << (EngineMap::factor_bits - 1);
  return ((y & (2 * half - 1)) ^ half) - half;
}

/// Number of low bits of a product that this mode drops.
constexpr int engine_shift(int mode) { return EngineMap::shifts[mode & 3]; }

/// Smallest number of clocks from start to start of a thread whose runs have so many instructions,
/// in an engine of 1 to 3 axes in which no other thread runs. If the period of its divider is at
/// least as long, a run starts each time; if it is shorter, starts are missed.
constexpr int engine_period(int instructions, int axes) {
  constexpr int round = EngineMap::round_clocks;
  const int words = EngineMap::input_axis_words * axes + 1;
  // An input word takes one clock; in one of the system's turns none is written.
  const int between = EngineMap::start_clocks + words + (words - 1) / (round - 1);
  return round * (instructions + (between + round - 1) / round);
}

/// Address in table memory that LRP, TAB and TST use; `x` as data word, `b` as base.
constexpr int engine_table_address(std::int32_t x, int b) {
  const std::int64_t segment = engine_floor_shift(x, EngineMap::fraction_bits);
  return static_cast<int>((static_cast<std::uint64_t>(segment) + static_cast<std::uint64_t>(b)) &
                          (EngineMap::table_words - 1));
}

/// A table word for LRP: a value (20 bits, signed) and a slope (16 bits, signed), in steps of the
/// value per segment.
constexpr std::uint64_t engine_table_word(std::int32_t value, std::int32_t slope) {
  const auto bits = [](std::int32_t v, int width) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) &
           ((std::uint64_t{1} << width) - 1);
  };
  return bits(slope, EngineMap::slope_bits) << EngineMap::value_bits |
         bits(value, EngineMap::value_bits);
}

/// The value in such a table word.
constexpr std::int32_t engine_table_value(std::uint64_t t) {
  constexpr std::int32_t half = 1 << (EngineMap::value_bits - 1);
  return (static_cast<std::int32_t>(t & (2 * half - 1)) ^ half) - half;
}

/// The slope in such a table word.
constexpr std::int32_t engine_table_slope(std::uint64_t t) {
  constexpr std::int32_t half = 1 << (EngineMap::slope_bits - 1);
  return (static_cast<std::int32_t>((t >> EngineMap::value_bits) & (2 * half - 1)) ^ half) - half;
}

/// The comparison of CMP, MIN and MAX.
constexpr bool engine_less(std::int32_t x, std::int32_t y) {
  // Exact: the difference may need 33 bits.
  return x < y;
}

/// The flag after CMP.
constexpr bool engine_compare(int mode, bool flag, std::int32_t x, std::int32_t y) {
  const bool c = engine_less(x, y);
  switch (mode & 3) {
    case 1:
      return flag || c;
    case 2:
      return flag && c;
    case 3:
      return !c;
    default:
      return c;
  }
}

/// Result and next state of one instruction. `x` and `y` are the data words at a and b, `t` is the
/// table word at engine_table_address (any value for an instruction that reads none). Every input
/// is allowed.
constexpr EngineState engine_step(EngineOp op, int mode, EngineState s, std::int32_t x,
                                  std::int32_t y, std::uint64_t t) {
  const auto wide = [](std::int32_t v) { return static_cast<std::int64_t>(v); };
  const std::int64_t product = wide(x) * engine_factor(y);
  const int shift = engine_shift(mode);
  const std::int32_t fraction = x & ((1 << EngineMap::fraction_bits) - 1);
  switch (op) {
    case EngineOp::add: {
      const std::int64_t sum = wide(x) + ((mode & 2) != 0 ? s.acc : y);
      s.acc = (mode & 1) != 0 ? engine_wrap(sum) : engine_sat(sum);
      break;
    }
    case EngineOp::sub:
      if (mode == 2) {
        s.acc = engine_sat(wide(s.acc) - x);
      } else {
        s.acc = mode == 0 ? engine_sat(wide(x) - y) : engine_wrap(wide(x) - y);
      }
      break;
    case EngineOp::mul:
      s.acc = engine_sat(engine_round_shift(product, shift));
      break;
    case EngineOp::mac:
      s.acc = engine_sat(s.acc + engine_round_shift(product, shift));
      break;
    case EngineOp::mlw:
      s.acc = engine_wrap(engine_floor_shift(product, shift));
      break;
    case EngineOp::min:
      s.acc = engine_less(x, y) ? x : y;
      break;
    case EngineOp::max:
      s.acc = engine_less(x, y) ? y : x;
      break;
    case EngineOp::sel:
      s.acc = s.flag ? x : y;
      break;
    case EngineOp::cmp:
      s.flag = engine_compare(mode, s.flag, x, y);
      s.acc = s.flag ? 1 : 0;
      break;
    case EngineOp::lrp:
      s.acc = static_cast<std::int32_t>(
          engine_table_value(t) + engine_round_shift(std::int64_t{engine_table_slope(t)} * fraction,
                                                     EngineMap::fraction_bits));
      break;
    case EngineOp::tab:
      s.acc = engine_wrap(static_cast<std::int64_t>(t & 0xffffffffU));
      break;
    case EngineOp::tst:
    case EngineOp::brf:
      break;
    case EngineOp::frc:
      s.acc = fraction;
      break;
    case EngineOp::abs:
      s.acc = x < 0 ? engine_sat(-wide(y)) : y;
      break;
    case EngineOp::nop:
      s.acc = 0;
      break;
  }
  return s;
}

/// Whether the next instruction is the one at b.
constexpr bool engine_branches(EngineOp op, int mode, bool flag) {
  return op == EngineOp::brf && flag == ((mode & 1) == 0);
}

/// Address in data memory that a thread reads for address `a`; `bank`: the bank of its parameters.
constexpr int engine_read_address(int a, int thread, int bank) {
  using D = EngineMap::D;
  if (a < D::exchange)
    return (a & (EngineMap::private_words - 1)) | thread * EngineMap::private_words;
  if (a >= D::parameter && a < D::lower) {
    return D::parameter + (a & (EngineMap::parameter_words - 1)) +
           bank * EngineMap::parameter_words;
  }
  return a;
}

/// Address in data memory that a thread writes for address `d`; -1 if it must not write there.
constexpr int engine_write_address(int d, int thread) {
  using D = EngineMap::D;
  const int own = d & (EngineMap::private_words - 1);
  if (d < D::exchange) {
    return own >= EngineMap::input_first ? -1 : own | thread * EngineMap::private_words;
  }
  if (d >= D::parameter) return -1;
  return (d - D::exchange) / EngineMap::exchange_words == thread ? d : -1;
}

}  // namespace feltgate
