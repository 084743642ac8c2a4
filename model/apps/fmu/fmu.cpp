// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// FMI 3.0 co-simulation: twin and plant of a scene, its variables, from which modelDescription.xml
// is written, the functions that an importer calls, and two for `feltgate product fmu`, which
// writes the FMU. FELTGATE_FMU_DESIGN is the design. Documentation: docs/other-tools.md
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/backends/fnv1a.hpp"
#include "sim/loop/columns.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::fmu {

namespace {

/// A variable of the model; its value reference is its place in variables().
struct Variable {
  enum class Kind { time, own_hand, torque, output };
  Kind kind;
  Column column;  ///< of an output; of the others name, unit and meaning
};

namespace fs = std::filesystem;

constexpr double longest_s = 1e5;  ///< as in a scene file

/// Units by their exponents of SI, for a tool that checks or converts them.
constexpr const char* unit_definitions =
    R"(  <UnitDefinitions>
    <Unit name="s"><BaseUnit s="1"/></Unit>
    <Unit name="rad"><BaseUnit rad="1"/></Unit>
    <Unit name="rad/s"><BaseUnit rad="1" s="-1"/></Unit>
    <Unit name="Nm"><BaseUnit kg="1" m="2" s="-2"/></Unit>
    <Unit name="A"><BaseUnit A="1"/></Unit>
    <Unit name="V"><BaseUnit kg="1" m="2" s="-3" A="-1"/></Unit>
  </UnitDefinitions>
)";

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) {
    throw std::invalid_argument(path + ": there is no such file; name one that can be read");
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Errors: as Scene.
Scenario scenario_of(const std::string& path, const DesignInfo& design) {
  (void)read_text(path);
  if (names_device(path)) {
    throw std::invalid_argument(path + " names a device of several axes; choose one of one lever");
  }
  Scenario s = read_scenario(path);
  if (scenes_used(s).count("law") != 0) {
    throw std::invalid_argument(path + " runs a law of its own, for which design " + design.name +
                                " has no engine; choose a scene without law");
  }
  for (const plant::HandPhase& phase : s.hand.phases) {
    if (phase.kind != plant::HandPhase::Kind::kTrace || phase.trace.file.empty()) continue;
    throw std::invalid_argument(
        fmt::format("{}:{}: the hand reads {}, which no FMU contains; give "
                    "it a motion",
                    path, phase.line, phase.trace.file));
  }
  choose_plant(s, design);
  return s;
}

/// Time, the parameter and the input, then every column of a run.
const std::vector<Variable>& variables() {
  static const std::vector<Variable> all = [] {
    const ColumnValue none(&Row::time_s);
    std::vector<Variable> list{
        {Variable::Kind::time, {"time", "s", "time of the importer", 0, none}},
        {Variable::Kind::own_hand,
         {"own_hand", "", "true: push_nm acts on the lever instead of the scene's hand", 0, none}},
        {Variable::Kind::torque,
         {"push_nm", "Nm", "with own_hand: torque on the lever during the step", 0, none}}};
    for (const Column& c : row_columns(true, {})) {
      list.push_back({Variable::Kind::output, c});
    }
    return list;
  }();
  return all;
}

/// A scene with its plant and design, as read from two files.
struct Scene {
  /// Errors: std::invalid_argument or config::ConfigError for files that are missing or wrong, and
  /// for a scene that this design cannot run alone: a law, a device, a recorded hand.
  Scene(const std::string& scene_path, const std::string& plant_path,
        const std::string& design_name)
      : scenario(scenario_of(scene_path, design_named(design_name))), design(design_name) {
    const DesignInfo& info = design_named(design);
    Fnv1a sum;
    for (const std::string& text : {read_text(scene_path), read_text(plant_path)}) {
      for (const char c : text) sum.add_at_once(static_cast<unsigned char>(c));
      sum.add(static_cast<std::int64_t>(text.size()));
    }
    token = fmt::format("{{feltgate-{:08x}-{:016x}}}", info.design_crc, sum.value());
    plant = plant::read_plant_file(plant_path);
    resolve_effects(scenario, plant.effects);
    resolve_amounts(scenario, info);
    scenario = as_run(scenario, info);
    check_scenario(scenario, plant, info);
  }

  Scenario scenario;
  plant::Parameters plant;
  std::string design;
  std::string token;  ///< the instantiationToken: of the design and the text of both files
};

/// Path of the scene's plant: a name in `plants`, or beside the scene. Errors: as Scene.
std::string plant_of_scene(const std::string& scene_path, const std::string& plants,
                           const std::string& design) {
  const std::string name = scenario_of(scene_path, design_named(design)).plant;
  const bool is_path = name.find('/') != std::string::npos || fs::path(name).extension() == ".toml";
  return is_path ? name : plants + "/" + name + ".toml";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c == '\n' ? ' ' : c;
    }
  }
  return out;
}

