#include "engine/depth/sum_windows.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "engine/depth/ncc_from_sums.h"
#include "engine/depth/place_window.h"

namespace quorum {
namespace {

constexpr int kSide = 40;

/// A photograph whose texels are black or white, where sums are largest.
PaddedImage make_checkered(std::mt19937& random) {
  ColorImage image(kSide, kSide);
  for (Rgba& texel : image.values)
    texel = random() % 2 == 0 ? 0U : make_rgb(255, random() % 2 * 255, random() % 2 * 255);
  return pad_image(image);
}

/// Windows anywhere in the image, the last ones up to its last row and column, with random supports.
void place_randomly(std::mt19937& random, int count, const WindowSumForm& form, std::vector<std::uint64_t>& reference,
                    WindowLanes& lanes) {
  const int radius = lanes.window / 2;
  constexpr int kEnd = (kSide - 1) * kPlacementScale;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const auto step = [&](int largest) { return static_cast<int>(random() % (2 * largest + 1U)) - largest; };
    constexpr int kHalfPixel = kPlacementScale / 2;
    lanes.u_x[i] = step(kHalfPixel), lanes.u_y[i] = step(kHalfPixel);
    lanes.v_x[i] = step(kHalfPixel), lanes.v_y[i] = step(kHalfPixel);
    const auto center = [&](int along_x, int along_y) {
      const int reach = radius * (std::abs(along_x) + std::abs(along_y));
      return random() % 5 == 0 ? kEnd - reach : reach + static_cast<int>(random() % (kEnd - 2 * reach + 1U));
    };
    lanes.u[i] = center(lanes.u_x[i], lanes.u_y[i]);
    lanes.v[i] = center(lanes.v_x[i], lanes.v_y[i]);
  }
  const auto places = static_cast<std::size_t>(lanes.window * lanes.window);
  reference.resize(WindowLanes::kCapacity * places);
  for (std::uint64_t& sample : reference) {
    const Rgba texel = random() % 2 == 0 ? 0U : make_rgb(255, 255, random() % 256);
    const Sample a = sample_pixel(texel, kSampleShift + extra_sample_shift(lanes.window));
    const auto word = [](int value, int place) {
      return std::uint64_t{static_cast<std::uint16_t>(value)} << (16 * place);
    };
    sample = random() % 4 == 0 ? 0 : word(a.red, 0) | word(a.green, 1) | word(a.blue, 2) | word(-1, 3);
  }
  lanes.reference.resize(WindowLanes::kCapacity / WindowLanes::kGroup * places);
  for (std::size_t i = 0; i < lanes.reference.size(); ++i)
    for (std::size_t k = 0; k < WindowLanes::kGroup; ++k) {
      const std::size_t lane = i / places * WindowLanes::kGroup + form.order[k];
      lanes.reference[i].samples[k] = reference[lane * places + i % places];
    }
}

/// The sums of a window, one sample after the other.
WindowSums sum_one(const PaddedImage& image, const std::uint64_t* reference, const WindowLanes& lanes, std::size_t i) {
  WindowSums sums;
  const int radius = lanes.window / 2;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const std::uint64_t a = *reference++;
      if (a == 0) continue;
      const auto word = [a](int place) { return static_cast<std::int16_t>(a >> (16 * place)); };
      add_sample(sums, {word(0), word(1), word(2)},
                 sample_bilinear(image, place_sample(lanes.u[i], lanes.u_x[i], lanes.u_y[i], dx, dy),
                                 place_sample(lanes.v[i], lanes.v_x[i], lanes.v_y[i], dx, dy),
                                 extra_sample_shift(lanes.window)));
    }
  }
  return sums;
}

TEST(SumWindows, EveryFormGivesTheSumsOfSingleSamples) {
  for (const int window : {3, 5, 7, 9, 11, 13, 15}) {
    for (const SimdLevel simd : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
      if (simd > best_simd_level()) continue;
      std::mt19937 random(static_cast<unsigned>(window));
      const PaddedImage image = make_checkered(random);
      const WindowSumForm form = window_sum_form(simd);
      const auto lanes = std::make_unique<WindowLanes>();
      lanes->window = window;
      std::vector<std::uint64_t> reference;
      constexpr int kCount = 77;  // some lanes of the last group have no window
      place_randomly(random, kCount, form, reference, *lanes);
      form.sum(make_texel_columns(image), kCount, kSampleShift + extra_sample_shift(window), *lanes);
      std::int32_t largest = 0;
      for (std::size_t i = 0; i < kCount; ++i) {
        const WindowSums expected =
            sum_one(image, &reference[i * static_cast<std::size_t>(window * window)], *lanes, i);
        for (std::size_t channel = 0; channel < 3; ++channel)
          ASSERT_EQ(lanes->b[channel][i], expected.b[channel]) << "window " << window << " lane " << i;
        ASSERT_EQ(lanes->bb[i], expected.bb) << "window " << window << " lane " << i;
        ASSERT_EQ(lanes->ab[i], expected.ab) << "window " << window << " lane " << i;
        largest = std::max(largest, expected.bb);
      }
      EXPECT_GT(largest, window * window << (21 - 2 * extra_sample_shift(window))) << "inputs are trivial";
    }
  }
}

TEST(RowSampler, EveryFormGivesSingleSamples) {
  constexpr std::size_t kCount = 24;
  for (const int shift : {kSampleShift, kSampleShift + 1}) {
    for (const SimdLevel simd : {SimdLevel::kAvx2, SimdLevel::kAvx512}) {
      if (simd > best_simd_level()) continue;
      std::mt19937 random(5);
      const PaddedImage image = make_checkered(random);
      std::array<std::int32_t, kCount> u, v, texel, red, green, blue, squares, products;
      std::array<std::uint64_t, kCount> reference;
      std::array<Sample, kCount> a;
      for (std::size_t i = 0; i < kCount; ++i) {
        constexpr unsigned kEnd = (kSide - 1) * kPositionScale;
        u[i] = static_cast<int>(i == 0 ? kEnd : random() % (kEnd + 1));
        v[i] = static_cast<int>(i < 2 ? kEnd : random() % (kEnd + 1));
        texel[i] = texel_index(u[i], v[i], image.stride());
        a[i] = sample_pixel(make_rgb(random() % 256, random() % 2 * 255, 0), shift);
        const auto word = [](int value) { return std::uint64_t{static_cast<std::uint16_t>(value)}; };
        reference[i] = word(a[i].red) | word(a[i].green) << 16 | word(a[i].blue) << 32;
      }
      row_sampler(simd)(make_texel_columns(image), {u.data(), v.data(), texel.data()}, reference.data(), kCount, shift,
                        {red.data(), green.data(), blue.data(), squares.data(), products.data()});
      for (std::size_t i = 0; i < kCount; ++i) {
        const Sample b = sample_bilinear(image, u[i], v[i], shift - kSampleShift);
        ASSERT_EQ(red[i], b.red) << i;
        ASSERT_EQ(green[i], b.green) << i;
        ASSERT_EQ(blue[i], b.blue) << i;
        ASSERT_EQ(squares[i], product(b, b)) << i;
        ASSERT_EQ(products[i], product(a[i], b)) << i;
      }
    }
  }
}

}  // namespace
}  // namespace quorum
