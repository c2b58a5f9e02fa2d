// A folder whose files come from a fuzzer.
#pragma once

#include <filesystem>
#include <string_view>

namespace quorum {

/// Writes the files that an input names into a folder that is empty before, and gives that folder. An input is files
/// one after another, each behind a line "@@ NAME"; a name is letters, digits and the signs . _ - /, at most three
/// folders deep, and stays inside the folder. At most 32 files.
const std::filesystem::path& fill_folder(std::string_view input);

/// Writes the input as one file with this ending, and gives its path.
const std::filesystem::path& write_input(std::string_view input, std::string_view ending);

}  // namespace quorum
