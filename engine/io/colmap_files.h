// The two spellings of the files of a COLMAP model. Each function parses the content of one file; path is for messages.
#pragma once

#include "engine/io/colmap_model.h"

namespace quorum {

Expected<std::vector<ColmapCamera>> parse_colmap_cameras_bin(const std::filesystem::path& path, std::string_view bytes);
Expected<std::vector<ColmapImage>> parse_colmap_images_bin(const std::filesystem::path& path, std::string_view bytes);
Expected<std::vector<ColmapPoint>> parse_colmap_points_bin(const std::filesystem::path& path, std::string_view bytes);

Expected<std::vector<ColmapCamera>> parse_colmap_cameras_txt(const std::filesystem::path& path, std::string_view text);
Expected<std::vector<ColmapImage>> parse_colmap_images_txt(const std::filesystem::path& path, std::string_view text);
Expected<std::vector<ColmapPoint>> parse_colmap_points_txt(const std::filesystem::path& path, std::string_view text);

}  // namespace quorum
