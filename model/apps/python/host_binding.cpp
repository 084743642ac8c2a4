// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The extension module feltgate._host, a board on a serial port for Python: values in units,
// arming, stream and capture as arrays. Documentation: docs/python.md, docs/host.md
#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/python/arrays.hpp"
#include "design/engine_map.hpp"
#include "host/capture.hpp"
#include "host/host_device.hpp"
#include "host/law_engine.hpp"
#include "law/compile.hpp"

namespace feltgate::python {
namespace {

using host::Quantity;
using Names = std::vector<std::string>;

/// In C++ without the interpreter; a signal that Python has seen ends what goes on.
template <class Call>
auto unlocked(Call call) {
  const py::gil_scoped_release free;
  return call();
}

class PyDevice {
 public:
  PyDevice(const std::string& port, const std::string& root, const std::string& design, int baud,
           double patience_s)
      : baud_(baud), transport_(host::open_serial(port, baud)), link_(*transport_, {patience_s}) {
    unlocked([&] {
      const host::BoardInfo board = host::read_board(link_);
      auto known = design.empty() ? host::design_by_crc(root, board.design_crc)
                                  : std::optional(host::read_known_design(root, design));
      if (!known || known->crc != board.design_crc) {
        throw std::invalid_argument(fmt::format(
            "{}: the board's design has CRC 0x{:08x}, {}; give the file that it was built from: "
            "design=",
            port, board.design_crc,
            known ? fmt::format("{} 0x{:08x}", known->name(), known->crc) : "no known one has it"));
      }
      device_ = std::make_unique<host::Device>(link_, board, std::move(known->design));
      keep_ = std::make_unique<host::KeepAlive>(*device_);
    });
  }

  py::dict info() {
    const host::BoardInfo& b = device().board();
    const host::Tick tick = unlocked([&] { return device().tick(); });
    return py::dict(
        "board"_a = b.board_name(), "simulated"_a = b.simulated,
        "design"_a = device().design().design.name, "design_crc"_a = b.design_crc,
        "tick_hz"_a = b.tick_hz(), "capture_rows"_a = b.has_capture ? b.capture_rows : 0,
        "inputs"_a = b.inputs, "armed"_a = device().armed(tick),
        "scene"_a = device().scene_name(tick), "faults"_a = device().fault_names(tick),
        "limits"_a = device().limit_names(tick), "in_words"_a = device().in_words(tick));
  }
  py::dict link() {
    const host::LinkCounts c = link_.counts();
    return py::dict("requests"_a = c.requests, "retries"_a = c.retries,
                    "damaged"_a = c.frames.bad_crc + c.frames.bad_slip + c.frames.too_long,
                    "streamed"_a = c.streamed, "lost"_a = c.lost);
  }
  py::dict names() {
    py::dict d;
    for (const Quantity& q : device().quantities().all()) {
      d[q.name.c_str()] = py::dict("unit"_a = q.unit, "doc"_a = q.doc, "settable"_a = q.writable);
    }
    const host::LawEngine* engine = unlocked([&] { return laws(); });
    if (engine == nullptr) return d;
    for (const law::ImageWord* w : engine->parameters()) {
      d[("law." + w->name).c_str()] = py::dict(
          "unit"_a = w->unit, "doc"_a = "of the law " + engine->image()->name, "settable"_a = true);
    }
    return d;
  }
  py::dict law(const std::string& path) {
    host::LawEngine& engine = engine_of_laws();
    const host::LoadReport r = unlocked([&] {
      const law::Image image = law::compile_file(path, design::law_target(device().design())).image;
      const host::LoadReport report = engine.load(image);
      host::keep_law(host::laws_folder(), image);
      return report;
    });
    return py::dict("name"_a = engine.image()->name, "words"_a = r.words, "written"_a = r.written);
  }
  py::list events(double seconds) {
    host::LawEngine& engine = engine_of_laws();
    std::vector<host::LawEvent> all;
    unlocked([&] {
      const host::Deadline end = host::within(seconds);
      do {
        check_interrupt();
        keep_->poll();
        if (keep_->holds()) check_armed(device().tick());
        while (auto event = engine.event()) all.push_back(*event);
      } while (host::HostClock::now() < end);
    });
    py::list list;
    for (const host::LawEvent& e : all) list.append(py::make_tuple(e.tick, e.name, e.value));
    return list;
  }
  double get(const std::string& name) {
    if (host::LawEngine* engine = law_with(name)) {
      return unlocked([&] { return engine->get(name); });
    }
    const Quantity& q = device().quantities().find(name);
    return unlocked([&] { return device().get(q); });
  }
  py::dict tick() {
    const host::Tick t = unlocked([&] { return device().tick(); });
    py::dict d;
    for (const Quantity& q : device().quantities().all()) {
      if (q.kind == Quantity::Kind::snapshot) d[q.name.c_str()] = t.value(q);
    }
    return d;
  }
  double set(const std::string& name, const py::object& value) {
    if (host::LawEngine* engine = law_with(name)) {
      const double number = py::isinstance<py::str>(value)
                                ? engine->value_in(*engine->find(name), value.cast<std::string>())
                                : value.cast<double>();
      return unlocked([&] { return engine->set({{name, number}}).front(); });
    }
    const host::Quantities& all = device().quantities();
    const host::Setting setting = py::isinstance<py::str>(value)
                                      ? all.setting(name + "=" + value.cast<std::string>())
                                      : all.setting(all.find(name), value.cast<double>());
    const host::SetResult r = unlocked([&] { return device().set(setting); });
    if (r.refused) {
      throw host::Refused(name +
                          " cannot change while armed: the torque could jump; disarm() first");
    }
    if (r.saturated) {
      throw host::Refused(name + ": the value does not fit the board's word and was saturated");
    }
    if (!r.kept) throw host::Refused(name + ": the board did not keep it");
    return setting.value();
  }

