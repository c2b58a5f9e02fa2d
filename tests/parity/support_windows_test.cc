#include "engine/depth/support_windows.h"

#include "tests/parity/parity_test.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

class SupportWindowsParity : public ParityTest {
 protected:
  /// Of an image with every fourth pixel of any color, so that many supports need more than the tolerance.
  static void compare(int window, int tolerance, unsigned seed) {
    const int width = 67;
    const int height = 45;
    PaddedImage image = pad_image(make_sphere_scene(2, width, height, true, seed).images[0]);
    std::mt19937 random(seed);
    for (Rgba& pixel : image.pixels)
      if (random() % 4 == 0) pixel = static_cast<Rgba>(random()) | 0xff000000U;
    const Grid<SupportWindow> twin = make_support_windows(image, window, tolerance);
    const Buffer windows = buffer_of(std::vector<SupportWindow>(twin.values.size(), {{7, 7, 7}, 7.0F, 7, 7}));
    run(kernel("support_windows", {{"kWindow", static_cast<std::uint32_t>(window)},
                                   {"kShift", static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(window))}}),
        {width, height}, SupportWindowsParams{width, height, tolerance}, {buffer_of(image.pixels), windows});
    const std::string what = fmt::format("window {} tolerance {} seed {}", window, tolerance, seed);
    ASSERT_TRUE(same_words(content<SupportWindow>(windows), twin.values, width, what));
    const auto part = std::ranges::count_if(
        twin.values, [&](const SupportWindow& w) { return w.samples > 0 && w.samples < window * window; });
    if (tolerance < 255) expect_share(part, std::int64_t{width} * height, 0.1, 1.0, what + ", supports in part");
    const auto wide =
        std::ranges::count_if(twin.values, [&](const SupportWindow& w) { return w.max_difference > tolerance; });
    if (tolerance < 30) expect_share(wide, std::int64_t{width} * height, 0.05, 1.0, what + ", supports made larger");
  }
};

TEST_F(SupportWindowsParity, EveryWindowGivesTheBytesOfTheTwin) {
  unsigned seed = 1;
  for (const int window : {3, 5, 9, 15}) {
    for (const int tolerance : {0, 15, 60, 255}) compare(window, tolerance, seed++);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace quorum
