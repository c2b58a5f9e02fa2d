// Files that hold no picture for us, and what helps.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace quorum {

/// What is wrong with a file that can't be taken for a photograph, and the remedy: a raw photograph (of which decoders
/// see the thumbnail at most), a kind of picture that is not read, a pointer in place of the file, a JPEG or TIFF file
/// that is cut or damaged (find_jpeg_flaw, find_tiff_flaw), or one with a hole (find_hole). Empty if nothing speaks
/// against it. bytes: the file, or its first ones; is_whole: all of them, so that what is missing counts.
std::string why_unread(const std::filesystem::path& path, std::string_view bytes, bool is_whole);

}  // namespace quorum
