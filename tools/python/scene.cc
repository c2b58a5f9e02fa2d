// Scenes, and their views.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "tools/python/scene_arrays.h"

namespace quorum_python {
namespace {

using quorum::Scene;
using quorum::ViewInfo;

template <typename Values>
py::array_t<double> array_of(const Values& values, std::vector<py::ssize_t> shape) {
  return py::array_t<double>(std::move(shape), values.data());
}

Scene read(const std::filesystem::path& folder, const py::kwargs& options) {
  const quorum::Options given = options_of(options);
  return take([&] { return Scene::read(folder, given); });
}

Scene from_arrays(const py::object& images, const py::object& intrinsics, const py::object& rotations,
                  const py::object& translations, const py::object& points, const py::object& point_views,
                  const py::object& masks, const py::object& names, const py::object& bounds,
                  const py::object& depth_ranges, const py::object& neighbor_lists, bool bgr,
                  const py::kwargs& options) {
  return scene_from_arrays({images, intrinsics, rotations, translations, points, point_views, masks, names, bounds,
                            depth_ranges, neighbor_lists, bgr},
                           options_of(options));
}

std::vector<ViewInfo> views(const Scene& scene) {
  std::vector<ViewInfo> all;
  for (int index = 0; index < scene.view_count(); ++index) all.push_back(scene.view(index));
  return all;
}

std::vector<py::str> notes(const Scene& scene) {
  std::vector<py::str> lines;
  for (const std::string& note : scene.notes()) lines.push_back(text_of(note));
  return lines;
}

void bind_view(py::module_& module) {
  py::class_<ViewInfo>(module, "View", "A photograph with its camera: pixel ~ K (R point + t).")
      .def_property_readonly(
          "name", [](const ViewInfo& self) { return text_of(self.name); }, "Names its files.")
      .def_property_readonly(
          "image_name", [](const ViewInfo& self) { return text_of(self.image_name); },
          "What the scene's files, or the argument names, call it.")
      .def_readonly("width", &ViewInfo::width, "Of the image that is worked on and of the depth map, pixels.")
      .def_readonly("height", &ViewInfo::height, "Pixels.")
      .def_readonly("near_depth", &ViewInfo::near_depth, "Scene units.")
      .def_readonly("far_depth", &ViewInfo::far_depth, "Scene units; 0: the bounds alone say.")
      .def_property_readonly(
          "K",
          [](const ViewInfo& self) {
            return array_of(self.camera.intrinsics, {3, 3});
          },
          "(3, 3) float64, pixels; the center of the top-left pixel is (0, 0).")
      .def_property_readonly(
          "R",
          [](const ViewInfo& self) {
            return array_of(self.camera.camera_from_world, {3, 3});
          },
          "(3, 3) float64: camera from world, x right, y down, z forward.")
      .def_property_readonly(
          "t", [](const ViewInfo& self) { return array_of(self.camera.translation, {3}); },
          "(3,) float64, scene units.")
      .def("__repr__", [](const ViewInfo& self) {
        return py::str("<quorum.View {}: {} x {}>").format(text_of(self.name), self.width, self.height);
      });
}

constexpr const char* kReadDoc = R"(Reads a scene in any format that `quorum reconstruct` reads.

folder: str or path. options: those of the scene (format, images, masks, bounds, max_image_size ...) and threads; see
quorum.options(). Raises quorum.Error.)";

constexpr const char* kFromArraysDoc = R"(Makes a scene of arrays, which may change after the call.

images: sequence of (height, width) or (height, width, 3) uint8, red green blue, free of lens distortion; three or more.
K: (3, 3), or (views, 3, 3) float, pixels; the center of the top-left pixel is (0, 0).
R, t: (views, 3, 3) and (views, 3) float: point_in_camera = R @ point + t; x right, y down, z forward.
points: (points, 3) float, scene units, of the object; they help to choose neighbors and depths.
point_views: of each point the places of the views that see it.
masks: of each view (height, width) uint8 or bool, or None; 0 is left out.
names: of each view a str; they name its files.
bounds: x0 y0 z0 x1 y1 z1 of the box that holds the object, or (2, 3); found from points or cameras if it is not given.
depth_ranges: (2,) or (views, 2) float: least and largest depth, scene units; 0 0: unknown.
neighbor_lists: of each view the places of those to compare it with, best first; empty: they are chosen.
bgr: whether channels are blue green red, as OpenCV has them.
options: roi, max_image_size, threads. Raises quorum.Error, which names the argument and its place.)";

}  // namespace

int view_index(const Scene& scene, const py::handle& view) {
  if (PyUnicode_Check(view.ptr())) {
    for (int index = 0; index < scene.view_count(); ++index) {
      const ViewInfo info = scene.view(index);
      if (text_of(info.name).equal(view) || text_of(info.image_name).equal(view)) return index;
    }
    throw py::key_error("the scene has no view " + std::string(py::repr(view)));
  }
  const auto index = view.cast<std::int64_t>();
  const std::int64_t count = scene.view_count();
  if (index < -count || index >= count)
    throw py::index_error("view " + std::to_string(index) + " was asked for; the scene has " + std::to_string(count));
  return static_cast<int>(index < 0 ? index + count : index);
}

void bind_scene(py::module_& module) {
  bind_view(module);
  py::class_<Scene>(module, "Scene", "Photographs with known cameras, from files or from arrays.")
      .def_static("read", &read, py::arg("folder"), kReadDoc)
      .def_static("from_arrays", &from_arrays, py::arg("images"), py::arg("K"), py::arg("R"), py::arg("t"),
                  py::kw_only(), py::arg("points") = py::none(), py::arg("point_views") = py::none(),
                  py::arg("masks") = py::none(), py::arg("names") = py::none(), py::arg("bounds") = py::none(),
                  py::arg("depth_ranges") = py::none(), py::arg("neighbor_lists") = py::none(), py::arg("bgr") = false,
                  kFromArraysDoc)
      .def("__len__", &Scene::view_count)
      .def_property_readonly("views", &views, "A quorum.View for each photograph.")
      .def_property_readonly(
          "bounds",
          [](const Scene& self) {
            return array_of(self.bounds(), {2, 3});
          },
          "(2, 3) float64: the corners of the box that holds the object, scene units.")
      .def_property_readonly("notes", &notes, "What was left out, and what was chosen: lines for the user.")
      .def("__repr__",
           [](const Scene& self) { return "<quorum.Scene of " + std::to_string(self.view_count()) + " views>"; });
}

}  // namespace quorum_python
