#include "tools/python/scene_arrays.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>

namespace quorum_python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::string text_of_shape(const py::array& array) { return py::str(array.attr("shape")); }

/// An argument and a place in it: images[2].
std::string place_of(const char* name, std::size_t index) {
  return std::string(name) + "[" + std::to_string(index) + "]";
}

/// Numbers of each view or point: an array of count rows of a shape, or of one row that all share.
class Rows {
 public:
  Rows(const py::handle& given, const char* name, std::size_t count, std::vector<py::ssize_t> shape, bool may_share) {
    values_ = Numbers::ensure(given);
    if (!values_) refuse(std::string(name) + ": is no array of numbers");
    for (const py::ssize_t length : shape) size_ *= static_cast<std::size_t>(length);
    std::vector<py::ssize_t> found(values_.shape(), values_.shape() + values_.ndim());
    if (may_share && found == shape) return;
    stride_ = size_;
    std::vector<py::ssize_t> column = shape;  // translations as columns of matrices
    column.push_back(1);
    for (std::vector<py::ssize_t>* wanted : {&shape, &column}) {
      wanted->insert(wanted->begin(), static_cast<py::ssize_t>(count));
      if (found == *wanted) return;
    }
    refuse(std::string(name) + ": has shape " + text_of_shape(values_) + "; give " +
           std::string(py::str(py::cast(shape))));
  }

  template <typename Values>
  void copy(std::size_t row, Values& to) const {
    std::copy_n(values_.data() + row * stride_, size_, to.begin());
  }

 private:
  Numbers values_;
  std::size_t size_ = 1;
  std::size_t stride_ = 0;  ///< 0: all share one row
};

/// The pixels of an array, which kept holds on to: the caller's own, or a copy if those of a row do not lie together.
quorum::PixelArray pixels_of(const py::handle& given, const std::string& place, std::vector<py::array>& kept) {
  py::array array = py::array::ensure(given);
  if (!array) refuse(place + ": is no array");
  if (array.dtype().kind() == 'b') array = array.attr("view")("uint8");
  if (array.dtype().kind() != 'u' || array.itemsize() != 1)
    refuse(place + ": holds " + std::string(py::str(array.dtype())) + "; give uint8, 0 to 255");
  constexpr py::ssize_t kMost = std::numeric_limits<int>::max();
  if (array.ndim() < 2 || array.ndim() > 3 || array.shape(0) > kMost || array.shape(1) > kMost)
    refuse(place + ": has shape " + text_of_shape(array) + "; give (height, width) or (height, width, 3)");
  const py::ssize_t channels = array.ndim() == 3 ? array.shape(2) : 1;
  if (channels != 1 && channels != 3)
    refuse(place + ": has shape " + text_of_shape(array) + "; give one channel or three");
  const py::ssize_t row = array.shape(1) * channels;
  const bool lies_together =
      array.strides(1) == channels && (array.ndim() == 2 || array.strides(2) == 1) && std::abs(array.strides(0)) >= row;
  if (!lies_together) array = py::array_t<std::uint8_t, py::array::c_style>::ensure(array);
  kept.push_back(array);
  quorum::PixelArray pixels;
  pixels.data = static_cast<const std::uint8_t*>(array.data());
  pixels.height = static_cast<int>(array.shape(0));
  pixels.width = static_cast<int>(array.shape(1));
  pixels.channels = static_cast<int>(channels);
  pixels.stride = array.strides(0);
  return pixels;
}

std::size_t length_of(const py::handle& given, const char* name) {
  const Py_ssize_t length = PyObject_Length(given.ptr());
  if (length >= 0) return static_cast<std::size_t>(length);
  PyErr_Clear();
  refuse(std::string(name) + ": is no sequence");
}

