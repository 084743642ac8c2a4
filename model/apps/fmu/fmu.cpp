// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// FMI 3.0 co-simulation: the functions that an importer calls, and two for `feltgate product fmu`,
// which writes the FMU. FELTGATE_FMU_DESIGN is the design. Documentation: docs/other-tools.md
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/fmu/scene_model.hpp"

// What is used of FMI 3.0 (https://fmi-standard.org), as the standard documents it.
extern "C" {

enum fmi3Status { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal };
using fmi3Instance = void*;
using fmi3InstanceEnvironment = void*;
using fmi3ValueReference = std::uint32_t;
using fmi3Float64 = double;
using fmi3Int32 = std::int32_t;
using fmi3Boolean = bool;
using fmi3String = const char*;
using fmi3LogMessageCallback = void (*)(fmi3InstanceEnvironment, fmi3Status, fmi3String category,
                                        fmi3String message);
/// Of functions that are never called here.
using fmi3Unused = void (*)();

}  // extern "C"

namespace {

using feltgate::fmu::Scene;
using feltgate::fmu::SceneModel;
using feltgate::fmu::Variable;
using feltgate::fmu::variables;

constexpr const char* design = FELTGATE_FMU_DESIGN;
constexpr const char* identifier = "feltgate_fmu_" FELTGATE_FMU_DESIGN;

/// An instance, and who is told what went wrong.
struct Instance {
  Instance(Scene of, fmi3InstanceEnvironment to, fmi3LogMessageCallback with)
      : scene(std::move(of)), environment(to), log(with) {
    reset();
  }
  void reset() {
    model = std::make_unique<SceneModel>(scene);
    initialised = false;
  }
  fmi3Status fails(const std::string& why) const {
    if (log != nullptr) log(environment, fmi3Error, "error", why.c_str());
    return fmi3Error;
  }

  Scene scene;
  std::unique_ptr<SceneModel> model;
  fmi3InstanceEnvironment environment;
  fmi3LogMessageCallback log;
  bool initialised = false;
};

/// Calls work(instance); no exception leaves the library.
template <class Work>
fmi3Status done(fmi3Instance instance, const Work& work) {
  auto& of = *static_cast<Instance*>(instance);
  try {
    work(of);
    return fmi3OK;
  } catch (const std::exception& error) {
    return of.fails(error.what());
  }
}

[[noreturn]] void refuse(fmi3ValueReference reference, const char* what) {
  throw std::invalid_argument(fmt::format("value reference {} is no {}", reference, what));
}

const Variable& variable(fmi3ValueReference reference) {
  if (reference >= variables().size()) refuse(reference, "variable of modelDescription.xml");
  return variables()[reference];
}

/// Reads n variables, each by one(variable, reference).
template <class Value, class One>
fmi3Status read(fmi3Instance instance, const fmi3ValueReference references[], std::size_t n,
                Value values[], std::size_t n_values, const One& one) {
  return done(instance, [&](Instance& of) {
    if (n != n_values) throw std::invalid_argument("every variable is a scalar");
    for (std::size_t i = 0; i < n; ++i) {
      values[i] = one(*of.model, variable(references[i]), references[i]);
    }
  });
}

std::string said;  ///< what the two functions for `feltgate product fmu` return

/// The text that work() returns, or nullptr with the error in feltgate_fmu_error().
template <class Work>
const char* told(const Work& work) {
  try {
    said = work();
    return said.c_str();
  } catch (const std::exception& error) {
    said = error.what();
    return nullptr;
  }
}

}  // namespace

