// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a twin calls while it advances. Documentation: docs/library.md
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace feltgate {

/// Refers to something that can be called with these arguments; it must live as long as this.
template <class... Arguments>
class Callback {
 public:
  /// Nothing is called.
  Callback() : call_([](void*, Arguments...) {}) {}
  template <class F, class = std::enable_if_t<!std::is_same_v<std::decay_t<F>, Callback>>>
  Callback(F&& f)  // NOLINT(google-explicit-constructor): a caller gives a lambda
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
        call_([](void* object, Arguments... arguments) {
          (*static_cast<std::remove_reference_t<F>*>(object))(arguments...);
        }) {}
  void operator()(Arguments... arguments) const { call_(object_, arguments...); }

 private:
  void* object_ = nullptr;
  void (*call_)(void*, Arguments...);
};

}  // namespace feltgate
