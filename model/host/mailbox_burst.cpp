// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Updates of a mailbox at the full rate of the line. Documentation: docs/host.md
#include "host/mailbox_burst.hpp"

#include <algorithm>

#include "feltgate/generated/engine.hpp"

namespace feltgate::host {

namespace {

/// The board's count of frames has 16 bits.
constexpr std::uint64_t most_unchecked = 8192;
constexpr std::uint32_t forgets = 2;  ///< bit of H::commit: the mark of a dropped word

}  // namespace

MailboxBurst::MailboxBurst(Device& device, LawEngine& engine) : device_(device), engine_(engine) {
  device_.link().taken();
}

bool MailboxBurst::send(const std::map<std::string, double>& values, Deadline deadline) {
  if (HostClock::now() > deadline) {
    ++counts_.late;
    return false;
  }
  const std::vector<HostWrite> writes = engine_.update(values);
  device_.link().post(writes);
  ++counts_.sent;
  unchecked_ += writes.size();
  if (unchecked_ >= most_unchecked) check();
  return true;
}

const BurstCounts& MailboxBurst::check() {
  const Link::Taken t = device_.link().taken();
  counts_.lost_frames += t.sent - std::min(t.sent, t.taken);
  unchecked_ = 0;
  if (engine_.status().dropped) {
    ++counts_.dropped;
    device_.link().write(EngineMap::port_first + EngineMap::H::commit, forgets);
  }
  return counts_;
}

}  // namespace feltgate::host
