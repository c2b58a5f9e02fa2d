#include "engine/core/version.h"

namespace quorum {

std::string_view version() { return QUORUM_VERSION; }

}  // namespace quorum