extern "C" {

// ---- for scripts/product.py ---------------------------------------------------------------------
const char* feltgate_fmu_plant(const char* scene, const char* plants) {
  return told([&] { return feltgate::fmu::plant_of_scene(scene, plants, design); });
}
const char* feltgate_fmu_description(const char* scene, const char* plant) {
  return told(
      [&] { return feltgate::fmu::model_description(Scene(scene, plant, design), identifier); });
}
const char* feltgate_fmu_error() { return said.c_str(); }

// ---- FMI 3.0 ------------------------------------------------------------------------------------
const char* fmi3GetVersion() { return "3.0"; }

fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String token, fmi3String resources,
                                         fmi3Boolean, fmi3Boolean, fmi3Boolean, fmi3Boolean,
                                         const fmi3ValueReference[], std::size_t,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log, fmi3Unused) {
  try {
    if (resources == nullptr) throw std::invalid_argument("there is no folder of resources");
    const std::filesystem::path folder(resources);
    Scene scene((folder / "scene.toml").string(), (folder / "plant.toml").string(), design);
    if (token == nullptr || scene.token != token) {
      throw std::invalid_argument("the files in resources are not those of the instantiationToken");
    }
    return new Instance(std::move(scene), environment, log);
  } catch (const std::exception& error) {
    if (log != nullptr) log(environment, fmi3Error, "error", error.what());
    return nullptr;
  }
}
void fmi3FreeInstance(fmi3Instance instance) { delete static_cast<Instance*>(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64,
                                       fmi3Float64 start_s, fmi3Boolean, fmi3Float64) {
  return done(instance, [&](Instance&) {
    if (start_s != 0) throw std::invalid_argument("a scene starts at 0 s; set startTime to 0");
  });
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return done(instance, [](Instance& of) {
    of.model->run_to(0);
    of.initialised = true;
  });
}
fmi3Status fmi3Terminate(fmi3Instance) { return fmi3OK; }
fmi3Status fmi3Reset(fmi3Instance instance) {
  return done(instance, [](Instance& of) { of.reset(); });
}
fmi3Status fmi3SetDebugLogging(fmi3Instance, fmi3Boolean, std::size_t, const fmi3String[]) {
  return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 from_s, fmi3Float64 step_s, fmi3Boolean,
                      fmi3Boolean* event, fmi3Boolean* terminate, fmi3Boolean* early,
                      fmi3Float64* reached_s) {
  *event = *terminate = *early = false;
  const fmi3Status status = done(instance, [&](Instance& of) {
    if (!of.initialised) throw std::logic_error("a step before the initialization is over");
    of.model->run_to(from_s + step_s);
  });
  *reached_s = static_cast<Instance*>(instance)->model->time_s();
  return status;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                          std::size_t n, fmi3Float64 values[], std::size_t n_values) {
  return read(instance, references, n, values, n_values,
              [](const SceneModel& model, const Variable& v, fmi3ValueReference reference) {
                switch (v.kind) {
                  case Variable::Kind::time:
                    return model.time_s();
                  case Variable::Kind::torque:
                    return model.pushed_nm();
                  case Variable::Kind::output:
                    if (!v.column.value.is_bits()) return v.column.value(model.row());
                    break;
                  case Variable::Kind::own_hand:
                    break;
                }
                refuse(reference, "Float64");
              });
}
fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference references[], std::size_t n,
                        fmi3Int32 values[], std::size_t n_values) {
  return read(instance, references, n, values, n_values,
              [](const SceneModel& model, const Variable& v, fmi3ValueReference reference) {
                if (v.kind != Variable::Kind::output || !v.column.value.is_bits()) {
                  refuse(reference, "Int32");
                }
                return static_cast<fmi3Int32>(v.column.value(model.row()));
              });
}
fmi3Status fmi3GetBoolean(fmi3Instance instance, const fmi3ValueReference references[],
                          std::size_t n, fmi3Boolean values[], std::size_t n_values) {
  return read(instance, references, n, values, n_values,
              [](const SceneModel& model, const Variable& v, fmi3ValueReference reference) {
                if (v.kind != Variable::Kind::own_hand) refuse(reference, "Boolean");
                return model.has_own_hand();
              });
}
fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                          std::size_t n, const fmi3Float64 values[], std::size_t n_values) {
  return done(instance, [&](Instance& of) {
    if (n != n_values) throw std::invalid_argument("every variable is a scalar");
    for (std::size_t i = 0; i < n; ++i) {
      if (variable(references[i]).kind != Variable::Kind::torque) refuse(references[i], "input");
      if (!std::isfinite(values[i])) throw std::invalid_argument("push_nm must be finite");
      of.model->push(values[i]);
    }
  });
}
fmi3Status fmi3SetBoolean(fmi3Instance instance, const fmi3ValueReference references[],
                          std::size_t n, const fmi3Boolean values[], std::size_t n_values) {
  return done(instance, [&](Instance& of) {
    if (n != n_values) throw std::invalid_argument("every variable is a scalar");
    for (std::size_t i = 0; i < n; ++i) {
      if (variable(references[i]).kind != Variable::Kind::own_hand) {
        refuse(references[i], "parameter");
      }
      if (of.initialised) throw std::logic_error("own_hand is set before the initialization");
      of.model->own_hand(values[i]);
    }
  });
}

