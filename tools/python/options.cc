// Options as keyword arguments, and devices.
#include <pybind11/stl.h>

#include <algorithm>
#include <vector>

#include "tools/python/bindings.h"

namespace quorum_python {
namespace {

std::string bytes_of(const py::handle& text) {
  PyObject* encoded = PyUnicode_EncodeFSDefault(text.ptr());
  if (encoded == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(encoded);
}

/// A str or a path; empty if it is neither.
py::object words_of(const py::handle& value) {
  if (PyUnicode_Check(value.ptr())) return py::reinterpret_borrow<py::object>(value);
  if (py::hasattr(value, "__fspath__")) return value.attr("__fspath__")();
  return py::none();
}

void set_option(quorum::Options& options, const std::string& name, py::object value) {
  if (value.is_none()) return;
  if (py::hasattr(value, "tolist")) value = value.attr("tolist")();  // NumPy's numbers and arrays
  if (PyBool_Check(value.ptr())) {
    options.set(name, value.cast<bool>());
  } else if (PyLong_Check(value.ptr())) {
    options.set(name, value.cast<std::int64_t>());
  } else if (PyFloat_Check(value.ptr())) {
    options.set(name, value.cast<double>());
  } else if (const py::object words = words_of(value); !words.is_none()) {
    options.set(name, bytes_of(words));
  } else if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::vector<double> numbers;
    for (const py::handle& number : value) numbers.push_back(number.cast<double>());
    options.set(name, numbers);
  } else {
    throw py::type_error("option " + name + ": give a bool, a number, a str, a path or several numbers, not " +
                         std::string(py::str(py::type::of(value).attr("__name__"))));
  }
}

std::vector<quorum::Device> devices() {
  return take([] { return quorum::list_devices(); });
}

quorum::Device device(const std::string& request) {
  return take([&] { return quorum::choose_device(request); });
}

void bind_devices(py::module_& module) {
  py::class_<quorum::Device>(module, "Device", "What a run can work on. Results are the same on every device.")
      .def_readonly("option", &quorum::Device::option, "The value of the option device that chooses it.")
      .def_readonly("name", &quorum::Device::name, "Of the device, or the CPU's in words.")
      .def_readonly("kind", &quorum::Device::kind, "'CPU', 'discrete GPU', 'software Vulkan' ...")
      .def_readonly("driver", &quorum::Device::driver, "And its version; empty if it does not tell.")
      .def_readonly("memory_bytes", &quorum::Device::memory_bytes, "Of the device; 0: that of the host.")
      .def_readonly("defect", &quorum::Device::defect, "Why it can't be used; empty if it can.")
      .def("__repr__", [](const quorum::Device& self) {
        return "<quorum.Device " + self.option + ": " + self.name + (self.defect.empty() ? "" : ", not usable") + ">";
      });
  module.def("devices", &devices, "The CPU, then the Vulkan devices, usable or not.");
  module.def("choose_device", &device, py::arg("request") = "auto",
             "The device that a run with this option device would use: 'auto', 'cpu', an index or a part of a name.");
}

}  // namespace

quorum::Options options_of(const py::kwargs& given) {
  quorum::Options options;
  for (const auto& [key, value] : given) {
    std::string name = key.cast<std::string>();
    std::ranges::replace(name, '_', '-');
    set_option(options, name, py::reinterpret_borrow<py::object>(value));
  }
  if (const auto checked = options.check(); !checked) raise(checked.error());
  return options;
}

void bind_options(py::module_& module) {
  using quorum::OptionInfo;
  py::class_<OptionInfo>(module, "OptionInfo", "What is known of an option.")
      .def_property_readonly(
          "name",
          [](const OptionInfo& self) {
            std::string name = self.name;
            std::ranges::replace(name, '-', '_');
            return name;
          },
          "As a keyword argument: 'voxel_size'.")
      .def_readonly("values", &OptionInfo::values, "What it takes: '3 to 15, odd'; empty for a switch.")
      .def_readonly("usual", &OptionInfo::usual, "Its default, as text; empty if it has none.")
      .def_readonly("help", &OptionInfo::help, "What it is for, with its unit.")
      .def_readonly("heading", &OptionInfo::heading, "What it and those beside it are about.")
      .def_readonly("is_switch", &OptionInfo::is_switch, "True or False.")
      .def("__repr__", [](const OptionInfo& self) { return "<quorum.OptionInfo " + self.name + ">"; });
  module.def("options", &quorum::list_options, "All options, those of the scene first.");
  bind_devices(module);
}

}  // namespace quorum_python
