#include "engine/synthetic/temple.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/synthetic/temple_solids.h"

namespace quorum {
namespace {

using Eigen::Vector3d;

constexpr CameraPath kPaths[] = {CameraPath::kRing, CameraPath::kHemisphere};

TempleOptions small_options() {
  TempleOptions options;
  options.views = 6;
  options.width = 160;
  return options;
}

ColorImage render_with_threads(std::size_t threads, const TempleOptions& options) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  return render_temple(make_temple_scene(options), 1, options);
}

std::optional<Vector3d> seen_from(const Vector3d& center, const Vector3d& toward) {
  const Ray ray{center, toward - center};
  std::optional<double> nearest;
  for (const Solid& solid : temple_solids()) {
    const auto hit = intersect(solid, ray);
    if (hit && (!nearest || hit->t < *nearest)) nearest = hit->t;
  }
  if (!nearest) return std::nullopt;
  return ray.origin + *nearest * ray.direction;
}

double green_between_pixels(const ColorImage& image, double x, double y) {
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0;
  const double fy = y - y0;
  const auto green = [&](int dx, int dy) { return static_cast<double>(green_of(image.at(x0 + dx, y0 + dy))); };
  return (1 - fy) * ((1 - fx) * green(0, 0) + fx * green(1, 0)) + fy * ((1 - fx) * green(0, 1) + fx * green(1, 1));
}

/// How far the green of points that view a shows differs from the pixels that view b has of them: medians, where they
/// belong and two pixels beside.
struct Differences {
  double in_place = 0;
  double beside = 0;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

Differences compare_views(const Scene& scene, const std::vector<ColorImage>& images, std::size_t a, std::size_t b) {
  const Camera& camera_a = scene.views[a].camera;
  const Camera& camera_b = scene.views[b].camera;
  std::vector<double> in_place;
  std::vector<double> beside;
  for (int y = 0; y < images[a].height; y += 3) {
    for (int x = 0; x < images[a].width; x += 3) {
      const auto point = seen_from(camera_a.center(), camera_a.unproject(x, y, 1.0));
      if (!point) continue;
      const auto first = seen_from(camera_b.center(), *point);
      if (!first || (*first - *point).norm() > 1e-6) continue;
      const Vector3d pixel = camera_b.project(*point);
      const double here = green_of(images[a].at(x, y));
      in_place.push_back(std::abs(green_between_pixels(images[b], pixel.x(), pixel.y()) - here));
      beside.push_back(std::abs(green_between_pixels(images[b], pixel.x() + 2, pixel.y()) - here));
    }
  }
  EXPECT_GT(in_place.size(), 500U);
  return {median(in_place), median(beside)};
}

TEST(TempleOptions, EachRangeIsChecked) {
  EXPECT_TRUE(TempleOptions{}.check());
  const auto error_with = [](auto change) {
    TempleOptions options;
    change(options);
    const Expected<void> checked = options.check();
    if (checked) return std::string("none");
    EXPECT_EQ(checked.error().kind, ErrorKind::kUsage);
    return checked.error().message;
  };
  EXPECT_EQ(error_with([](TempleOptions& o) { o.views = 2; }), "option views 2: give 3 to 1024");
  EXPECT_EQ(error_with([](TempleOptions& o) { o.views = 1025; }), "option views 1025: give 3 to 1024");
  EXPECT_EQ(error_with([](TempleOptions& o) { o.width = 63; }), "option width 63: give 64 to 8192");
  EXPECT_EQ(error_with([](TempleOptions& o) { o.width = 8193; }), "option width 8193: give 64 to 8192");
  EXPECT_EQ(error_with([](TempleOptions& o) { o.noise = -0.5; }), "option noise -0.5: give 0 to 64");
  EXPECT_EQ(error_with([](TempleOptions& o) { o.noise = 64.5; }), "option noise 64.5: give 0 to 64");
  EXPECT_EQ(error_with([](TempleOptions& o) { o.texture = -1; }), "option texture -1: give 0 to 4");
  EXPECT_EQ(error_with([](TempleOptions& o) { o.texture = 4.5; }), "option texture 4.5: give 0 to 4");
  EXPECT_EQ(error_with([](TempleOptions& o) { o.noise = std::nan(""); }), "option noise nan: give 0 to 64");
  EXPECT_EQ(error_with([](TempleOptions& o) { o = {3, CameraPath::kHemisphere, 64, 0, 0, 0}; }), "none");
  EXPECT_EQ(error_with([](TempleOptions& o) { o = {1024, CameraPath::kRing, 8192, 64, 4, 7}; }), "none");
}

TEST(TempleScene, ViewsAreNamedAndHaveCameras) {
  const Scene scene = make_temple_scene({});
  ASSERT_EQ(scene.views.size(), 16U);
  EXPECT_EQ(scene.views[0].name, "temple0001");
  EXPECT_EQ(scene.views[15].image_path, "temple0016.png");
  for (const View& view : scene.views) {
    EXPECT_EQ(view.width, 640);
    EXPECT_EQ(view.height, 480);
    EXPECT_EQ(camera_defect(view.camera), nullptr);
  }
  EXPECT_DOUBLE_EQ(scene.views[0].camera.intrinsics(0, 2), 302.32);
}

TEST(TempleScene, WholeObjectIsInEveryImage) {
  constexpr double kMargin = 5;
  TempleOptions options;
  options.views = 100;
  for (const CameraPath path : kPaths) {
    options.path = path;
    const Scene scene = make_temple_scene(options);
    for (const View& view : scene.views) {
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d pixel = view.camera.project(scene.bounds.corner(corner));
        EXPECT_GT(pixel.x(), kMargin) << view.name;
        EXPECT_GT(pixel.y(), kMargin) << view.name;
        EXPECT_LT(pixel.x(), view.width - 1 - kMargin) << view.name;
        EXPECT_LT(pixel.y(), view.height - 1 - kMargin) << view.name;
      }
    }
  }
}

TEST(TempleScene, PixelsOfAWiderImageDivideThoseOfANarrowOne) {
  TempleOptions options = small_options();
  const Camera narrow = make_temple_scene(options).views[1].camera;
  options.width *= 2;
  const Camera wide = make_temple_scene(options).views[1].camera;
  const Vector3d point(0.03, 0.1, 0.02);
  EXPECT_NEAR(wide.project(point).x() + 0.5, 2 * (narrow.project(point).x() + 0.5), 1e-9);
  EXPECT_NEAR(wide.project(point).y() + 0.5, 2 * (narrow.project(point).y() + 0.5), 1e-9);
}

TEST(TempleScene, EveryThirdViewIsUpsideDown) {
  for (const CameraPath path : kPaths) {
    TempleOptions options;
    options.path = path;
    const Scene scene = make_temple_scene(options);
    const Vector3d middle = scene.bounds.center();
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
      const Camera& camera = scene.views[i].camera;
      const double above = camera.project(middle + Vector3d(0, 0.02, 0)).y();
      EXPECT_EQ(above > camera.project(middle).y(), i % 3 == 2) << "view " << i;
    }
  }
}

