#include "engine/camera/camera.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <numbers>
#include <string>

namespace quorum {
namespace {

Camera tilted_camera() {
  Camera camera;
  camera.intrinsics << 1520.4, 1.5, 302.32, 0.0, 1525.9, 246.87, 0.0, 0.0, 1.0;
  camera.camera_from_world = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  camera.translation = {0.1, -0.2, 0.6};
  return camera;
}

TEST(Camera, PointOnTheOpticalAxisLandsOnThePrincipalPoint) {
  const Camera camera = tilted_camera();
  const Eigen::Vector3d pixel = camera.project(camera.center() + 2.5 * camera.optical_axis());
  EXPECT_NEAR(pixel.x(), 302.32, 1e-9);
  EXPECT_NEAR(pixel.y(), 246.87, 1e-9);
  EXPECT_NEAR(pixel.z(), 2.5, 1e-12);
}

TEST(Camera, AxesPointRightDownAndForward) {
  Camera camera;
  camera.intrinsics << 100.0, 0.0, 50.0, 0.0, 200.0, 40.0, 0.0, 0.0, 1.0;
  const Eigen::Vector3d pixel = camera.project({1.0, 2.0, 10.0});
  EXPECT_DOUBLE_EQ(pixel.x(), 60.0);
  EXPECT_DOUBLE_EQ(pixel.y(), 80.0);
  EXPECT_DOUBLE_EQ(pixel.z(), 10.0);
}

TEST(Camera, DepthIsTheDistanceAlongTheAxisAndNotAlongTheRay) {
  const Camera camera = tilted_camera();
  const Eigen::Vector3d point = camera.unproject(0.0, 479.0, 3.0);
  EXPECT_NEAR((point - camera.center()).dot(camera.optical_axis()), 3.0, 1e-12);
  EXPECT_GT((point - camera.center()).norm(), 3.01);
}

TEST(Camera, UnprojectUndoesProject) {
  const Camera camera = tilted_camera();
  for (const double x : {-0.5, 0.0, 302.32, 639.0})
    for (const double y : {0.0, 123.25, 479.5})
      for (const double depth : {1e-3, 0.6, 1e4}) {
        const Eigen::Vector3d pixel = camera.project(camera.unproject(x, y, depth));
        EXPECT_NEAR(pixel.x(), x, 1e-6);
        EXPECT_NEAR(pixel.y(), y, 1e-6);
        EXPECT_NEAR(pixel.z(), depth, 1e-9 * depth + 1e-12);
      }
}

TEST(Camera, PointBehindItHasNegativeDepth) {
  const Camera camera = tilted_camera();
  EXPECT_LT(camera.project(camera.center() - camera.optical_axis()).z(), 0.0);
}

TEST(Camera, CenterIsWhereDepthAndOffsetVanish) {
  const Camera camera = tilted_camera();
  EXPECT_LT(camera.to_camera(camera.center()).norm(), 1e-15);
  Camera shifted;
  shifted.translation = {1.0, 2.0, 3.0};
  EXPECT_EQ(shifted.center(), Eigen::Vector3d(-1.0, -2.0, -3.0));
}

TEST(OpticalAxisAngle, IsThatOfTheRotationBetweenTheCameras) {
  const Camera a = tilted_camera();
  for (const double angle_deg : {0.0, 30.0, 90.0, 180.0}) {
    Camera b = a;
    const double angle = angle_deg * std::numbers::pi / 180.0;
    b.camera_from_world = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()) * a.camera_from_world;
    b.translation = {9.0, 9.0, 9.0};
    EXPECT_NEAR(optical_axis_angle_deg(a, b), angle_deg, 1e-5);
    EXPECT_NEAR(optical_axis_angle_deg(b, a), angle_deg, 1e-5);
  }
}

TEST(OpticalAxisAngle, RotationInTheImagePlaneDoesNotCount) {
  const Camera a = tilted_camera();
  Camera b = a;
  b.camera_from_world = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()) * a.camera_from_world;
  EXPECT_NEAR(optical_axis_angle_deg(a, b), 0.0, 1e-5);
}

