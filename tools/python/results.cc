// Results, whose arrays lie in the object that they come from and keep it.
#include <pybind11/numpy.h>
#include <pybind11/stl/filesystem.h>

#include "tools/python/bindings.h"

namespace quorum_python {
namespace {

using quorum::DepthMap;
using quorum::Mesh;
using quorum::Results;

/// The values as an array that keeps their owner; None where there are none.
template <typename Value>
py::object array_of(const std::vector<Value>& values, std::vector<py::ssize_t> shape, const py::object& owner) {
  if (values.empty() && shape[0] != 0) return py::none();
  return py::array_t<Value>(std::move(shape), values.data(), owner);
}

/// A property: a member of a map, with so many values a pixel.
template <auto Member, int Channels>
py::object map_array(const py::object& self) {
  const auto& map = self.cast<const DepthMap&>();
  std::vector<py::ssize_t> shape = {map.height, map.width};
  if (Channels > 1) shape.push_back(Channels);
  return array_of(map.*Member, std::move(shape), self);
}

/// A property: a member of a mesh, with so many values a row.
template <auto Member, int Channels>
py::object mesh_array(const py::object& self) {
  const auto& values = self.cast<const Mesh&>().*Member;
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(values.size() / Channels)};
  if (Channels > 1) shape.push_back(Channels);
  return array_of(values, std::move(shape), self);
}

void bind_depth_map(py::module_& module) {
  py::class_<DepthMap>(
      module, "DepthMap",
      "What is known at each pixel of a view, row by row from the top. Pixels without a depth hold 0 "
      "everywhere. The arrays lie in this object and keep it; a map that the run did not write is None.")
      .def_readonly("width", &DepthMap::width, "Pixels.")
      .def_readonly("height", &DepthMap::height, "Pixels.")
      .def_property_readonly("depth", &map_array<&DepthMap::depth, 1>,
                             "(height, width) float32: distance along the optical axis, scene units; 0 = none.")
      .def_property_readonly("normal", &map_array<&DepthMap::normal, 3>,
                             "(height, width, 3) float32: unit vectors in the camera's frame, toward the camera.")
      .def_property_readonly("confidence", &map_array<&DepthMap::confidence, 1>,
                             "(height, width) float32: how far the votes lie above the threshold, 0 to 1.")
      .def_property_readonly("certainty", &map_array<&DepthMap::certainty, 1>,
                             "(height, width) float32: how likely the depth is right, from other views' maps, 0 to 1.")
      .def_property_readonly("correlation", &map_array<&DepthMap::correlation, 1>,
                             "(height, width) float32: mean correlation with the views that voted, 0 to 1; with "
                             "maps='all' alone.")
      .def("__repr__", [](const DepthMap& self) {
        return "<quorum.DepthMap of " + std::to_string(self.width) + " x " + std::to_string(self.height) + " pixels>";
      });
}

void bind_mesh(py::module_& module) {
  py::class_<Mesh>(module, "Mesh",
                   "Triangles, and what is known of each vertex. The arrays lie in this object and keep it.")
      .def_property_readonly("vertices", &mesh_array<&Mesh::positions, 3>,
                             "(vertices, 3) float32, scene units; world = vertices + offset.")
      .def_property_readonly("normals", &mesh_array<&Mesh::normals, 3>,
                             "(vertices, 3) float32: unit vectors away from the solid; zero if unknown.")
      .def_property_readonly("colors", &mesh_array<&Mesh::colors, 3>, "(vertices, 3) uint8: red green blue.")
      .def_property_readonly("confidence", &mesh_array<&Mesh::confidence, 1>,
                             "(vertices,) float32: 1 is one view that is fully confident; 0: filled in.")
      .def_property_readonly("faces", &mesh_array<&Mesh::triangles, 3>,
                             "(faces, 3) uint32: vertices, counterclockwise as seen from outside.")
      .def_property_readonly(
          "offset", [](const Mesh& self) { return py::array_t<double>({3}, self.offset.data()); },
          "(3,) float64, scene units: zero unless the scene lies far from its origin.")
      .def("__repr__", [](const Mesh& self) {
        return "<quorum.Mesh of " + std::to_string(self.vertex_count()) + " vertices, " +
               std::to_string(self.triangle_count()) + " faces>";
      });
}

DepthMap depth_map(const Results& results, const py::object& view) {
  const int index = view_index(results.scene(), view);
  return take([&] { return results.depth_map(index); });
}

py::object report(const Results& results) {
  const std::string text = take([&] { return results.report(); });
  return py::module_::import("json").attr("loads")(text_of(text));
}

Results open(const quorum::Scene& scene, const std::filesystem::path& workspace) {
  return take([&] { return Results::open(scene, workspace); });
}

}  // namespace

void bind_results(py::module_& module) {
  bind_depth_map(module);
  bind_mesh(module);
  py::class_<Results>(module, "Results",
                      "What a run gave. It lies in files until it is asked for: in the workspace, or in a temporary "
                      "folder that goes with this object.")
      .def_static("open", &open, py::arg("scene"), py::arg("workspace"),
                  "Those that a run of this scene, here or by the program, left in a workspace.")
      .def_property_readonly("scene", &Results::scene, "The quorum.Scene.")
      .def_property_readonly("folder", &Results::folder, "The folder in which they lie.")
      .def(
          "has_depth_map",
          [](const Results& self, const py::object& view) {
            return self.has_depth_map(view_index(self.scene(), view));
          },
          py::arg("view"), "Whether a view has a depth map; views with fewer than two neighbors have none.")
      .def("depth_map", &depth_map, py::arg("view"),
           "The quorum.DepthMap of a view, by its place or its name. Reads its files at each call.")
      .def(
          "mesh", [](const Results& self) { return take([&] { return self.mesh(); }); },
          "The quorum.Mesh. Reads its file at each call.")
      .def("report", &report, "What the run did, as a dict: run.json.")
      .def("__repr__", [](const Results& self) {
        return py::str("<quorum.Results in {}>").format(py::repr(py::str(py::cast(self.folder()))));
      });
}

}  // namespace quorum_python
