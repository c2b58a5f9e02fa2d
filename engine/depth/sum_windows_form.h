// How windows are summed, and rows sampled, with vectors of 256 bits: sum_windows.cc includes this once for each set of
// instructions, with QUORUM_TARGET (what the compiler may use) and, in the same namespace, add_products. Vectors of 512
// bits were slower. In a lane of 128 bits lie, as TexelColumns has them side by side, the four texels of a sample in
// three channels:
//
//   bytes          multiplied in pairs by the fractions along y, and added: 8 words, those of the left and right texel
//   words          brought together in pairs, multiplied by the fractions along x, and added: red, green, blue, 24 bits
//   double words   shifted: the sample; two lanes' are packed into one
//   words          red, green, blue, 0 of two samples
//
// What interpolation sums is exact whatever the order, so this equals sample_bilinear.

#define QUORUM_FORM [[QUORUM_TARGET, gnu::always_inline]] inline

using Int32 [[gnu::vector_size(sizeof(__m256i))]] = std::int32_t;
using Int16 [[gnu::vector_size(sizeof(__m256i))]] = std::int16_t;
constexpr int kLanes = 8;

QUORUM_FORM Int32 load(const void* from) {
  Int32 value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}
QUORUM_FORM void store(void* to, Int32 value) { std::memcpy(to, &value, sizeof(value)); }
QUORUM_FORM __m256i bits(Int32 vector) { return reinterpret_cast<__m256i>(vector); }
QUORUM_FORM Int32 int32(__m256i vector) { return reinterpret_cast<Int32>(vector); }
QUORUM_FORM Int16 int16(__m256i vector) { return reinterpret_cast<Int16>(vector); }

/// In each lane of 128 bits the bytes with these numbers.
QUORUM_FORM Int32 shuffle_bytes(Int32 vector, int a, int b, int c, int d) {
  return int32(_mm256_shuffle_epi8(bits(vector), _mm256_setr_epi32(a, b, c, d, a, b, c, d)));
}
/// In each lane of 128 bits its j-th double word, four times.
template <int kIndex>
QUORUM_FORM Int32 spread(Int32 vector) {
  return int32(_mm256_shuffle_epi32(bits(vector), kIndex * 0x55));
}
/// In each lane of 128 bits the double words 0 and 2 of both, or 1 and 3.
QUORUM_FORM Int32 evens(Int32 a, Int32 b) {
  return reinterpret_cast<Int32>(_mm256_shuffle_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b), 0x88));
}
QUORUM_FORM Int32 odds(Int32 a, Int32 b) {
  return reinterpret_cast<Int32>(_mm256_shuffle_ps(reinterpret_cast<__m256>(a), reinterpret_cast<__m256>(b), 0xdd));
}

/// Sums of the windows of two samples in each lane of 128 bits.
struct Sums {
  Int32 red_blue, green, squares, products;  // double words: red and blue of a sample, green and 0, …
  Int16 words;                               // of b, not yet widened
};

/// Adds the words to the double words before they can overflow.
QUORUM_FORM void widen(Sums& sums) {
  const Int32 words = reinterpret_cast<Int32>(sums.words);
  sums.red_blue += (words << 16) >> 16;
  sums.green += words >> 16;
  sums.words = Int16{};
}

