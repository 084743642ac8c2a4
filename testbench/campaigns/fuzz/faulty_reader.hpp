// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A reader with every fault that fuzzing must find. Documentation: docs/testing.md
#pragma once

#include "reader_inputs.hpp"

namespace feltgate::fuzz {

/// The input names the fault: crash, hang, write, message or throw.
Ending use_faulty(const std::filesystem::path& file);

}  // namespace feltgate::fuzz
