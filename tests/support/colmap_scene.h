// A small COLMAP model with its photographs, made by the rules of the format.
#pragma once

#include <filesystem>
#include <string>

#include "engine/io/colmap_model.h"

namespace quorum {

/// Four images a.png to d.png, of cameras 1 to 4 of one model (width 64 to 67, height 48) that stand on an arc around
/// 60 points, and all observations that fall into the images, at COLMAP's pixels. model: a name of
/// colmap_camera_models(); its coefficients bend the picture by some pixels at the border.
ColmapModel make_colmap_model(const std::string& model);

/// Writes the model as cameras.txt, images.txt and points3D.txt, with a feature without point in front of each image's.
void write_colmap_text(const std::filesystem::path& folder, const ColmapModel& model);

/// Writes folder/images with a photograph for each image, and folder/sparse with the model as .bin.
void write_colmap_scene(const std::filesystem::path& folder, const ColmapModel& model);

}  // namespace quorum
