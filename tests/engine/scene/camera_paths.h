// Cameras as people carry them, 320 x 240 pixels with a focal length of 300.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/scene/scene.h"

namespace quorum {

inline View view_from(const Eigen::Vector3d& center, const Eigen::Matrix3d& camera_from_world) {
  View view;
  view.width = 320;
  view.height = 240;
  view.camera.intrinsics << 300, 0, 159.5, 0, 300, 119.5, 0, 0, 1;
  view.camera.camera_from_world = camera_from_world;
  view.camera.translation = -camera_from_world * center;
  return view;
}

/// World to camera of a level camera that looks along this angle in the x-y plane; z is up.
inline Eigen::Matrix3d looking(double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180.0;
  const Eigen::Vector3d forward(std::cos(angle), std::sin(angle), 0.0);
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  Eigen::Matrix3d rotation;
  rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return rotation;
}

inline Eigen::Vector3d on_circle(double radius, double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180.0;
  return {radius * std::cos(angle), radius * std::sin(angle), 0.0};
}

/// On a circle of radius 4 around an object of size 2, looking at it.
inline Scene orbit(int views) {
  Scene scene{{}, {Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1)}};
  for (int i = 0; i < views; ++i)
    scene.views.push_back(view_from(on_circle(4, 360.0 * i / views), looking(360.0 * i / views + 180)));
  return scene;
}

/// A drone 8 above the ground, straight down, 1.2 apart.
inline Scene strip(int views) {
  Scene scene{{}, {{-3, -3, -1}, {1.2 * views + 2, 3, 1}}};
  const Eigen::Matrix3d down = Eigen::Vector3d(1, -1, -1).asDiagonal();
  for (int i = 0; i < views; ++i) scene.views.push_back(view_from({1.2 * i, 0, 8}, down));
  return scene;
}

/// A walk along a wall at x = 3: places 0.35 apart, from each of them three views, turned by 6 degrees.
inline Scene pans(int places) {
  Scene scene{{}, {{2.7, -3, -2}, {3.2, 3, 2}}};
  for (int i = 0; i < places; ++i)
    for (const double turn : {-6.0, 0.0, 6.0}) scene.views.push_back(view_from({0, 0.35 * i - 1, 0}, looking(turn)));
  return scene;
}

/// Turned on the spot, in a room of 6.
inline Scene turn(int views) {
  Scene scene{{}, {Eigen::Vector3d::Constant(-3.2), Eigen::Vector3d::Constant(3.2)}};
  for (int i = 0; i < views; ++i) scene.views.push_back(view_from({0.3, 0.2, 0}, looking(6.0 * i)));
  return scene;
}

/// On a circle of radius 0.9 in a room of 6, looking outward.
inline Scene room(int views) {
  Scene scene{{}, {Eigen::Vector3d::Constant(-3.2), Eigen::Vector3d::Constant(3.2)}};
  for (int i = 0; i < views; ++i)
    scene.views.push_back(view_from(on_circle(0.9, 360.0 * i / views), looking(360.0 * i / views)));
  return scene;
}

/// Straight ahead through a street, 0.5 a step, looking ahead and 20 degrees aside by turns.
inline Scene walk(int views) {
  Scene scene{{}, {{4, -3, -1}, {0.5 * views + 8, 3, 3}}};
  for (int i = 0; i < views; ++i) scene.views.push_back(view_from({0.5 * i, 0, 1}, looking(i % 2 == 0 ? 0 : 20)));
  return scene;
}

}  // namespace quorum
