// What the files of the Python module share.
#pragma once

#include <pybind11/pybind11.h>
#include <quorum/quorum.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace quorum_python {

namespace py = pybind11;

/// Raises quorum.Error. Needs the GIL.
[[noreturn]] void raise(const quorum::Error& error);

/// Raises a quorum.Error about an argument. Needs the GIL.
[[noreturn]] inline void refuse(std::string message) { raise({quorum::ErrorKind::kInput, std::move(message)}); }

/// Does work, which gives a quorum::Result, without the GIL: its value, or a quorum.Error.
template <typename Work>
auto take(const Work& work) {
  auto result = [&] {
    const py::gil_scoped_release released;
    return work();
  }();
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<decltype(*result)>) return *std::move(result);
}

/// Bytes of a name or a line as str; what is not UTF-8 as Python has it in names of files.
py::str text_of(std::string_view bytes);

/// Options by their names, with _ for -. None is left out.
quorum::Options options_of(const py::kwargs& given);

/// The place of a view: a number, which may count from the end, or a name. Raises IndexError or KeyError.
int view_index(const quorum::Scene& scene, const py::handle& view);

void bind_options(py::module_& module);
void bind_scene(py::module_& module);
void bind_results(py::module_& module);
void bind_reconstruct(py::module_& module);

}  // namespace quorum_python
