// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The planes of a mesh for a board.
#include "apps/commands/touch/touch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "apps/commands/commands.hpp"
#include "apps/commands/host/streaming.hpp"

namespace feltgate {

using plant::Vec3;

namespace {

/// Of an update on the line: SLIP, CRC, address and word of each write.
constexpr double bits_per_write = 15 * 10, most_of_line = 0.8;
/// Without --csv, figures are of the last so many poses at most: a session may last for days.
constexpr std::size_t most_kept = 200'000;

/// Gives the board this law, if it does not have it, without a plane: another session may have left
/// one, and its velocity, in the mailbox.
void bring_law(host::Session& session, host::LawEngine& laws, const char* name, bool quiet) {
  const law::Image image = session.image_of(name);
  if (laws.holds(image)) {
    laws.attach(image);
  } else {
    Progress progress("loading the law " + image.name, quiet);
    laws.load(image, [&](double share) { progress.update(share); });
    host::keep_law(host::laws_folder(), image);
  }
  laws.set({{"stiffness", 0}, {"speed_x", 0}, {"speed_y", 0}, {"speed_z", 0}});
}

/// Within the ranges of the law's words.
void keep_within(std::map<std::string, double>& words, const host::LawEngine& laws) {
  for (auto& [name, value] : words) {
    const law::ImageWord& w = *laws.find(name);
    const double ends[] = {w.lower * w.scale, w.upper * w.scale};
    value = std::clamp(value, std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  }
}

/// Leaves the oldest poses out.
void forget(touch::TouchRun& run, std::size_t count) {
  const auto rows = static_cast<std::ptrdiff_t>(count);
  run.rows.erase(run.rows.begin(), run.rows.begin() + rows);
  run.updates.erase(run.updates.begin(), run.updates.begin() + rows);
}

/// Whether the pen is outside of the mesh, so that a proxy can begin; says what to do if not.
bool began(touch::Seeker& seeker, Vec3 pen_m, bool quiet) {
  try {
    seeker.begin(pen_m);
    return true;
  } catch (const std::invalid_argument&) {
    if (!quiet) std::fputs("the pen is in the mesh: lead it out, then it feels the mesh\n", stderr);
    return false;
  }
}

}  // namespace

AxesScene stylus_scene() {
  return read_axes_scene(find_file("stylus_cube", "vectors/scenes"), [](const std::string& name) {
    return find_file(name, "vectors/devices");
  });
}

BoardTouch touch_board(const TouchArguments& a, const touch::Mesh& mesh,
                       const touch::TouchRequest& request) {
  constexpr double shown_every_s = 0.25;
  host::Session session;
  session.options.port = a.board;
  session.options.baud = a.baud;
  session.options.patience_s = 3;
  const std::string design = session.design().name();
  if (session.device().axes() != 3 || design.find("stylus") == std::string::npos) {
    throw std::invalid_argument(
        fmt::format("--board {}: its design {} is no stylus; a pen on three slides is needed",
                    a.board, design));
  }
  host::Device& device = session.device();
  host::LawEngine laws(device);
  bring_law(session, laws, touch::law_of(request), a.quiet);
  const double capstan_m =
      std::get<StylusSetup>(stylus_scene().device).parameters.lever.lever.radius_m;
  touch::Seeker seeker(mesh, request);
  host::MailboxBurst burst(device, laws);

  BoardTouch b;
  host::StreamArguments stream;
  for (const char* word : {"angle", "tau_ref"}) {
    for (const char* axis : {"", ".1", ".2"}) stream.names.push_back(std::string(word) + axis);
  }
  stream.arm = "law";
  stream.seconds = a.seconds;
  const auto writes = static_cast<double>(plane_words(seeker.host(), {}, {}, {}).size() + 1);
  const double fits_hz = most_of_line * a.baud / (bits_per_write * writes);
  const double tick_hz = session.board().tick_hz();
  const auto period = std::max(
      device.shortest_period(host::stream_mask(device, stream), a.baud),
      static_cast<std::uint32_t>(std::ceil(tick_hz / std::min(a.request.host.rate_hz, fits_hz))));
  b.rate_hz = tick_hz / period;
  const auto columns = host::stream_columns(device, stream);
  double shown_s = -shown_every_s;
  bool told = a.quiet;  // that the pen is in the mesh
  if (!a.quiet) {
    std::fputs(fmt::format("{}planes at {:.0f} Hz to {}, {} baud; Ctrl-C ends it\n",
                           simulated_banner(session.board()), b.rate_hz, a.board, a.baud)
                   .c_str(),
               stderr);
  }
  host::follow_stream(device, stream, period, [&](const host::Tick& oldest) {
    host::Tick tick = oldest;
    for (; const auto newer = device.streamed(host::HostClock::now()); ++b.skipped) tick = *newer;
    const auto vector_of = [&](std::size_t first, double by) {
      return Vec3{by * tick.value(*columns[first]), by * tick.value(*columns[first + 1]),
                  by * tick.value(*columns[first + 2])};
    };
    const Vec3 pen_m = vector_of(0, capstan_m);
    if (b.run.updates.empty() && !began(seeker, pen_m, std::exchange(told, true))) return;
    const auto [plane, material] = seeker.find(pen_m, tick.time_s, b.run.updates);
    std::map<std::string, double> words = plane_words(seeker.host(), material, plane, pen_m);
    keep_within(words, laws);
    burst.send(words);
    const Vec3 force_n = vector_of(3, 1 / capstan_m);
    b.run.rows.push_back({tick.time_s, pen_m, plane.normal, force_n});
    if (a.csv.empty() && b.run.rows.size() >= most_kept) forget(b.run, most_kept / 2);
    if (a.quiet || tick.time_s - shown_s < shown_every_s) return;
    shown_s = tick.time_s;
    const touch::Touched& t = b.run.updates.back().touched;
    std::fputs(
        fmt::format("{:7.2f} s  pen {:6.2f} {:6.2f} {:6.2f} mm  {}  force {:6.3f} {:6.3f} "
                    "{:6.3f} N\n",
                    tick.time_s, 1e3 * pen_m.x, 1e3 * pen_m.y, 1e3 * pen_m.z,
                    t.touching ? fmt::format("{:5.2f} mm deep", 1e3 * t.depth_m) : "free         ",
                    force_n.x, force_n.y, force_n.z)
            .c_str(),
        stderr);
  });
  b.counts = burst.check();
  return b;
}

std::string board_text(const BoardTouch& b) {
  const TouchSummary m = summary_of(b.run);
  return fmt::format(
      "\n{} planes at {:.0f} Hz, {:.0f} % touching; {} poses overtaken, {} frames lost on the "
      "line, {} checks found a busy engine\n"
      "depth up to {:.3f} mm, force up to {:.3f} N; an update of the proxy took {:.1f} us in the "
      "median\n",
      b.counts.sent, b.rate_hz, 100 * m.touching, b.skipped, b.counts.lost_frames, b.counts.dropped,
      1e3 * m.depth_m, m.force_n, 1e6 * m.median_s);
}

void add_board(nlohmann::ordered_json& j, const BoardTouch& b) {
  const TouchSummary m = summary_of(b.run);
  j["planes"] = b.counts.sent;
  j["rate_hz"] = b.rate_hz;
  j["touching"] = m.touching;
  j["constraints"] = m.constraints;
  j["depth_m"] = m.depth_m;
  j["force_n"] = m.force_n;
  j["update_s"] = {{"median", m.median_s}, {"q999", m.rare_s}};
  j["overtaken"] = b.skipped;
  j["lost_frames"] = b.counts.lost_frames;
  j["dropped"] = b.counts.dropped;
}

}  // namespace feltgate
