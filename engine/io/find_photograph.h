// Where a photograph stands that a scene's files name.
#pragma once

#include <filesystem>
#include <string>

namespace quorum {

/// The file of a name below a folder; empty if there is none. Taken as it is said first; else with "\" as "/"; of a
/// path that is absolute, which another machine may have had, its end, as long as it can be; with another case of the
/// extension, or with the usual ones where it has none. If none of these is there, a name that is a URI in whole or in
/// part (RFC 3986, RFC 8089): without file: and with %20 and other escapes as what they stand for.
std::filesystem::path find_photograph(const std::filesystem::path& folder, const std::string& name);

/// The same for a name that may begin with folders which lead to another folder of photographs (nerfstudio's
/// images/a.png in images_2): its end counts, too.
std::filesystem::path find_photograph_by_end(const std::filesystem::path& folder, const std::string& name);

}  // namespace quorum
