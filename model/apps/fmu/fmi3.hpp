// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What fmu.cpp needs of FMI 3.0 (https://fmi-standard.org): types and signatures as the standard
// documents them. Documentation: docs/product.md
#pragma once

#include <cstddef>
#include <cstdint>

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
