#include "engine/core/error_of.h"

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "engine/core/option.h"

namespace quorum {

Error error_of(const std::exception_ptr& exception) {
  const std::string memory = fmt::format("out of memory; give the run more, or fewer pixels by {}, or a larger {}",
                                         option_name("max-image-size"), option_name("voxel-size"));
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    return {ErrorKind::kMemory, memory};
  } catch (const std::length_error&) {
    return {ErrorKind::kMemory, memory};
  } catch (const std::filesystem::filesystem_error& error) {
    return {ErrorKind::kInput,
            fmt::format("{}: {}; check the disk and the path", error.path1().string(), error.code().message())};
  } catch (const std::system_error& error) {
    // What std::thread throws where no thread is to be had.
    if (error.code() == std::errc::resource_unavailable_try_again)
      return {ErrorKind::kMemory,
              "no thread can be made; raise the limit on processes (ulimit -u) or of the container"};
    if (error.code() == std::errc::not_enough_memory) return {ErrorKind::kMemory, memory};
    return {ErrorKind::kDevice, fmt::format("the system fails: {}", error.what())};
  } catch (const std::exception& error) {
    // oneTBB has no type of its own for this one.
    if (std::string_view(error.what()).find("pthread_create") != std::string_view::npos)
      return {ErrorKind::kMemory,
              "no thread can be made; raise the limit on processes (ulimit -u) or of the container"};
    return {ErrorKind::kDevice, fmt::format("unexpected failure: {}", error.what())};
  } catch (...) {
    return {ErrorKind::kDevice, "unexpected failure"};
  }
}

}  // namespace quorum
