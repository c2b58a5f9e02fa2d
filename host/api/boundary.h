// Between the engine and its callers: failures and exceptions of the one as results of the other.
#pragma once

#include <quorum/result.h>

#include <exception>
#include <type_traits>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/error_of.h"

namespace quorum::v0 {

/// The same failure for callers.
inline Error outward(const quorum::Error& error) { return {static_cast<ErrorKind>(error.kind), error.message}; }

/// Does work, which gives an Expected<Value>. Exceptions become failures.
template <typename Value, typename Work>
Result<Value> at_boundary(const Work& work) {
  try {
    quorum::Expected<Value> done = work();
    if (!done) return outward(done.error());
    if constexpr (std::is_void_v<Value>)
      return {};
    else
      return *std::move(done);
  } catch (...) {
    return outward(quorum::error_of(std::current_exception()));
  }
}

}  // namespace quorum::v0
