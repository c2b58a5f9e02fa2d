#include "engine/depth/reference_windows.h"

#include "host/sweep_texels.h"
#include "tests/parity/parity_test.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

class ReferenceWindowsParity : public ParityTest {
 protected:
  static void compare(int window, int width, int height, unsigned seed) {
    const PaddedImage image = pad_image(make_sphere_scene(2, width, height, true, seed).images[0]);
    const Grid<ReferenceWindow> twin = in_whole_blocks(make_reference_windows(image, window));
    const Buffer windows = buffer_of(std::vector<ReferenceWindow>(twin.values.size(), {{7, 7, 7}, 7.0F}));
    run(kernel("reference_windows",
               {{"kWindow", static_cast<std::uint32_t>(window)},
                {"kShift", static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(window))}}),
        {twin.width, twin.height}, ReferenceWindowsParams{width, height, twin.width, twin.height},
        {buffer_of(image.pixels), windows});
    ASSERT_TRUE(same_words(content<ReferenceWindow>(windows), twin.values, twin.width,
                           fmt::format("window {} {}x{} seed {}", window, width, height, seed)));
    const auto known = std::ranges::count_if(twin.values, [](const ReferenceWindow& w) { return w.sum[0] != 0; });
    expect_share(known, std::int64_t{width} * height, 0.3, 1.0, "windows in the image");
  }
};

TEST_F(ReferenceWindowsParity, EveryWindowGivesTheBytesOfTheTwin) {
  unsigned seed = 1;
  for (const int window : {3, 5, 9, 15}) {
    compare(window, 67, 45, seed++);
    compare(window, 64, 48, seed++);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace quorum
