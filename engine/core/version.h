// The version of the program, as `quorum --version` and run.json state it.
#pragma once

#include <string_view>

namespace quorum {

std::string_view version();

}  // namespace quorum
