// The pixels that the windows of a work group have, in shared memory. Before it stand: kWindow, and pixels, a buffer
// that begins with an image whose rows have a pixel more than it is wide.
const int kSide = 8;  // of a work group, pixels
const int kRadius = kWindow / 2;
const int kTile = kSide + kWindow - 1;
shared uint tile[kTile * kTile];

// corner: the first pixel of the work group. Beyond the border pixels repeat: no window is asked for there.
void load_tile(ivec2 corner, int width, int height) {
  for (int i = int(gl_LocalInvocationIndex); i < kTile * kTile; i += kSide * kSide) {
    ivec2 at = clamp(corner - kRadius + ivec2(i % kTile, i / kTile), ivec2(0), ivec2(width, height) - 1);
    tile[i] = pixels[at.y * (width + 1) + at.x];
  }
  barrier();
}

// The place of the invocation's own pixel.
int own_place() {
  return (int(gl_LocalInvocationID.y) + kRadius) * kTile + int(gl_LocalInvocationID.x) + kRadius;
}

// Whether the window around a pixel lies in the image.
bool has_window(int x, int y, int width, int height) {
  return x >= kRadius && y >= kRadius && x < width - kRadius && y < height - kRadius;
}
