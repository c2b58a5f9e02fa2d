// The installed colmap, called as a process of its own.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/pipeline/progress.h"

namespace quorum {

/// That a run was stopped as asked (kStopped).
Error stopped_by_request();

/// Runs colmap with its output in a file; the result is its exit status. It has a process group of its own, which ends
/// with us when we are asked to stop.
Expected<int> call_colmap(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                          const Progress& progress);

/// The arguments that keep a command off the GPU.
Expected<std::vector<std::string>> without_gpu(const std::string& command, std::initializer_list<const char*> names,
                                               const std::filesystem::path& work, const Progress& progress);

}  // namespace quorum
