// Cameras of Agisoft Metashape and PhotoScan: the XML file of File > Export > Export Cameras.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// True if a file begins as an export of cameras does.
bool is_metashape_file(const std::filesystem::path& file);

/// Reads the file: of several chunks the one with the most aligned cameras, with their sensors' adjusted calibrations,
/// types frame, fisheye and equidistant_fisheye (Metashape Professional's manual, appendix D). Coordinates are those of
/// the chunk's transform (earth-centered where it is georeferenced), or of its own frame without one. A camera's label
/// is the name of its photograph, with an extension or without, below images, or around the file
/// (photograph_folders). Cameras that are not aligned or not enabled are left out. Fails (kInput), naming the sensor or
/// camera, if a value is absent or no number, a calibration is none, of another type or has b2, p3 or p4, or as
/// ViewList does.
Expected<Scene> read_metashape(const std::filesystem::path& file, const std::filesystem::path& images);

}  // namespace quorum
