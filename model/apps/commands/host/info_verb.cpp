// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT info. Documentation: docs/host.md
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands/host/verbs.hpp"
#include "files/output_file.hpp"

namespace feltgate::host {

namespace {

std::string line(const char* label, const std::string& text) {
  return fmt::format("{:<10}{}\n", label, text);
}

std::string features(const BoardInfo& b) {
  std::string text = b.has_stream ? "stream" : "no stream";
  text += b.has_capture
              ? fmt::format(", capture of {} rows of {} words", b.capture_rows, b.capture_columns)
              : ", no capture";
  if (b.has_engine) text += ", engine for laws";
  return text;
}

std::string state(Device& device, const Tick& tick) {
  const char* const modes[] = {"closed loop", "open loop", "direct voltage", "mode 3"};
  const auto mode = static_cast<unsigned>(tick.value(device.quantities().find("status.mode"))) & 3u;
  return fmt::format("{}, scene {}, {}; arm and scene come from the {}",
                     device.armed(tick) ? "ARMED" : "disarmed", device.scene_name(tick),
                     modes[mode], device.host_has_the_say() ? "host" : "panel");
}

nlohmann::ordered_json board_json(const BoardInfo& b, const KnownDesign* design) {
  nlohmann::ordered_json j;
  j["schema"] = "feltgate-host-info/1";
  j["simulated"] = b.simulated;
  j["board"] = b.board_name();
  j["link_version"] = fmt::format("{}.{}", b.major, b.minor);
  j["design"] = design != nullptr ? nlohmann::ordered_json(design->name()) : nullptr;
  j["design_crc"] = fmt::format("0x{:08x}", b.design_crc);
  j["clock_hz"] = b.clock_hz;
  j["clocks_per_tick"] = b.clocks_per_tick;
  j["stream"] = b.has_stream;
  j["capture_rows"] = b.has_capture ? b.capture_rows : 0;
  j["capture_columns"] = b.has_capture ? b.capture_columns : 0;
  j["inputs"] = b.inputs;
  return j;
}

int info(Session& session, const std::string& json_path) {
  files::Outputs outputs;
  files::OutputFile* json = outputs.open("--json", json_path);
  const BoardInfo& b = session.board();
  const KnownDesign* design = session.design_if_known();
  nlohmann::ordered_json j = board_json(b, design);
  std::string text = simulated_banner(b);
  text += line("port", fmt::format("{}, {} baud", session.options.port, session.options.baud));
  text += line("board", fmt::format("{}{}, link {}.{}", b.board_name(),
                                    b.simulated ? " (SIMULATED)" : "", b.major, b.minor));
  text += line(
      "design",
      fmt::format(
          "{}, CRC 0x{:08x}",
          design != nullptr
              ? fmt::format("{} ({})", design->name(), design->design.design.path)
              : "unknown: none of rtl/designs; give its file with --design to see state and units",
          b.design_crc));
  text += line("clock", fmt::format("{:g} MHz, {} clocks in a tick: {:g} MHz",
                                    static_cast<double>(b.clock_hz) / 1e6, b.clocks_per_tick,
                                    b.tick_hz() / 1e6));
  text += line("features", features(b));
  text += line("inputs", fmt::format("0x{:02x}", b.inputs));
  bool fault = false;
  if (design != nullptr) {
    Device& device = session.device();
    const Tick tick = device.tick();
    const std::string faults = device.fault_names(tick), limits = device.limit_names(tick);
    fault = !faults.empty();
    text += line("state", state(device, tick));
    if (LawEngine* laws = session.laws_if_any()) {
      text += line("law", law_state(*laws));
      j["law"] = laws->image() != nullptr ? nlohmann::ordered_json(laws->image()->name) : nullptr;
    }
    for (int axis = 0; axis < device.axes(); ++axis) {
      const auto of = [&](const char* name) {
        return tick.value(device.quantities().find(name + Quantities::suffix(axis)));
      };
      text += line(("at" + Quantities::suffix(axis)).c_str(),
                   fmt::format("{:.4f} rad, {:.4g} rad/s, {:.1f} s since the reset", of("angle"),
                               of("velocity"), tick.time_s));
    }
    if (device.axes() > 1) j["axes"] = device.axes();
    text += line("faults", faults.empty() ? "none" : faults);
    text += line("limits", limits.empty() ? "none" : limits);
    for (const std::string& words : device.in_words(tick)) text += "  " + words + "\n";
    j["armed"] = device.armed(tick);
    j["scene"] = device.scene_name(tick);
    j["host_has_the_say"] = device.host_has_the_say();
    j["faults"] = faults;
    j["limits"] = limits;
  }
  const LinkCounts c = session.link().counts();
  const BoardInfo now = read_board(session.link());
  text +=
      line("link", fmt::format("the board took {} requests and refused {} frames since its reset",
                               now.frames_good, now.frames_bad));
  text += line("", fmt::format("this call: {} requests, {} repeated; {} good frames, {} with a "
                               "wrong CRC, {} with a wrong escape, {} too long, {} stray",
                               c.requests, c.retries, c.frames.good, c.frames.bad_crc,
                               c.frames.bad_slip, c.frames.too_long, c.stray));
  j["board_frames_good"] = now.frames_good;
  j["board_frames_bad"] = now.frames_bad;
  j["requests"] = c.requests;
  j["retries"] = c.retries;
  if (json != nullptr) json->write(j.dump(2) + "\n");
  outputs.say(text);
  outputs.commit();
  return fault ? exit_failed : exit_ok;
}

}  // namespace

Run add_info(CLI::App& sub) {
  auto json = std::make_shared<std::string>();
  sub.footer(R"(  feltgate host /dev/ttyUSB0 info
Exit code: 0 no fault is latched, 1 one is, 2 unusable input or port, 3 the link broke down.)");
  option(sub, "--json", *json, "FILE", "the same as JSON (docs/json.md)");
  return [json](Session& session) { return info(session, *json); };
}

}  // namespace feltgate::host
