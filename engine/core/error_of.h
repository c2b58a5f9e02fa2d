// Exceptions as errors, at the boundary of the engine: the program's main, and each call of the library.
#pragma once

#include <exception>

#include "engine/core/error.h"

namespace quorum {

/// What an exception tells that nothing closer to its cause has caught.
Error error_of(const std::exception_ptr& exception);

}  // namespace quorum
