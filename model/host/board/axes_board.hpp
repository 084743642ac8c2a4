// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A board with several axes: a pantograph or another device in closed loop. Documentation:
// docs/host.md
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/board/board.hpp"

namespace feltgate::board {

/// The board of a design with several axes. The joints' counts begin at the joints' zeros, as after
/// homing. The hand of `setup` is "free", "hold" or "swing" (its pen goes 40 mm to the side and
/// back, once a second) for a pantograph, else a scene file of the design's device; `find` converts
/// the names of scenes and devices to paths. Errors: std::invalid_argument, config::ConfigError.
std::unique_ptr<Board> make_axes_board(
    std::unique_ptr<Core> core, const Setup& setup,
    const std::function<std::string(const std::string& name, const std::string& folder)>& find);

}  // namespace feltgate::board
