// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law that is refused, and its messages.
#pragma once

#include "catch.hpp"
#include "law_case.hpp"

struct Bad {
  const char* text;
  const char* messages;  ///< without the file's name, a line each
};

// A line that is well, so that only what is looked at is wrong.
#define OUT "\nout torque = tau_hat"

inline void check(const Bad& bad) {
  INFO(bad.text);
  CHECK(feltgate::law::messages_of(bad.text) == bad.messages);
}
