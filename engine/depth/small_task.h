// The sweep of a view whose images were halved: images, cameras and warps.
#pragma once

#include <vector>

#include "engine/depth/small_images.h"
#include "engine/depth/sweep_task.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Whether images of half and a quarter of the size help: with windows that follow tilted planes, if enough is left.
bool has_small_images(const SweepTask& task);

/// The camera of an image that was halved this often; see limit_image_size().
Camera small_camera(Camera camera, int halvings);

/// The task with all images halved this often; without planes and ranges. reference, neighbors: the views of the task.
/// images: where the small ones are kept.
SweepTask make_small_task(const SweepTask& task, const View& reference, const std::vector<const View*>& neighbors,
                          int halvings, SmallImages& images);

}  // namespace quorum
