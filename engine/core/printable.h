// Text from strangers, made safe to show.
#pragma once

#include <string>
#include <string_view>

namespace quorum {

/// The text for one line of a terminal or of a file: what is no printable character becomes the substitute. These are
/// control characters (ASCII's, so also line ends and the beginnings of terminal escapes, DEL, and Unicode's U+0080 to
/// U+009F), line and paragraph separators, marks that turn the direction of text, and bytes that are no UTF-8 (of
/// each one). The result is valid UTF-8 if the substitute is ASCII. Empty for an empty text.
std::string printable(std::string_view text, char substitute = '?');

}  // namespace quorum