TEST(TempleScene, PathsHaveTheirElevations) {
  TempleOptions options;
  options.views = 50;
  for (const CameraPath path : kPaths) {
    options.path = path;
    double lowest = 90;
    double highest = 0;
    for (const View& view : make_temple_scene(options).views) {
      const double elevation = std::asin(-view.camera.optical_axis().y()) * 180 / 3.14159265358979;
      lowest = std::min(lowest, elevation);
      highest = std::max(highest, elevation);
    }
    const bool ring = path == CameraPath::kRing;
    EXPECT_NEAR(lowest, ring ? 20 : 5, ring ? 1e-6 : 2);
    EXPECT_NEAR(highest, ring ? 20 : 75, ring ? 1e-6 : 2);
  }
  options.path = CameraPath::kRing;
  const Scene scene = make_temple_scene(options);
  for (std::size_t i = 1; i < scene.views.size(); ++i)
    EXPECT_NEAR((scene.views[i].camera.center() - scene.views[i - 1].camera.center()).norm(),
                (scene.views[1].camera.center() - scene.views[0].camera.center()).norm(), 1e-9);
}

TEST(RenderTemple, ThreadsDoNotChangeTheBytes) {
  const ColorImage one = render_with_threads(1, small_options());
  EXPECT_EQ(one, render_with_threads(2, small_options()));
  EXPECT_EQ(one, render_with_threads(2, small_options()));
}

TEST(RenderTemple, SeedNoiseAndTextureChangeTheBytes) {
  const ColorImage first = render_with_threads(2, small_options());
  TempleOptions options = small_options();
  options.seed = 2;
  EXPECT_NE(first, render_with_threads(2, options));
  options = small_options();
  options.noise = 0;
  EXPECT_NE(first, render_with_threads(2, options));
  options = small_options();
  options.texture = 0;
  EXPECT_NE(first, render_with_threads(2, options));
}

TEST(RenderTemple, SeedChangesStoneAndNoiseEach) {
  for (const bool noise_alone : {false, true}) {
    TempleOptions options = small_options();
    (noise_alone ? options.texture : options.noise) = 0;
    const ColorImage first = render_with_threads(2, options);
    options.seed = 2;
    EXPECT_NE(first, render_with_threads(2, options));
  }
}