/// The items of an argument with one for each view or point; empty if it is None.
std::vector<py::object> items_of(const py::object& given, const char* name, std::size_t count) {
  std::vector<py::object> items;
  if (given.is_none()) return items;
  if (length_of(given, name) != count)
    refuse(std::string(name) + ": has " + std::to_string(length_of(given, name)) + " items; give " +
           std::to_string(count));
  for (std::size_t i = 0; i < count; ++i) items.push_back(given[py::int_(i)]);
  return items;
}

std::vector<int> places_of(const py::object& given, const std::string& place) {
  try {
    return given.cast<std::vector<int>>();
  } catch (const py::cast_error&) {
    refuse(place + ": is no sequence of places of views");
  }
}

void add_views(const GivenArrays& given, quorum::SceneArrays& arrays, std::vector<py::array>& kept) {
  const std::size_t count = length_of(given.images, "images");
  const std::vector<py::object> images = items_of(given.images, "images", count);
  const std::vector<py::object> masks = items_of(given.masks, "masks", count);
  const std::vector<py::object> names = items_of(given.names, "names", count);
  const std::vector<py::object> neighbors = items_of(given.neighbor_lists, "neighbor_lists", count);
  const Rows intrinsics(given.intrinsics, "K", count, {3, 3}, true);
  const Rows rotations(given.rotations, "R", count, {3, 3}, false);
  const Rows translations(given.translations, "t", count, {3}, false);
  std::optional<Rows> depths;
  if (!given.depth_ranges.is_none()) depths.emplace(given.depth_ranges, "depth_ranges", count, std::vector{2L}, true);
  for (std::size_t i = 0; i < count; ++i) {
    quorum::ViewArrays view;
    if (!names.empty()) {
      if (!PyUnicode_Check(names[i].ptr())) refuse(place_of("names", i) + ": is no str");
      view.name = py::cast<std::string>(names[i].attr("encode")("utf-8", "surrogateescape"));
    }
    view.image = pixels_of(images[i], place_of("images", i), kept);
    view.image.is_bgr = given.bgr;
    if (!masks.empty() && !masks[i].is_none()) view.mask = pixels_of(masks[i], place_of("masks", i), kept);
    intrinsics.copy(i, view.camera.intrinsics);
    rotations.copy(i, view.camera.camera_from_world);
    translations.copy(i, view.camera.translation);
    if (depths) {
      std::array<double, 2> range{};
      depths->copy(i, range);
      view.near_depth = range[0];
      view.far_depth = range[1];
    }
    if (!neighbors.empty()) view.neighbors = places_of(neighbors[i], place_of("neighbor_lists", i));
    arrays.views.push_back(std::move(view));
  }
}

void add_points(const GivenArrays& given, quorum::SceneArrays& arrays) {
  if (given.points.is_none()) {
    if (!given.point_views.is_none()) refuse("point_views: needs points");
    return;
  }
  const std::size_t count = length_of(given.points, "points");
  const std::vector<py::object> views = items_of(given.point_views, "point_views", count);
  if (count == 0) return;
  const Rows positions(given.points, "points", count, {3}, false);
  for (std::size_t i = 0; i < count; ++i) {
    quorum::SparsePoint point;
    positions.copy(i, point.position);
    if (!views.empty()) point.views = places_of(views[i], place_of("point_views", i));
    arrays.points.push_back(std::move(point));
  }
}

}  // namespace

quorum::Scene scene_from_arrays(const GivenArrays& given, const quorum::Options& options) {
  quorum::SceneArrays arrays;
  std::vector<py::array> kept;  // until the library has copied them
  add_views(given, arrays, kept);
  add_points(given, arrays);
  if (!given.bounds.is_none()) {
    const Numbers box = Numbers::ensure(given.bounds);
    if (!box || box.size() != 6) refuse("bounds: give x0 y0 z0 x1 y1 z1, or the two corners");
    arrays.bounds.emplace();
    std::copy_n(box.data(), 6, arrays.bounds->begin());
  }
  return take([&] { return quorum::Scene::from_arrays(arrays, options); });
}

}  // namespace quorum_python
