// Float operations that give the same bits on every device. Twin: engine/core/exact.h.
#ifndef QUORUM_EXACT_GLSL
#define QUORUM_EXACT_GLSL

// 1 / x. x: positive, normal, 1e-30 to 1e30.
float reciprocal(float x) {
  precise float y = uintBitsToFloat(0x7ef311c7u - floatBitsToUint(x));
  y = y * (2.0 - x * y);
  y = y * (2.0 - x * y);
  y = y * (2.0 - x * y);
  return y;
}

// 1 / sqrt(x). x: positive, normal, 1e-30 to 1e30.
float reciprocal_sqrt(float x) {
  precise float half_x = 0.5 * x;
  precise float y = uintBitsToFloat(0x5f3759dfu - (floatBitsToUint(x) >> 1));
  y = y * (1.5 - (half_x * y) * y);
  y = y * (1.5 - (half_x * y) * y);
  y = y * (1.5 - (half_x * y) * y);
  return y;
}

// A signed 64-bit integer in two words, for sums of products that 32 bits don't hold.
struct Int64 {
  int high;
  uint low;
};

Int64 multiply(int a, int b) {
  int high, low;
  imulExtended(a, b, high, low);
  return Int64(high, uint(low));
}

Int64 subtract(Int64 a, Int64 b) {
  uint borrow;
  uint low = usubBorrow(a.low, b.low, borrow);
  return Int64(a.high - b.high - int(borrow), low);
}

// The 24 leading bits of an integer, toward zero, as float.
float float_from_integer(Int64 value) {
  bool negative = value.high < 0;
  uint high = uint(value.high);
  uint low = value.low;
  if (negative) {
    low = ~low + 1u;
    high = ~high + (low == 0u ? 1u : 0u);
  }
  int bits = high != 0u ? 33 + findMSB(high) : 1 + findMSB(low);
  int shift = max(bits - 24, 0);
  uint leading = shift == 0 ? low : shift < 32 ? (low >> shift) | (high << (32 - shift)) : high >> (shift - 32);
  precise float magnitude = float(leading & 0xffffffu) * uintBitsToFloat(uint(127 + shift) << 23);
  return negative ? -magnitude : magnitude;
}

#endif
