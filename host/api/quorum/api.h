// What all headers of the library share: its namespace, and the mark of what it exports.
#pragma once

#define QUORUM_API __attribute__((visibility("default")))

/// All names lie in quorum::v0, where 0 is the major version, so that programs built for another one don't link with
/// it. Write quorum::Scene: the directive below finds them there. The engine has a namespace quorum with a Scene of its
/// own. Whoever includes headers of the engine, too, defines QUORUM_API_APART first and writes quorum::v0::Scene.
namespace quorum::v0 {}

#ifndef QUORUM_API_APART
namespace quorum {
using namespace v0;  // NOLINT
}
#endif