std::string element(const Variable& v, std::size_t reference) {
  std::string type = "Float64", role;
  switch (v.kind) {
    case Variable::Kind::time:
      role = R"(causality="independent" variability="continuous")";
      break;
    case Variable::Kind::own_hand:
      type = "Boolean";
      role = R"(causality="parameter" variability="fixed" start="false")";
      break;
    case Variable::Kind::torque:
      role = R"(causality="input" variability="continuous" start="0")";
      break;
    case Variable::Kind::output:
      if (v.column.value.is_bits()) type = "Int32";
      role = fmt::format(R"(causality="output" variability="{}" initial="calculated")",
                         v.column.value.is_bits() ? "discrete" : "continuous");
      break;
  }
  const std::string unit = v.column.unit.empty() ? "" : fmt::format(R"( unit="{}")", v.column.unit);
  return fmt::format(R"(    <{} name="{}" valueReference="{}" {}{} description="{}"/>)"
                     "\n",
                     type, v.column.name, reference, role, unit, escaped(v.column.meaning));
}

/// modelDescription.xml of a library that is called `identifier`.
std::string model_description(const Scene& scene, const std::string& identifier) {
  const Scenario& s = scene.scenario;
  std::string text = fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="{0} of feltgate {1}" description="{2}"
    instantiationToken="{3}" generationTool="feltgate product fmu" license="Apache-2.0">
  <CoSimulation modelIdentifier="{4}" canHandleVariableCommunicationStepSize="true"/>
{5}  <DefaultExperiment startTime="0" stopTime="{6}" stepSize="0.001"/>
  <ModelVariables>
)",
      escaped(s.name), scene.design, escaped(s.title), scene.token, identifier, unit_definitions,
      s.duration_s);
  const auto& all = variables();
  for (std::size_t i = 0; i < all.size(); ++i) text += element(all[i], i);
  text += "  </ModelVariables>\n  <ModelStructure>\n";
  for (const char* what : {"Output", "InitialUnknown"}) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].kind == Variable::Kind::output) {
        text += fmt::format("    <{} valueReference=\"{}\"/>\n", what, i);
      }
    }
  }
  return text + "  </ModelStructure>\n</fmiModelDescription>\n";
}

/// The scene in time; it goes on after its own end for as long as it is asked to.
class SceneModel {
 public:
  explicit SceneModel(const Scene& scene)
      : scenario_(scene.scenario), plant_(scene.plant), design_(design_named(scene.design)) {
    scenario_.duration_s = longest_s;
    scenario_.expectations.clear();
    row_.theta_rad = scenario_.hand.initial_rad();
    options_.design = scene.design;
    options_.engine = "twin";
    options_.row = [this](const Row& r) { later_.push_back(r); };
  }

  /// Whether a torque acts instead of the scene's hand; before the first run_to().
  void own_hand(bool own) { own_hand_ = own; }
  bool has_own_hand() const { return own_hand_; }
  /// Of the own hand, Nm, from now on.
  void push(double torque_nm) { torque_nm_ = torque_nm; }
  double pushed_nm() const { return torque_nm_; }
  /// Runs to this time, s. Errors: std::runtime_error.
  void run_to(double time_s) {
    if (!(time_s >= time_s_ && time_s <= longest_s)) {
      throw std::runtime_error(
          fmt::format("the model is at {} s and goes on to {:g} s at most; {} s "
                      "is not between them",
                      time_s_, longest_s, time_s));
    }
    if (!run_) start();
    if (own_hand_ && torque_nm_ != acting_nm_) {
      plant::Segment step;
      step.kind = plant::Segment::Kind::kStep;
      step.duration_s = longest_s;
      step.to = acting_nm_ = torque_nm_;
      plant::HandPhase push;
      push.kind = plant::HandPhase::Kind::kTorque;
      push.profile = {step};
      run_->take(push);
    }
    time_s_ = time_s;
    const Clock now = std::llround(time_s * static_cast<double>(design_.clock_hz));
    run_->run_to(now);
    const std::int64_t over = now / design_.clocks_per_tick;
    for (; ticks_shown_ < over && !later_.empty(); ++ticks_shown_) {
      row_ = later_.front();
      later_.pop_front();
    }
  }
  double time_s() const { return time_s_; }
  /// The last tick that was over at time_s().
  const Row& row() const { return row_; }

 private:
  void start() {
    if (own_hand_) {
      scenario_.hand.start_rad = scenario_.hand.initial_rad();
      scenario_.hand.phases.clear();
    }
    run_ = stepped_run(scenario_, plant_, options_);
  }

  Scenario scenario_;
  plant::Parameters plant_;
  RunOptions options_;
  DesignInfo design_;
  std::unique_ptr<SteppedRun> run_;
  Row row_;
  std::deque<Row> later_;  ///< of ticks that a step of the plant ran past time_s()
  std::int64_t ticks_shown_ = 0;
  bool own_hand_ = false;
  double torque_nm_ = 0, acting_nm_ = 0, time_s_ = 0;
};

}  // namespace

}  // namespace feltgate::fmu

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
