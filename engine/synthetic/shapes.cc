#include "engine/synthetic/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quorum {

namespace {

/// The part of a ray that lies within all constraints so far. The normal of the entry is kept.
class Span {
 public:
  explicit Span(const Ray& ray) : ray_(ray) {}

  /// Keeps what lies below the plane normal · p = offset.
  void clip_to_plane(const Eigen::Vector3d& normal, double offset) {
    const double speed = normal.dot(ray_.direction);
    const double distance = offset - normal.dot(ray_.origin);
    if (speed < 0) {
      enter(distance / speed, normal);
    } else if (speed > 0) {
      leave(distance / speed);
    } else if (distance < 0) {
      clear();
    }
  }

  /// Keeps what lies between two planes across an axis.
  void clip_to_slab(int axis, double low, double high) {
    const double speed = ray_.direction[axis];
    const double to_low = low - ray_.origin[axis];
    const double to_high = high - ray_.origin[axis];
    if (speed > 0) {
      enter(to_low / speed, -Eigen::Vector3d::Unit(axis));
      leave(to_high / speed);
    } else if (speed < 0) {
      enter(to_high / speed, Eigen::Vector3d::Unit(axis));
      leave(to_low / speed);
    } else if (to_low > 0 || to_high < 0) {
      clear();
    }
  }

  /// Keeps what lies within the drum's cone, which is convex because the drum's slab has only one of its two halves.
  void clip_to_cone(const Drum& drum) {
    const double slope = drum.slope();
    const Eigen::Vector3d from_foot = ray_.origin - drum.foot;
    const double radius = drum.foot_radius + slope * from_foot.y();
    const double radius_speed = slope * ray_.direction.y();
    const double dx = ray_.direction.x();
    const double dz = ray_.direction.z();
    // Inside: a t² + 2 b t + c <= 0.
    const double a = dx * dx + dz * dz - radius_speed * radius_speed;
    const double b = dx * from_foot.x() + dz * from_foot.z() - radius_speed * radius;
    const double c = from_foot.x() * from_foot.x() + from_foot.z() * from_foot.z() - radius * radius;
    const double discriminant = b * b - a * c;
    if (a == 0) {
      if (b > 0) {
        leave(-c / (2 * b));
      } else if (b < 0) {
        enter_cone(-c / (2 * b), drum);
      } else if (c > 0) {
        clear();
      }
    } else if (discriminant <= 0) {
      if (a > 0) clear();
    } else {
      const double root = std::sqrt(discriminant);
      const double first = (-b - root) / a;
      const double second = (-b + root) / a;
      if (a > 0) {
        enter_cone(first, drum);
        leave(second);
      } else if (radius_speed > 0) {  // steeper than the cone: inside its half for good, from or up to one root
        enter_cone(first, drum);
      } else {
        leave(second);
      }
    }
  }

  [[nodiscard]] std::optional<Hit> entry() const {
    if (!(near_ > 0 && near_ < far_)) return std::nullopt;
    return Hit{near_, normal_};
  }

 private:
  void enter(double t, const Eigen::Vector3d& normal) {
    if (t <= near_) return;
    near_ = t;
    normal_ = normal;
  }
  void enter_cone(double t, const Drum& drum) {
    const Eigen::Vector3d from_foot = ray_.origin + t * ray_.direction - drum.foot;
    const double slope = drum.slope();
    const double radius = drum.foot_radius + slope * from_foot.y();
    const double scale = 1.0 / (radius * std::sqrt(1.0 + slope * slope));
    enter(t, {from_foot.x() * scale, -slope * radius * scale, from_foot.z() * scale});
  }
  void leave(double t) { far_ = t < far_ ? t : far_; }
  void clear() { far_ = -std::numeric_limits<double>::infinity(); }

  const Ray& ray_;
  double near_ = -std::numeric_limits<double>::infinity();
  double far_ = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
};

/// A point of the ridge.
Eigen::Vector3d ridge_of(const Gable& gable) { return {gable.bounds.center().x(), gable.bounds.high.y(), 0}; }

void clip(Span& span, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) span.clip_to_slab(axis, box.bounds.low[axis], box.bounds.high[axis]);
}

void clip(Span& span, const Drum& drum) {
  span.clip_to_slab(1, drum.foot.y(), drum.foot.y() + drum.height);
  span.clip_to_cone(drum);
}

void clip(Span& span, const Gable& gable) {
  span.clip_to_plane(-Eigen::Vector3d::UnitY(), -gable.bounds.low.y());
  span.clip_to_slab(2, gable.bounds.low.z(), gable.bounds.high.z());
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector3d normal = gable.slope_normal(side);
    span.clip_to_plane(normal, normal.dot(ridge_of(gable)));
  }
}

bool in_slab(double value, double low, double high, double tolerance) {
  return value >= low - tolerance && value <= high + tolerance;
}

bool inside(const Box& box, const Eigen::Vector3d& point, double tolerance) {
  for (int axis = 0; axis < 3; ++axis)
    if (!in_slab(point[axis], box.bounds.low[axis], box.bounds.high[axis], tolerance)) return false;
  return true;
}

bool inside(const Drum& drum, const Eigen::Vector3d& point, double tolerance) {
  const Eigen::Vector3d from_foot = point - drum.foot;
  const double radius = drum.foot_radius + drum.slope() * from_foot.y();
  return in_slab(from_foot.y(), 0, drum.height, tolerance) &&
         std::sqrt(from_foot.x() * from_foot.x() + from_foot.z() * from_foot.z()) <= radius + tolerance;
}

bool inside(const Gable& gable, const Eigen::Vector3d& point, double tolerance) {
  const Bounds& bounds = gable.bounds;
  if (point.y() < bounds.low.y() - tolerance) return false;
  if (!in_slab(point.z(), bounds.low.z(), bounds.high.z(), tolerance)) return false;
  for (const double side : {-1.0, 1.0})
    if (gable.slope_normal(side).dot(point - ridge_of(gable)) > tolerance) return false;
  return true;
}

}  // namespace

Eigen::Vector3d Gable::slope_normal(double side) const {
  const Eigen::Vector3d size = bounds.size();
  return Eigen::Vector3d(side * size.y(), size.x() / 2, 0).normalized();
}

Bounds bounds_of(const Solid& solid) {
  const auto* drum = std::get_if<Drum>(&solid);
  if (drum == nullptr) {
    const auto* box = std::get_if<Box>(&solid);
    return box != nullptr ? box->bounds : std::get<Gable>(solid).bounds;
  }
  const double radius = std::max(drum->foot_radius, drum->head_radius);
  return {drum->foot - Eigen::Vector3d(radius, 0, radius), drum->foot + Eigen::Vector3d(radius, drum->height, radius)};
}

std::optional<Hit> intersect(const Solid& solid, const Ray& ray) {
  Span span(ray);
  std::visit([&](const auto& shape) { clip(span, shape); }, solid);
  return span.entry();
}

bool contains(const Solid& solid, const Eigen::Vector3d& point, double tolerance) {
  return std::visit([&](const auto& shape) { return inside(shape, point, tolerance); }, solid);
}

}  // namespace quorum