// Every other function of the standard is there, so that an importer can bind it, and refuses: this
// model has no such variables and modes. A caller in C clears its own arguments away.
#define FELTGATE_NOT_HERE(name) \
  fmi3Status name() { return fmi3Error; }
#define FELTGATE_NO_TYPE(type)     \
  FELTGATE_NOT_HERE(fmi3Get##type) \
  FELTGATE_NOT_HERE(fmi3Set##type)
FELTGATE_NO_TYPE(Float32)
FELTGATE_NO_TYPE(Int8)
FELTGATE_NO_TYPE(UInt8)
FELTGATE_NO_TYPE(Int16)
FELTGATE_NO_TYPE(UInt16)
FELTGATE_NOT_HERE(fmi3SetInt32)
FELTGATE_NO_TYPE(UInt32)
FELTGATE_NO_TYPE(Int64)
FELTGATE_NO_TYPE(UInt64)
FELTGATE_NO_TYPE(String)
FELTGATE_NO_TYPE(Binary)
FELTGATE_NO_TYPE(Clock)
FELTGATE_NO_TYPE(FMUState)
FELTGATE_NO_TYPE(IntervalDecimal)
FELTGATE_NO_TYPE(IntervalFraction)
FELTGATE_NO_TYPE(ShiftDecimal)
FELTGATE_NO_TYPE(ShiftFraction)
FELTGATE_NOT_HERE(fmi3GetNumberOfVariableDependencies)
FELTGATE_NOT_HERE(fmi3GetVariableDependencies)
FELTGATE_NOT_HERE(fmi3FreeFMUState)
FELTGATE_NOT_HERE(fmi3SerializedFMUStateSize)
FELTGATE_NOT_HERE(fmi3SerializeFMUState)
FELTGATE_NOT_HERE(fmi3DeserializeFMUState)
FELTGATE_NOT_HERE(fmi3GetDirectionalDerivative)
FELTGATE_NOT_HERE(fmi3GetAdjointDerivative)
FELTGATE_NOT_HERE(fmi3EnterConfigurationMode)
FELTGATE_NOT_HERE(fmi3ExitConfigurationMode)
FELTGATE_NOT_HERE(fmi3EnterEventMode)
FELTGATE_NOT_HERE(fmi3EnterStepMode)
FELTGATE_NOT_HERE(fmi3EvaluateDiscreteStates)
FELTGATE_NOT_HERE(fmi3UpdateDiscreteStates)
FELTGATE_NOT_HERE(fmi3GetOutputDerivatives)
FELTGATE_NOT_HERE(fmi3ActivateModelPartition)
FELTGATE_NOT_HERE(fmi3EnterContinuousTimeMode)
FELTGATE_NOT_HERE(fmi3CompletedIntegratorStep)
FELTGATE_NOT_HERE(fmi3SetTime)
FELTGATE_NOT_HERE(fmi3SetContinuousStates)
FELTGATE_NOT_HERE(fmi3GetContinuousStateDerivatives)
FELTGATE_NOT_HERE(fmi3GetContinuousStates)
FELTGATE_NOT_HERE(fmi3GetNominalsOfContinuousStates)
FELTGATE_NOT_HERE(fmi3GetNumberOfContinuousStates)
FELTGATE_NOT_HERE(fmi3GetEventIndicators)
FELTGATE_NOT_HERE(fmi3GetNumberOfEventIndicators)
fmi3Instance fmi3InstantiateModelExchange() { return nullptr; }
fmi3Instance fmi3InstantiateScheduledExecution() { return nullptr; }

}  // extern "C"
