// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate host PORT law. Documentation: docs/host.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "apps/commands/host/verbs.hpp"

namespace feltgate::host {

std::string law_text(const law::ImageWord& of, double value) {
  return fmt::format("{:.9g}{}{}", value + 0.0, of.unit.empty() ? "" : " ", of.unit);
}

std::string range_text(const law::ImageWord& of) {
  const double a = of.lower * of.scale / of.to_si, b = of.upper * of.scale / of.to_si;
  return fmt::format("{:.6g} .. {:.6g}{}{}", std::min(a, b) + 0.0, std::max(a, b) + 0.0,
                     of.unit.empty() ? "" : " ", of.unit);
}

std::string law_state(LawEngine& laws) {
  const EngineStatus s = laws.status();
  std::string text = laws.image() != nullptr
                         ? laws.image()->name
                         : "none, or one that is not known here: --law gives its file";
  text += s.crc_busy   ? "; its CRC is being checked"
          : s.crc_good ? "; its CRC held at the last arming"
                       : "; its CRC is checked when the motor arms";
  if (s.mailbox_late && laws.image() != nullptr && laws.image()->mailbox_first < 32) {
    text += "; its mailbox was not fed in time, so there is no torque";
  }
  if (s.late) text += "; no fresh torque in time";
  if (s.overrun) text += "; a start found it still running";
  return text;
}

namespace {

std::string parameter_lines(LawEngine& laws) {
  std::string text;
  for (const law::ImageWord* w : laws.parameters()) {
    text += fmt::format("  {:<20} {:<20} {}{}\n", w->name, law_text(*w, laws.get(w->name)),
                        range_text(*w), w->mailbox ? ", mailbox" : "");
  }
  for (const law::ImageEvent& e : laws.image()->events) {
    text += fmt::format("  {:<20} event\n", e.name);
  }
  return text;
}

int run_law(Session& session, const std::string& file) {
  Device& device = session.device();
  if (file.empty()) {
    LawEngine& laws = session.laws();
    std::string text = simulated_banner(device.board()) + "law " + law_state(laws) + "\n";
    if (laws.image() != nullptr) text += parameter_lines(laws);
    std::fputs(text.c_str(), stdout);
    return exit_ok;
  }
  LawEngine laws(device);  // before the work of compiling: it says where there is no engine
  const law::Image image = session.image_of(file);
  LoadReport r;
  {
    Progress progress("loading", false);
    r = laws.load(image, [&](double share) { progress.update(share); });
  }
  keep_law(laws_folder(), image);
  std::fputs(
      fmt::format("{}law {}: {} words written, {} read back and equal, CRC 0x{:08x}\n{}"
                  "the board computes that CRC when the motor arms: arm law --hold\n{}",
                  simulated_banner(device.board()), image.name, r.written, r.words, law::crc(image),
                  parameter_lines(laws), link_troubles(session.link().counts()))
          .c_str(),
      stdout);
  return exit_ok;
}

}  // namespace

Run add_law(CLI::App& sub) {
  auto file = std::make_shared<std::string>();
  sub.footer(R"(  feltgate host /dev/ttyUSB0 law detent                 one of rtl/laws
  feltgate host /dev/ttyUSB0 law mine.law               yours (docs/laws.md)
  feltgate host /dev/ttyUSB0 set clicks=12 amplitude=80mNm
  feltgate host /dev/ttyUSB0 arm law --hold
Compiles the law for the board's design, loads it while the motor is disarmed, and reads all of it
back. The board computes the CRC of what it holds at each arming and arms the scene law only if it
is that of a law that was loaded whole. Its parameters are known by name from then on.
Exit code: 0 loaded, 1 refused: armed, no engine; 2 unusable input, a law that cannot be read or
proven, with line, reason and mend; 3 the link broke down.)");
  option(sub, "law", *file, "LAW",
         "name in rtl/laws, a law file, or an image of feltgate law --output; without it says "
         "which law runs");
  return [file](Session& session) { return run_law(session, *file); };
}

}  // namespace feltgate::host