TEST(RenderTemple, ViewsDoNotShareTheirNoise) {
  const TempleOptions options = small_options();
  Scene scene = make_temple_scene(options);
  scene.views[1].camera = scene.views[0].camera;
  EXPECT_NE(render_temple(scene, 0, options), render_temple(scene, 1, options));
}

TEST(RenderTemple, ObjectIsWellLitBeforeABlackBackground) {
  TempleOptions options = small_options();
  const Scene scene = make_temple_scene(options);
  for (const int view : {0, 2, 3}) {
    const ColorImage image = render_temple(scene, view, options);
    EXPECT_EQ(image.width, 160);
    EXPECT_EQ(image.height, 120);
    const Camera& camera = scene.views[static_cast<std::size_t>(view)].camera;
    int on_object = 0;
    int saturated = 0;
    double sum = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Rgba pixel = image.at(x, y);
        const Vector3d toward = camera.unproject(x, y, 1.0);
        EXPECT_EQ(pixel >> 24, 255U);
        if (seen_from(camera.center(), toward)) {
          ++on_object;
          sum += green_of(pixel);
          saturated += std::max(red_of(pixel), green_of(pixel)) == 255 ? 1 : 0;
        }
      }
    }
    EXPECT_LT(green_of(image.at(0, 0)), 12U);
    EXPECT_LT(green_of(image.at(159, 119)), 12U);
    EXPECT_GT(on_object, 1500);
    EXPECT_GT(sum / on_object, 80);
    EXPECT_LT(sum / on_object, 160);
    EXPECT_LT(saturated, on_object / 100);
  }
}

TEST(RenderTemple, NoiseHasItsStandardDeviation) {
  TempleOptions options = small_options();
  options.noise = 5;
  const ColorImage noisy = render_with_threads(2, options);
  options.noise = 0;
  const ColorImage clean = render_with_threads(2, options);
  double sum_of_squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < clean.values.size(); ++i) {
    if (green_of(clean.values[i]) < 40 || green_of(clean.values[i]) > 200) continue;
    const double difference =
        static_cast<double>(green_of(noisy.values[i])) - static_cast<double>(green_of(clean.values[i]));
    sum_of_squares += difference * difference;
    ++count;
  }
  ASSERT_GT(count, 1000);
  EXPECT_NEAR(std::sqrt(sum_of_squares / count), 5, 0.4);
}

TEST(RenderTemple, GlossAddsHighlightsAlone) {
  TempleOptions options = small_options();
  options.noise = 0;
  const ColorImage diffuse = render_with_threads(2, options);
  options.gloss = 0.6;
  const ColorImage glossy = render_with_threads(2, options);
  int brighter = 0;
  for (std::size_t i = 0; i < diffuse.values.size(); ++i) {
    EXPECT_GE(blue_of(glossy.values[i]), blue_of(diffuse.values[i]));
    brighter += blue_of(glossy.values[i]) > blue_of(diffuse.values[i]) + 10 ? 1 : 0;
  }
  EXPECT_GT(brighter, 50);
  EXPECT_LT(brighter, static_cast<int>(diffuse.values.size()) / 4);
}

TEST(RenderTemple, LightsPerViewDifferBetweenTwinCameras) {
  TempleOptions options = small_options();
  options.noise = 0;
  Scene scene = make_temple_scene(options);
  scene.views[1].camera = scene.views[0].camera;
  EXPECT_EQ(render_temple(scene, 0, options), render_temple(scene, 1, options));
  options.lighting = Lighting::kPerView;
  const ColorImage first = render_temple(scene, 0, options);
  const ColorImage second = render_temple(scene, 1, options);
  EXPECT_EQ(first, render_temple(scene, 0, options));
  int different = 0;
  for (std::size_t i = 0; i < first.values.size(); ++i)
    different +=
        std::abs(static_cast<int>(green_of(first.values[i])) - static_cast<int>(green_of(second.values[i]))) > 8;
  EXPECT_GT(different, 300);
}

TEST(RenderTemple, TextureSticksToTheSurface) {
  TempleOptions options;
  options.width = 320;
  options.noise = 0;
  const Scene scene = make_temple_scene(options);
  std::vector<ColorImage> images;
  for (int view = 0; view < 3; ++view) images.push_back(render_temple(scene, view, options));
  for (const std::size_t other : {0U, 2U}) {  // view 2 is upside down
    const Differences differences = compare_views(scene, images, 1, other);
    EXPECT_LT(differences.in_place, 4) << "view " << other;
    EXPECT_GT(differences.beside, 3 * differences.in_place) << "view " << other;
  }
}

}  // namespace
}  // namespace quorum