  void arm(const std::string& scene) {
    unlocked([&] { keep_->arm(scene, signalled); });
  }
  void hold(double seconds) {
    unlocked([&] {
      const host::Deadline end = host::within(seconds);
      while (host::HostClock::now() < end) {
        check_interrupt();
        keep_->poll();
        check_armed(device().tick());
      }
    });
  }
  void disarm() {
    unlocked([&] {
      device().disarm();
      keep_->release();
    });
  }
  /// One of the board's commands.
  void does(void (host::Device::*command)()) {
    unlocked([&] { (device().*command)(); });
  }
  void select(const std::string& scene) {
    unlocked([&] { device().select(scene); });
  }

  py::dict stream(const Names& names, double every_s, double seconds) {
    const host::WordMask mask = host::mask_of(device().quantities(), names) | status_words();
    const std::uint32_t fastest = device().shortest_period(mask, baud_);
    const double asked = std::round(every_s * device().board().tick_hz());
    const auto period = static_cast<std::uint32_t>(every_s > 0 ? std::clamp(asked, 1.0, 4e9)
                                                               : static_cast<double>(fastest));
    if (period < fastest) {
      throw std::invalid_argument(
          fmt::format("every_s={:g}: the wire carries these words every {:.3g} s at most; leave "
                      "words out, or use capture()",
                      every_s, fastest / device().board().tick_hz()));
    }
    std::vector<host::Tick> ticks;
    unlocked([&] {
      device().stream(mask, period);
      const host::Deadline end = host::within(seconds);
      try {
        while (host::HostClock::now() < end) {
          check_interrupt();
          auto tick = device().streamed(std::min(end, host::within(keep_->next_in_s())));
          keep_->poll();
          if (!tick) continue;
          check_armed(*tick);
          ticks.push_back(std::move(*tick));
        }
      } catch (const host::LinkLost&) {
        throw;
      } catch (...) {
        device().stream(0, 0);
        throw;
      }
      device().stream(0, 0);
    });
    return columns(names, ticks);
  }

  py::dict capture(const Names& names, const std::string& trigger, double before, double span_s,
                   double wait_s) {
    host::CaptureSetup setup;
    setup.quantities = names;
    setup.trigger = unlocked([&] {
      return host::parse_trigger(device(), host::means_event(trigger) ? laws() : nullptr, trigger);
    });
    const int rows = device().board().capture_rows;
    setup.rows_before = std::clamp(static_cast<int>(before * rows), 0, rows - 1);
    if (span_s > 0) {
      setup.period = static_cast<std::uint32_t>(
          std::clamp(std::ceil(span_s * device().board().tick_hz() / rows), 1.0, 4e9));
    }
    const host::Captured c = unlocked([&] {
      host::start_capture(device(), setup);
      const bool came = host::wait_for_capture(device(), setup, wait_s, [&](int) {
        check_interrupt();
        keep_->poll();
        return std::min(keep_->next_in_s(), 0.02);
      });
      if (!came) {
        throw host::Refused(
            fmt::format("the trigger {} did not come within {:g} s", trigger, wait_s));
      }
      return host::read_capture(device(), setup, [&](double) {
        check_interrupt();
        keep_->poll();
      });
    });
    return columns(names, c.rows);
  }