std::string defect_of(const Camera& camera) {
  const char* defect = camera_defect(camera);
  return defect != nullptr ? defect : "";
}

TEST(CameraDefect, ProperCameraHasNone) {
  EXPECT_EQ(defect_of(tilted_camera()), "");
  EXPECT_EQ(defect_of(Camera()), "");
}

TEST(CameraDefect, RotationOfFewDigitsIsAccepted) {
  Camera camera = tilted_camera();
  camera.camera_from_world = (camera.camera_from_world * 1e4).array().round() / 1e4;
  EXPECT_EQ(defect_of(camera), "");
}

TEST(CameraDefect, NamesWhatIsWrongWithK) {
  const auto with_k = [](int row, int column, double value) {
    Camera camera = tilted_camera();
    camera.intrinsics(row, column) = value;
    return defect_of(camera);
  };
  EXPECT_EQ(with_k(0, 2, std::numeric_limits<double>::quiet_NaN()), "a camera value is not finite");
  EXPECT_EQ(with_k(1, 0, 1e-3), "K is not upper triangular");
  EXPECT_EQ(with_k(2, 1, 1e-3), "K is not upper triangular");
  EXPECT_EQ(with_k(0, 0, 0.0), "K is singular or has a focal length that is not positive");
  EXPECT_EQ(with_k(1, 1, -1525.9), "K is singular or has a focal length that is not positive");
  EXPECT_EQ(with_k(2, 2, 0.0), "K is singular or has a focal length that is not positive");
  EXPECT_EQ(with_k(2, 2, 2.0), "K is not scaled to K(2,2) = 1");
}

TEST(CameraDefect, NamesWhatIsWrongWithRAndT) {
  Camera stretched = tilted_camera();
  stretched.camera_from_world *= 1.01;
  EXPECT_EQ(defect_of(stretched), "R is not a rotation: its rows are not orthonormal");
  Camera mirrored = tilted_camera();
  mirrored.camera_from_world.row(0) *= -1.0;
  EXPECT_EQ(defect_of(mirrored), "R is not a rotation: it mirrors");
  Camera far = tilted_camera();
  far.translation.y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(defect_of(far), "a camera value is not finite");
}

TEST(AbsurdValue, IsNoneOfACameraThatPeopleHave) {
  Camera camera = tilted_camera();
  EXPECT_EQ(absurd_value(camera, 640, 480), "");
  camera.intrinsics(0, 2) = -20000;
  EXPECT_EQ(absurd_value(camera, 640, 480), "") << "cropped from a large picture";
  camera.intrinsics(0, 0) = 1.6e6;
  camera.intrinsics(1, 1) = 1.6e6;
  EXPECT_EQ(absurd_value(camera, 640, 480), "") << "a satellite's";
  camera.translation = {6.4e12, 0, 0};
  EXPECT_EQ(absurd_value(camera, 640, 480), "") << "the earth's radius in micrometers";
}

TEST(AbsurdValue, IsNamedWithItsNumbers) {
  const auto with = [](auto change) {
    Camera camera = tilted_camera();
    change(camera);
    return absurd_value(camera, 640, 480);
  };
  for (const double focal : {1e30, 1e-30, 0.8, 35.0})
    EXPECT_EQ(with([focal](Camera& camera) { camera.intrinsics(0, 0) = camera.intrinsics(1, 1) = focal; }),
              fmt::format("its focal length {:.6g} is none of a picture of 640 x 480, in pixels", focal));
  EXPECT_EQ(with([](Camera& camera) { camera.intrinsics(1, 1) = 70; }),
            "its focal lengths 1520.4 and 70 are those of no camera");
  EXPECT_EQ(with([](Camera& camera) { camera.intrinsics(1, 2) = 1e5; }),
            "its principal point (302.32, 100000) is far outside of a picture of 640 x 480");
  EXPECT_TRUE(with([](Camera& camera) { camera.translation.z() = 1e30; }).ends_with("is beyond all units"));
}

}  // namespace
}  // namespace quorum
