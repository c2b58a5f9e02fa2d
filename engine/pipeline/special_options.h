// The options of a run that take more than a number, a word or a file. Each is a line of the table in run_options.cc.
#pragma once

#include <string>

#include "engine/pipeline/run_options.h"

namespace quorum {

/// Six numbers, in one word or in six.
Option<RunOptions> bounds_option(std::string name, std::string help);

/// The factors of a depth's weight.
Option<RunOptions> weights_option(std::string name, std::string help);

/// Windows that face the camera, by a name of their own.
Option<RunOptions> no_slant_option(std::string help);

/// Two numbers.
Option<RunOptions> tile_option(std::string name, std::string help);

/// Several options of depth maps by one name. It stands before them, so each of them overrules it.
Option<RunOptions> quality_option(std::string name, std::string help);

/// A part of a stage's work.
Option<RunOptions> shard_option(std::string name, std::string help);

/// Such as 500k.
Option<RunOptions> triangles_option(std::string name, std::string help);

}  // namespace quorum
