// Scenes from NumPy arrays.
#pragma once

#include <optional>
#include <vector>

#include "tools/python/bindings.h"

namespace quorum_python {

/// What Scene.from_arrays takes, as it is given.
struct GivenArrays {
  py::object images;
  py::object intrinsics;
  py::object rotations;
  py::object translations;
  py::object points;
  py::object point_views;
  py::object masks;
  py::object names;
  py::object bounds;
  py::object depth_ranges;
  py::object neighbor_lists;
  bool bgr = false;
};

/// Raises a quorum.Error that names the argument and its place.
quorum::Scene scene_from_arrays(const GivenArrays& given, const quorum::Options& options);

}  // namespace quorum_python
