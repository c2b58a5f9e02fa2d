#include "tools/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "engine/core/option.h"
#include "tools/messages.h"
#include "tools/signals.h"

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

int fail(std::string_view command, const Error& error) {
  tell(fmt::format("{}: {}", command, error.message));
  return error.kind == ErrorKind::kStopped && stop_signal() != 0 ? 128 + stop_signal() : static_cast<int>(error.kind);
}

namespace {

/// Edits (a letter more, less, another, or two in the other order) that lead from one word to the other.
std::size_t edits_between(std::string_view from, std::string_view to) {
  std::vector<std::vector<std::size_t>> edits(from.size() + 1, std::vector<std::size_t>(to.size() + 1));
  for (std::size_t i = 0; i <= from.size(); ++i)
    for (std::size_t j = 0; j <= to.size(); ++j) {
      if (i == 0 || j == 0) {
        edits[i][j] = i + j;
        continue;
      }
      const bool same = from[i - 1] == to[j - 1];
      edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, edits[i - 1][j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  return edits[from.size()][to.size()];
}

/// For the first word that looks like an option and is none.
std::string suggest_option(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = std::string_view(argv[i]).substr(0, std::string_view(argv[i]).find('='));
    if (word.starts_with("--") && std::ranges::count(names, word) == 0) return did_you_mean(word, names);
  }
  return "";
}

/// An empty word is mostly a variable of a shell that was not set: -o "$OUT".
Expected<void> check_words(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& word : option->results())
      if (word.empty())
        return failure(ErrorKind::kUsage,
                       fmt::format("{}: is empty; give a value, or leave it out; see quorum {} --help",
                                   option->get_name(), app.get_name()));
  return {};
}

}  // namespace

Expected<void> check_not_input(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs) {
  std::error_code ignored;
  for (const std::filesystem::path& input : inputs)
    if (!input.empty() && std::filesystem::equivalent(output, input, ignored))
      return failure(ErrorKind::kUsage,
                     fmt::format("{}: is an input of this command, which would be lost; give the output another name",
                                 output.string()));
  return {};
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 64;
  if (word.size() > kLongest) return "";
  std::size_t least = 1 + std::max<std::size_t>(1, word.size() / 4);
  std::string nearest;
  for (const std::string& name : names)
    if (const std::size_t edits = edits_between(word, name); edits < least) {
      least = edits;
      nearest = name;
    }
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

int run_command(CLI::App& app, int argc, char** argv, const std::function<Expected<void>()>& work) {
  set_option_speller([](std::string_view name) { return "--" + std::string(name); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    write_result(app.help());
    const auto shown = flush_results();
    return shown ? 0 : fail(app.get_name(), shown.error());
  } catch (const CLI::ParseError& error) {
    const bool is_extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    return fail(app.get_name(),
                {ErrorKind::kUsage, fmt::format("{}{}; see quorum {} --help", error.what(),
                                                is_extra ? suggest_option(app, argc, argv) : "", app.get_name())});
  }
  auto done = check_words(app);
  if (done) done = work();
  if (done) done = flush_results();
  return done ? 0 : fail(app.get_name(), done.error());
}

}  // namespace quorum
