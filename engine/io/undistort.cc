#include "engine/io/undistort.h"

#include <algorithm>
#include <exception>
#include <opencv2/imgproc.hpp>

#include "engine/core/check.h"

namespace quorum {
namespace {

template <typename T>
Expected<Grid<T>> undistort(const Grid<T>& photograph, const Lens& lens, const PinholePicture& picture, int type,
                            int interpolation, int border) {
  constexpr int kBand = 64;  // rows at a time, so that the map of positions stays small
  QUORUM_CHECK_EQ(photograph.width, lens.width);
  QUORUM_CHECK_EQ(photograph.height, lens.height);
  try {
    // OpenCV knows no constant matrix over foreign memory; it only reads here.
    const cv::Mat source(photograph.height, photograph.width, type, const_cast<T*>(photograph.values.data()));
    Grid<T> result(picture.width, picture.height);
    const Eigen::Matrix3d& k = picture.intrinsics;
    for (int first = 0; first < picture.height; first += kBand) {
      const int rows = std::min(kBand, picture.height - first);
      cv::Mat positions(rows, picture.width, CV_32FC2);
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < picture.width; ++x) {
          const Eigen::Vector2d pixel = lens.project({(x - k(0, 2)) / k(0, 0), (first + y - k(1, 2)) / k(1, 1)});
          positions.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
        }
      }
      cv::Mat target(rows, picture.width, type, result.row(first));
      cv::remap(source, target, positions, cv::noArray(), interpolation, border);
    }
    return result;
  } catch (const std::exception& exception) {
    return failure(ErrorKind::kMemory, std::string("undistorting fails: ") + exception.what());
  }
}

}  // namespace

Expected<ColorImage> undistort_image(const ColorImage& photograph, const Lens& lens, const PinholePicture& picture) {
  return undistort(photograph, lens, picture, CV_8UC4, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
}

Expected<Mask> undistort_mask(const Mask& mask, const Lens& lens, const PinholePicture& picture) {
  return undistort(mask, lens, picture, CV_8UC1, cv::INTER_NEAREST, cv::BORDER_CONSTANT);
}

}  // namespace quorum