  void close() {
    if (!device_) return;
    unlocked([&] {
      if (keep_->holds()) keep_->release();
    });
    keep_.reset();
    laws_.reset();
    device_.reset();
    transport_.reset();
  }

 private:
  static bool signalled() {
    check_interrupt();
    return true;
  }
  host::Device& device() {
    if (!device_) throw std::runtime_error("the device is closed; open it again");
    return *device_;
  }
  /// The engine, its law known where this computer has loaded it; nullptr without an engine.
  host::LawEngine* laws() {
    if (!device().board().has_engine) return nullptr;
    if (!laws_) {
      laws_ = std::make_unique<host::LawEngine>(device());
      (void)laws_->recognise(host::laws_folder());
    }
    return laws_.get();
  }
  host::LawEngine& engine_of_laws() {
    host::LawEngine* engine = unlocked([&] { return laws(); });
    if (engine == nullptr) (void)host::LawEngine(device());  // says that there is none
    return *engine;
  }
  /// The engine where its law has a parameter of this name and the core has not.
  host::LawEngine* law_with(const std::string& name) {
    if (device().quantities().look(name) != nullptr) return nullptr;
    host::LawEngine* engine = unlocked([&] { return laws(); });
    return engine != nullptr && engine->find(name) != nullptr ? engine : nullptr;
  }
  host::WordMask status_words() {
    return host::mask_of(device().quantities(), {"status", "faults"});
  }
  /// What this has armed is still armed.
  void check_armed(const host::Tick& tick) {
    if (!keep_->holds() || device().armed(tick)) return;
    throw host::Refused("the motor is off: fault " + device().fault_names(tick));
  }
  py::dict columns(const Names& names, const std::vector<host::Tick>& ticks) {
    py::dict all;
    all["time_s"] = column(ticks, &host::Tick::time_s);
    for (const std::string& name : names) {
      const Quantity& q = device().quantities().streamed(name);
      all[name.c_str()] = column(ticks, [&](const host::Tick& t) { return t.value(q); });
    }
    return all;
  }

  int baud_;
  std::unique_ptr<host::Transport> transport_;
  host::Link link_;
  std::unique_ptr<host::Device> device_;
  std::unique_ptr<host::KeepAlive> keep_;
  std::unique_ptr<host::LawEngine> laws_;
};

}  // namespace

PYBIND11_MODULE(_host, m) {
  m.doc() = "The host's side of the link, and the compiler of laws: imported with feltgate.Device.";
  py::register_exception_translator(translate);
  py::register_exception<host::LinkLost>(m, "LinkLost", PyExc_ConnectionError);
  py::register_exception<host::Refused>(m, "Refused", PyExc_RuntimeError);
  py::class_<PyDevice>(m, "Device")
      .def(py::init<const std::string&, const std::string&, const std::string&, int, double>(),
           "port"_a, "root"_a, "design"_a, "baud"_a, "patience_s"_a)
      .def("info", &PyDevice::info)
      .def("link", &PyDevice::link)
      .def("names", &PyDevice::names)
      .def("get", &PyDevice::get, "name"_a)
      .def("tick", &PyDevice::tick)
      .def("set", &PyDevice::set, "name"_a, "value"_a)
      .def("law", &PyDevice::law, "path"_a)
      .def("events", &PyDevice::events, "seconds"_a)
      .def("arm", &PyDevice::arm, "scene"_a)
      .def("hold", &PyDevice::hold, "seconds"_a)
      .def("kick", [](PyDevice& d) { d.does(&host::Device::kick); })
      .def("disarm", &PyDevice::disarm)
      .def("stop", [](PyDevice& d) { d.does(&host::Device::stop); })
      .def("clear_faults", [](PyDevice& d) { d.does(&host::Device::clear_faults); })
      .def("set_zero", [](PyDevice& d) { d.does(&host::Device::set_zero); })
      .def("select", &PyDevice::select, "scene"_a)
      .def("stream", &PyDevice::stream, "names"_a, "every_s"_a, "seconds"_a)
      .def("capture", &PyDevice::capture, "names"_a, "trigger"_a, "before"_a, "span_s"_a,
           "wait_s"_a)
      .def("close", &PyDevice::close);
}

}  // namespace feltgate::python
