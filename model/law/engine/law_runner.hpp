// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs a law's image on thread 0 in whole runs, bit by bit like the hardware: as the C++ that the
// compiler made of the law, if the program contains it, else by the interpreter of its words.
// Documentation: docs/law-compiler.md
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "feltgate/law_ops.hpp"
#include "law/engine/machine.hpp"

namespace feltgate::law {

/// A law that can run. Parameters are in two banks as in Machine; one of them is in force.
class LawRunner {
 public:
  virtual ~LawRunner() = default;
  /// Whether it runs as compiled C++, rather than in the interpreter.
  virtual bool compiled() const = 0;
  /// The next run is the first after a load, an arming or an entry into the scene.
  virtual void enter() = 0;
  /// Sets word 0 to 31 of the bank that is not in force; commit() puts that bank in force.
  virtual void set_parameter(int word, std::int32_t value) = 0;
  virtual void commit() = 0;
  /// Executes one run; the reference is valid until the next run.
  virtual const MachineRun& run(const MachineInputs& inputs) = 0;
};

/// The words of a memory, run by the interpreter.
class InterpretedLaw : public LawRunner {
 public:
  explicit InterpretedLaw(const EngineMemory& memory) : machine_(memory) {}
  bool compiled() const override { return false; }
  void enter() override { machine_.enter(); }
  void set_parameter(int word, std::int32_t value) override { machine_.set_parameter(word, value); }
  void commit() override { machine_.commit(); }
  const MachineRun& run(const MachineInputs& inputs) override { return machine_.run(0, inputs); }

 private:
  Machine machine_;
};

/// Law<Fixed> of a generated header, with the parameters from a memory that holds the law's image.
template <template <class> class Law>
class CompiledLaw : public LawRunner {
 public:
  explicit CompiledLaw(const EngineMemory& memory) {
    for (std::size_t bank = 0; bank < 2; ++bank) {
      for (int n = 0; n < EngineMap::parameter_words; ++n) {
        banks_[bank][static_cast<std::size_t>(n)] = memory.data_at(
            engine_read_address(EngineMap::D::parameter + n, 0, static_cast<int>(bank)));
      }
    }
    read_bank();
  }
  bool compiled() const override { return true; }
  void enter() override { law_.enter(); }
  void set_parameter(int word, std::int32_t value) override {
    banks_[1 - bank_][static_cast<std::size_t>(word)] = value;
  }
  void commit() override {
    bank_ = 1 - bank_;
    read_bank();
  }
  const MachineRun& run(const MachineInputs& inputs) override {
    typename Law<Fixed>::Inputs in;
    for (std::size_t n = 0; n < in.size(); ++n) {
      const LawInput& of = Law<Fixed>::inputs[n];
      in[n] = LawOps<Fixed>::word(
          inputs[static_cast<std::size_t>(EngineMap::input_axis_words * of.axis + of.source)]);
    }
    law_.run(in);
    run_.written = 0;
    for (const LawOutput& o : Law<Fixed>::outputs) {
      const auto axis = static_cast<std::size_t>(o.axis);
      run_.outputs[axis] = LawOps<Fixed>::raw(law_.output(axis));
      run_.written |= 1U << o.axis;
    }
    run_.events.clear();
    for (std::size_t n = 0; n < Law<Fixed>::events.size(); ++n) {
      const auto& e = law_.happened()[n];
      if (e.happened) {
        run_.events.push_back({Law<Fixed>::events[n].number, LawOps<Fixed>::raw(e.value)});
      }
    }
    run_.instructions = Law<Fixed>::instructions;
    run_.ended = true;
    return run_;
  }

 private:
  void read_bank() {
    for (std::size_t n = 0; n < Law<Fixed>::words.size(); ++n) {
      law_.set_word(n, banks_[bank_][static_cast<std::size_t>(Law<Fixed>::words[n].number)]);
    }
  }

  Law<Fixed> law_;
  MachineRun run_;
  std::array<std::array<std::int32_t, EngineMap::parameter_words>, 2> banks_{};
  std::size_t bank_ = 0;
};

/// A law whose C++ is part of the program.
struct CompiledEntry {
  const char* name;
  std::uint32_t image_crc;
  std::unique_ptr<LawRunner> (*make)(const EngineMemory&);
};

/// The laws of rtl/laws, compiled for the design lever and others with its formats; none in a
/// browser.
#ifdef __wasm__
inline const std::vector<CompiledEntry>& shipped_laws() {
  static const std::vector<CompiledEntry> none;
  return none;
}
#else
const std::vector<CompiledEntry>& shipped_laws();
#endif

/// Whether a shipped law has an image with this CRC-32.
inline bool is_shipped(std::uint32_t image_crc) {
  for (const CompiledEntry& e : shipped_laws()) {
    if (e.image_crc == image_crc) return true;
  }
  return false;
}

/// A compiled runner if a shipped law has this CRC-32, else the interpreter.
inline std::unique_ptr<LawRunner> make_law_runner(const EngineMemory& memory,
                                                  std::uint32_t image_crc) {
  for (const CompiledEntry& e : shipped_laws()) {
    if (e.image_crc == image_crc) return e.make(memory);
  }
  return std::make_unique<InterpretedLaw>(memory);
}

}  // namespace feltgate::law
