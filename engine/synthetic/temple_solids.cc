#include "engine/synthetic/temple_solids.h"

#include <utility>
#include <vector>

namespace quorum {

namespace {

/// Collects solids; all lengths in millimeters, so that the plan below reads like one.
class Builder {
 public:
  void box(double x0, double x1, double y0, double y1, double z0, double z1) {
    solids_.emplace_back(Box{{Eigen::Vector3d(x0, y0, z0) * kMeter, Eigen::Vector3d(x1, y1, z1) * kMeter}});
  }
  void drum(double x, double z, double y0, double y1, double foot_radius, double head_radius) {
    solids_.emplace_back(
        Drum{Eigen::Vector3d(x, y0, z) * kMeter, (y1 - y0) * kMeter, foot_radius * kMeter, head_radius * kMeter});
  }
  void gable(double x0, double x1, double y0, double y1, double z0, double z1) {
    solids_.emplace_back(Gable{{Eigen::Vector3d(x0, y0, z0) * kMeter, Eigen::Vector3d(x1, y1, z1) * kMeter}});
  }
  void plinth(double x, double z) { box(x - 6.5, x + 6.5, kFloor, kPlinthTop, z - 6.5, z + 6.5); }
  void column(double x, double z) {
    plinth(x, z);
    drum(x, z, kPlinthTop, 111, 5.7, 4.7);
    drum(x, z, 111, 114, 4.7, 6.3);
    box(x - 6.5, x + 6.5, 114, kWallTop, z - 6.5, z + 6.5);
  }

  static constexpr double kFloor = 21;
  static constexpr double kPlinthTop = 23.5;
  static constexpr double kWallTop = 117.5;

  std::vector<Solid> take() { return std::move(solids_); }

 private:
  static constexpr double kMeter = 1e-3;
  std::vector<Solid> solids_;
};

void build_steps(Builder& b) {
  b.box(-50, 50, 0, 7, -37.5, 37.5);
  b.box(-46, 46, 7, 14, -33.5, 33.5);
  b.box(-42, 42, 14, Builder::kFloor, -29.5, 29.5);
}

void build_columns(Builder& b) {
  for (const double x : {-33.0, -11.0, 33.0}) b.column(x, 22);
  for (const double x : {-33.0, 33.0}) b.column(x, 3);
  b.plinth(11, 22);
  b.drum(11, 22, Builder::kPlinthTop, 44, 5.7, 5.4);
  b.drum(11.4, 22.2, 44, 58, 4.9, 4.7);  // the broken column: its second drum has slipped, the rest is gone
  b.box(4.5, 17.5, 114, Builder::kWallTop, 15.5, 28.5);
}

void build_cella(Builder& b) {
  b.box(-35, 35, Builder::kFloor, Builder::kWallTop, -27, -8);
  for (const double x : {-30.0, 0.0, 30.0}) b.box(x - 3, x + 3, Builder::kFloor, Builder::kWallTop, -28.5, -27);
  b.box(-36.5, -35, Builder::kFloor, Builder::kWallTop, -21, -14);
  b.box(-11, -8, Builder::kFloor, 75, -8, -6);  // door frame
  b.box(8, 11, Builder::kFloor, 75, -8, -6);
  b.box(-13, 13, 75, 79, -8, -6);
  b.box(35, 41.5, Builder::kFloor, 52, -24, -13);  // buttress in two stages
  b.box(35, 38.5, 52, 70, -24, -13);
  b.box(-25, -19.5, Builder::kFloor, 33, 19, 26);  // altar
}

void build_entablature(Builder& b) {
  b.box(-39.5, 39.5, Builder::kWallTop, 123.5, -28.5, 28.5);
  b.box(-38.5, 38.5, 123.5, 130, -27.5, 27.5);
  for (int i = -3; i <= 3; ++i) b.box(11.0 * i - 2, 11.0 * i + 2, 123.5, 130, 27.5, 28.5);  // triglyphs
  for (int i = -2; i <= 2; ++i) b.box(-39.5, -38.5, 123.5, 130, 11.0 * i - 2, 11.0 * i + 2);
  b.box(-43, 43, 130, 133.5, -32, 32);
}

std::vector<Solid> build_temple() {
  Builder b;
  build_steps(b);
  build_columns(b);
  build_cella(b);
  build_entablature(b);
  b.gable(-45.5, 45.5, 133.5, 160, -34.5, 34.5);
  return b.take();
}

}  // namespace

std::span<const Solid> temple_solids() {
  static const std::vector<Solid> kSolids = build_temple();
  return kSolids;
}

Bounds temple_bounds() {
  Bounds all = bounds_of(temple_solids().front());
  for (const Solid& solid : temple_solids()) {
    const Bounds bounds = bounds_of(solid);
    all.low = all.low.cwiseMin(bounds.low);
    all.high = all.high.cwiseMax(bounds.high);
  }
  return all;
}

}  // namespace quorum
