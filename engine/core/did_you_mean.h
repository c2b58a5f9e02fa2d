// Suggestions for mistyped names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quorum {

/// "; did you mean NAME?" of the name that is nearest to a word, as mistyped as a word may be; empty if none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace quorum