/// Fractions of positions in 1/256 pixel as factors: each a byte of the texel below and one of the texel, which is one
/// too small, in all bytes of a double word.
QUORUM_FORM Int32 factors_along_y(Int32 v) {
  return shuffle_bytes(v, 0x0000'0000, 0x0404'0404, 0x0808'0808, 0x0c0c'0c0c) ^ static_cast<std::int32_t>(0xff00'ff00);
}
/// The same as words, of the left and the right texel, and right.
QUORUM_FORM Int32 factors_along_x(Int32 u) {
  const Int32 fraction = u & 255;
  return (fraction << 16) - fraction + 256;
}

/// The texels of two samples.
QUORUM_FORM Int32 load_quads(const std::uint64_t* low, const std::uint64_t* high) {
  const __m128i first = _mm_loadu_si128(reinterpret_cast<const __m128i*>(low));
  const __m128i second = _mm_loadu_si128(reinterpret_cast<const __m128i*>(high));
  return int32(_mm256_inserti128_si256(_mm256_castsi128_si256(first), second, 1));
}

/// Two samples, whose texels begin at low and high, with the factors of the lanes kIndex and 4 + kIndex.
template <int kIndex, int kShift>
QUORUM_FORM Int32 interpolate(const std::uint64_t* low, const std::uint64_t* high, Int32 along_x, Int32 along_y) {
  const Int32 quads = load_quads(low, high);
  const Int16 columns =
      int16(_mm256_maddubs_epi16(bits(spread<kIndex>(along_y)), bits(quads))) + (int16(bits(quads)) >> 8);
  const Int32 pairs =
      shuffle_bytes(reinterpret_cast<Int32>(columns), 0x0908'0100, 0x0b0a'0302, 0x0d0c'0504, 0x0f0e'0706);
  return int32(_mm256_madd_epi16(bits(pairs), bits(spread<kIndex>(along_x)))) >> kShift;
}

QUORUM_FORM Int32 pack(Int32 a, Int32 b) { return int32(_mm256_packs_epi32(bits(a), bits(b))); }

QUORUM_FORM void add_samples(Int32 b, const void* reference, Sums& sums) {
  const Int32 a = load(reference);
  b &= shuffle_bytes(a, 0x0706'0706, 0x0706'0706, 0x0f0e'0f0e, 0x0f0e'0f0e);
  sums.words += reinterpret_cast<Int16>(b);
  sums.squares = int32(add_products(bits(sums.squares), bits(b), bits(b)));
  sums.products = int32(add_products(bits(sums.products), bits(a), bits(b)));
}

template <int kShift>
QUORUM_FORM void sum_group(const TexelColumns& neighbor, std::size_t first, WindowLanes& lanes) {
  constexpr int kRest = kPlacementBits - kPositionBits;
  constexpr int kMostWords = 16;  // samples of 12 bits whose sum fits 16
  const int window = lanes.window;
  const int radius = window / 2;
  const WindowLanes::Place* place = lanes.reference.data() + first / WindowLanes::kGroup * (window * window);
  const std::size_t begin = first % WindowLanes::kGroup;
  const Int32 u_x = load(&lanes.u_x[first]);
  const Int32 v_x = load(&lanes.v_x[first]);
  const Int32 u_y = load(&lanes.u_y[first]);
  const Int32 v_y = load(&lanes.v_y[first]);
  Int32 row_u = load(&lanes.u[first]) - radius * (u_x + u_y);
  Int32 row_v = load(&lanes.v[first]) - radius * (v_x + v_y);
  Sums low{};
  Sums high{};
  int words = 0;
  for (int row = 0; row < window; ++row) {
    Int32 u = row_u;
    Int32 v = row_v;
    for (int column = 0; column < window; ++column) {
      alignas(sizeof(__m256i)) std::int32_t texel[kLanes];
      store(texel, (v >> kPlacementBits) * neighbor.stride + (u >> kPlacementBits));
      asm("" : "+m"(texel));  // else the compiler takes lane after lane out of the vector, which costs more than loads
      const Int32 y = factors_along_y(v >> kRest);
      const Int32 x = factors_along_x(u >> kRest);
      const auto at = [&](int lane) { return neighbor.entries.data() + texel[lane]; };
      const Int32 b[4] = {interpolate<0, kShift>(at(0), at(4), x, y), interpolate<1, kShift>(at(1), at(5), x, y),
                          interpolate<2, kShift>(at(2), at(6), x, y), interpolate<3, kShift>(at(3), at(7), x, y)};
      add_samples(pack(b[0], b[1]), &place->samples[begin], low);
      add_samples(pack(b[2], b[3]), &place->samples[begin + kLanes / 2], high);
      ++place;
      u += u_x;
      v += v_x;
    }
    row_u += u_y;
    row_v += v_y;
    words += window;
    if (words + window <= kMostWords) continue;
    widen(low);
    widen(high);
    words = 0;
  }
  widen(low);
  widen(high);
  store(&lanes.b[0][first], evens(low.red_blue, high.red_blue));
  store(&lanes.b[1][first], evens(low.green, high.green));
  store(&lanes.b[2][first], odds(low.red_blue, high.red_blue));
  store(&lanes.bb[first], evens(low.squares, high.squares) + odds(low.squares, high.squares));
  store(&lanes.ab[first], evens(low.products, high.products) + odds(low.products, high.products));
}

template <int kShift>
QUORUM_FORM void sum_groups(const TexelColumns& neighbor, int count, WindowLanes& lanes) {
  for (std::size_t first = 0; first < static_cast<std::size_t>(count); first += kLanes)
    sum_group<kShift>(neighbor, first, lanes);
}

[[QUORUM_TARGET]] void sum(const TexelColumns& neighbor, int count, int shift, WindowLanes& lanes) {
  if (shift == kSampleShift)
    sum_groups<kSampleShift>(neighbor, count, lanes);
  else
    sum_groups<kSampleShift + 1>(neighbor, count, lanes);
}

/// Puts the double words 0, 1, 4, 5, 2, 3, 6, 7 in this order.
QUORUM_FORM Int32 reorder(Int32 vector) { return int32(_mm256_permute4x64_epi64(bits(vector), 0xd8)); }

/// Products of samples with samples, summed over the channels, in the order of the samples.
QUORUM_FORM Int32 multiply(const Int32 (&a)[2], const Int32 (&b)[2]) {
  const Int32 first = int32(_mm256_madd_epi16(bits(a[0]), bits(b[0])));
  const Int32 second = int32(_mm256_madd_epi16(bits(a[1]), bits(b[1])));
  return reorder(evens(first, second) + odds(first, second));
}

template <int kShift>
QUORUM_FORM void sample_groups(const TexelColumns& neighbor, const RowPositions& at, const std::uint64_t* reference,
                               int count, const RowSamples& row) {
  for (int i = 0; i < count; i += kLanes) {
    const Int32 x = factors_along_x(reorder(load(at.u + i)));
    const Int32 y = factors_along_y(reorder(load(at.v + i)));
    const auto texels = [&](int sample) { return neighbor.entries.data() + at.texel[i + sample]; };
    const Int32 b[2] = {
        pack(interpolate<0, kShift>(texels(0), texels(2), x, y), interpolate<1, kShift>(texels(1), texels(3), x, y)),
        pack(interpolate<2, kShift>(texels(4), texels(6), x, y), interpolate<3, kShift>(texels(5), texels(7), x, y))};
    const Int32 a[2] = {load(reference + i), load(reference + i + kLanes / 2)};
    const Int32 red_blue[2] = {(b[0] << 16) >> 16, (b[1] << 16) >> 16};
    store(row.red + i, reorder(evens(red_blue[0], red_blue[1])));
    store(row.green + i, reorder(evens(b[0] >> 16, b[1] >> 16)));
    store(row.blue + i, reorder(odds(red_blue[0], red_blue[1])));
    store(row.squares + i, multiply(b, b));
    store(row.products + i, multiply(a, b));
  }
}

[[QUORUM_TARGET]] void sample(const TexelColumns& neighbor, const RowPositions& at, const std::uint64_t* reference,
                              int count, int shift, const RowSamples& row) {
  if (shift == kSampleShift)
    sample_groups<kSampleShift>(neighbor, at, reference, count, row);
  else
    sample_groups<kSampleShift + 1>(neighbor, at, reference, count, row);
}

#undef QUORUM_FORM
