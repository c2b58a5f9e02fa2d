// Structs and constants that kernels (GLSL) and engine (C++) both read. Four-byte scalars and arrays of them alone, so
// that both languages lay them out alike; matrices row by row; every struct with its size asserted.
#ifndef QUORUM_SHADERS_LAYOUT_H
#define QUORUM_SHADERS_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
#define QUORUM_SIZE(type, bytes) static_assert(sizeof(type) == (bytes))
namespace quorum {
using uint = std::uint32_t;
#else
#define QUORUM_SIZE(type, bytes)
#endif

// Image samples. A position is rounded to 1/256 pixel; a sample keeps 12 of the 24 bits that interpolation gives and is
// centered, so that sums of products of 13x13 windows in three channels fit int: 3 * 169 * 2048^2 < 2^31.
// Larger windows drop one more bit.
const int kPositionScale = 256;
const int kPositionBits = 8;
const int kSampleShift = 12;
const int kLargestFullPrecisionWindow = 13;

// Where a window on a tilted plane lands in a neighbor: its center and its steps, in 1/4096 pixel.
const int kPlacementScale = 4096;
const int kPlacementBits = 12;
const int kMaxStretch = 8;  // pixels of the neighbor to one of the reference; beyond that it does not see the window

// A neighbor that would see a point at less than this share of the reference depth does not see it.
const float kMinDepthRatio = 0.0009765625f;  // 1/1024

// The sweep takes blocks of pixels as a whole, whose sides divide this; their width is a multiple of 4.
const int kBlockMultiple = 16;

// Voxels.
const int kBlockSide = 8;              // voxels along an edge of a block
const int kBlockVoxels = 512;          // kBlockSide^3
const int kDistanceScale = 2048;       // signed distance is kept in 1/2048 of the truncation
const int kWeightScale = 255;          // weight 1 = a vertex of full confidence
const int kWeightBits = 8;             // of a vertex's word; above them its cosine
const int kCosineScale = 65535;        // cosine 1
const int kMaxIntegratedViews = 4096;  // 2048 * 255 * 4096 < 2^31: the sums of a voxel can't overflow
const float kBehindShare = 0.5f;  // of the truncation: how far behind a surface voxels take it (what lies further in
                                  // belongs to other surfaces: docs/measurements/fusion_defaults.md)
const int kVoxelWords = 5;        // of one voxel: weight, weighted distance, weighted red, green, blue

// Bits of a cell of the range surface. A cell has the pixels 0 = (x, y), 1 = (x+1, y), 2 = (x, y+1), 3 = (x+1, y+1) and
// up to two triangles: split along 1-2 they are 0-1-2 and 3-2-1, split along 0-3 they are 1-3-0 and 2-0-3.
const uint kCellFirstTriangle = 1u;   // 0-1-2, or 1-3-0
const uint kCellSecondTriangle = 2u;  // 3-2-1, or 2-0-3
const uint kCellSplitAlong03 = 4u;

// How far another view's depth may lie from a point that it confirms, in footprints of one of its pixels there: close
// agreement counts twice. Where it lies further behind than kLooksThrough, the view looks through the point.
const float kCloseAgreement = 0.5f;
const float kAgreement = 1.0f;
const float kLooksThrough = 2.0f;
// What each of these adds to a depth's support.
const int kSupportOfAgreement = 2;
const int kSupportOfLookingThrough = -1;
// So much that no agreement outweighs it: the depth denies a surer one of the other view.
const int kSupportOfDenial = -1000;

// What confirm_depths does beside adding, as bits.
const uint kFirstOfViews = 1u;  // sums start anew
const uint kFindsDenials = 2u;  // certainties are known, from the round before

// Factors of a vertex's weight, as bits.
const uint kWeighConfidence = 1u;
const uint kWeighSlant = 2u;
const uint kWeighBorder = 4u;
const uint kDistanceAlongNormal = 8u;  // not a factor: the cosine beside the weight is that of the surface, not 1

// Where the pixels of a view land in a neighbor on the plane at inverse depth w:
// (x', y', 1) ~ rotation * (x, y, 1) + offset * w.
struct PlaneWarp {
  float rotation[9];  // K' R' R^-1 K^-1
  float offset[3];    // K' (t' - R' R^-1 t), pixels * scene units
};
QUORUM_SIZE(PlaneWarp, 48);

// Planes of one reference pixel, both ends included; none if first > last.
struct PlaneRange {
  uint first;
  uint last;
};
QUORUM_SIZE(PlaneRange, 8);

// What the sweep knows of one reference pixel. plane: index of the best plane so far, -1 = none.
struct PixelVote {
  float correlation;
  float confidence;
  int plane;
};
QUORUM_SIZE(PixelVote, 12);

// The plane of one reference pixel (x, y), linear in inverse depth: the point (x + dx, y + dy) of the plane lies at
// inverse_depth + slope_x * dx + slope_y * dy. inverse_depth 0 = none, and then all is 0.
struct PixelPlane {
  float inverse_depth;  // 1 / scene units
  float slope_x;        // 1 / scene units, per pixel
  float slope_y;
  float correlation;
  float confidence;
  int taken_by;  // number of the move of its round that it was taken by; 0 = not in this round
};
QUORUM_SIZE(PixelPlane, 24);

// A plane that is tried at a pixel, and the votes so far. inverse_depth 0 = none, or it can't win any more.
struct PlaneTrial {
  float inverse_depth;
  float slope_x;
  float slope_y;
  float ncc_sum;
  int votes;
};
QUORUM_SIZE(PlaneTrial, 20);

// A plane beyond the bounds that faces the camera. inverse_depth 0 = none.
struct OutsidePlane {
  float inverse_depth;  // 1 / scene units
  float correlation;    // of the small images
};
QUORUM_SIZE(OutsidePlane, 8);

// Where the planes of one reference pixel may cross its ray, 1 / scene units; none if farthest > nearest.
struct InverseDepthRange {
  float farthest;
  float nearest;
};
QUORUM_SIZE(InverseDepthRange, 8);

// How a plane to try comes about: that of the pixel at the offset in the last round, extrapolated, or with offset (0,
// 0) the pixel's best one so far, with a step. Moves of a round have the numbers 1, 2, …
struct PlaneMove {
  int offset_x;
  int offset_y;
  float inverse_depth;  // the step
  float slope_x;
  float slope_y;
  float near_depth;  // a plane of another pixel that differs by less from the pixel's own is not tried
  float near_slope;
  int undoes;  // number of the move that this one would take back; 0 = none
};
QUORUM_SIZE(PlaneMove, 32);

// A block of the reference view that is swept on one plane, all its windows together. x, y: its first pixel, a
// multiple of the block's size, which the kernel knows.
struct SweepItem {
  int x;
  int y;
  int plane;
  float inverse_depth;  // of the plane
};
QUORUM_SIZE(SweepItem, 16);

// A block with its items of a batch, which stand together in the order of their planes.
struct SweepBlock {
  int x;
  int y;
  int item_begin;
  int item_count;
};
QUORUM_SIZE(SweepBlock, 16);

// What NCC needs of a window of the reference view. inverse_deviation: 1 / sqrt(n^2 variance).
struct ReferenceWindow {
  int sum[3];  // of the samples of each channel
  float inverse_deviation;
};
QUORUM_SIZE(ReferenceWindow, 16);

// The part of a window of the reference view that looks like its center, and what NCC needs of it.
struct SupportWindow {
  int sum[3];               // of the samples of each channel
  float inverse_deviation;  // 1 / sqrt(n^2 variance)
  int samples;              // n
  int max_difference;       // of the part's pixels from the center, largest of the channels, 0..255
};
QUORUM_SIZE(SupportWindow, 24);

// refine_planes_lanes reads these as texels of four words: what a pixel needs beside its plane,
struct PlanePixel {
  SupportWindow support;
  InverseDepthRange range;
};
QUORUM_SIZE(PlanePixel, 32);

// its plane of the last round, a PixelPlane without its correlation,
struct PlaneTexel {
  float inverse_depth;
  float slope_x;
  float slope_y;
  float confidence;  // below 0 if the plane was taken in the last round
};
QUORUM_SIZE(PlaneTexel, 16);

// and a neighbor, as refine_planes does. Moves are two texels, too.
struct PlaneNeighbor {
  PlaneWarp warp;
  int width;        // pixels
  int height;       // pixels
  int first_texel;  // its place in all images, the reference first; of a quad of texels for the lanes
  int unused;
};
QUORUM_SIZE(PlaneNeighbor, 64);

// sweep_depth and sweep_depth_lanes: NCC of all windows of a batch of items against one neighbor.
struct SweepParams {
  PlaneWarp warp;
  int width;             // reference view, pixels
  int height;            // reference view, pixels
  int neighbor_width;    // pixels
  int neighbor_height;   // pixels
  int reference_stride;  // sweep_depth_lanes: texels of four pixels in a row of the reference
  int window_stride;     // reference windows in a row
  int item_count;        // of this batch
  int ncc_offset;        // where this neighbor's values start in the ncc buffer, in fours
};
QUORUM_SIZE(SweepParams, 80);

// vote_depth: from the NCC values of a batch to the best plane of each pixel so far.
struct VoteParams {
  int width;
  int height;
  int block_width;   // pixels
  int block_height;  // pixels
  int block_count;   // of this batch
  int item_count;    // of this batch
  int neighbor_count;
  int min_votes;
  float threshold;
  float confidence_scale;  // 1 / (neighbor count * (1 - threshold))
};
QUORUM_SIZE(VoteParams, 40);

// reference_windows: what NCC needs of the windows of a view.
struct ReferenceWindowsParams {
  int width;    // pixels
  int height;   // pixels
  int columns;  // of the windows, in whole blocks of the sweep
  int rows;
};
QUORUM_SIZE(ReferenceWindowsParams, 16);

// support_windows: the part of each that looks like its center.
struct SupportWindowsParams {
  int width;      // pixels
  int height;     // pixels
  int tolerance;  // by which a pixel may differ from the center, 0..255
};
QUORUM_SIZE(SupportWindowsParams, 12);

// first_planes: what the pixels begin with.
struct FirstPlanesParams {
  int width;             // pixels
  int height;            // pixels
  int outside_width;     // of the small image whose pixels have planes beyond the bounds; 0 = none
  int outside_height;    // pixels
  int outside_halvings;  // from the image to the small one
  float limit;           // how far the depths that a plane is fitted to may lie apart, 1 / scene units
};
QUORUM_SIZE(FirstPlanesParams, 24);

// refine_planes: moves of a round, in a run of rows.
struct RefinePlanesParams {
  int width;       // reference view, pixels
  int height;      // reference view, pixels
  int row_begin;   // the run
  int row_end;     // one beyond it
  int move_begin;  // of the round; 0 begins with the planes of the last one
  int move_end;    // one beyond the last
  int neighbor_count;
  int is_first;  // 1: the planes of the last round are those to begin with, and no pixel has one yet
  int min_votes;
  float max_tilt;  // largest slope, as a share of the inverse depth
  float threshold;
  float confidence_scale;  // 1 / (neighbor count * (1 - threshold))
};
QUORUM_SIZE(RefinePlanesParams, 48);

// refine_planes_lanes: a round of moves in a run of rows.
struct RefinePlanesLanesParams {
  int width;          // reference view, pixels
  int height;         // reference view, pixels
  int row_begin;      // the run
  int row_end;        // one beyond it
  int rows_per_lane;  // that an invocation takes
  int first_pixel;    // of the bound parts of what is written
  int move_count;
  int neighbor_count;
  int is_first;  // as in RefinePlanesParams, as what follows
  int min_votes;
  float max_tilt;
  float threshold;
  float confidence_scale;  // 1 / (neighbor count * (1 - threshold))
};
QUORUM_SIZE(RefinePlanesLanesParams, 52);

// confirm_depths: what one other view's depth map says of the depths of a view.
struct ConfirmDepthsParams {
  PlaneWarp warp;  // to the other view
  PlaneWarp back;  // and from it
  int width;
  int height;
  int other_width;        // pixels
  int other_height;       // pixels
  float other_max_step;   // as in RangeSurfaceParams
  float footprint;        // of one of the view's pixels, as a share of the depth there
  float other_footprint;  // of one of the other view's
  uint steps;             // bits kFirstOfViews, kFindsDenials
};
QUORUM_SIZE(ConfirmDepthsParams, 128);

// A normal in a word: x, y and z in kNormalBits each, from the lowest on, as kNormalScale * value + kNormalZero. The
// word 0 is no normal.
const int kNormalBits = 10;
const int kNormalScale = 511;
const int kNormalZero = 512;

// range_surface: the triangles of one depth map.
struct RangeSurfaceParams {
  int width;
  int height;
  float max_step;    // largest depth difference between pixels one apart, as a share of the nearer depth
  float plane_step;  // the same, from which on planes are asked
  float agreement;  // distance from the other's plane, between pixels one apart, as a share of the nearer depth; 0: any
  float inverse_focal_x;  // pixels
  float inverse_focal_y;
  float principal_x;
  float principal_y;
};
QUORUM_SIZE(RangeSurfaceParams, 36);

// weigh_surface: the weights of its vertices, and in the upper bits the cosines of the distances along their normals.
struct WeighSurfaceParams {
  int width;
  int height;
  float focal_x;  // pixels
  float focal_y;  // pixels
  float principal_x;
  float principal_y;
  float max_step;  // as in RangeSurfaceParams
  int feather;     // pixels over which the weight rises from a border of the surface
  uint factors;    // kWeigh… bits
};
QUORUM_SIZE(WeighSurfaceParams, 36);

// collect_blocks: which voxel blocks lie within the truncation of a range surface. Points are in blocks of the grid.
struct CollectParams {
  float ray_from_pixel[9];  // direction of the ray of (x, y, 1) that reaches depth 1
  float origin[3];          // the camera's center
  int blocks[3];            // size of the grid
  int width;
  int height;
  float depth_step;  // between points along a ray, scene units
  int steps;         // points on each side of the surface
  float margin;      // around each point, blocks
};
QUORUM_SIZE(CollectParams, 80);

// integrate, carve_blocks: one range surface against the voxels of the listed blocks.
struct IntegrateParams {
  float projection[12];   // (x z, y z, z) of a voxel's center, pixels and depth, from its coordinates in the grid
  float inverse_focal_x;  // 1 / pixels
  float inverse_focal_y;
  float principal_x;  // pixels
  float principal_y;
  float inverse_truncation;  // 1 / scene units
  int width;
  int height;
  int list_begin;  // first entry of the block list for this dispatch
  int blocks[2];   // size of the grid along x and y
  int pool_begin;  // number of the first block in the bound part of the pool, or of the grid
};
QUORUM_SIZE(IntegrateParams, 92);

#ifdef __cplusplus
}  // namespace quorum
#endif
#endif
