// Integer hashing: noise that depends only on a seed and a place, so any thread may compute any part of it.
// Source: the finalizer of SplitMix64, Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014.
#pragma once

#include <cstdint>

namespace quorum {

/// A well mixed word for each word; neighboring inputs give unrelated outputs.
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ x >> 27) * 0x94d049bb133111ebULL;
  return x ^ x >> 31;
}

/// Near-normal noise, mean 0, standard deviation 1, within -6 to 6: the sum of twelve 16-bit uniform numbers.
constexpr double gaussian_from_hash(std::uint64_t key) {
  constexpr double kScale = 65536.0;
  constexpr double kMeanOfSum = 12 * 65535.0 / 2;
  std::uint64_t sum = 0;
  for (int i = 0; i < 3; ++i) {
    key = mix(key);
    sum += (key & 0xffff) + (key >> 16 & 0xffff) + (key >> 32 & 0xffff) + (key >> 48);
  }
  return (static_cast<double>(sum) - kMeanOfSum) / kScale;
}

}  // namespace quorum
