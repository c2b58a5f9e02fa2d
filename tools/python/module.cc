// The Python module quorum._quorum, which quorum/__init__.py shows as quorum (docs/python.md). It stands on the headers
// of the library alone.
#include "tools/python/bindings.h"

namespace quorum_python {

void raise(const quorum::Error& error) {
  const py::object type = py::module_::import("quorum.errors").attr("Error");
  const py::object made = type(static_cast<int>(error.kind), text_of(error.message));
  PyErr_SetObject(type.ptr(), made.ptr());
  throw py::error_already_set();
}

py::str text_of(std::string_view bytes) {
  PyObject* text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

}  // namespace quorum_python

PYBIND11_MODULE(_quorum, module) {
  pybind11::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const pybind11::cast_error&) {
      PyErr_SetString(PyExc_TypeError, "an argument, or what a callback gave, has another type; see help(quorum)");
    }
  });
  module.attr("__version__") = quorum::version();
  quorum_python::bind_options(module);
  quorum_python::bind_scene(module);
  quorum_python::bind_results(module);
  quorum_python::bind_reconstruct(module);
}
