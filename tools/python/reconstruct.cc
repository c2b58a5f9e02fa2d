// The run, without the GIL but while it calls back.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "tools/python/bindings.h"

namespace quorum_python {
namespace {

/// quorum::Progress, whose stage may be kept.
struct KeptProgress {
  std::string stage;
  quorum::Progress progress;
};

/// The functions of a run. Signals are looked at before each view, so that Ctrl-C raises KeyboardInterrupt.
void set_callbacks(quorum::RunSettings& settings, const py::object& on_progress, const py::object& on_note,
                   const py::object& should_stop) {
  if (!on_progress.is_none())
    settings.on_progress = [&on_progress](const quorum::Progress& progress) {
      const py::gil_scoped_acquire held;
      on_progress(KeptProgress{std::string(progress.stage), progress});
    };
  if (!on_note.is_none())
    settings.on_note = [&on_note](std::string_view line) {
      const py::gil_scoped_acquire held;
      on_note(text_of(line));
    };
  settings.should_stop = [&should_stop] {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return !should_stop.is_none() && should_stop().cast<bool>();
  };
}

quorum::Scene scene_of(const py::object& given, const quorum::Options& options) {
  if (py::isinstance<quorum::Scene>(given)) return given.cast<quorum::Scene>();
  const auto folder = given.cast<std::filesystem::path>();
  return take([&] { return quorum::Scene::read(folder, options); });
}

quorum::Results reconstruct(const py::object& scene, const std::optional<std::filesystem::path>& workspace, bool mesh,
                            bool restart, bool report_page, const py::object& on_progress, const py::object& on_note,
                            const py::object& should_stop, const py::kwargs& options) {
  const quorum::Options given = options_of(options);
  const quorum::Scene taken = scene_of(scene, given);
  quorum::RunSettings settings;
  settings.workspace = workspace.value_or(std::filesystem::path());
  settings.mesh = mesh;
  settings.restart = restart;
  settings.report_page = report_page;
  set_callbacks(settings, on_progress, on_note, should_stop);
  return take([&] { return quorum::reconstruct(taken, given, settings); });
}

void bind_progress(py::module_& module) {
  const auto field = [](auto member) { return [member](const KeptProgress& self) { return self.progress.*member; }; };
  py::class_<KeptProgress>(module, "Progress", "Where a run stands.")
      .def_readonly("stage", &KeptProgress::stage, "'computing depth maps' ...")
      .def_property_readonly("done", field(&quorum::Progress::done), "Steps of the stage that are done.")
      .def_property_readonly("steps", field(&quorum::Progress::steps), "Steps of the stage.")
      .def_property_readonly("percent", field(&quorum::Progress::percent), "Of the stage, 0 to 100.")
      .def_property_readonly("run_percent", field(&quorum::Progress::run_percent), "Of the whole run, 0 to 100.")
      .def_property_readonly("seconds_left", field(&quorum::Progress::seconds_left), "Of the stage, or None.")
      .def_property_readonly("run_seconds_left", field(&quorum::Progress::run_seconds_left), "Of the run, or None.")
      .def("__repr__", [](const KeptProgress& self) {
        return py::str("<quorum.Progress {} {}/{}>").format(self.stage, self.progress.done, self.progress.steps);
      });
}

constexpr const char* kReconstructDoc = R"(Makes the depth maps of all views and the mesh.

scene: a quorum.Scene, or the folder of one (str or path), which is read with the same options.
workspace: a folder (str or path) where results are kept and those of an earlier run taken up; None: a temporary one.
mesh: False makes depth maps and their certainties alone. restart: make all anew. report_page: also report.html.
on_progress: called with a quorum.Progress; on_note: with a line for the user; should_stop: before each view, and True
ends the run with a quorum.Error of kind STOPPED. What they raise ends the run and comes out of this call, and so does
KeyboardInterrupt.
options: those of `quorum reconstruct` by name, with _ for - (neighbors=6, voxel_size='0.5mm', fill_holes=True, half_size=False);
see quorum.options(). Returns quorum.Results. Raises quorum.Error. Other threads go on meanwhile.)";

}  // namespace

void bind_reconstruct(py::module_& module) {
  bind_progress(module);
  module.def("reconstruct", &reconstruct, py::arg("scene"), py::arg("workspace") = py::none(), py::kw_only(),
             py::arg("mesh") = true, py::arg("restart") = false, py::arg("report_page") = false,
             py::arg("on_progress") = py::none(), py::arg("on_note") = py::none(), py::arg("should_stop") = py::none(),
             kReconstructDoc);
}

}  // namespace quorum_python
